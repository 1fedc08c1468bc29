// The vertices of a mesh in their order: what one thread does.
//
// Patch by patch there are the vertices on its boundary that it owns, and its inner points, row by
// row. Both go to planes that a delivery provides, chunk by chunk: inner rows straight from the
// grid kernels, or from closed grids of patches of few cells, boundaries by way of samples of all
// patches that have them.
#pragma once

#include <algorithm>
#include <cstddef>

#include "src/mesh/vertices/boundary_store.hpp"
#include "src/mesh/vertices/plain_boundary.hpp"
#include "src/output/delivery.hpp"

namespace simdbezier::detail {

/// What all threads of a call share.
template <typename T>
struct VertexTask {
  const MeshData* mesh;
  const PatchKernels<T>* kernels;
  std::size_t dimension; ///< components of positions
  bool normals;
  ValuesOf values;
  std::size_t first_vertex; ///< what is vertex 0 for the caller
  std::size_t last_vertex;  ///< behind the last one wanted

  /// Whether a vertex needs a sample of every patch that has it.
  [[nodiscard]] bool every_patch() const noexcept { return normals || !mesh->side_first.empty(); }
};

/// Sizes of one thread's memory.
template <typename T>
struct VertexSizes {
  std::size_t chunk; ///< vertices
  std::size_t most_rate;
  BoundaryWishes wishes;

  VertexSizes(const VertexTask<T>& task, std::size_t wanted_chunk) noexcept {
    const MeshData& mesh = *task.mesh;
    const std::size_t widest = mesh.most_nu;
    most_rate = mesh.most_rate();
    chunk = std::max({wanted_chunk, mesh.most_boundary_vertices, widest});
    wishes = {task.dimension, task.normals, task.every_patch(),
              std::max(kBoundarySamples, mesh.most_boundary_samples)};
  }

private:
  /// Few enough that they stay in the first-level cache until vertices are made of them.
  static constexpr std::size_t kBoundarySamples = 512;
};

/// Rows of inner points that a kernel takes at once.
inline constexpr std::size_t kMostMeshRows = 1024;

/// One thread. Sink:
///   void begin(vertex, VertexTarget<T>&)   where a chunk goes that begins with a vertex
///   void end(vertices)                     it is complete
///   DrainQueue<T>* queue()                 what kernels pass on meanwhile, or null
///   void finish()                          after the last chunk
template <typename T, typename Sink>
class VertexWorker {
public:
  [[nodiscard]] static std::size_t scratch_bytes(const VertexTask<T>& task,
                                                 const VertexSizes<T>& sizes) noexcept {
    return lines_bytes(sizes) + BoundarySamples<T>::bytes(*task.mesh, sizes.wishes) +
           ClosedGrids<T>::bytes(*task.mesh) + BoundaryStore<T>::bytes(*task.mesh);
  }

  VertexWorker(const VertexTask<T>& task, const VertexSizes<T>& sizes, Sink& sink,
               unsigned char* scratch) noexcept
      : task_(task), mesh_(*task.mesh), sizes_(sizes), sink_(sink), runner_(*task.kernels),
        lines_(reinterpret_cast<T*>(take(scratch, lines_bytes(sizes))), sizes.most_rate),
        samples_(mesh_, sizes.wishes, runner_, lines_,
                 take(scratch, BoundarySamples<T>::bytes(mesh_, sizes.wishes))),
        grids_(mesh_, runner_, lines_, task.dimension > 0, task.normals,
               take(scratch, ClosedGrids<T>::bytes(mesh_))),
        plain_(mesh_, runner_, lines_, samples_.unions(), samples_.corners(), grids_, task.normals),
        store_(mesh_, task.values, take(scratch, BoundaryStore<T>::bytes(mesh_))) {}

  /// Computes the boundaries and rows that begin at vertices [begin, end).
  Isa run(std::size_t begin, std::size_t end) noexcept {
    std::size_t patch = patch_of(begin);
    for (std::size_t first = mesh_.first_vertex(patch); first < end; ++patch) {
      const std::size_t inner = mesh_.inner[patch];
      if (first >= begin && inner > first) {
        make_room(first, inner - first);
        add_boundary(patch, inner - first);
        filled_ += inner - first;
      }
      const std::size_t points = mesh_.inner_points(patch);
      if (points > 0) {
        run_rows(patch, rows_before(patch, begin), rows_before(patch, end));
      }
      first = inner + points;
    }
    pass_on();
    sink_.finish();
    return runner_.executed();
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
    const std::size_t rows = mesh_.nv[patch] - 1;
    if (vertex <= inner) {
      return 0;
    }
    const std::size_t before = vertex - inner; // most patches lie before both ends of a share
    return before >= columns * rows ? rows : (before + columns - 1) / columns;
  }

  /// Passes on the chunk if `count` more vertices would not fit, and begins another one.
  void make_room(std::size_t vertex, std::size_t count) noexcept {
    if (filled_ > 0 && filled_ + count > sizes_.chunk) {
      pass_on();
    }
    if (filled_ == 0) {
      sink_.begin(vertex, target_);
      target_.drain = sink_.queue();
    }
  }
  void pass_on() noexcept {
    store_boundaries();
    if (filled_ > 0) {
      sink_.end(filled_);
    }
    filled_ = 0;
  }

  /// The corners and edges that a patch owns, which have so many vertices.
  void add_boundary(std::size_t patch, std::size_t vertices) noexcept {
    if (!samples_.has_room()) {
      store_boundaries();
    }
    const TopologyData& topology = *mesh_.topology.data();
    topology.for_owned_corners(patch, [&](std::uint32_t corner) {
      --vertices;
      if (!plain_.put_corner(corner, target_)) {
        samples_.add_corner(corner);
      }
    });
    if (vertices == 0) {
      return; // edges of single segments
    }
    topology.for_owned_edges(patch, [this](std::uint32_t edge) {
      if (!plain_.add_edge(edge, target_)) {
        plain_.run(target_); // the lines of its parameters may give way to others
        samples_.add_edge(edge);
      }
    });
  }
  void store_boundaries() noexcept {
    plain_.run(target_);
    for (const BoundaryEntry& entry : samples_.entries()) {
      store_.store(entry, samples_.positions(), samples_.normals(), target_);
    }
    samples_.clear();
  }

  void run_rows(std::size_t patch, std::size_t row, std::size_t last) noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (row == last) {
      return;
    }
    const T* const x = lines_.line(mesh_.nu[patch]);
    const T* const y = lines_.line(mesh_.nv[patch]);
    const ClosedGrid<T>* const grid = rows_from_grid(patch);
    while (row < last) {
      make_room(mesh_.inner[patch] + row * columns, columns);
      const std::size_t rows =
          std::min({last - row, (sizes_.chunk - filled_) / columns, kMostMeshRows});
      const PieceTarget<T> to{moved(target_.position), moved(target_.normal), target_.step,
                              target_.drain};
      if (grid != nullptr) {
        copy_rows(*grid, row, rows, to);
      } else {
        const RowRun<T> run{y + row, static_cast<std::uint32_t>(rows), RowKind::interior};
        runner_.run(patch, 1, {x, columns, &run, 1, rows}, to);
      }
      finish_rows(patch, row, rows, to.normal);
      row += rows;
      filled_ += rows * columns;
    }
  }
  /// The grid that has a patch's inner points; null where there is none.
  const ClosedGrid<T>* rows_from_grid(std::size_t patch) noexcept {
    if (std::max(mesh_.nu[patch], mesh_.nv[patch]) > ClosedGrids<T>::kMostRate) {
      return nullptr;
    }
    const ClosedGrid<T>* const grid = grids_.of(patch);
    return grid != nullptr && grid->whole ? grid : nullptr;
  }
  static void copy_rows(const ClosedGrid<T>& grid, std::size_t row, std::size_t rows,
                        const PieceTarget<T>& to) noexcept {
    static_assert(ClosedGrids<T>::kMostRate == 5);
    with_known_count(grid.columns - std::size_t{2}, [&]<std::size_t kColumns>() {
      const T* from = grid.first + (row + 1) * (kColumns + 2) + 1;
      for (std::size_t c = 0; c < 6; ++c, from += ClosedGrid<T>::kPlane) {
        T* plane = (c < 3 ? to.position : to.normal).component[c % 3];
        for (std::size_t j = 0; j < rows && plane != nullptr; ++j) {
          T values[kColumns];
          std::copy_n(from + j * (kColumns + 2), kColumns, values);
          for (std::size_t i = 0; i < kColumns; ++i, plane += to.record) {
            *plane = values[i];
          }
        }
      }
    });
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
                   const Planes<T>& normals) const noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (task_.normals && mesh_.topology.data()->is_turned(patch)) {
      for (T* const plane : normals.component) {
        for (std::size_t k = 0; k < rows * columns; ++k) {
          plane[k * target_.step] = T(0) - plane[k * target_.step];
        }
      }
    }
    if (!target_.parameters.wanted()) {
      return;
    }
    std::size_t vertex = mesh_.inner[patch] + row * columns - target_.parameters_first;
    for (std::size_t j = row + 1; j <= row + rows; ++j) {
      const T v = static_cast<T>(j) / static_cast<T>(mesh_.nv[patch]);
      for (std::size_t i = 1; i <= columns; ++i, ++vertex) {
        target_.parameters.put(vertex, static_cast<std::uint32_t>(patch),
                               static_cast<T>(i) / static_cast<T>(mesh_.nu[patch]), v);
      }
    }
  }

  const VertexTask<T>& task_;
  const MeshData& mesh_;
  const VertexSizes<T>& sizes_;
  Sink& sink_;
  PatchRunner<T> runner_;
  ParameterLines<T> lines_;
  BoundarySamples<T> samples_;
  ClosedGrids<T> grids_;
  PlainBoundary<T> plain_;
  BoundaryStore<T> store_;
  VertexTarget<T> target_; ///< of the chunk
  std::size_t filled_ = 0; ///< vertices of the chunk
};

} // namespace simdbezier::detail
