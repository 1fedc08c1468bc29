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
        add_rows(patch, rows_before(patch, begin), rows_before(patch, end));
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
    run_group();
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

  /// Rows of inner points: those of patches of few cells are known, others wait for a kernel.
  void add_rows(std::size_t patch, std::size_t row, std::size_t last) noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (row == last) {
      return;
    }
    const bool few = std::max(mesh_.nu[patch], mesh_.nv[patch]) <= ClosedGrids<T>::kMostRate;
    const ClosedGrid<T>* const grid = few ? &samples_.grids().of(patch) : nullptr;
    while (row < last) {
      make_room(mesh_.inner[patch] + row * columns, columns);
      const std::size_t rows = std::min({last - row, (chunk_ - filled_) / columns, kMostMeshRows});
      if (grid != nullptr && grid->whole) {
        put_rows(*grid, row, rows);
        finish_rows(patch, row, rows, target_.parameters);
      } else if (!joins_group(patch, row, rows)) {
        run_group();
        group_ = {patch, 1, row, rows, 0};
      }
      row += rows;
      filled_ += rows * columns;
    }
  }
  void put_rows(const ClosedGrid<T>& grid, std::size_t row, std::size_t rows) const noexcept {
    const PieceTarget<T> to = target_at(grid.patch, row);
    const std::size_t columns = grid.columns; // a copy, which no store below can change
    const VertexSample<T>* const first = grid.first + (row + 1) * columns + 1;
    const auto put = [&](const Planes<T>& planes, const T* from) {
      if (!planes.wanted()) {
        return;
      }
      // A component that is not wanted is stored where x is stored next.
      T* x = planes.component[0];
      T* y = planes.component[1] != nullptr ? planes.component[1] : x;
      T* z = planes.component[2] != nullptr ? planes.component[2] : x;
      for (std::size_t j = 0; j < rows; ++j, from += 2 * kSampleRecord) {
        for (std::size_t i = 2; i < columns; ++i, from += kSampleRecord) {
          *z = from[2];
          *y = from[1];
          *x = from[0];
          x += to.record;
          y += to.record;
          z += to.record;
        }
      }
    };
    put(to.position, reinterpret_cast<const T*>(&first->position));
    put(to.normal, reinterpret_cast<const T*>(&first->normal));
  }
  /// Adds a patch to the group if all of its rows are as those of the patch before.
  bool joins_group(std::size_t patch, std::size_t row, std::size_t rows) noexcept {
    if (group_.patches == 0 || patch != group_.patch + group_.patches || row + group_.row > 0 ||
        rows != group_.rows || rows + 1 != mesh_.nv[patch - 1] || rows + 1 != mesh_.nv[patch] ||
        mesh_.nu[patch] != mesh_.nu[patch - 1] || samples_.runner().together(patch - 1, 2) < 2) {
      return false;
    }
    const std::size_t step = mesh_.inner[patch] - mesh_.inner[patch - 1];
    if (group_.patches > 1 && step != group_.step) {
      return false;
    }
    group_.step = step;
    ++group_.patches;
    return true;
  }
  void run_group() noexcept {
    const auto [patch, patches, row, rows, step] = group_;
    if (patches == 0) {
      return;
    }
    group_.patches = 0;
    const std::size_t columns = mesh_.nu[patch] - 1;
    const ParameterLine<T> x = boundary_.line(mesh_.nu[patch]);
    const ParameterLine<T> y = boundary_.line(mesh_.nv[patch]);
    const RowRun<T> run{y.along + row, static_cast<std::uint32_t>(rows), RowKind::interior};
    samples_.runner().run(patch, patches,
                          {x.along, columns, &run, 1, step, x.shares, y.shares + row},
                          target_at(patch, row));
    ParameterOutputs<T> missing = target_.parameters;
    if (target_.step == kVertexRecord) {
      missing.u = nullptr; // kernels have written u and v
    }
    for (std::size_t k = 0; k < patches; ++k) {
      finish_rows(patch + k, row, rows, missing);
    }
  }
  /// Where rows of inner points go that follow each other.
  [[nodiscard]] PieceTarget<T> target_at(std::size_t patch, std::size_t row) const noexcept {
    const std::size_t vertex = mesh_.inner[patch] + row * (mesh_.nu[patch] - 1);
    const auto moved = [&](Planes<T> planes) {
      for (T*& plane : planes.component) {
        plane = plane == nullptr ? nullptr : plane + (vertex - target_.first) * target_.step;
      }
      return planes;
    };
    return {moved(target_.position), moved(target_.normal), target_.step, target_.drain};
  }
  /// Turns normals of rows if their patch is turned, and puts the rows' parameters.
  void finish_rows(std::size_t patch, std::size_t row, std::size_t rows,
                   const ParameterOutputs<T>& parameters) noexcept {
    const std::size_t columns = mesh_.nu[patch] - 1;
    if (task_.normals && mesh_.topology.data()->is_turned(patch)) {
      for (T* const plane : target_at(patch, row).normal.component) {
        for (std::size_t k = 0; k < rows * columns; ++k) {
          plane[k * target_.step] = T(0) - plane[k * target_.step];
        }
      }
    }
    if (!parameters.wanted()) {
      return;
    }
    const T* const u = boundary_.line(mesh_.nu[patch]).shares;
    const T* const v = boundary_.line(mesh_.nv[patch]).shares;
    for (std::size_t j = row; j < row + rows; ++j) {
      parameters.put_run(mesh_.inner[patch] + j * columns - target_.parameters_first, columns,
                         static_cast<std::uint32_t>(patch), u, 1, v + j, 0);
    }
  }

  /// Rows of inner points that wait for a kernel: those of one patch, or all rows of patches whose
  /// rates are the same, and whose rows are equally far apart.
  struct RowGroup {
    std::size_t patch;
    std::size_t patches;
    std::size_t row; ///< the first one
    std::size_t rows;
    std::size_t step; ///< vertices from one patch's rows to the next one's
  };

  const VertexTask<T>& task_;
  const MeshData& mesh_;
  std::size_t chunk_; ///< vertices
  Sink& sink_;
  VertexTarget<T> target_; ///< of the chunk
  WaitingVertices<T> waiting_;
  BoundarySamples<T> samples_;
  BoundaryVertices<T> boundary_;
  std::size_t filled_ = 0; ///< vertices of the chunk
  RowGroup group_{};
};

} // namespace simdbezier::detail
