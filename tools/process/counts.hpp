// Counts that are formed from numbers in files, which may say anything.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace simdbezier::tools {

/// A number of things. A sum or product that std::size_t cannot hold has no value, and neither has
/// anything that is formed of it, because a product that wraps around would pass for a small one.
class Count {
public:
  constexpr Count(std::size_t value) noexcept : value_(value), fits_(true) {} // NOLINT: a number

  /// Has no value where it cannot be counted.
  [[nodiscard]] constexpr std::optional<std::size_t> value() const noexcept {
    return fits_ ? std::optional(value_) : std::nullopt;
  }
  /// Returns whether there are at most so many.
  [[nodiscard]] constexpr bool within(std::size_t most) const noexcept {
    return fits_ && value_ <= most;
  }

  friend constexpr Count operator+(Count a, Count b) noexcept {
    Count sum(0);
    sum.fits_ = !__builtin_add_overflow(a.value_, b.value_, &sum.value_) && a.fits_ && b.fits_;
    return sum;
  }
  friend constexpr Count operator*(Count a, Count b) noexcept {
    Count product(0);
    product.fits_ =
        !__builtin_mul_overflow(a.value_, b.value_, &product.value_) && a.fits_ && b.fits_;
    return product;
  }

private:
  std::size_t value_;
  bool fits_;
};

/// Returns "1 patch", "2 patches".
[[nodiscard]] inline std::string quantity(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// Returns the count's digits, or "more than" the largest one.
[[nodiscard]] inline std::string to_string(Count count) {
  return count.value() ? std::to_string(*count.value())
                       : "more than " + std::to_string(std::numeric_limits<std::size_t>::max());
}

} // namespace simdbezier::tools
