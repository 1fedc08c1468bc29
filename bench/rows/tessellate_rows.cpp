// tessellate/position_normal/<type>/<isa>/<nu>x<nv>/memory/threads:<t>/part:<part>
// [/degree:MxN][/weights:rational]: meshes of a sheet of patches that share edges, with merged
// normals and 32-bit triangles. Adaptive ones on the widest instruction set also of other patches
// than bicubic ones.
//
//   16x16   uniform: every patch has 15 x 15 cells. mesh: vertices and triangles.
//   8x8     adaptive, 7 x 7 cells in the mean. mesh: rates, layout, vertices, triangles; all: the
//           topology as well; grids: evaluate() on the grids of the same rates.
//
// plain/8x8: a scalar tessellator without a library, on some of the patches, all with one grid, to
// the same tolerance; items are triangles. peers/mesh_peer_rows.cpp has another library's.
//
// Items are samples: vertices of meshes, samples of grids, patches of rates, topology and layout.
// Bytes are those of the output.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/mesh_stages.hpp"
#include "bench/rows/plain_tessellator.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

constexpr BatchShape kShapes[] = {{1, 1}, {2, 2}, {5, 4}, {8, 8}, {2, 2, true}, {3, 3, true}};

/// One part of the work: which stages run, in their order.
template <typename T>
struct Part {
  const char* name;
  std::vector<Status (MeshStages<T>::*)(const Options&)> stages;
  enum Items { vertices, triangles, patches, samples } items;
  bool has_isa; ///< whether the last stage says which instruction set ran
};

template <typename T>
class MeshRow {
public:
  MeshRow(const Part<T>& part, const MeshKind& kind, Isa isa, int threads)
      : part_(part), stages_(shared_stages<T>(kind)) {
    options_.isa = isa;
    options_.destination = simdbezier::Destination::memory;
    options_.threads = threads;
  }
  void operator()() { (void)run(options_); }
  std::string check() {
    if (stages_ == nullptr) {
      return "the sheet could not be laid out";
    }
    if (const Status status = run(options_); !part_.has_isa) {
      return status ? std::string() : std::string(simdbezier::to_string(status));
    }
    return run_verified(options_, [&](const Options& how) { return run(how); });
  }
  [[nodiscard]] double items() const {
    const simdbezier::MeshSize size = stages_->layout.size();
    switch (part_.items) {
    case Part<T>::vertices:
      return static_cast<double>(size.vertices);
    case Part<T>::triangles:
      return static_cast<double>(size.triangles);
    case Part<T>::samples:
      return stages_->grid_samples();
    default:
      return static_cast<double>(stages_->patches());
    }
  }
  [[nodiscard]] double bytes() const {
    const simdbezier::MeshSize size = stages_->layout.size();
    const auto has = [&](auto stage) { return std::ranges::count(part_.stages, stage) > 0; };
    double bytes = 0;
    if (has(&MeshStages<T>::evaluate_vertices)) {
      bytes += 6.0 * sizeof(T) * static_cast<double>(size.vertices);
    }
    if (has(&MeshStages<T>::write)) {
      bytes += 12.0 * static_cast<double>(size.triangles);
    }
    if (has(&MeshStages<T>::evaluate_grids)) {
      bytes += 6.0 * sizeof(T) * stages_->grid_samples();
    }
    return bytes;
  }

private:
  Status run(const Options& how) {
    for (const auto stage : part_.stages) {
      if (const Status status = (*stages_.*stage)(how); !status) {
        return status;
      }
    }
    return Status::ok;
  }

  Part<T> part_;
  std::shared_ptr<MeshStages<T>> stages_;
  Options options_;
};

template <typename T>
std::vector<Part<T>> parts_of(bool adaptive) {
  using S = MeshStages<T>;
  using P = Part<T>;
  std::vector<P> parts = {{"vertices", {&S::evaluate_vertices}, P::vertices, true},
                          {"triangles", {&S::write}, P::triangles, false},
                          {"grids", {&S::evaluate_grids}, P::samples, true}};
  if (adaptive) {
    parts.push_back({"topology", {&S::join}, P::patches, false});
    parts.push_back({"rates", {&S::choose}, P::patches, false});
    parts.push_back({"layout", {&S::lay_out}, P::patches, false});
    parts.push_back(
        {"mesh", {&S::choose, &S::lay_out, &S::write, &S::evaluate_vertices}, P::vertices, true});
    parts.push_back(parts.back());
    parts.back().name = "all";
    parts.back().stages.insert(parts.back().stages.begin(), &S::join);
  } else {
    parts.push_back({"mesh", {&S::write, &S::evaluate_vertices}, P::vertices, true});
  }
  return parts;
}

template <typename T>
void add_mesh(const MeshKind& kind, Isa isa, int threads) {
  const std::size_t n = kind.adaptive ? 8 : 16;
  const RowName name{"tessellate",
                     OutputGroups::position_normal,
                     sizeof(T) == 4,
                     std::string(simdbezier::to_string(isa)),
                     n,
                     n,
                     MemoryLevel::memory,
                     threads};
  for (const Part<T>& part : parts_of<T>(kind.adaptive)) {
    register_row(name.text() + "/part:" + part.name + shape_parts(kind.shape),
                 benchmark::kMillisecond, threads,
                 [=] { return MeshRow<T>(part, kind, isa, threads); });
  }
}

template <typename T>
void add_meshes() {
  const auto isas = simdbezier::available_isas();
  for (const Isa isa : isas) {
    for (const bool adaptive : {false, true}) {
      for (int threads = 1; threads <= max_threads(); ++threads) {
        add_mesh<T>({adaptive}, isa, threads);
      }
    }
  }
  for (const BatchShape shape : kShapes) {
    add_mesh<T>({true, shape}, isas.back(), 1);
  }
}

/// The rows called plain: what one writes without a library, on some rows of the sheet, to the
/// tolerance of 8x8.
class PlainRow {
public:
  PlainRow()
      : stages_(shared_stages<float>({.adaptive = true})),
        plain_(stages_ == nullptr ? std::span<const PlainTessellator::Point>()
                                  : std::span(reinterpret_cast<const PlainTessellator::Point*>(
                                                  stages_->nets.data()),
                                              16 * kPeerPatches)) {}
  void operator()() { plain_.run(stages_->tolerance); }
  std::string check() {
    if (stages_ == nullptr) {
      return "the sheet could not be laid out";
    }
    (*this)();
    const std::size_t rate = plain_.rate(stages_->tolerance);
    const std::size_t joined = (kColumns * rate + 1) * (kPeerRows * rate + 1);
    return plain_.vertices() >= joined ? std::string() : "vertices are missing";
  }
  [[nodiscard]] double items() const { return static_cast<double>(plain_.triangles()); }
  [[nodiscard]] double bytes() const {
    return 24.0 * static_cast<double>(plain_.vertices()) + 12.0 * items();
  }

private:
  std::shared_ptr<MeshStages<float>> stages_;
  PlainTessellator plain_;
};

} // namespace

void register_tessellate_rows() {
  add_meshes<float>();
  add_meshes<double>();
  register_row("tessellate/position_normal/f32/plain/8x8/memory/threads:1/part:mesh",
               benchmark::kMillisecond, 1, [] { return PlainRow(); });
}

} // namespace simdbezier_bench
