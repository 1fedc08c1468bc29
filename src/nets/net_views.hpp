// Views of control nets whose patches are numbered through, view after view.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

template <typename S>
class NetViews {
public:
  /// A patch's view, and its number in there.
  struct Place {
    const ControlNets<S>* nets;
    std::size_t patch;
  };

  explicit NetViews(std::span<const ControlNets<S>> nets) : nets_(nets) {
    starts_.reserve(nets.size() + 1);
    starts_.push_back(0);
    for (const ControlNets<S>& view : nets) {
      starts_.push_back(starts_.back() + view.count);
    }
  }
  [[nodiscard]] std::size_t patches() const noexcept { return starts_.back(); }
  /// The view that a patch is in.
  [[nodiscard]] std::size_t view_of(std::size_t patch) const noexcept {
    std::size_t low = 0; // the last view that starts at or before the patch and is not empty
    std::size_t high = nets_.size();
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (starts_[middle] <= patch ? low : high) = middle;
    }
    return low;
  }
  [[nodiscard]] Place place(std::size_t patch) const noexcept {
    const std::size_t view = view_of(patch);
    return {&nets_[view], patch - starts_[view]};
  }
  /// The first value of a patch, which is in the view.
  [[nodiscard]] const S* net(std::size_t view, std::size_t patch) const noexcept {
    return nets_[view].points +
           static_cast<std::ptrdiff_t>(patch - starts_[view]) * nets_[view].patch_stride;
  }

  /// Calls visit(view, its number, first, last + 1) for the patches [begin, end), those of one view
  /// at a time: cheaper than to look for the place of each.
  template <typename Visit>
  void for_views(std::size_t begin, std::size_t end, const Visit& visit) const {
    for (std::size_t view = 0; view < nets_.size(); ++view) {
      const std::size_t first = std::max(begin, starts_[view]);
      const std::size_t last = std::min(end, starts_[view + 1]);
      if (first < last) {
        visit(nets_[view], view, first, last);
      }
    }
  }

private:
  std::span<const ControlNets<S>> nets_;
  std::vector<std::size_t> starts_; ///< first patch of each view, then the number of all
};

} // namespace simdbezier::detail
