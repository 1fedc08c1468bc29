// How much a patch bends out of its tangent planes, which is what its triangles can be close to
// wherever parameters run. An estimate that proves nothing: it tells where bounds on point sets
// pay.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/mesh/bounds/vector_patch.hpp"

namespace simdbezier::detail {

inline constexpr std::size_t kBendSamples = 4; ///< in each direction, half of them in each half

/// Bernstein polynomials and their first two derivatives in the middles of as many equal parts.
class BendSamples {
public:
  BendSamples() = default;
  /// Of nets of so many control points.
  BendSamples(std::size_t columns, std::size_t rows);

  [[nodiscard]] bool suits(const VectorNet& net) const {
    return net.columns == columns_ && net.rows == rows_;
  }

private:
  friend class NormalBends;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<double> along_u_; ///< [sample][derivative][control point]
  std::vector<double> along_v_;
};

class NormalBends {
public:
  NormalBends(const BendSamples& samples, const VectorPatch& patch);

  /// About how far the triangles of cells with such small steps in u and v are from the surface,
  /// with the better diagonal in each quarter.
  [[nodiscard]] double at(double u, double v) const;
  /// About the number of small cells that have this distance.
  [[nodiscard]] double fewest(double distance) const;

private:
  /// Second derivatives along the normal; zeros where there is none.
  struct Bend {
    double uu = 0;
    double uv = 0;
    double vv = 0;
  };
  std::array<Bend, kBendSamples * kBendSamples> at_; ///< [u][v]
  double side_uu_ = 0;                               ///< of sides, out of their tangents
  double side_vv_ = 0;
};

} // namespace simdbezier::detail
