// A tessellator as one writes it in an afternoon, without a library: scalar, one grid for all
// patches, vertices joined by their positions.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace simdbezier_bench {

class PlainTessellator {
public:
  using Point = std::array<float, 3>;

  /// The nets are bicubic, 16 points each.
  explicit PlainTessellator(std::span<const Point> nets) : nets_(nets) {}

  /// Returns how many cells a patch takes in each direction, so that no triangle is farther than
  /// the tolerance from its patch: the bound of Filip, Magedson and Markot (1986).
  [[nodiscard]] std::size_t rate(double tolerance) const {
    double worst = 0;
    for (std::size_t first = 0; first < nets_.size(); first += 16) {
      const Point* const p = &nets_[first];
      double uu = 0;
      double uv = 0;
      double vv = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 2; ++i) {
          uu = std::max(uu,
                        second(p[4 * j + i + 2], p[4 * j + i + 1], p[4 * j + i + 1], p[4 * j + i]));
          vv = std::max(vv,
                        second(p[4 * i + j + 8], p[4 * i + j + 4], p[4 * i + j + 4], p[4 * i + j]));
        }
      }
      for (std::size_t k = 0; k < 9; ++k) {
        const Point* const at = p + 4 * (k / 3) + k % 3;
        uv = std::max(uv, second(at[5], at[4], at[1], at[0]));
      }
      worst = std::max(worst, 6 * uu + 2 * 9 * uv + 6 * vv);
    }
    return static_cast<std::size_t>(std::ceil(std::sqrt(worst / (8 * tolerance))));
  }

  void run(double tolerance) {
    const std::size_t n = rate(tolerance);
    positions_.clear();
    normals_.clear();
    triangles_.clear();
    known_.clear();
    std::vector<std::uint32_t> grid((n + 1) * (n + 1));
    for (std::size_t first = 0; first < nets_.size(); first += 16) {
      for (std::size_t k = 0; k < grid.size(); ++k) {
        grid[k] = add_vertex(&nets_[first], static_cast<float>(k % (n + 1)) / static_cast<float>(n),
                             static_cast<float>(k / (n + 1)) / static_cast<float>(n));
      }
      for (std::size_t k = 0; k < n * n; ++k) {
        const std::size_t at = k / n * (n + 1) + k % n;
        triangles_.push_back({grid[at], grid[at + 1], grid[at + n + 2]});
        triangles_.push_back({grid[at], grid[at + n + 2], grid[at + n + 1]});
      }
    }
    for (Point& normal : normals_) {
      normalise(normal);
    }
  }
  [[nodiscard]] std::size_t vertices() const { return positions_.size(); }
  [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }

private:
  struct Hash {
    std::size_t operator()(const Point& p) const {
      std::size_t state = 0;
      for (const float value : p) {
        state = (state ^ std::bit_cast<std::uint32_t>(value)) * 0x9e3779b97f4a7c15U;
        state ^= state >> 29;
      }
      return state;
    }
  };

  static double second(const Point& a, const Point& b, const Point& c, const Point& d) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = (static_cast<double>(a[k]) - b[k]) - (static_cast<double>(c[k]) - d[k]);
      square += x * x;
    }
    return std::sqrt(square);
  }
  static void normalise(Point& n) {
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& value : n) {
      value = length > 0 ? value / length : 0;
    }
  }
  /// Returns the point of a cubic by de Casteljau's algorithm, and in `slope` its derivative over
  /// 3.
  static float cubic(float t, float a, float b, float c, float d, float& slope) {
    const auto mix = [t](float x, float y) { return x + t * (y - x); };
    const float ab = mix(a, b);
    const float bc = mix(b, c);
    const float cd = mix(c, d);
    const float low = mix(ab, bc);
    const float high = mix(bc, cd);
    slope = high - low;
    return mix(low, high);
  }

  std::uint32_t add_vertex(const Point* net, float u, float v) {
    Point position;
    Point du;
    Point dv;
    for (std::size_t c = 0; c < 3; ++c) {
      float row[4];
      float along[4];
      float unused = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        const Point* const p = net + 4 * j;
        row[j] = cubic(u, p[0][c], p[1][c], p[2][c], p[3][c], along[j]);
      }
      position[c] = cubic(v, row[0], row[1], row[2], row[3], dv[c]);
      du[c] = cubic(v, along[0], along[1], along[2], along[3], unused);
    }
    Point normal = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                    du[0] * dv[1] - du[1] * dv[0]};
    normalise(normal);
    const auto [found, fresh] =
        known_.try_emplace(position, static_cast<std::uint32_t>(positions_.size()));
    if (fresh) {
      positions_.push_back(position);
      normals_.push_back(normal);
    } else {
      for (std::size_t c = 0; c < 3; ++c) {
        normals_[found->second][c] += normal[c];
      }
    }
    return found->second;
  }

  std::span<const Point> nets_;
  std::vector<Point> positions_;
  std::vector<Point> normals_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::unordered_map<Point, std::uint32_t, Hash> known_;
};

} // namespace simdbezier_bench
