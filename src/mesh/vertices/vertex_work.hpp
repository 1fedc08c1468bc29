// The vertices of a mesh in their order: what one thread does.
//
// Patch by patch there are the vertices on its boundary that it owns, and its inner points, row by
// row. Both go to planes that a delivery provides, chunk by chunk. Inner rows come straight from
// the grid kernels, or from closed grids of patches of few cells.
#pragma once

#include <algorithm>
#include <cstddef>

#include "src/mesh/vertices/boundary_vertices.hpp"
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
  /// The vertices of a chunk, at least those of a boundary or of a row.
  [[nodiscard]] std::size_t chunk(std::size_t wanted) const noexcept {
    return std::max({wanted, mesh->most_boundary_vertices, std::size_t{mesh->most_nu}});
  }
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
  [[nodiscard]] static std::size_t scratch_bytes(const VertexTask<T>& task) noexcept {
    return BoundarySamples<T>::bytes(*task.mesh) + BoundaryVertices<T>::bytes(*task.mesh);
  }
  VertexWorker(const VertexTask<T>& task, std::size_t chunk, Sink& sink,
               unsigned char* scratch) noexcept
      : task_(task), mesh_(*task.mesh), chunk_(chunk), sink_(sink), waiting_(target_, task.normals),
        samples_(mesh_, *task.kernels, task.dimension, task.normals, task.every_patch(), scratch),
        boundary_(mesh_, samples_, waiting_, task.values, task.normals, target_,
                  scratch + BoundarySamples<T>::bytes(mesh_)) {}

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
    return samples_.runner().executed();
  }

private:
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
    if (filled_ > 0 && filled_ + count > chunk_) {
      pass_on();
    }
    if (filled_ == 0) {
      sink_.begin(vertex, target_);
      target_.drain = sink_.queue();
    }
  }
  void pass_on() noexcept {
    boundary_.finish();
    if (filled_ > 0) {
      sink_.end(filled_);
    }
    filled_ = 0;
  }

  /// The corners and edges that a patch owns, which have so many vertices.
  void add_boundary(std::size_t patch, std::size_t vertices) noexcept {
    const TopologyData& topology = *mesh_.topology.data();
    samples_.grids().count_patch();
    topology.for_owned_corners(patch, [&](std::uint32_t corner) {
      --vertices;
      boundary_.put_corner(corner);
    });
    if (vertices > 0) { // else edges have single segments
      topology.for_owned_edges(patch, [this](std::uint32_t edge) { boundary_.put_edge(edge); });
    }
  }

  void run_rows(std::size_t patch, std::size_t row, std::size_t last) noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (row == last) {
      return;
    }
    const bool few = std::max(mesh_.nu[patch], mesh_.nv[patch]) <= ClosedGrids<T>::kMostRate;
    const ClosedGrid<T>* const grid = few ? &samples_.grids().of(patch) : nullptr;
    const bool copies = grid != nullptr && grid->whole;
    while (row < last) {
      make_room(mesh_.inner[patch] + row * columns, columns);
      const std::size_t rows = std::min({last - row, (chunk_ - filled_) / columns, kMostMeshRows});
      const PieceTarget<T> to{moved(target_.position), moved(target_.normal), target_.step,
                              target_.drain};
      ParameterLine<T> x{};
      ParameterLine<T> y{};
      if (!copies || target_.parameters.wanted()) {
        x = boundary_.line(mesh_.nu[patch]);
        y = boundary_.line(mesh_.nv[patch]);
      }
      if (copies) {
        put_rows(*grid, row, rows, to);
      } else {
        const RowRun<T> run{y.along + row, static_cast<std::uint32_t>(rows), RowKind::interior};
        samples_.runner().run(patch, 1, {x.along, columns, &run, 1, rows}, to);
      }
      turn_rows(patch, rows * columns, to.normal);
      if (target_.parameters.wanted()) {
        put_parameters(patch, row, rows, x.shares, y.shares);
      }
      row += rows;
      filled_ += rows * columns;
    }
  }
  static void put_rows(const ClosedGrid<T>& grid, std::size_t row, std::size_t rows,
                       const PieceTarget<T>& to) noexcept {
    std::size_t at = 0;
    for (std::size_t j = row; j < row + rows; ++j) {
      const VertexSample<T>* const samples = grid.first + (j + 1) * grid.columns + 1;
      for (std::size_t i = 0; i + 2 < grid.columns; ++i, at += to.record) {
        for (std::size_t c = 0; c < 3 && to.position.component[c] != nullptr; ++c) {
          to.position.component[c][at] = samples[i].position[c];
        }
        for (std::size_t c = 0; c < 3 && to.normal.wanted(); ++c) {
          to.normal.component[c][at] = samples[i].normal[c];
        }
      }
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
  /// Turns normals of points one after the other, if their patch is turned.
  void turn_rows(std::size_t patch, std::size_t points, const Planes<T>& normals) const noexcept {
    if (task_.normals && mesh_.topology.data()->is_turned(patch)) {
      for (T* const plane : normals.component) {
        for (std::size_t k = 0; k < points; ++k) {
          plane[k * target_.step] = T(0) - plane[k * target_.step];
        }
      }
    }
  }
  void put_parameters(std::size_t patch, std::size_t row, std::size_t rows, const T* u,
                      const T* v) const noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    for (std::size_t j = row; j < row + rows; ++j) {
      const std::size_t vertex = mesh_.inner[patch] + j * columns - target_.parameters_first;
      target_.parameters.put_row(vertex, columns, static_cast<std::uint32_t>(patch), u, v[j]);
    }
  }

  const VertexTask<T>& task_;
  const MeshData& mesh_;
  std::size_t chunk_; ///< vertices
  Sink& sink_;
  VertexTarget<T> target_; ///< of the chunk
  WaitingVertices<T> waiting_;
  BoundarySamples<T> samples_;
  BoundaryVertices<T> boundary_;
  std::size_t filled_ = 0; ///< vertices of the chunk
};

} // namespace simdbezier::detail
