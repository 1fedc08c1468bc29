#include "src/calls/counted_grids.hpp"

#include <new>

namespace simdbezier::detail {
namespace {

/// Looks at all values instead of stopping at the first other one, so that it can be vectorised.
bool all_equal(std::span<const std::uint32_t> values) noexcept {
  std::uint32_t differences = 0;
  for (const std::uint32_t value : values) {
    differences |= value ^ values[0];
  }
  return differences == 0;
}

} // namespace

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
  of_one_size_ = size() > 1 && given_offset_.empty() && all_equal(nu_) && all_equal(nv_);
  const std::size_t sizes = of_one_size_ ? 1 : size();
  before_.reset(new (std::nothrow) std::size_t[sizes + 1]);
  if (before_ == nullptr) {
    return Status::out_of_memory;
  }
  std::size_t total = 0; // in a register: members might change with every store to before_
  for (std::size_t k = 0; k < sizes; ++k) {
    before_[k] = total;
    const std::size_t columns = nu(k);
    const std::size_t rows = nv(k);
    if (columns < 2 || (rows < 2 && !rows_of_one_)) {
      return Status::bad_grid;
    }
    if (std::max(columns, rows) > GridPlan<float>::kMost) {
      return Status::size_overflow;
    }
    const std::size_t samples = columns * rows; // of two 32-bit values
    if (__builtin_add_overflow(total, samples, &total)) {
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
  before_[sizes] = total;
  const bool too_many = of_one_size_ && __builtin_mul_overflow(total, size(), &total);
  return too_many ? Status::size_overflow : Status::ok;
}

} // namespace simdbezier::detail
