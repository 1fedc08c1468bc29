// position_errors() of rates.hpp and flatten.hpp.
#include <cmath>

#include <simdbezier/error_bounds.hpp>
#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>

#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// An upper bound on the norm of a vector of errors.
double norm_bound(std::span<const double> errors) noexcept {
  double square = 0;
  double norm = 0; // taken where squares overflow or vanish
  for (const double error : errors) {
    square += error * error;
    norm = std::hypot(norm, error);
  }
  const bool usual = square > 0x1p-900 && square < 0x1p900;
  return (usual ? std::sqrt(square) : norm) * (1 + 0x1p-40);
}

/// components: of a position.
template <typename Set>
Status find_errors(const Set& set, std::size_t components, std::span<double> out,
                   Isa isa) noexcept {
  if (out.size() < set.size()) {
    return Status::output_too_small;
  }
  Isa chosen = Isa::automatic;
  if (const Status status = resolve_isa(isa, chosen); !status) {
    return status;
  }
  const DefaultFpEnvironment environment;
  for (std::size_t k = 0; k < set.size(); ++k) {
    const auto bounds = error_bounds(set, k, chosen);
    out[k] = norm_bound(std::span(bounds.position).first(components));
  }
  return Status::ok;
}

} // namespace
} // namespace detail

template <typename T>
Status position_errors(const PatchSet<T>& set, std::span<double> out, Isa isa) noexcept {
  return detail::find_errors(set, 3, out, isa);
}
template <typename T>
Status position_errors(const CurveSet<T>& set, std::span<double> out, Isa isa) noexcept {
  return detail::find_errors(set, kMostComponents, out, isa);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status position_errors(const PatchSet<T>&, std::span<double>,            \
                                                 Isa) noexcept;                                    \
  template SIMDBEZIER_API Status position_errors(const CurveSet<T>&, std::span<double>,            \
                                                 Isa) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
