// The patches of one view in the lanes of groups.
#pragma once

#include <algorithm>
#include <new>
#include <span>
#include <vector>

#include <simdbezier/rates.hpp>

#include "src/mesh/bounds/group_bound.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

/// Some patches in the lanes of a group whose bounds are known.
class PatchGroup {
public:
  /// patches: those from `begin` on are in lanes 0, 1, …; found: one status a lane.
  PatchGroup(const GroupBound& bound, std::span<const std::uint32_t> patches, std::size_t begin,
             std::span<Status> found)
      : bound_(bound), patches_(patches), begin_(begin), found_(found) {}

  [[nodiscard]] const GroupBound& bound() const { return bound_; }
  /// The same group where the view's patches have numbers from `first` on.
  [[nodiscard]] PatchGroup shifted(std::size_t first) const {
    PatchGroup group = *this;
    group.first_ += first;
    return group;
  }
  /// Calls visit(lane, patch) for those without a fault.
  template <typename Visit>
  void for_lanes(const Visit& visit) const {
    for (std::size_t lane = 0; lane < found_.size(); ++lane) {
      if (found_[lane] == Status::ok) {
        visit(lane, first_ + patches_[begin_ + lane]);
      }
    }
  }
  void fail(std::size_t lane, Status status) const { found_[lane] = status; }

private:
  const GroupBound& bound_;
  std::span<const std::uint32_t> patches_;
  std::size_t begin_;
  std::span<Status> found_;
  std::size_t first_ = 0;
};

/// Calls visit(group) for these patches of a view, some at a time, in parallel; the report names
/// the first of them at fault. flags_of(patch): its RateFlags. thorough: as in GroupBound.
template <typename S, typename FlagsOf, typename Visit>
Report visit_groups(const ControlNets<S>& nets, std::span<const std::uint32_t> patches,
                    const FlagsOf& flags_of, bool thorough, Isa isa, int threads,
                    const Visit& visit) {
  constexpr std::size_t kNanoseconds = 2000; // a patch
  std::vector<Status> found(patches.size(), Status::ok);
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    try {
      GroupBound bound(isa, thorough);
      for (std::size_t k = begin; k < end; k += bound.lanes()) {
        const std::size_t count = std::min(end - k, bound.lanes());
        bound.begin();
        for (std::size_t lane = 0; lane < count; ++lane) {
          const std::size_t patch = patches[k + lane];
          // A quotient of values without faults may be out of range.
          found[k + lane] =
              bound.read(nets, patch, flags_of(patch)) ? Status::ok : Status::non_finite_input;
        }
        bound.form();
        visit(PatchGroup(bound, patches, k, std::span(found).subspan(k, count)));
      }
    } catch (const std::bad_alloc&) {
      found[begin] = Status::out_of_memory;
    }
  };
  divide_work(patches.size(), kNanoseconds, threads, body);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (found[k] != Status::ok) {
      return {found[k], patches[k]};
    }
  }
  return {};
}

} // namespace simdbezier::detail
