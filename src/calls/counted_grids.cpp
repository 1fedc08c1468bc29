// See src/calls/counted_grids.hpp.
#include "src/calls/counted_grids.hpp"

#include <new>

namespace simdbezier::detail {

Status CountedGrids::count() noexcept {
  if (!equal_lengths_) {
    return Status::unequal_lengths;
  }
  if (size() > 0 && (nu_.data() == nullptr || (!rows_of_one_ && nv_.data() == nullptr) ||
                     (!given_offset_.empty() && given_offset_.data() == nullptr))) {
    return Status::null_input;
  }
  if (size() >= static_cast<std::size_t>(-1) / sizeof(std::size_t)) {
    return Status::size_overflow;
  }
  before_.reset(new (std::nothrow) std::size_t[size() + 1]);
  if (before_ == nullptr) {
    return Status::out_of_memory;
  }
  before_[0] = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t columns = nu(k);
    const std::size_t rows = nv(k);
    if (columns < 2 || (rows < 2 && !rows_of_one_)) {
      return Status::bad_grid;
    }
    if (std::max(columns, rows) > GridPlan<float>::kMost) {
      return Status::size_overflow;
    }
    const std::size_t samples = columns * rows; // of two 32-bit values
    if (__builtin_add_overflow(before_[k], samples, &before_[k + 1])) {
      return Status::size_overflow;
    }
    least_nu_ = std::min(least_nu_, columns);
    most_nu_ = std::max(most_nu_, columns);
    most_nv_ = std::max(most_nv_, rows);
    if (!given_offset_.empty()) {
      if (given_offset_[k] < extent_) {
        return Status::bad_offsets;
      }
      if (__builtin_add_overflow(given_offset_[k], samples, &extent_)) {
        return Status::size_overflow;
      }
    }
  }
  return Status::ok;
}

} // namespace simdbezier::detail
