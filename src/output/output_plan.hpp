// A call's outputs, cut into what kernels write directly and what is staged first.
#pragma once

#include <cstddef>

#include "src/choice/destination.hpp"
#include "src/output/output_list.hpp"
#include "src/tables/drain_queue.hpp"

namespace simdbezier::detail {

/// Consecutive records in the caller's memory: a plane, triples, vertices, or the members of
/// vertices that lie side by side.
template <typename T>
struct StreamShape {
  std::size_t plane[kMostMembers]; ///< staged planes, in the order of their places in the record
  std::size_t members;
  T* first;              ///< member 0 of record 0
  std::ptrdiff_t stride; ///< in elements
  bool streaming;

  /// Records before the first one that begins a cache line; kDrainStep where none does.
  [[nodiscard]] std::size_t records_to_line(std::size_t record) const noexcept;
};

/// What the kernels of a call can write to its final place themselves, besides planes with plain
/// stores: all outputs at once, in rows of `row` samples or more (streamed_anywhere: exactly).
struct DirectRows {
  std::size_t row = 0; ///< 0: nothing
  std::size_t lanes = 1;
  bool streamed = false;          ///< planes past the caches: whole lines
  bool streamed_anywhere = false; ///< planes past the caches, wherever they begin
  bool same_place = false;        ///< streamed_anywhere: if all begin at one place within a line
  bool records = false;           ///< triples of each group, or one vertex of all
  bool streamed_records = false;  ///< likewise, past the caches
  bool vertices = false;          ///< with records, vertices of kVertexRecord as well
};

/// How the outputs of one call are delivered.
template <typename T>
class OutputPlan {
public:
  /// out: checked, and alive as long as the plan. way: decided.
  OutputPlan(const OutputList<T>& out, Way way) noexcept;

  [[nodiscard]] const OutputList<T>& out() const noexcept { return out_; }
  [[nodiscard]] bool staged() const noexcept { return staged_planes_ > 0; }
  [[nodiscard]] bool streaming() const noexcept { return way_ != Way::cache; }
  /// Bytes of staging memory that one chunk should fill.
  [[nodiscard]] std::size_t chunk_bytes() const noexcept;
  /// Gives up staging where kernels can do without it; Way::memory_other stages rows to be turned.
  void put_directly(const DirectRows& rows) noexcept;
  /// Values from one sample to the next where kernels write directly: 1 for planes, 3 for triples
  /// of each group, more for one vertex of all groups, counted from a group's first component.
  [[nodiscard]] std::size_t record() const noexcept { return record_; }
  /// Finds where the outputs that are not staged have sample number `sample`. planes: of every
  /// vector output; others are left alone.
  void find_planes(std::size_t sample, Planes<T> (&planes)[kVectorOutputs]) const noexcept;
  /// Gives up staging: kernels know the outputs' layout themselves.
  void write_directly() noexcept;
  [[nodiscard]] std::size_t staged_planes() const noexcept { return staged_planes_; }
  /// Component c of a vector is staged plane first_plane() + c, or written directly where the
  /// vector is not staged.
  [[nodiscard]] bool is_staged(std::size_t vector) const noexcept {
    return first_plane_[vector] != kNotStaged;
  }
  [[nodiscard]] std::size_t first_plane(std::size_t vector) const noexcept {
    return first_plane_[vector];
  }
  [[nodiscard]] std::size_t streams() const noexcept { return streams_; }
  [[nodiscard]] const StreamShape<T>& stream(std::size_t k) const noexcept { return stream_[k]; }

private:
  static constexpr std::size_t kNotStaged = ~std::size_t(0);

  void add_streams() noexcept;

  const OutputList<T>& out_;
  Way way_;
  std::size_t staged_planes_ = 0;
  std::size_t record_ = 1;
  std::size_t first_plane_[kVectorOutputs];
  std::size_t streams_ = 0;
  StreamShape<T> stream_[kMostMembers]; ///< the first streams_ of them are written
};

} // namespace simdbezier::detail
