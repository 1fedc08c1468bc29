// Random nets with vanishing normals and curves with vanishing tangents, their samples and the
// exact answers: made once, then judged for every instruction set, call and choice of origins.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <simdbezier/evaluate.hpp>

#include "tests/support/nets/degenerate_nets.hpp"
#include "tests/support/oracle/limit_oracle.hpp"

namespace simdbezier::tests {

inline constexpr int kLimitGrid = 5; ///< samples a side of the grid that every net has

/// One sample with its exact answer. The first kLimitGrid^2 of a net, and kLimitGrid of a curve,
/// are those of the grid.
struct LimitSample {
  double x = 0;
  double y = 0; ///< 0 on curves
  SampleStatus status = SampleStatus::degenerate;
  Vector3 direction{};  ///< of the normal or the tangent
  double kappa = 0;     ///< regular ones: how much du x dv or C' magnifies errors, see OracleNormal
  double lightness = 1; ///< of curves: the largest weight over the one here
};

struct LimitNet {
  const char* kind = nullptr;
  Net net; ///< of degree_v 0 for a curve
  int components = 3;
  std::vector<LimitSample> samples;
};

/// What the sets hold (T) and what their control points were given as (S).
struct LimitTypes {
  bool values_double = false;
  bool points_double = false;
};

/// `count` nets, equal shapes side by side.
[[nodiscard]] std::vector<LimitNet> limit_nets(LimitTypes types, std::size_t count,
                                               std::uint64_t seed);

/// Returns curves likewise, some of them in a plane (two components).
[[nodiscard]] std::vector<LimitNet> limit_curves(LimitTypes types, std::size_t count,
                                                 std::uint64_t seed);

/// Whether two nets fit into one ControlNets or ControlCurves.
[[nodiscard]] bool same_limit_shape(const LimitNet& a, const LimitNet& b);

/// How many nets a type has: 10^4 in `./run accuracy`, some hundreds in `./run test`.
[[nodiscard]] std::size_t limit_net_count();

/// A net and a sample, in numbers that read back to the same bits.
[[nodiscard]] std::string described(const LimitNet& net, const LimitSample& sample);

[[nodiscard]] SampleStatus status_of(const ExactDirection& exact);
[[nodiscard]] double degrees_apart(const Vector3& a, const Vector3& b);

} // namespace simdbezier::tests
