// The interface through which the suite judges an evaluator of Bézier patches, ours or another's.
// Nets may have any degrees and weights; see handles().
//
// To add one: derive from Evaluator<float> and/or Evaluator<double>, implement the pure functions,
// and list it in evaluators.cpp. The suite calls evaluate() once for each net of each family.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <simdbezier/evaluate.hpp>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

/// What an evaluator gives at one sample. Entries that it does not give are left as they are.
template <typename T>
struct Result {
  T position[3];
  T du[3];
  T dv[3];
  T duu[3];
  T duv[3];
  T dvv[3];
  T normal[3];
  T curvature[4]; ///< Gaussian, mean, smaller and larger principal one
  SampleStatus status;
};

/// Bounds that an evaluator itself certifies for one net, absolute, per component.
struct Certificate {
  double position[3];
  double du[3];
  double dv[3];
};

/// Which of them it gives.
struct Capabilities {
  bool position = true;
  bool tangents = true;
  bool normal = true;
  bool second_derivatives = false;
  bool curvature = false;
};

/// Whose bits and bounds an evaluator shares.
enum class ResultClass : std::uint8_t {
  fma,    ///< this library, fused multiply-adds: gates and committed thresholds apply
  nofma,  ///< this library, rounding twice: likewise
  plugin, ///< somebody's who wants it judged: flagged where it leaves the bounds of `fma`
  other   ///< another library's: measured and reported, never failed
};

/// This library's own.
[[nodiscard]] constexpr bool is_ours(ResultClass result_class) {
  return result_class == ResultClass::fma || result_class == ResultClass::nofma;
}

template <typename T>
class Evaluator {
public:
  virtual ~Evaluator() = default;

  /// A short name for rows and tables: "avx512", "de_casteljau", "opensubdiv", …
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual ResultClass result_class() const { return ResultClass::other; }
  [[nodiscard]] virtual Capabilities capabilities(const Net& /*net*/) const { return {}; }

  /// Whether it knows nets of this shape: degrees, weights.
  [[nodiscard]] virtual bool handles(const Net& /*net*/) const { return true; }

  /// A mode of the evaluator, appended to the family in rows and thresholds: "+origin", or "".
  [[nodiscard]] virtual std::string variant() const { return {}; }
  /// Its own bounds for a net, judged beside the published ones.
  [[nodiscard]] virtual std::optional<Certificate> certificate(const Net& /*net*/) const {
    return std::nullopt;
  }

  /// True: evaluates at the centred parameters x, y; false: at u, v. Errors are measured against
  /// the exact surface at the parameters that were read, so no conversion is held against anyone.
  [[nodiscard]] virtual bool reads_centred() const { return false; }

  /// Evaluates one net (control points representable in T; degrees in the net) at each of `at`.
  /// results has the size of `at`. `grid` samples, where not 0, tell that `at` is the uniform grid
  /// of that many samples each way, u fastest.
  virtual void evaluate(const Net& net, std::span<const Parameters2<T>> at, int grid,
                        std::span<Result<T>> results) = 0;
};

template <typename T>
using Evaluators = std::vector<std::unique_ptr<Evaluator<T>>>;

} // namespace simdbezier::tests
