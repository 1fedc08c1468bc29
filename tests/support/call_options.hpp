// All that a call can be told in one struct: how it runs, on which part of a set, with which
// components. Tables of cases need it in one place; the library has it in three.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tests {

struct CallOptions {
  int threads = 0;
  bool watertight = true;
  Isa isa = Isa::automatic;
  Destination destination = Destination::automatic;
  int first_component = 0;
  std::size_t first_patch = 0; ///< or curve
  std::size_t patch_count = SetRange::kToTheEnd;

  operator Options() const { // NOLINT: for calls that have no parts
    return {threads, isa, watertight, destination};
  }
  operator RunOptions() const { return {threads, isa}; } // NOLINT: likewise
  [[nodiscard]] SetRange range() const { return {first_patch, patch_count}; }
};

template <typename T>
[[nodiscard]] Grid<T> part_of(Grid<T> grid, const CallOptions& options) {
  grid.patches = options.range();
  return grid;
}
template <typename T>
[[nodiscard]] CurveGrid<T> part_of(CurveGrid<T> grid, const CallOptions& options) {
  grid.curves = options.range();
  return grid;
}
[[nodiscard]] inline PatchGrids part_of(PatchGrids grids, const CallOptions& options) {
  grids.patches.first = options.first_patch;
  grids.nu = grids.nu.first(std::min(grids.nu.size(), options.patch_count));
  grids.nv = grids.nv.first(std::min(grids.nv.size(), options.patch_count));
  grids.offset = grids.offset.first(std::min(grids.offset.size(), options.patch_count));
  return grids;
}
[[nodiscard]] inline CurveGrids part_of(CurveGrids grids, const CallOptions& options) {
  grids.curves.first = options.first_patch;
  grids.n = grids.n.first(std::min(grids.n.size(), options.patch_count));
  grids.offset = grids.offset.first(std::min(grids.offset.size(), options.patch_count));
  return grids;
}
template <typename T>
[[nodiscard]] Samples<T> part_of(const Samples<T>& samples, const CallOptions&) {
  return samples;
}
template <typename T>
[[nodiscard]] CurveSamples<T> part_of(const CurveSamples<T>& samples, const CallOptions&) {
  return samples;
}

// Found by their exact type: Options, in braces as well, lead to the library's own.
template <typename Set, typename Where, typename Out, std::same_as<CallOptions> How>
[[nodiscard]] Status evaluate(const Set& set, const Where& where, Out out, const How& options) {
  out.first_component = options.first_component;
  return simdbezier::evaluate(set, part_of(where, options), out, Options(options));
}
template <typename T, std::same_as<CallOptions> How>
[[nodiscard]] Status evaluate_tiles(const PatchSet<T>& set, const Grid<T>& grid, TileFormat format,
                                    std::type_identity_t<TileFunction<T>> function,
                                    const How& options) {
  format.first_component = options.first_component;
  return simdbezier::evaluate_tiles(set, part_of(grid, options), format, function,
                                    Options(options));
}
template <typename T, typename Where, std::same_as<CallOptions> How>
[[nodiscard]] Status evaluate_derivatives(const PatchSet<T>& set, const Where& where,
                                          std::span<const PartialDerivative<T>> wanted,
                                          const How& options) {
  return simdbezier::evaluate_derivatives(set, part_of(where, options),
                                          {wanted, options.first_component}, Options(options));
}

} // namespace simdbezier::tests
