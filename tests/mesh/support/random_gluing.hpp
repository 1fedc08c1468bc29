// Patches whose sides are joined at random: any surface that can be made of a few squares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace simdbezier::tests {

/// Control points in general position, except on sides that are joined or points.
struct RandomGluing {
  std::size_t patches = 0;
  std::vector<double> values; ///< bicubic, packed
  std::size_t open_edges = 0;
  bool has_points = false; ///< sides that are points
  /// Two neighbouring sides of a patch are one edge. No grid of cells can take that apart: the cell
  /// between them has one and the same vertex at two corners.
  bool folded = false;

  explicit RandomGluing(unsigned seed);

private:
  using Point = std::array<double, 3>;

  void join_sides();
  void place_points();
  std::size_t corner(std::size_t side, bool end);
  std::size_t find(std::size_t corner);
  Point random_point();

  struct Joint {
    std::size_t edge = 0;
    bool reversed = false;
    bool point = false;
  };
  std::mt19937 random_;
  std::vector<Joint> sides_;
  std::vector<std::size_t> parent_; ///< of corners that are one
  std::size_t edges_ = 0;
};

} // namespace simdbezier::tests
