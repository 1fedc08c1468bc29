// A derivative of any order that a call is asked for.
#pragma once

#include <simdbezier/control_nets.hpp>
#include <simdbezier/vectors.hpp>

namespace simdbezier {

/// The highest order in each direction. Polynomials have nothing but zeros beyond their degree;
/// derivatives of rational patches do not end there.
inline constexpr int kMostDerivativeOrder = kMostDegree;

/// One derivative that is asked for: d^(a+b) S / du^a dv^b, a = order_u, b = order_v, each from 0
/// to kMostDerivativeOrder; (0, 0) is the position.
template <typename T>
struct PartialDerivative {
  int order_u = 0;
  int order_v = 0;
  Vectors<T> out; ///< required; layouts as in Outputs
};

} // namespace simdbezier
