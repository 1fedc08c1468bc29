// Views of control nets whose patches are numbered through, view after view.
#pragma once

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
  [[nodiscard]] Place place(std::size_t patch) const noexcept {
    std::size_t low = 0; // the last view that starts at or before the patch and is not empty
    std::size_t high = nets_.size();
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (starts_[middle] <= patch ? low : high) = middle;
    }
    return {&nets_[low], patch - starts_[low]};
  }

private:
  std::span<const ControlNets<S>> nets_;
  std::vector<std::size_t> starts_; ///< first patch of each view, then the number of all
};

} // namespace simdbezier::detail
