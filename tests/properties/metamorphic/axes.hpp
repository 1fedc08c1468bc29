// The axes of the table of metamorphic tests: (relation x call x shape x output x side x kind x
// origin x type), and the reasons for which a cell cannot be filled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tests {

/// How a second net is made of a first one, whose results then follow from the first one's.
enum class Relation : std::uint8_t {
  transposed, ///< u and v exchanged
  reversed_u,
  reversed_v,
  scaled, ///< by a power of two
  translated,
  permuted,  ///< components in another order
  elevated,  ///< by one degree in each direction
  reweighted ///< all weights times a power of two: the same surface
};
inline constexpr const char* kRelationNames[] = {"transposed", "reversed_u", "reversed_v",
                                                 "scaled",     "translated", "permuted",
                                                 "elevated",   "reweighted"};

enum class Call : std::uint8_t {
  grid,
  given_grid, ///< with parameters of its own
  patch_grids,
  tiles,
  scattered,
  derivative_grid,
  derivative_samples,
  iso_u,
  iso_v,
  curve_rows,
  counted_curves,
  curve_samples
};
inline constexpr const char* kCallNames[] = {
    "grid",      "given grid",      "patch grids",        "tiles",
    "scattered", "derivative grid", "derivative samples", "iso_u",
    "iso_v",     "curve rows",      "counted curves",     "curve samples"};

/// The outputs of patches and curves. Those of curves are position, du for d1, duu for d2, normal
/// for the tangent.
enum class Output : std::uint8_t {
  position,
  du,
  dv,
  duu,
  duv,
  dvv,
  normal,
  status,
  curvature,
  any_order
};
inline constexpr const char* kOutputNames[] = {
    "position", "du", "dv", "duu", "duv", "dvv", "normal", "status", "curvature", "any order"};

inline constexpr const char* kSideNames[] = {"v0", "v1", "u0", "u1"};

/// What is degenerate, at one side. Corners are the ones at which sides begin, counter-clockwise.
enum class Kind : std::uint8_t { regular, collapsed_edge, doubled_row, collapsed_corner };
inline constexpr const char* kKindNames[] = {"regular", "collapsed_edge", "doubled_row",
                                             "collapsed_corner"};

enum class Origin : std::uint8_t { none, local, relative };
inline constexpr const char* kOriginNames[] = {"no origin", "local origins", "relative_to"};

struct ShapeRow {
  const char* name;
  int degree_u;
  int degree_v; ///< 0: curves
  int components;
  Weights weights;
  int nu; ///< samples
  int nv;
  [[nodiscard]] constexpr bool is_curve() const { return degree_v == 0; }
};

/// The last row stands for all surfaces in space in one set.
inline constexpr ShapeRow kShapeRows[] = {
    {"bicubic", 3, 3, 3, Weights::none, 4, 4},
    {"bicubic, rows", 3, 3, 3, Weights::none, 18, 4},
    {"bilinear", 1, 1, 3, Weights::none, 4, 4},
    {"2x3", 2, 3, 3, Weights::none, 4, 4},
    {"5x4", 5, 4, 3, Weights::none, 4, 4},
    {"6x7", 6, 7, 3, Weights::none, 4, 4},
    {"15x2", 15, 2, 3, Weights::none, 4, 4},
    {"3x3, 1 component", 3, 3, 1, Weights::none, 4, 4},
    {"4x2, 2 components", 4, 2, 2, Weights::none, 4, 4},
    {"3x2, 16 components", 3, 2, 16, Weights::none, 4, 4},
    {"3x3 cartesian", 3, 3, 3, Weights::cartesian, 4, 4},
    {"2x2 cartesian", 2, 2, 3, Weights::cartesian, 18, 4},
    {"7x3 cartesian", 7, 3, 3, Weights::cartesian, 4, 4},
    {"2x3, 5 components, cartesian", 2, 3, 5, Weights::cartesian, 4, 4},
    {"3x3 homogeneous", 3, 3, 3, Weights::homogeneous, 4, 4},
    {"2x3 homogeneous", 2, 3, 3, Weights::homogeneous, 4, 4},
    {"cubic curve", 3, 0, 3, Weights::none, 18, 1},
    {"line", 1, 0, 3, Weights::none, 4, 1},
    {"degree 7 curve", 7, 0, 3, Weights::none, 4, 1},
    {"plane cubic curve", 3, 0, 2, Weights::none, 4, 1},
    {"1 component curve", 5, 0, 1, Weights::none, 4, 1},
    {"cartesian conic", 2, 0, 3, Weights::cartesian, 18, 1},
    {"homogeneous curve", 4, 0, 3, Weights::homogeneous, 4, 1},
    {"mixed", 0, 0, 3, Weights::none, 4, 4},
};
inline constexpr std::size_t kMixedShape = std::size(kShapeRows) - 1;

inline constexpr std::size_t kAxes = 8;
/// relation, call, shape, output, side, kind, origin, type
inline constexpr std::array<std::size_t, kAxes> kAxisSizes{
    std::size(kRelationNames), std::size(kCallNames),
    std::size(kShapeRows),     std::size(kOutputNames),
    std::size(kSideNames),     std::size(kKindNames),
    std::size(kOriginNames),   2};

/// One cell of the table.
struct Cell {
  Relation relation;
  Call call;
  std::size_t shape;
  Output output;
  std::size_t side;
  Kind kind;
  Origin origin;
  bool is_double;

  [[nodiscard]] std::size_t index() const;
};

/// Every cell, in the order of their indices.
[[nodiscard]] Cell cell_at(std::size_t index);
[[nodiscard]] std::size_t cell_count();

[[nodiscard]] constexpr bool is_curve_call(Call call) { return call >= Call::curve_rows; }
[[nodiscard]] constexpr bool is_iso_call(Call call) {
  return call == Call::iso_u || call == Call::iso_v;
}
[[nodiscard]] constexpr bool is_derivative_call(Call call) {
  return call == Call::derivative_grid || call == Call::derivative_samples;
}

/// Why no test can fill it, in a few words; null where one must.
[[nodiscard]] const char* impossible_because(const Cell& cell);

} // namespace simdbezier::tests
