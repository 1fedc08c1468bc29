// What packing patches and packing curves have in common, apart from arithmetic.
#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>

#include <simdbezier/patch_set.hpp>

namespace simdbezier::detail {

/// The instruction set that packs. ok | unsupported_isa; a wrong SIMDBEZIER_ISA is for evaluate
/// calls to report.
inline Status packing_isa(const PackOptions& options, Isa& isa) noexcept {
  const Status status = resolve_isa(options.isa, isa);
  if (status == Status::ok || options.isa != Isa::automatic) {
    return status;
  }
  isa = available_isas().back();
  return Status::ok;
}

/// A relative_to that is finite where points have components.
inline PackReport check_relative_to(const PackOptions& options, int components) noexcept {
  for (int c = 0; c < std::min(components, 3); ++c) {
    if (!std::isfinite(options.relative_to[c])) {
      return {Status::non_finite_input, 0, -1, c};
    }
  }
  return {};
}

/// The fault of the lowest patch or curve, whichever thread finds it.
class LowestFault {
public:
  void add(const PackReport& report) {
    if (!report) {
      const std::lock_guard<std::mutex> lock(guard_);
      if (lowest_ || report.patch < lowest_.patch) {
        lowest_ = report;
      }
    }
  }
  /// After all threads have finished.
  [[nodiscard]] const PackReport& report() const noexcept { return lowest_; }

private:
  std::mutex guard_;
  PackReport lowest_;
};

} // namespace simdbezier::detail
