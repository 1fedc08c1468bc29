// The ways in which grids on bicubic patches in space are evaluated. All of them give the same
// bits; kernels/grid/strategies.hpp says when each of them is taken, but for strips, which
// src/choice/row_strips.hpp decides. No xsimd in here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace simdbezier::detail {

/// In the order in which they are asked whether they apply; `tiles` always does.
enum class GridStrategy : std::uint8_t {
  squares_of_four, ///< 4 x 4 samples, all components in one register
  small_across,    ///< 3 x 3 to 6 x 6 samples, lanes are patches
  small_groups,    ///< positions of 3 x 3 to 6 x 6 samples, lanes are groups of four
  streamed_order,  ///< past the caches, row after row, each plane as one stream
  records,         ///< triples and vertices, put together in registers
  streamed_rows,   ///< past the caches, two or three lines of a row side by side
  squares,         ///< squares whose size the compiler knows
  bands,           ///< all registers of a row side by side
  components,      ///< large patches, all tiles of one component before those of the next one
  across_lines,    ///< rows of one tile, put together to whole lines
  strips,          ///< some rows at a time, where rows compete for places in a cache
  tiles            ///< one or two registers of columns after the other
};
inline constexpr std::size_t kGridStrategies = static_cast<std::size_t>(GridStrategy::tiles) + 1;

/// Names as the benchmark's --without spells them.
inline constexpr std::string_view kGridStrategyNames[] = {
    "squares_of_four", "small_across", "small_groups", "streamed_order", "records", "streamed_rows",
    "squares",         "bands",        "components",   "across_lines",   "strips",  "tiles"};
static_assert(std::size(kGridStrategyNames) == kGridStrategies);

/// A set of strategies.
class StrategySet {
public:
  constexpr StrategySet() noexcept = default;
  constexpr explicit StrategySet(std::uint32_t bits) noexcept : bits_(bits) {}
  static constexpr StrategySet all() noexcept {
    return StrategySet((std::uint32_t{1} << kGridStrategies) - 1);
  }

  [[nodiscard]] constexpr bool has(GridStrategy strategy) const noexcept {
    return (bits_ & bit(strategy)) != 0;
  }
  constexpr void add(GridStrategy strategy) noexcept { bits_ |= bit(strategy); }
  constexpr void remove(GridStrategy strategy) noexcept { bits_ &= ~bit(strategy); }
  [[nodiscard]] constexpr std::uint32_t bits() const noexcept { return bits_; }

private:
  static constexpr std::uint32_t bit(GridStrategy strategy) noexcept {
    return std::uint32_t{1} << static_cast<unsigned>(strategy);
  }
  std::uint32_t bits_ = 0;
};

} // namespace simdbezier::detail
