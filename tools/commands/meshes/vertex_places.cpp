#include <tools/commands/meshes/vertex_places.hpp>

#include <cmath>
#include <limits>

#include <tools/patches/library_status.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

template <typename T>
void describe_vertices(const MeshArguments& mesh, std::size_t patches, MeshContents& contents) {
  const NumberType type = mesh.floats ? number_type<float>() : number_type<T>();
  if (mesh.parameters && mesh_abilities(mesh.format).point_data) {
    contents.patches = patches;
  }
  if (mesh.curvature) {
    contents.data = {{"gaussian", type}, {"mean", type}, {"kmin", type}, {"kmax", type}};
  }
}

template <typename T>
Curvatures<T> VertexCurvatures<T>::outputs(std::size_t vertices) {
  Curvatures<T> to;
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    values_[k].resize(vertices);
    to[static_cast<Curvature>(k)] = values_[k];
  }
  return to;
}

template <typename T>
void VertexCurvatures<T>::turn(std::size_t vertex) {
  const auto of = [&](Curvature kind) -> T& {
    return values_[static_cast<std::size_t>(kind)][vertex];
  };
  of(Curvature::mean) = T(0) - of(Curvature::mean); // no -0
  const T least = T(0) - of(Curvature::maximum);
  of(Curvature::maximum) = T(0) - of(Curvature::minimum);
  of(Curvature::minimum) = least;
}

template <typename T>
std::span<const std::byte> VertexCurvatures<T>::records(bool floats) {
  const auto store = [&]<typename Stored>(Stored) {
    records_.resize(values_[0].size() * kCurvatureKinds * sizeof(Stored));
    std::byte* to = records_.data();
    for (std::size_t vertex = 0; vertex < values_[0].size(); ++vertex) {
      for (const std::vector<T>& kind : values_) {
        // The sign of nan depends on the machine.
        constexpr Stored kNan = std::numeric_limits<Stored>::quiet_NaN();
        const T value = kind[vertex];
        store_little(to, std::isnan(value) ? kNan : static_cast<Stored>(value));
        to += sizeof(Stored);
      }
    }
  };
  floats ? store(float()) : store(T());
  return records_;
}

template <typename T>
void VertexPlaces<T>::ask(std::size_t vertices, MeshOutputs<T>& out) {
  if (!mesh_.parameters && !mesh_.curvature) {
    return;
  }
  static_cast<void>(curvatures_.outputs(vertices)); // which has to be none where there are none
  patch_.resize(vertices);
  u_.resize(vertices);
  v_.resize(vertices);
  out.patch = patch_;
  out.parameters = Vectors<T>::planes(std::span(u_), std::span(v_));
}

template <typename T>
void VertexPlaces<T>::find_curvatures(const PatchSet<T>& set, const Topology& topology,
                                      const Options& options) {
  if (!mesh_.curvature) {
    return;
  }
  Outputs<T> out;
  out.curvature = curvatures_.outputs(patch_.size());
  check(evaluate(set, Samples<T>{patch_, u_, v_}, out, options));
  for (std::size_t k = 0; k < patch_.size(); ++k) {
    if (topology.is_turned(patch_[k])) {
      curvatures_.turn(k);
    }
  }
}

template <typename T>
void VertexPlaces<T>::find_in_file(std::span<const PatchPiece> pieces,
                                   std::span<const std::uint32_t> numbers) {
  for (std::size_t k = 0; k < patch_.size() && !pieces.empty(); ++k) {
    const PatchPiece& piece = pieces[patch_[k]];
    u_[k] = static_cast<T>(piece.whole_u(static_cast<double>(u_[k])));
    v_[k] = static_cast<T>(piece.whole_v(static_cast<double>(v_[k])));
  }
  for (std::size_t k = 0; k < patch_.size() && !numbers.empty(); ++k) {
    patch_[k] = numbers[patch_[k]];
  }
}

template <typename T>
VertexBlock<T> VertexPlaces<T>::block(std::span<T> values, std::size_t stride) {
  VertexBlock<T> block{values};
  if (mesh_.parameters) {
    for (std::size_t k = 0; k < patch_.size(); ++k) {
      values[(k + 1) * stride - 2] = u_[k];
      values[(k + 1) * stride - 1] = v_[k];
    }
    block.patch = mesh_abilities(mesh_.format).point_data ? patch_ : block.patch;
  }
  block.data = mesh_.curvature ? curvatures_.records(mesh_.floats) : block.data;
  return block;
}

template void describe_vertices<float>(const MeshArguments&, std::size_t, MeshContents&);
template void describe_vertices<double>(const MeshArguments&, std::size_t, MeshContents&);
template class VertexCurvatures<float>;
template class VertexCurvatures<double>;
template class VertexPlaces<float>;
template class VertexPlaces<double>;

} // namespace simdbezier::tools
