// Kernels on small pieces of patches: the part of a task that is about the set is written once.
// Pieces go to planes, or become VertexSamples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "src/calls/grid_plan.hpp"
#include "src/choice/kernel_choice.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/mesh/vertices/patch_copies.hpp"
#include "src/mesh/vertices/vertex_samples.hpp"

namespace simdbezier::detail {

/// Parameters of a piece: columns, and rows by runs.
template <typename T>
struct PieceParameters {
  const T* x; ///< half-centred, kMaxLanes more readable behind them
  std::size_t columns;
  const RowRun<T>* runs;
  std::size_t run_count;
  std::size_t patch_step; ///< samples from one patch to the next
  const T* u = nullptr;   ///< of columns and rows, for records of kVertexRecord
  const T* v = nullptr;
};

/// The memory that samples go to: a patch's rows one after the other.
template <typename T>
struct PieceTarget {
  Planes<T> position;
  Planes<T> normal;
  std::size_t record = 1; ///< values from one sample to the next, see GridTask
  DrainQueue<T>* drain = nullptr;

  [[nodiscard]] bool wanted() const noexcept { return position.wanted() || normal.wanted(); }
};

/// One thread's tasks.
template <typename T>
class PatchRunner {
public:
  /// Bytes of scratch. most_points: of a side.
  [[nodiscard]] static std::size_t bytes(std::size_t most_points) noexcept {
    return 6 * whole_lines(plane_values(most_points) * sizeof(T));
  }
  /// positions, normals: what samples have.
  PatchRunner(const PatchKernels<T>& kernels, std::size_t dimension, bool normals,
              std::size_t most_points, unsigned char* memory) noexcept
      : kernels_(kernels), dimension_(dimension), normals_(normals),
        most_(plane_values(most_points)) {
    std::fill_n(low_, kMaxLanes + 1, T(-0.5));
    std::fill_n(high_, kMaxLanes + 1, T(0.5));
    grid_.cached_bytes = cached_sample_bytes();
    for (std::size_t c = 0; c < 6; ++c, memory += whole_lines(most_ * sizeof(T))) {
      const bool wanted = c < 3 ? c < dimension : normals;
      T*& plane = (c < 3 ? planes_.position : planes_.normal).component[c % 3];
      plane = wanted ? reinterpret_cast<T*>(memory) : nullptr;
    }
  }

  /// How many of the patches from `patch` on, at most `most`, one call takes.
  [[nodiscard]] std::size_t together(std::size_t patch, std::size_t most) const noexcept {
    const SetStorage<T>& set = *kernels_.set;
    most = std::min(most, set.count - patch);
    if (set.places == nullptr) {
      return most;
    }
    std::size_t count = 1;
    while (count < most && set.places[patch + count].bucket == set.places[patch].bucket &&
           set.places[patch + count].index == set.places[patch].index + count) {
      ++count;
    }
    return count;
  }

  /// Runs no kernel where neither positions nor normals are wanted: not all kernels accept a task
  /// without outputs.
  void run(std::size_t patch, std::size_t count, const PieceParameters<T>& piece,
           const PieceTarget<T>& to) noexcept {
    if (to.wanted()) {
      aim(grid_, kernels_.set->place(patch), to);
      run_grid(count, piece, to);
    }
  }
  /// Makes samples, patch by patch, of a piece that is a whole closed grid.
  void sample(std::size_t patch, std::size_t count, const PieceParameters<T>& piece,
              VertexSample<T>* to) noexcept {
    const std::uint32_t bucket = bucket_of(patch);
    make_samples(bucket, count, piece, to, [&](std::size_t first, const PieceTarget<T>& target) {
      aim(grid_, {bucket, kernels_.set->place(patch).index + first}, target);
    });
  }
  /// The same of the first copies of patches of one bucket.
  void sample(const PatchCopies<T>& copies, std::uint32_t bucket, std::size_t count,
              const PieceParameters<T>& piece, VertexSample<T>* to) noexcept {
    make_samples(bucket, count, piece, to, [&](std::size_t first, const PieceTarget<T>& target) {
      aim(grid_, {bucket, 0}, target);
      static_cast<PatchArrays<T>&>(grid_) = copies.arrays(kernels_.set->buckets[bucket], first);
      grid_.prefetch = false;
    });
  }
  /// Makes a copy of a patch.
  void copy(std::size_t patch, PatchCopies<T>& copies, std::size_t copy) const noexcept {
    const PatchPlace place = kernels_.set->place(patch);
    copies.put(kernels_.set->buckets[place.bucket], place.index, copy, normals_);
  }

  /// Makes samples of the points between the ends of a patch's side. along: their half-centred
  /// parameters, kMaxLanes more readable behind them.
  void sample_side(std::size_t patch, std::size_t side, const T* along, std::uint32_t points,
                   VertexSample<T>* to) noexcept {
    if (!planes_.wanted()) {
      return;
    }
    const PatchPlace place = kernels_.set->place(patch);
    if (kernels_.has_edges(kernels_.set->buckets[place.bucket].shape)) {
      const EdgeJob<T> job{along, points, 0, 1, {{place.index, side, T(1), T(1)}, {}}};
      run_edges({&job, 1}, place.bucket, as_planes(to));
      return;
    }
    const bool far = side % 2 != 0;
    const T* const end = far ? high_ : low_;
    if (runs_in_u(side)) {
      const RowRun<T> row{end, 1, far ? RowKind::edge_v1 : RowKind::edge_v0};
      run(patch, 1, {along, points, &row, 1, 1}, planes_);
    } else {
      const RowRun<T> rows{along, points, RowKind::interior};
      run(patch, 1, {end, 1, &rows, 1, points}, planes_);
    }
    collect(points, to);
  }

  /// The normal in a corner of a patch whose sides there, 1 << PatchEdge each, count as points.
  void find_corner_normal(std::size_t patch, std::size_t corner, unsigned sides,
                          T* normal) const noexcept {
    const PatchPlace place = kernels_.set->place(patch);
    const PatchStorage<T>& bucket = kernels_.set->buckets[place.bucket];
    resolve_corner_normal<T>({&bucket.shape,
                              bucket.given.net(place.index * bucket.shape.control_values()),
                              T(corner % 2 == 0 ? -0.5 : 0.5), T(corner / 2 == 0 ? -0.5 : 0.5)},
                             sides, normal);
  }

  [[nodiscard]] std::size_t lanes() const noexcept { return kernels_.table->lanes; }
  [[nodiscard]] std::uint32_t bucket_of(std::size_t patch) const noexcept {
    return kernels_.set->place(patch).bucket;
  }
  /// Whether a kernel is acquainted with edges of patches of a bucket.
  [[nodiscard]] bool has_edges(std::uint32_t bucket) const noexcept {
    return kernels_.has_edges(kernels_.set->buckets[bucket].shape);
  }
  /// Whether kernels evaluate grids that end at a patch's edges with patches as lanes.
  [[nodiscard]] bool takes_closed_grids(std::uint32_t bucket) const noexcept {
    return has_edges(bucket) && kernels_.table->puts_records &&
           kernels_.set->buckets[bucket].origins == nullptr;
  }
  /// A patch's number in its bucket.
  [[nodiscard]] std::size_t index_of(std::size_t patch) const noexcept {
    return kernels_.set->place(patch).index;
  }
  /// Edges between patches of one such bucket, whose numbers are those in there.
  void run_edges(std::span<const EdgeJob<T>> jobs, std::uint32_t bucket,
                 const PieceTarget<T>& to) noexcept {
    if (!to.wanted()) {
      return;
    }
    aim(edges_, {bucket, 0}, to);
    edges_.jobs = jobs.data();
    edges_.count = jobs.size();
    edges_.step = to.record;
    edges_.drain = to.drain;
    kernels_.run(edges_);
    executed_ = edges_.executed;
  }

  /// The instruction set of the kernels that ran.
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  static std::size_t plane_values(std::size_t most_points) noexcept {
    constexpr std::size_t kLeast = 1024;
    return std::max(most_points, kLeast);
  }
  /// The planes whose values samples have.
  [[nodiscard]] PieceTarget<T> as_planes(VertexSample<T>* samples) const noexcept {
    PieceTarget<T> to;
    to.record = kSampleRecord;
    for (std::size_t c = 0; c < 3; ++c) {
      T* const values = reinterpret_cast<T*>(samples) + c;
      to.position.component[c] = c < dimension_ ? values : nullptr;
      to.normal.component[c] = normals_ ? values + 4 : nullptr;
    }
    return to;
  }
  /// Makes samples of what is in the planes.
  void collect(std::size_t count, VertexSample<T>* to) const noexcept {
    using Four = typename FourOf<T>::type;
    const auto collect_vectors = [&](const Planes<T>& planes, Four VertexSample<T>::*member) {
      constexpr std::size_t kPoints = PointBlock<T>::kPoints;
      for (std::size_t k = 0; k < count; k += kPoints) {
        typename PointBlock<T>::Values component[3] = {};
        for (std::size_t c = 0; c < 3 && planes.component[c] != nullptr; ++c) {
          std::memcpy(&component[c], planes.component[c] + k, sizeof component[c]);
        }
        Four vectors[kPoints];
        turn_to_vectors<T>(component, vectors);
        for (std::size_t i = 0; i < kPoints && k + i < count; ++i) {
          to[k + i].*member = vectors[i];
        }
      }
    };
    collect_vectors(planes_.position, &VertexSample<T>::position);
    if (normals_) {
      collect_vectors(planes_.normal, &VertexSample<T>::normal);
    }
  }
  /// aim_at(patches before, target) prepares the task.
  template <typename AimAt>
  void make_samples(std::uint32_t bucket, std::size_t count, const PieceParameters<T>& piece,
                    VertexSample<T>* to, const AimAt& aim_at) noexcept {
    if (!planes_.wanted()) {
      return;
    }
    if (count >= lanes() && dimension_ == 3 && normals_ && takes_closed_grids(bucket) &&
        kernels_.allowed.has(GridStrategy::small_across)) {
      const PieceTarget<T> target = as_planes(to);
      aim_at(0, target);
      run_grid(count, piece, target);
      return;
    }
    const std::size_t samples = piece.patch_step;
    for (std::size_t first = 0; first < count;) {
      const std::size_t part = std::min(count - first, most_ / samples);
      aim_at(first, planes_);
      run_grid(part, piece, planes_);
      collect(part * samples, to + first * samples);
      first += part;
    }
  }
  void run_grid(std::size_t count, const PieceParameters<T>& piece,
                const PieceTarget<T>& to) noexcept {
    grid_.patch_count = count;
    grid_.x = piece.x;
    grid_.nu = piece.columns;
    grid_.runs = piece.runs;
    grid_.run_count = piece.run_count;
    grid_.patch_step = piece.patch_step;
    grid_.record = to.record;
    grid_.column_values = piece.u;
    grid_.row_values = piece.v;
    grid_.by_lines = kernels_.by_lines;
    grid_.allowed = kernels_.allowed;
    grid_.drain = to.drain;
    kernels_.run(grid_);
    executed_ = grid_.executed;
  }
  void aim(SampleTask<T>& task, const PatchPlace& place, const PieceTarget<T>& to) noexcept {
    const PatchStorage<T>& bucket = kernels_.set->buckets[place.bucket];
    if (bucket_ != &bucket) {
      bucket_ = &bucket;
      prefetch_ = pays_to_prefetch(bucket, true);
    }
    static_cast<PatchArrays<T>&>(task) = bucket.arrays(place.index);
    task.first_component = kernels_.first_component;
    task.resolve_normal = resolve_normal<T>;
    task.watertight = kernels_.watertight;
    task.prefetch = prefetch_;
    task.out[output_index(Output::position)] = to.position;
    task.out[output_index(Output::normal)] = to.normal;
  }

  const PatchKernels<T>& kernels_;
  std::size_t dimension_; ///< of positions
  bool normals_;
  std::size_t most_; ///< values of a plane
  PieceTarget<T> planes_;
  const PatchStorage<T>* bucket_ = nullptr;
  bool prefetch_ = false; ///< of the bucket
  GridTask<T> grid_{};
  EdgeTask<T> edges_{};
  Isa executed_ = Isa::automatic;
  T low_[kMaxLanes + 1];
  T high_[kMaxLanes + 1];
};

} // namespace simdbezier::detail
