// Control points as they were given, from which samples that need a second look are decided.
//
// They are kept in the caller's own type, homogeneous where they were given so, and not moved by
// PackOptions::relative_to, since any change would round. Only -0 has become +0.
#pragma once

#include <cmath>
#include <cstddef>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

struct GivenPoints;

/// The points of one patch, [j][i][channel], or of one curve, [i][channel]; the weight comes last.
struct GivenNet {
  const void* values;
  const GivenPoints* all; ///< the points that it is a part of

  [[nodiscard]] double value(std::size_t k) const;
  /// Component `c` of a point in Cartesian form and relative to the set's origin, in double;
  /// `channels` values a point.
  [[nodiscard]] double coordinate(std::size_t point, std::size_t channels, std::size_t c) const;
};

/// The points of all patches of a bucket, or of all curves of a set.
struct GivenPoints {
  const void* values = nullptr;
  bool in_double = false;
  Weights weights = Weights::none;
  double relative_to[3] = {0, 0, 0}; ///< PackOptions::relative_to, which is still to be subtracted

  [[nodiscard]] std::size_t value_bytes() const {
    return in_double ? sizeof(double) : sizeof(float);
  }
  /// The points from the value number `first` on.
  [[nodiscard]] GivenPoints from(std::size_t first) const {
    GivenPoints rest = *this;
    rest.values = net(first).values;
    return rest;
  }
  /// The net that begins with the value number `first`.
  [[nodiscard]] GivenNet net(std::size_t first) const {
    return {static_cast<const unsigned char*>(values) + first * value_bytes(), this};
  }
};

inline double GivenNet::value(std::size_t k) const {
  return all->in_double ? static_cast<const double*>(values)[k]
                        : static_cast<double>(static_cast<const float*>(values)[k]);
}

inline double GivenNet::coordinate(std::size_t point, std::size_t channels, std::size_t c) const {
  const double given = value(point * channels + c);
  const double origin = c < 3 ? all->relative_to[c] : 0;
  if (all->weights != Weights::homogeneous) {
    return given - origin;
  }
  const double weight = value(point * channels + channels - 1);
  return std::fma(-origin, weight, given) / weight;
}

} // namespace simdbezier::detail
