// Evaluation in the parameters of splines: grids are cut at knots into a small grid on each patch.
#include <simdbezier/splines.hpp>

#include <algorithm>

#include "src/splines/spline_grid_work.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// What a grid call is given: the samples of all patches, as one range of the set.
struct SplineWhere {
  SetRange patches;
};

template <typename T>
class SplineGridCall : public OutputCall<T, PatchSet, SplineWhere> {
public:
  SplineGridCall(const PatchSet<T>& set, const SplineWhere& where, const Outputs<T>& out,
                 const Options& options, std::span<const double> U, std::span<const double> V,
                 const AxisRuns<T>& u, const AxisRuns<T>& v) noexcept
      : OutputCall<T, PatchSet, SplineWhere>(set, where, out, options), U_(U), V_(V), u_(u), v_(v) {
  }

  Status check() noexcept {
    std::size_t samples = 0;
    if (!multiply_samples(U_.size(), V_.size(), 1, samples)) {
      return Status::size_overflow;
    }
    const MemoryRange inputs[] = {MemoryRange(U_), MemoryRange(V_)};
    return this->check_given(samples, inputs);
  }
  [[nodiscard]] bool empty() const noexcept { return U_.empty() || V_.empty(); }
  [[nodiscard]] SplineGridWork<T> plan(Way way) const noexcept {
    return {
        *this->in_.set.storage(), this->request_, u_, v_, this->in_.out, this->in_.options, way};
  }
  [[nodiscard]] std::size_t written() const noexcept {
    return written_bytes(this->in_.out, u_.count * v_.count);
  }
  [[nodiscard]] CallKind kind() const noexcept {
    return kind_of_call(CallName::spline_grid, this->in_, this->request_)
        .add(u_.count)
        .add(u_.runs.size());
  }

private:
  std::span<const double> U_;
  std::span<const double> V_;
  const AxisRuns<T>& u_;
  const AxisRuns<T>& v_;
};

} // namespace
} // namespace detail

template <typename T, typename S>
Report evaluate_grid(const PatchSet<T>& set, const SplineSurface<S>& surface,
                     std::span<const double> U, std::span<const double> V,
                     const std::type_identity_t<Outputs<T>>& out, const Options& options,
                     std::size_t first_patch) noexcept {
  return detail::guarded([&]() -> Report {
    detail::AxisRuns<T> u;
    detail::AxisRuns<T> v;
    if (const Report report = u.build(surface, 0, U, detail::kMostColumns); !report) {
      return report;
    }
    const std::size_t rows = std::clamp<std::size_t>(
        detail::kTogether / std::max<std::size_t>(U.size(), 1), 1, detail::kMostRows);
    if (const Report report = v.build(surface, 1, V, rows); !report) {
      return report;
    }
    const detail::SplineWhere where{{first_patch, u.spans * v.spans}};
    return {detail::make_call(detail::SplineGridCall<T>(set, where, out, options, U, V, u, v),
                              options)};
  });
}

template <typename T, typename S>
Report evaluate_grid(const SplineSurface<S>& surface, std::span<const double> U,
                     std::span<const double> V, const Outputs<T>& out,
                     const Options& options) noexcept {
  PackOptions how;
  how.threads = options.threads;
  how.isa = options.isa;
  PatchSet<T> set;
  if (const Report report = pack(surface, set, {}, how); !report) {
    return report;
  }
  return evaluate_grid(set, surface, U, V, out, options);
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API Report evaluate_grid(const PatchSet<T>&, const SplineSurface<S>&,        \
                                               std::span<const double>, std::span<const double>,   \
                                               const std::type_identity_t<Outputs<T>>&,            \
                                               const Options&, std::size_t) noexcept;              \
  template SIMDBEZIER_API Report evaluate_grid(const SplineSurface<S>&, std::span<const double>,   \
                                               std::span<const double>, const Outputs<T>&,         \
                                               const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
