// What was found beside what is exact: figures, and the first failures in words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "tests/properties/limits/limit_cases.hpp"

namespace simdbezier::tests {

/// Angles in degrees. Limits are exact up to the rounding of the result; regular directions carry
/// what the quick tests let pass (gate G6 of docs/accuracy.md), and tangents of curves what sums of
/// weights lose where these are light: kernels sum relative to the largest one.
struct AllowedAngles {
  double limit;
  double regular;
  double unit_roundoff;
  [[nodiscard]] double regular_at(double lightness) const {
    constexpr double kRoundings = 64;
    return std::max(regular, kRoundings * unit_roundoff * lightness * lightness * 57.3);
  }
};
[[nodiscard]] constexpr AllowedAngles allowed_angles(bool values_double) {
  return values_double ? AllowedAngles{1e-9, 0.02, 0x1p-53} : AllowedAngles{1e-3, 0.02, 0x1p-24};
}

/// What a call wrote at one sample.
struct FoundDirection {
  Vector3 direction{};
  SampleStatus status = SampleStatus::non_finite;
  int nan_curvatures = -1; ///< of four; -1: not asked for
};

/// The samples of one type.
class LimitTally {
public:
  explicit LimitTally(AllowedAngles allowed) : allowed_(allowed) {}

  void add(const LimitNet& net, const LimitSample& sample, const FoundDirection& found,
           const char* call);

  /// Prints the figures, and fails the test where anything is wrong.
  void report(const std::string& title) const;

private:
  struct Place {
    const LimitNet* net;
    const LimitSample* sample;
    const char* call;
  };
  void add_regular(const Place& at, const FoundDirection& found, double angle);
  void fail(const Place& at, const FoundDirection& found, const char* what);

  AllowedAngles allowed_;
  std::size_t samples_[3] = {}; ///< by the status that is expected
  std::map<std::pair<SampleStatus, SampleStatus>, std::size_t> wrong_; ///< {expected, found}
  std::map<std::string, std::size_t> wrong_kinds_;
  std::map<int, double> regular_; ///< largest angle by the binary exponent of kappa
  double limit_ = 0;
  std::map<std::string, std::pair<std::size_t, std::string>> failures_; ///< number, first of them
};

} // namespace simdbezier::tests
