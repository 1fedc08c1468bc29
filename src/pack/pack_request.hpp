// What packing patches and packing curves have in common, apart from arithmetic.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>

#include <simdbezier/patch_set.hpp>

#include "src/storage/given_points.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// The instruction set that packs. ok | unsupported_isa; a wrong SIMDBEZIER_ISA is for evaluate
/// calls to report.
inline Status packing_isa(const PackOptions& options, Isa& isa) noexcept {
  const Status status = resolve_isa(options.isa, isa);
  if (status == Status::ok || options.isa != Isa::automatic || available_isas().empty()) {
    return status;
  }
  isa = available_isas().back();
  return Status::ok;
}

/// Checks that relative_to is finite in the components that points have.
inline Report check_relative_to(const PackOptions& options, int components) noexcept {
  for (int c = 0; c < std::min(components, 3); ++c) {
    if (!std::isfinite(options.relative_to[c])) {
      return {Status::non_finite_input, 0, -1, c};
    }
  }
  return {};
}

/// The first step of packing: whether the options are sound for points of so many components, and
/// which instruction set packs.
inline Report resolve_packing(const PackOptions& options, int components, Isa& isa) noexcept {
  const Report moved = check_relative_to(options, components);
  return moved ? Report{packing_isa(options, isa)} : moved;
}

/// Packs [begin, end) up to the first fault. pack(begin, end) calls a kernel, which only compares
/// squares with a bound; inspect(k) decides about patches that it finds doubtful.
template <typename Pack, typename Inspect>
Report pack_and_inspect(std::size_t begin, std::size_t end, const Pack& pack,
                        const Inspect& inspect) {
  while (begin < end) {
    const PackDoubt doubt = pack(begin, end);
    for (std::size_t k = doubt.begin; k < doubt.end; ++k) {
      const Report report = inspect(k);
      if (!report) {
        return report;
      }
    }
    begin = doubt.end;
  }
  return {};
}

/// The form in which the control points of a call are kept; they have no place yet.
template <typename S>
GivenPoints given_form(Weights weights, const PackOptions& options) noexcept {
  GivenPoints given;
  given.in_double = std::is_same_v<S, double>;
  given.weights = weights;
  std::copy_n(options.relative_to, 3, given.relative_to);
  return given;
}

/// The place where a pack call keeps its control points, in memory of its own.
template <typename S>
S* writable_points(const GivenPoints& given) noexcept {
  return static_cast<S*>(const_cast<void*>(given.values));
}

/// The fault of the lowest patch or curve, whichever thread finds it.
class LowestFault {
public:
  void add(const Report& report) {
    if (!report) {
      while (guard_.test_and_set(std::memory_order_acquire)) { // faults are few, and this is short
      }
      if (lowest_ || report.item < lowest_.item) {
        lowest_ = report;
      }
      guard_.clear(std::memory_order_release);
    }
  }
  /// The lowest fault, to be asked for when all threads have finished.
  [[nodiscard]] const Report& report() const noexcept { return lowest_; }

private:
  std::atomic_flag guard_;
  Report lowest_;
};

} // namespace simdbezier::detail
