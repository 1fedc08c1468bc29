// A call's outputs: checked, and cut into what kernels write directly and what is staged first.
#pragma once

#include <cstddef>

#include <simdbezier/evaluate.hpp>

#include "src/tables/drain_queue.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// The vector groups of an Outputs, by Group.
template <typename T>
struct OutputGroups {
  const Vectors<T>* group[kGroups];
  explicit OutputGroups(const Outputs<T>& out) noexcept
      : group{&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal} {}
};

/// A range of memory that a call reads.
struct InputRange {
  const void* begin = nullptr;
  std::size_t bytes = 0;
};

/// ok | null_output | bad_components | bad_stride | overlapping_outputs | size_overflow, for
/// `samples` samples of vectors of `dimension` (1 to 3) components; `space`: they are points in
/// space, which have normals. Groups of different strides must not share a range of memory at all.
template <typename T>
[[nodiscard]] Status check_outputs(const Outputs<T>& out, std::size_t samples,
                                   std::size_t dimension, bool space, const InputRange* inputs,
                                   std::size_t input_count) noexcept;

/// The curvatures of an Outputs, in the order of the tasks.
template <typename T>
struct CurvaturePlanes {
  T* plane[kCurvatures];
  explicit CurvaturePlanes(const Curvatures<T>& c) noexcept
      : plane{c.gaussian, c.mean, c.minimum, c.maximum} {}
};

/// The kernels of one call: the narrowest that compute what is asked for.
struct KernelChoice {
  bool first = false; ///< position, du, dv, normal
  OutputSet outputs = kPosition;
  bool second = false; ///< duu, duv, dvv
};

/// Which groups a call wants.
struct WantedGroups {
  bool group[kGroups];
};

template <typename T>
[[nodiscard]] WantedGroups wanted_groups(const Outputs<T>& out) noexcept;

/// Values of all wanted vectors of one sample.
[[nodiscard]] std::size_t vector_values(const WantedGroups& wanted, std::size_t dimension) noexcept;

[[nodiscard]] KernelChoice choose_kernels(const WantedGroups& wanted) noexcept;

/// Consecutive records in the caller's memory: a plane, triples, vertices, or the members of
/// vertices that lie side by side.
template <typename T>
struct StreamShape {
  std::size_t plane[kMostMembers]; ///< staged planes, in the order of their places in the record
  std::size_t members = 0;
  T* first = nullptr;        ///< member 0 of record 0
  std::ptrdiff_t stride = 0; ///< in elements
  bool streaming = false;

  /// Records before the first one that begins a cache line; kDrainStep where none does.
  [[nodiscard]] std::size_t records_to_line(std::size_t record) const noexcept;
};

/// What the kernels of a call can put where it belongs by themselves, besides planes with plain
/// stores: all outputs that they compute at once, in rows of `row` samples or more.
struct DirectRows {
  std::size_t row = 0; ///< 0: nothing
  std::size_t lanes = 1;
  bool streamed = false; ///< planes, and records too, past the caches: whole lines, whole registers
  bool records = false;  ///< triples of each group, or one vertex of all
};

/// How the outputs of one call are delivered.
template <typename T>
class OutputPlan {
public:
  /// out: checked, and alive as long as the plan.
  OutputPlan(const Outputs<T>& out, std::size_t samples, Destination destination) noexcept;

  [[nodiscard]] const Outputs<T>& out() const noexcept { return out_; }
  [[nodiscard]] bool staged() const noexcept { return staged_planes_ > 0; }
  [[nodiscard]] bool streaming() const noexcept { return streaming_; }
  /// Gives staging up where kernels can do without it; and streaming, if that was not asked for,
  /// where it needs staging that does not pay with so many threads.
  void arrange(const DirectRows& rows, int threads) noexcept;
  /// Values from one sample to the next where they do: 1 planes; 3 triples of each group, more one
  /// vertex of all groups, both counted from a group's first component.
  [[nodiscard]] std::size_t record() const noexcept { return record_; }
  /// Gives staging up: kernels know the outputs' layout themselves.
  void write_directly() noexcept;
  [[nodiscard]] std::size_t staged_planes() const noexcept { return staged_planes_; }
  /// Components of each group.
  [[nodiscard]] std::size_t dimension() const noexcept { return dimension_; }
  /// Component c of group g is staged plane dimension() * staged_group(g) + c, or written directly
  /// where the group is not staged.
  [[nodiscard]] bool is_staged(std::size_t group) const noexcept {
    return group_index_[group] < kGroups;
  }
  [[nodiscard]] std::size_t staged_group(std::size_t group) const noexcept {
    return group_index_[group];
  }
  [[nodiscard]] std::size_t streams() const noexcept { return streams_; }
  [[nodiscard]] const StreamShape<T>& stream(std::size_t k) const noexcept { return stream_[k]; }

private:
  void put_directly(const DirectRows& rows) noexcept;
  void stage() noexcept;
  void add_streams() noexcept;

  const Outputs<T>& out_;
  std::size_t dimension_ = 3;
  bool automatic_; ///< whether to stream was left to the call
  bool streaming_ = false;
  std::size_t staged_planes_ = 0;
  std::size_t record_ = 1;
  std::size_t group_index_[kGroups];
  std::size_t streams_ = 0;
  StreamShape<T> stream_[kMostMembers];
};

} // namespace simdbezier::detail
