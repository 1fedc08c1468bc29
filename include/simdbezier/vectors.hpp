// The caller's memory for results: vectors in any layout, and single values.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>

namespace simdbezier {

/// The capacity of memory that is given by a pointer alone: the call trusts that it suffices.
inline constexpr std::size_t kTrusted = static_cast<std::size_t>(-1);

/// Where one vector-valued output goes: component c of sample k is c-th pointer [k * stride], with
/// the stride in elements. All three null: not asked for. If made from spans, it knows its
/// capacity, and calls with more samples return output_too_small.
template <typename T>
struct Vectors {
  T* x = nullptr;
  T* y = nullptr;
  T* z = nullptr;
  std::ptrdiff_t stride = 1;
  std::size_t capacity = kTrusted; ///< samples

  /// x y z triples (AoS), `stride` elements from one to the next: 3 if packed, the size of a vertex
  /// if interleaved. A span begins with the first triple and needs a stride of 3 or more.
  [[nodiscard]] static constexpr Vectors xyz(T* first, std::ptrdiff_t stride = 3) noexcept {
    return {first, first + 1, first + 2, stride};
  }
  [[nodiscard]] static constexpr Vectors xyz(std::span<T> values,
                                             std::ptrdiff_t stride = 3) noexcept {
    Vectors triples = values.empty() ? Vectors{} : xyz(values.data(), stride);
    triples.capacity = records(values.size(), 3, stride);
    return triples;
  }
  [[nodiscard]] static constexpr Vectors xyz(std::span<std::array<T, 3>> points) noexcept {
    Vectors triples = points.empty() ? Vectors{} : xyz(points.front().data());
    triples.capacity = points.size();
    return triples;
  }

  /// Three planes (SoA), unit stride.
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y, T* z) noexcept { return {x, y, z}; }
  [[nodiscard]] static constexpr Vectors planes(std::span<T> x, std::span<T> y,
                                                std::span<T> z) noexcept {
    return {x.data(), y.data(), z.data(), 1, std::min({x.size(), y.size(), z.size()})};
  }

  /// Sets of one or two components: one or two planes, or pairs side by side.
  [[nodiscard]] static constexpr Vectors plane(T* x) noexcept { return {x}; }
  [[nodiscard]] static constexpr Vectors plane(std::span<T> x) noexcept {
    return {x.data(), nullptr, nullptr, 1, x.size()};
  }
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y) noexcept { return {x, y}; }
  [[nodiscard]] static constexpr Vectors planes(std::span<T> x, std::span<T> y) noexcept {
    return {x.data(), y.data(), nullptr, 1, std::min(x.size(), y.size())};
  }
  [[nodiscard]] static constexpr Vectors pairs(T* first, std::ptrdiff_t stride = 2) noexcept {
    return {first, first + 1, nullptr, stride};
  }
  [[nodiscard]] static constexpr Vectors pairs(std::span<T> values,
                                               std::ptrdiff_t stride = 2) noexcept {
    Vectors pairs_of = values.empty() ? Vectors{} : pairs(values.data(), stride);
    pairs_of.capacity = records(values.size(), 2, stride);
    return pairs_of;
  }

  /// Whether the output is asked for. An empty span counts, since the call has to refuse it.
  [[nodiscard]] constexpr bool wanted() const noexcept {
    return x != nullptr || y != nullptr || z != nullptr || capacity != kTrusted;
  }

private:
  /// How many records of `members` values, `stride` apart, fit.
  static constexpr std::size_t records(std::size_t values, std::size_t members,
                                       std::ptrdiff_t stride) noexcept {
    return values < members || stride <= 0
               ? 0
               : (values - members) / static_cast<std::size_t>(stride) + 1;
  }
};

/// Where an output of one value a sample goes, unit stride; null: not asked for. A pointer is
/// trusted, the size of a span or a vector is checked.
template <typename T>
struct Values {
  T* first = nullptr;
  std::size_t capacity = kTrusted;

  constexpr Values() noexcept = default;
  constexpr Values(T* memory) noexcept : first(memory) {} // NOLINT: implicit on purpose
  template <std::convertible_to<std::span<T>> Range>
  constexpr Values(Range&& range) noexcept // NOLINT: implicit on purpose
      : Values(std::span<T>(range)) {}
  constexpr Values(std::span<T> values) noexcept // NOLINT: implicit on purpose
      : first(values.data()), capacity(values.size()) {}

  [[nodiscard]] constexpr bool wanted() const noexcept {
    return first != nullptr || capacity != kTrusted;
  }
  [[nodiscard]] constexpr T& operator[](std::size_t sample) const noexcept { return first[sample]; }
};

} // namespace simdbezier
