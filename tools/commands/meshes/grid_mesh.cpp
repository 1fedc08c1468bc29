#include <tools/commands/meshes/grid_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <tools/patches/edge_counts.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/patches/patch_rounding.hpp>

namespace simdbezier::tools {

template <typename T>
GridMesh<T>::GridMesh(const ModelPart& part, const Arguments& arguments, MeshStats& stats)
    : arguments_(arguments), patches_(part.file.count), first_patch_(part.first_patch()),
      numbered_(part.patches), grid_(arguments.grid), box_(part.box),
      evaluator_(part.file, arguments.grid, arguments.threads) {
  expect_no_point<T>(box_, part.file.name, arguments.mesh.can_move);
  const MeshContents mesh = contents();
  stats.patches = patches_;
  stats.vertices = stats.samples = mesh.vertices;
  stats.triangles = mesh.faces * (mesh.corners - 2);
  if (arguments_.mesh.stats != StatsForm::none) {
    measure(part.file, stats);
  }
}

template <typename T>
void GridMesh<T>::measure(const PatchFile& file, MeshStats& stats) const {
  const Stopwatch watch(stats.seconds.rates);
  MeshContents mesh = contents();
  stats.diagonal = diagonal_of(box_);
  // Every edge is open but those that are a point.
  stats.open_edges = kPatchEdges * patches_ - joined_counts(file).collapsed_sides;
  double deviation = std::numeric_limits<double>::min();
  for (std::size_t first = 0; first < patches_; first += kBlockPatches) {
    const std::size_t count = std::min(kBlockPatches, patches_ - first);
    const std::vector<double> errors = rounding_errors<T>(file, first, count);
    const PatchNets<double> block = file.nets<double>(first, count);
    std::vector<double> deviations(count);
    check(certify_grids<double>(block.nets, static_cast<std::uint32_t>(grid_.nu - 1),
                                static_cast<std::uint32_t>(grid_.nv - 1), errors, deviations,
                                {.threads = arguments_.threads})
              .status);
    deviation = std::max(deviation, std::ranges::max(deviations));
  }
  mesh.deviation = deviation;
  stats.deviation = stated_deviation<T>(arguments_.mesh.format, mesh);
}

template <typename T>
MeshContents GridMesh<T>::contents() const {
  MeshContents contents;
  contents.vertices = patches_ * vertices_per_patch();
  contents.corners = arguments_.mesh.quads ? 4 : 3;
  contents.faces = patches_ * (grid_.nu - 1) * (grid_.nv - 1) * (arguments_.mesh.quads ? 1 : 2);
  contents.normals = arguments_.mesh.normals;
  contents.uv = arguments_.mesh.parameters;
  contents.storage = arguments_.mesh.storage;
  contents.floats = arguments_.mesh.floats;
  describe_vertices<T>(arguments_.mesh, numbered_, contents);
  contents.origin = arguments_.mesh.origin;
  contents.box = box_;
  // Positions may leave the control points' box by rounding, which is less than this part of the
  // largest coordinate. Bounds that are 0 or small stay, and positions beyond them come to them:
  // exact ones lie inside, so that this brings no position farther from its exact one.
  constexpr double kMargin = 0x1p-16;
  contents.margin = kMargin * largest_coordinate(box_);
  // The box of a point stays one, whose size is not that of its errors.
  for (std::size_t c = 0; c < 3 && box_.low != box_.high; ++c) {
    contents.box->low[c] -= kMargin * std::abs(box_.low[c]);
    contents.box->high[c] += kMargin * std::abs(box_.high[c]);
  }
  return contents;
}

template <typename T>
void GridMesh<T>::write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) {
  for_each_block(patches_, grid_, [&](const GridBlock& block) {
    write_block(block, writer, seconds);
    if (block.first_row + block.row_count != grid_.nv) {
      return;
    }
    if (writer.takes_faces_early()) {
      write_faces(block.first_patch, block.patch_count, writer, seconds);
    }
    progress.advance(block.patch_count);
  });
  if (!writer.takes_faces_early()) {
    write_faces(0, patches_, writer, seconds);
  }
}

template <typename T>
void GridMesh<T>::write_block(const GridBlock& block, MeshWriter<T>& writer,
                              StageSeconds& seconds) {
  const std::size_t stride = contents().stride();
  values_.resize(block.samples(grid_) * stride);
  Outputs<T> out;
  out.position = Vectors<T>::xyz(values_.data(), static_cast<std::ptrdiff_t>(stride));
  if (arguments_.mesh.normals) {
    out.normal = Vectors<T>::xyz(values_.data() + 3, static_cast<std::ptrdiff_t>(stride));
  }
  if (arguments_.mesh.curvature) {
    out.curvature = curvatures_.outputs(block.samples(grid_));
  }
  {
    const Stopwatch watch(seconds.evaluate);
    evaluator_.evaluate(block, out);
    if (arguments_.mesh.flip) {
      turn_normals(stride);
    }
  }
  if (arguments_.mesh.parameters) {
    put_parameters(block, stride);
  }
  const Stopwatch watch(seconds.write);
  VertexBlock<T> written{values_};
  if (contents().patches > 0) {
    written.patch = patch_;
  }
  if (arguments_.mesh.curvature) {
    written.data = curvatures_.records(arguments_.mesh.floats);
  }
  writer.vertices(written);
}

template <typename T>
void GridMesh<T>::turn_normals(std::size_t stride) {
  for (std::size_t k = 0; k < values_.size() / stride; ++k) {
    for (std::size_t c = 3; c < 6 && arguments_.mesh.normals; ++c) {
      T& value = values_[k * stride + c];
      value = T(0) - value; // no -0
    }
    if (arguments_.mesh.curvature) {
      curvatures_.turn(k);
    }
  }
}

// Puts u and v at the end of every vertex of a block, and its patch in patch_.
template <typename T>
void GridMesh<T>::put_parameters(const GridBlock& block, std::size_t stride) {
  T* to = values_.data() + stride - 2;
  patch_.clear();
  for (std::size_t row = 0; row < block.patch_count * block.row_count; ++row) {
    const std::size_t j = block.first_row + row % block.row_count;
    patch_.insert(
        patch_.end(), grid_.nu,
        static_cast<std::uint32_t>(first_patch_ + block.first_patch + row / block.row_count));
    for (std::size_t i = 0; i < grid_.nu; ++i, to += stride) {
      to[0] = static_cast<T>(i) / static_cast<T>(grid_.nu - 1);
      to[1] = static_cast<T>(j) / static_cast<T>(grid_.nv - 1);
    }
  }
}

template <typename T>
void GridMesh<T>::write_faces(std::size_t first, std::size_t count, MeshWriter<T>& writer,
                              StageSeconds& seconds) {
  constexpr std::size_t kBlockCorners = std::size_t{12} << 12;
  const Stopwatch watch(seconds.write);
  corners_.clear();
  for (std::size_t p = first; p < first + count; ++p) {
    for (std::size_t j = 0; j + 1 < grid_.nv; ++j) {
      for (std::size_t i = 0; i + 1 < grid_.nu; ++i) {
        append_cell(static_cast<std::uint32_t>(p * vertices_per_patch() + j * grid_.nu + i));
        if (corners_.size() >= kBlockCorners) {
          writer.faces(corners_);
          corners_.clear();
        }
      }
    }
  }
  writer.faces(corners_);
}

template <typename T>
void GridMesh<T>::append_cell(std::uint32_t a) {
  a += first_vertex_;
  const std::uint32_t b = a + 1;
  const std::uint32_t d = a + static_cast<std::uint32_t>(grid_.nu);
  const std::uint32_t c = d + 1;
  // Flipped, every face begins with the same vertex and runs the other way round.
  const std::uint32_t second = arguments_.mesh.flip ? d : b;
  const std::uint32_t fourth = arguments_.mesh.flip ? b : d;
  if (arguments_.mesh.quads) {
    corners_.insert(corners_.end(), {a, second, c, fourth});
  } else {
    corners_.insert(corners_.end(), {a, second, c, a, c, fourth});
  }
}

template class GridMesh<float>;
template class GridMesh<double>;

} // namespace simdbezier::tools
