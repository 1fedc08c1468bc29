// The bases of RIB files.
// Source: The RenderMan Interface, version 3.2, 5.2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <tools/formats/surfaces/basis_mesh.hpp>

namespace simdbezier::tools {

/// One direction's basis of bicubic patches.
struct RibBasis {
  std::string name = "bezier";
  std::size_t step = 3;
  /// Null where values are Bézier points, and where no basis has the name.
  std::shared_ptr<const BasisMatrix> matrix = nullptr;

  [[nodiscard]] bool is_known() const noexcept { return matrix || name == "bezier"; }
};
struct RibBases {
  RibBasis u;
  RibBasis v;
};

/// The functions of a direction are (t^3 t^2 t 1) times the matrix, over the denominator.
using RibMatrix = std::array<double, 16>;
struct RibNamedBasis {
  std::string_view name;
  double denominator;
  RibMatrix matrix;
};
inline constexpr RibNamedBasis kRibNamedBases[] = {
    {"bezier", 1, {-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0}},
    {"b-spline", 6, {-1, 3, -3, 1, 3, -6, 3, 0, -3, 0, 3, 0, 1, 4, 1, 0}},
    {"catmull-rom", 2, {-1, 3, -3, 1, 2, -5, 4, -1, -1, 0, 1, 0, 0, 2, 0, 0}},
    {"hermite", 1, {2, 1, -2, 1, -3, -2, 3, -1, 0, 1, 0, 0, 1, 0, 0, 0}},
    {"power", 1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};

[[nodiscard]] inline std::shared_ptr<const BasisMatrix> rib_basis_matrix(const RibMatrix& matrix,
                                                                         double denominator) {
  BasisFunctions functions{3, {}, denominator};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto row = matrix.begin() + static_cast<std::ptrdiff_t>((3 - k) * 4);
    functions.coefficients.insert(functions.coefficients.end(), row, row + 4);
  }
  return std::make_shared<const BasisMatrix>(functions);
}

[[nodiscard]] inline RibBasis rib_basis(std::string_view name, std::size_t step) {
  const auto* const found = std::ranges::find(kRibNamedBases, name, &RibNamedBasis::name);
  RibBasis basis{std::string(name), step};
  if (found != std::end(kRibNamedBases) && name != "bezier") {
    basis.matrix = rib_basis_matrix(found->matrix, found->denominator);
  }
  return basis;
}

/// A matrix whose numbers are those of a named basis to four decimals, as files have sixths, is
/// that basis: patches would not meet otherwise.
[[nodiscard]] inline RibBasis rib_basis(const RibMatrix& matrix, std::size_t step) {
  for (const RibNamedBasis& named : kRibNamedBases) {
    const bool is_it = std::ranges::equal(matrix, named.matrix, [&](double value, double exact) {
      return std::abs(value - exact / named.denominator) <= 5e-5;
    });
    if (is_it) {
      return rib_basis(named.name, step);
    }
  }
  return {"a matrix", step, rib_basis_matrix(matrix, 1)};
}

} // namespace simdbezier::tools
