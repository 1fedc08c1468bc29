// Runs an evaluator over a family and measures it against the oracle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/properties/accuracy/judge/evaluator.hpp"
#include "tests/properties/accuracy/judge/sample_bounds.hpp"
#include "tests/support/hash.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests {

/// The rows of a report. Position and tangents are measured per component.
enum class Quantity : std::uint8_t {
  position,     ///< P: error / (u max|b|)
  du,           ///< Du: error / (u max|hodograph|)
  dv,           ///< Dv
  duu,          ///< Duu: error / (u max|second hodograph|)
  duv,          ///< Duv
  dvv,          ///< Dvv
  normal,       ///< N: |n - true n| / u where the surface has a normal
  normal_kappa, ///< Nk: the same divided by its conditioning kappa
  limit,        ///< L: angle to the limit in degrees where du x dv vanishes
  gaussian,     ///< Kg: error of the Gaussian curvature / what the derivatives' bounds make of it
  mean,         ///< Kh: likewise
  principal     ///< Kp: likewise, both of them
};
inline constexpr std::size_t kQuantities = 12;
inline constexpr std::array<const char*, kQuantities> kQuantityNames{
    "P", "Du", "Dv", "Duu", "Duv", "Dvv", "N", "Nk", "L", "Kg", "Kh", "Kp"};

/// Curvatures are judged at every so many samples, since their bound takes long to find.
inline constexpr std::size_t kCurvatureStride = 48;

/// Where a maximum was found.
struct Worst {
  std::size_t net = 0;
  int component = 0;
  double x = 0; ///< the parameters that were read
  double y = 0;
};

/// Figures of one quantity over one family.
struct Metric {
  std::size_t count = 0;
  double max = 0;
  double sum_of_squares = 0;
  double max_ratio = 0;             ///< error / bound; the contract is <= 1
  double max_certificate_ratio = 0; ///< error / the evaluator's own bound, likewise
  Worst worst;                      ///< of max
  Fnv1a hash;                       ///< of the results' bits, in order

  [[nodiscard]] double rms() const;
  void add(double error, double ratio, const Worst& where);
};

/// All figures of one evaluator on one family.
struct Measurement {
  std::array<Metric, kQuantities> metrics;
  double max_condition_error = 0; ///< position error / (u sum |b| B_i B_j), informative
  std::size_t nan_values = 0;     ///< values that are NaN (all parameters are finite)
  std::size_t bad_lengths = 0;    ///< normals neither unit length nor zero with its status
  std::size_t missed_limits = 0;  ///< zero normals where the surface has a limit

  [[nodiscard]] const Metric& operator[](Quantity quantity) const {
    return metrics[static_cast<std::size_t>(quantity)];
  }
};

/// The truth at one sample, and what errors there are relative to.
struct Truth {
  OracleSample sample;
  OracleNormal normal;
  WeightSample weight;
  Vector3 condition{}; ///< sum |b| B_i B_j per component (of the control polygon)
  double x = 0;
  double y = 0;
};

/// The oracle's answers for a family: at its centred parameters, or at its u, v.
struct Reference {
  std::vector<std::vector<Truth>> truths; ///< [net][sample]
};

/// |du x dv| / (|Hu||Hv|) below which the cross product of the exact surface counts as zero.
inline constexpr double kVanishing = 0x1p-60;

template <typename T>
[[nodiscard]] Reference make_reference(const Family<T>& family, bool centred);

template <typename T>
[[nodiscard]] Measurement measure(Evaluator<T>& evaluator, const Family<T>& family,
                                  const Reference& reference);

} // namespace simdbezier::tests
