// The vertices of a mesh in their order: what one thread does.
//
// Patch by patch there are the vertices on its boundary that it owns, and its inner points, row by
// row. Both go to planes that a delivery provides, chunk by chunk: inner rows straight from the
// grid kernels, boundaries from the kernels for single samples, a chunk's worth at once.
#pragma once

#include <algorithm>
#include <cstddef>

#include "src/calls/piece_evaluator.hpp"
#include "src/calls/sample_evaluator.hpp"
#include "src/mesh/boundary_store.hpp"

namespace simdbezier::detail {

/// What all threads of a call share.
template <typename T>
struct VertexTask {
  const MeshData* mesh;
  const PatchKernels<T>* kernels;
  std::size_t dimension; ///< components of positions
  bool normals;
  ValuesOf values;
  ParameterOutputs<T> parameters; ///< of vertices from first_vertex on
  std::size_t first_vertex;       ///< what is vertex 0 for the caller
  std::size_t last_vertex;        ///< behind the last one wanted

  /// Whether a vertex needs a sample of every patch that has it.
  [[nodiscard]] bool every_patch() const noexcept { return normals || !mesh->side_first.empty(); }
};

/// Sizes of one thread's memory.
template <typename T>
struct VertexSizes {
  std::size_t chunk;   ///< vertices
  std::size_t samples; ///< on boundaries, evaluated together
  std::size_t planes;  ///< of these samples
  std::size_t most_rate;

  VertexSizes(const VertexTask<T>& task, std::size_t wanted_chunk) noexcept {
    const MeshData& mesh = *task.mesh;
    const auto most = [](const auto& rates) {
      return *std::max_element(rates.begin(), rates.end());
    };
    const std::size_t widest = most(mesh.nu);
    most_rate = std::max<std::size_t>(widest, most(mesh.nv));
    chunk = std::max({wanted_chunk, mesh.most_boundary_vertices, widest});
    samples = std::max<std::size_t>(chunk, mesh.most_boundary_samples);
    planes = task.dimension + (task.normals ? 3 : 0);
  }
};

/// Rows of inner points that a kernel takes at once.
inline constexpr std::size_t kMostMeshRows = 1024;

/// One thread. Sink: const Planes<T>* begin(vertex), void end(vertices), void finish(),
/// DrainQueue<T>* queue(), std::size_t step().
template <typename T, typename Sink>
class VertexWorker {
public:
  [[nodiscard]] static std::size_t scratch_bytes(const VertexTask<T>& task,
                                                 const VertexSizes<T>& sizes) noexcept {
    return lines_bytes(sizes) + BoundarySamples<T>::bytes(*task.mesh, sizes.samples) +
           BoundaryStore<T>::bytes(*task.mesh) +
           sizes.planes * whole_lines(sizes.samples * sizeof(T)) +
           SampleEvaluator<T>::scratch_bytes(*task.kernels->set, sizes.samples) +
           whole_lines(PieceEvaluator<T>::scratch_bytes(kMostMeshRows));
  }

  VertexWorker(const VertexTask<T>& task, const VertexSizes<T>& sizes, Sink& sink,
               unsigned char* scratch) noexcept
      : task_(task), mesh_(*task.mesh), sizes_(sizes), sink_(sink),
        lines_(reinterpret_cast<T*>(take(scratch, lines_bytes(sizes))), sizes.most_rate),
        samples_(mesh_, task.every_patch(), sizes.samples, lines_,
                 take(scratch, BoundarySamples<T>::bytes(mesh_, sizes.samples))),
        store_(mesh_, task.values, take(scratch, BoundaryStore<T>::bytes(mesh_))),
        sample_evaluator_(*task.kernels, take(scratch, SampleEvaluator<T>::scratch_bytes(
                                                           *task.kernels->set, sizes.samples))),
        rows_(*task.kernels, kMostMeshRows,
              take(scratch, whole_lines(PieceEvaluator<T>::scratch_bytes(kMostMeshRows)))) {
    const auto take_plane = [&] {
      return reinterpret_cast<T*>(take(scratch, whole_lines(sizes.samples * sizeof(T))));
    };
    for (std::size_t c = 0; c < task.dimension; ++c) {
      results_[kPositionGroup].component[c] = take_plane();
    }
    for (std::size_t c = 0; c < 3 && task.normals; ++c) {
      results_[kNormalGroup].component[c] = take_plane();
    }
  }

  /// Whatever begins at vertices [begin, end): boundaries and rows.
  Isa run(std::size_t begin, std::size_t end) noexcept {
    for (std::size_t patch = patch_of(begin); patch < mesh_.patches(); ++patch) {
      const std::size_t first = mesh_.first_vertex(patch);
      const std::size_t inner = mesh_.inner[patch];
      if (first >= end) {
        break;
      }
      if (first >= begin && inner > first) {
        make_room(first, inner - first);
        if (samples_.size() + mesh_.most_boundary_samples > sizes_.samples) {
          evaluate_boundaries();
        }
        samples_.add(patch);
        filled_ += inner - first;
      }
      run_rows(patch, rows_before(patch, begin), rows_before(patch, end));
    }
    pass_on();
    sink_.finish();
    return executed_;
  }

private:
  static std::size_t lines_bytes(const VertexSizes<T>& sizes) noexcept {
    return whole_lines(ParameterLines<T>::memory_values(sizes.most_rate) * sizeof(T));
  }
  static unsigned char* take(unsigned char*& memory, std::size_t bytes) noexcept {
    unsigned char* const taken = memory;
    memory += bytes;
    return taken;
  }

  /// The patch among whose own vertices a vertex is.
  [[nodiscard]] std::size_t patch_of(std::size_t vertex) const noexcept {
    std::size_t low = 0;
    std::size_t high = mesh_.patches();
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (mesh_.first_vertex(middle) <= vertex ? low : high) = middle;
    }
    return low;
  }
  /// Rows of inner points that begin before a vertex.
  [[nodiscard]] std::size_t rows_before(std::size_t patch, std::size_t vertex) const noexcept {
    const std::size_t inner = mesh_.inner[patch];
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (vertex <= inner || columns == 0) {
      return 0;
    }
    return std::min<std::size_t>(mesh_.nv[patch] - 1, (vertex - inner + columns - 1) / columns);
  }

  /// Passes on what there is where `count` vertices more would not fit; begins a chunk.
  void make_room(std::size_t vertex, std::size_t count) noexcept {
    if (filled_ > 0 && filled_ + count > sizes_.chunk) {
      pass_on();
    }
    if (filled_ == 0) {
      const Planes<T>* const planes = sink_.begin(vertex - task_.first_vertex);
      target_ = {planes[kPositionGroup], planes[kNormalGroup], sink_.step(), vertex,
                 task_.parameters,       task_.first_vertex};
    }
  }
  void pass_on() noexcept {
    evaluate_boundaries();
    if (filled_ > 0) {
      sink_.end(filled_);
    }
    filled_ = 0;
  }

  void evaluate_boundaries() noexcept {
    if (samples_.size() == 0) {
      return;
    }
    executed_ = sample_evaluator_.run({samples_.patch(), samples_.u(), samples_.v(),
                                       samples_.size(), samples_.size(), Parameters::centred},
                                      {results_});
    for (const BoundaryEntry& entry : samples_.entries()) {
      store_.store(entry, results_[kPositionGroup], results_[kNormalGroup], target_);
    }
    samples_.clear();
  }

  void run_rows(std::size_t patch, std::size_t row, std::size_t last) noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (row == last || columns == 0) {
      return;
    }
    plan_.refer(lines_.line(mesh_.nu[patch]), columns, lines_.line(mesh_.nv[patch]),
                mesh_.nv[patch] - 1);
    while (row < last) {
      const std::size_t vertex = mesh_.inner[patch] + row * columns;
      make_room(vertex, columns);
      const std::size_t rows =
          std::min({last - row, (sizes_.chunk - filled_) / columns, kMostMeshRows});
      Planes<T> planes[kGroups];
      planes[kPositionGroup] = moved(target_.position);
      planes[kNormalGroup] = moved(target_.normal);
      rows_.run(plan_, {patch, 1, row, row + rows}, {planes, sink_.queue(), sink_.step()});
      executed_ = rows_.executed();
      finish_rows(patch, row, rows, planes);
      row += rows;
      filled_ += rows * columns;
    }
  }
  /// Planes behind what the chunk holds already.
  [[nodiscard]] Planes<T> moved(const Planes<T>& planes) const noexcept {
    Planes<T> result;
    for (std::size_t c = 0; c < 3; ++c) {
      T* const plane = planes.component[c];
      result.component[c] = plane == nullptr ? nullptr : plane + filled_ * target_.step;
    }
    return result;
  }
  /// Normals of turned patches, and parameters.
  void finish_rows(std::size_t patch, std::size_t row, std::size_t rows,
                   const Planes<T> (&planes)[kGroups]) const noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (task_.normals && mesh_.topology.data()->is_turned(patch)) {
      for (T* const plane : planes[kNormalGroup].component) {
        for (std::size_t k = 0; k < rows * columns; ++k) {
          plane[k * target_.step] = T(0) - plane[k * target_.step];
        }
      }
    }
    if (!task_.parameters.wanted()) {
      return;
    }
    std::size_t vertex = mesh_.inner[patch] + row * columns - task_.first_vertex;
    for (std::size_t j = row + 1; j <= row + rows; ++j) {
      const T v = static_cast<T>(j) / static_cast<T>(mesh_.nv[patch]);
      for (std::size_t i = 1; i <= columns; ++i, ++vertex) {
        task_.parameters.put(vertex, static_cast<std::uint32_t>(patch),
                             static_cast<T>(i) / static_cast<T>(mesh_.nu[patch]), v);
      }
    }
  }

  const VertexTask<T>& task_;
  const MeshData& mesh_;
  const VertexSizes<T>& sizes_;
  Sink& sink_;
  ParameterLines<T> lines_;
  BoundarySamples<T> samples_;
  BoundaryStore<T> store_;
  SampleEvaluator<T> sample_evaluator_;
  PieceEvaluator<T> rows_;
  GridPlan<T> plan_;
  Planes<T> results_[kGroups]; ///< of samples on boundaries
  VertexTarget<T> target_;     ///< of the chunk
  std::size_t filled_ = 0;     ///< vertices of the chunk
  Isa executed_ = Isa::automatic;
};

} // namespace simdbezier::detail
