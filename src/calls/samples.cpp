// Parameters and numbers of samples, for callers that make room for results.
#include <cmath>
#include <limits>

#include <simdbezier/curves.hpp>
#include <simdbezier/patch_set.hpp>

#include "src/calls/call.hpp"
#include "src/calls/counted_grids.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// A number of samples that no memory has room for.
constexpr std::size_t kTooMany = std::numeric_limits<std::size_t>::max();

constexpr std::size_t addressable(std::size_t samples) noexcept {
  return samples > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) ? kTooMany
                                                                                        : samples;
}

std::size_t samples_of(std::size_t nu, std::size_t nv, const SetRange& range,
                       std::size_t set_size) noexcept {
  std::size_t first = 0;
  std::size_t count = 0;
  if (!resolve_range(range, set_size, first, count)) {
    return 0;
  }
  std::size_t samples = 0;
  return multiply_samples(nu, nv, count, samples) ? addressable(samples) : kTooMany;
}

template <typename Where>
std::size_t samples_of_counted(const Where& where, std::size_t set_size) noexcept {
  std::size_t first = 0;
  std::size_t size = 0;
  if (!resolve_range(range_of(where), set_size, first, size)) {
    return 0;
  }
  CountedGrids grids(where);
  const Status counted = grids.count();
  if (counted == Status::size_overflow) {
    return kTooMany;
  }
  return counted ? addressable(grids.extent()) : 0;
}

} // namespace
} // namespace detail

template <typename T>
T to_centred(double u) noexcept {
  T centred = 0;
  detail::in_default_environment(
      [&]() noexcept { centred = static_cast<T>(std::fma(2.0, u, -1.0)); });
  return centred;
}

template <typename T>
std::size_t sample_count(const PatchSet<T>& set, const Grid<T>& grid) noexcept {
  return detail::samples_of(grid.nu, grid.nv, grid.patches, set.size());
}

template <typename T>
std::size_t sample_count(const PatchSet<T>& set, const PatchGrids& grids) noexcept {
  return detail::samples_of_counted(grids, set.size());
}

template <typename T>
std::size_t sample_count(const CurveSet<T>& set, const CurveGrid<T>& grid) noexcept {
  return detail::samples_of(grid.n, 1, grid.curves, set.size());
}

template <typename T>
std::size_t sample_count(const CurveSet<T>& set, const CurveGrids& grids) noexcept {
  return detail::samples_of_counted(grids, set.size());
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API T to_centred<T>(double) noexcept;                                        \
  template SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>&, const Grid<T>&) noexcept;   \
  template SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>&,                             \
                                                   const PatchGrids&) noexcept;                    \
  template SIMDBEZIER_API std::size_t sample_count(const CurveSet<T>&,                             \
                                                   const CurveGrid<T>&) noexcept;                  \
  template SIMDBEZIER_API std::size_t sample_count(const CurveSet<T>&, const CurveGrids&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
