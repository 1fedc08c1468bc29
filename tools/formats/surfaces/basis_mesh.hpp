// Meshes of values in any polynomial basis, and the Bézier patches that they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// The functions that the values of one direction are multiplied by. That of value j is the sum
/// over k of coefficients[k * (degree + 1) + j] / denominator * t^k, t from 0 to 1.
struct BasisFunctions {
  int degree = 3; ///< 1 to kMostDegree
  std::vector<double> coefficients;
  double denominator = 1;
};

/// How degree + 1 values of such a direction become as many Bézier points: point i is the sum over
/// j of numerators[i * order + j] * value j, over the denominator of row i.
class BasisMatrix {
public:
  explicit BasisMatrix(const BasisFunctions& functions);

  [[nodiscard]] int degree() const noexcept { return static_cast<int>(order_) - 1; }
  [[nodiscard]] std::size_t order() const noexcept { return order_; }
  [[nodiscard]] std::span<const double> row(std::size_t i) const noexcept {
    return std::span(numerators_).subspan(i * order_, order_);
  }
  [[nodiscard]] double denominator(std::size_t i) const noexcept { return denominators_[i]; }
  /// Whether Bézier points are means of values, so that weights above 0 stay above 0.
  [[nodiscard]] bool has_means() const noexcept { return has_means_; }
  /// What the sum of row i may add to values of 1 at most: exactly, and by rounding, which includes
  /// what the numerators are rounded by.
  [[nodiscard]] double sum(std::size_t i) const noexcept { return sums_[i]; }
  [[nodiscard]] double rounding(std::size_t i) const noexcept { return roundings_[i]; }

private:
  std::size_t order_;
  std::vector<double> numerators_;
  std::vector<double> denominators_;
  std::vector<double> sums_;
  std::vector<double> roundings_;
  bool has_means_ = true;
};

/// A mesh of values: patch k of a direction has the values k * step to k * step + degree, as
/// MeshDirection counts them.
struct BasisMesh {
  const BasisMatrix& basis_u;
  const BasisMatrix& basis_v;
  MeshDirection u;
  MeshDirection v;
  Weights weights = Weights::none;      ///< none or homogeneous
  std::span<const double> points;       ///< x y z or wx wy wz w, u fastest
  std::span<const std::uint32_t> lines; ///< of every point
};

/// Adds the patches of a mesh to a file, one by one, u fastest, each with the line of its first
/// value. Returns a bound on how far rounding moves their surfaces.
///
/// Bits: sums run in the order of the values, first in u, then in v, values with the factor 0 are
/// left out, and there is one division at the end. Patches that have the same factors for the same
/// values along a common edge, as those of B-splines and Catmull-Rom splines do, get equal bits
/// there. Results are exact where the sums and the quotient are.
///
/// Throws Failure where a weight of the patches is not above 0, or a coordinate is not finite.
[[nodiscard]] double add_basis_mesh(PatchFile& file, const BasisMesh& mesh);

} // namespace simdbezier::tools
