// Patches of any degrees and weights as tests of meshes build them, in long double until the end.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/dense_deviation.hpp"
#include "tests/mesh/support/random_gluing.hpp"
#include "tests/mesh/support/sampled_patch.hpp"
#include "tests/mesh/support/triangle_census.hpp"

namespace simdbezier::tests {

/// One patch with a weight at each control point, which its coordinates have been multiplied by.
struct GeneralNet {
  int degree_u = 3;
  int degree_v = 3;
  std::vector<std::array<long double, 4>> points; ///< u fastest

  [[nodiscard]] std::array<long double, 4>& at(int i, int j) {
    return points[static_cast<std::size_t>(j * (degree_u + 1) + i)];
  }
  [[nodiscard]] const std::array<long double, 4>& at(int i, int j) const {
    return points[static_cast<std::size_t>(j * (degree_u + 1) + i)];
  }
};

inline GeneralNet transposed(const GeneralNet& net) {
  GeneralNet other{net.degree_v, net.degree_u, net.points};
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      other.at(j, i) = net.at(i, j);
    }
  }
  return other;
}

/// u -> 1 - u.
inline GeneralNet reversed(const GeneralNet& net) {
  GeneralNet other = net;
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      other.at(i, j) = net.at(net.degree_u - i, j);
    }
  }
  return other;
}

/// The same surface, of one degree more in u.
inline GeneralNet raised(const GeneralNet& net) {
  const int n = net.degree_u + 1;
  GeneralNet other{n, net.degree_v, {}};
  other.points.resize(static_cast<std::size_t>((n + 1) * (net.degree_v + 1)));
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= n; ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        const long double before = i > 0 ? net.at(i - 1, j)[c] : 0;
        const long double own = i < n ? net.at(i, j)[c] : 0;
        other.at(i, j)[c] = (i * before + (n - i) * own) / n;
      }
    }
  }
  return other;
}

/// The patch in [u0, u1], by de Casteljau's algorithm.
inline GeneralNet cut(const GeneralNet& net, long double u0, long double u1) {
  GeneralNet other = net;
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int k = 0; k <= net.degree_u; ++k) { // the blossom at u0, n - k times, and u1
      std::vector<std::array<long double, 4>> row;
      for (int i = 0; i <= net.degree_u; ++i) {
        row.push_back(net.at(i, j));
      }
      for (int step = 0; step < net.degree_u; ++step) {
        const long double t = step < k ? u1 : u0;
        for (std::size_t i = 0; i + 1 < row.size(); ++i) {
          for (std::size_t c = 0; c < 4; ++c) {
            row[i][c] = (1 - t) * row[i][c] + t * row[i + 1][c];
          }
        }
        row.pop_back();
      }
      other.at(k, j) = row[0];
    }
  }
  return other;
}

/// With all weights multiplied.
inline GeneralNet weighted(GeneralNet net, long double factor) {
  for (auto& point : net.points) {
    for (long double& value : point) {
      value *= factor;
    }
  }
  return net;
}

/// With degrees raised by up to three each.
inline GeneralNet raised_at_random(GeneralNet net, std::mt19937& random) {
  for (int direction = 0; direction < 2; ++direction) {
    for (unsigned k = random() % 4; k > 0; --k) {
      net = raised(net);
    }
    net = transposed(net);
  }
  return net;
}

/// Scaled in space, then moved.
inline GeneralNet placed(GeneralNet net, long double scale, const Point& to) {
  for (auto& point : net.points) {
    for (std::size_t c = 0; c < 3; ++c) {
      point[c] = point[c] * scale + to[c] * point[3];
    }
  }
  return net;
}

/// The values of a form, rounded once to a type. Without weights, all have to be 1.
template <typename S>
TestPatch rounded_patch(const GeneralNet& net, Weights form) {
  TestPatch patch{"", net.degree_u, net.degree_v, form, {}};
  for (const auto& point : net.points) {
    for (std::size_t c = 0; c < 3; ++c) {
      const long double value = form == Weights::homogeneous ? point[c] : point[c] / point[3];
      patch.values.push_back(static_cast<double>(static_cast<S>(value)));
    }
    if (form != Weights::none) {
      patch.values.push_back(static_cast<double>(static_cast<S>(point[3])));
    }
  }
  return patch;
}

/// Patches as views of one type; the values have to outlive them.
template <typename S>
struct GeneralViews {
  std::vector<std::vector<S>> values;
  std::vector<ControlNets<S>> nets;

  explicit GeneralViews(const std::vector<TestPatch>& patches) {
    for (const TestPatch& patch : patches) {
      values.emplace_back(patch.values.begin(), patch.values.end());
    }
    for (std::size_t k = 0; k < patches.size(); ++k) {
      nets.push_back(ControlNets<S>::packed(values[k].data(), 1, patches[k].degree_u,
                                            patches[k].degree_v, 3, patches[k].weights));
    }
  }
};

/// The bicubic patches of a gluing. Weights belong to points, so that common ones have the same.
inline std::vector<GeneralNet> nets_of(const RandomGluing& gluing, bool weights) {
  std::vector<GeneralNet> nets(gluing.patches);
  for (std::size_t k = 0; k < 16 * gluing.patches; ++k) {
    const double* const x = &gluing.values[3 * k];
    const double share = std::fabs(std::sin(1e3 * (x[0] + 2 * x[1] + 3 * x[2])));
    const long double weight = weights ? 0.5L + share : 1.0L;
    nets[k / 16].points.push_back({weight * x[0], weight * x[1], weight * x[2], weight});
  }
  return nets;
}

template <typename T>
TriangleCensus census_of(const Mesh<T>& mesh) {
  return count_triangles(
      std::span<const std::uint32_t>(mesh.triangles.front().data(), 3 * mesh.triangles.size()),
      mesh.positions.size());
}

/// Against the surfaces of the patches given, in long double.
template <typename T>
void expect_certified(const MeshPlan<T>& plan, const Mesh<T>& mesh,
                      const std::vector<TestPatch>& given) {
  for (std::size_t p = 0; p < plan.deviations.size(); ++p) {
    const PatchPiece piece =
        plan.pieces.empty() ? PatchPiece{static_cast<std::uint32_t>(p)} : plan.pieces[p];
    const auto surface = [&](double u, double v) {
      const auto x = given[piece.patch].at<long double>(piece.u0 + (piece.u1 - piece.u0) * u,
                                                        piece.v0 + (piece.v1 - piece.v0) * v);
      return Point{static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
    };
    EXPECT_LE(farthest_sample(plan, mesh, surface, p, 2), plan.deviations[p]) << "patch " << p;
  }
}

} // namespace simdbezier::tests
