// The matrices behind degree elevation, derivatives and changes of basis, from exact integers.
#pragma once

#include <simdbezier/nets.hpp>

#include "src/tables/net_table.hpp"

namespace simdbezier::detail {

LinearMap identity_map(int degree) noexcept;
LinearMap elevation_map(int degree, int new_degree) noexcept;
/// Degree 1 gives two equal values.
LinearMap hodograph_map(int degree) noexcept;
/// The support of a map whose factors are positive; none of others.
Support support_of(const LinearMap& map) noexcept;
/// The support of a piece of a direction, or of the whole: `first`, it begins where that begins;
/// `last`, it ends where that ends.
Support support_of_piece(int degree, bool first, bool last) noexcept;
/// From a basis to control points, or back.
LinearMap basis_map(Basis basis, int degree, bool to_bezier) noexcept;

} // namespace simdbezier::detail
