// See certificate.hpp. Computed from the coefficients on demand: they are all it depends on.
#include <simdbezier/certificate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/fp_environment.hpp"
#include "kernels/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

// Roundings (of the FMA class) that the term of a power passes through on its way to the result.
constexpr double kHornerRoundings[kOrder] = {1, 2, 3, 3};
constexpr double kDivisionRoundings[kOrder] = {0, 2, 3, 3};

template <typename T>
constexpr double kUnitRoundoff = std::numeric_limits<T>::epsilon() / 2;

struct Sums {
  double position = 0; ///< sum of (roundings + 1) |term|
  double du = 0;
  double dv = 0;
  double size = 0; ///< sum of |term|: bounds |S|
};

/// Terms at |X| = |Y| = 1/2: C_kl 2^-(k+l), and for derivatives k C_kl 2^-(k+l-1).
template <typename T>
Sums weighted_sums(const T* matrix, double roundings_per_step) {
  Sums sums;
  for (std::size_t k = 0; k < kOrder; ++k) {
    for (std::size_t l = 0; l < kOrder; ++l) {
      const double c = std::fabs(static_cast<double>(matrix[k * kOrder + l]));
      const double term = std::ldexp(c, -static_cast<int>(k + l));
      const double hk = roundings_per_step * kHornerRoundings[k];
      const double hl = roundings_per_step * kHornerRoundings[l];
      const double dk = roundings_per_step * kDivisionRoundings[k];
      const double dl = roundings_per_step * kDivisionRoundings[l];
      sums.size += term;
      sums.position += (hk + hl + 1) * term;
      sums.du += 2 * static_cast<double>(k) * (dk + hl + 1) * term;
      sums.dv += 2 * static_cast<double>(l) * (hk + dl + 1) * term;
    }
  }
  return sums;
}

/// The largest |origin| of a patch and its edges.
template <typename T>
double largest_origin(const T* origins) {
  double largest = 0;
  for (std::size_t i = 0; i < kOriginsPerComponent; ++i) {
    largest = std::max(largest, std::fabs(static_cast<double>(origins[i])));
  }
  return largest;
}

} // namespace
} // namespace detail

template <typename T>
ErrorBounds error_bounds(const PatchSet<T>& set, std::size_t patch, Isa isa) noexcept {
  ErrorBounds bounds;
  Isa chosen = Isa::automatic;
  if (resolve_isa(isa, chosen) != Status::ok) {
    std::fill_n(bounds.position, 3, std::numeric_limits<double>::infinity());
    std::fill_n(bounds.du, 3, std::numeric_limits<double>::infinity());
    std::fill_n(bounds.dv, 3, std::numeric_limits<double>::infinity());
    return bounds;
  }
  if (patch >= set.size()) {
    return bounds;
  }
  const detail::DefaultFpEnvironment environment;
  const detail::PatchStorage<T>& storage = set.storage()->buckets[0];
  const double per_step = fuses_multiply_add(chosen) ? 1 : 2;
  const double unit = 1.01 * detail::kUnitRoundoff<T>;
  const double denormals = 64 * static_cast<double>(std::numeric_limits<T>::denorm_min());
  for (std::size_t c = 0; c < detail::kComponents; ++c) {
    const T* const matrix =
        storage.coefficients + patch * detail::kCoefficients + c * detail::kOrder * detail::kOrder;
    const detail::Sums sums = detail::weighted_sums(matrix, per_step);
    double position = sums.position;
    if (storage.origins != nullptr) {
      const T* const origins =
          storage.origins + patch * detail::kOriginBlock + c * detail::kOriginsPerComponent;
      position += sums.size + detail::largest_origin(origins);
    }
    bounds.position[c] = unit * position + denormals;
    bounds.du[c] = unit * sums.du + denormals;
    bounds.dv[c] = unit * sums.dv + denormals;
  }
  return bounds;
}

template <typename T>
double largest_position_bound(const PatchSet<T>& set, Isa isa) noexcept {
  double largest = 0;
  for (std::size_t patch = 0; patch < set.size(); ++patch) {
    const ErrorBounds bounds = error_bounds(set, patch, isa);
    largest = std::max({largest, bounds.position[0], bounds.position[1], bounds.position[2]});
  }
  return largest;
}

template SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<float>&, std::size_t, Isa) noexcept;
template SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<double>&, std::size_t,
                                                 Isa) noexcept;
template SIMDBEZIER_API double largest_position_bound(const PatchSet<float>&, Isa) noexcept;
template SIMDBEZIER_API double largest_position_bound(const PatchSet<double>&, Isa) noexcept;

} // namespace simdbezier
