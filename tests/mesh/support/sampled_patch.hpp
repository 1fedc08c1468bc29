// A patch by an evaluation of its own, its mesh, and the distance of dense samples from that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/rates.hpp>

#include "tests/mesh/support/mesh_oracle.hpp"

namespace simdbezier::tests {

/// One patch: values x y z (w) of its control points, u fastest.
struct TestPatch {
  std::string name;
  int degree_u = 3;
  int degree_v = 3;
  Weights weights = Weights::none;
  std::vector<double> values;

  [[nodiscard]] std::size_t channels() const { return weights == Weights::none ? 3 : 4; }
  [[nodiscard]] ControlNets<double> nets() const {
    return ControlNets<double>::packed(values.data(), 1, degree_u, degree_v, 3, weights);
  }
  /// In the precision of the parameters.
  template <typename Real>
  [[nodiscard]] std::array<Real, 3> at(Real u, Real v) const;
};

/// Bernstein polynomials by their recurrence.
template <typename Real>
std::vector<Real> bernstein(int degree, Real t) {
  std::vector<Real> b(static_cast<std::size_t>(degree) + 1);
  b[0] = 1;
  for (std::size_t n = 1; n < b.size(); ++n) {
    for (std::size_t i = n + 1; i-- > 0;) {
      b[i] = (i < n ? (1 - t) * b[i] : 0) + (i > 0 ? t * b[i - 1] : 0);
    }
  }
  return b;
}

template <typename Real>
std::array<Real, 3> TestPatch::at(Real u, Real v) const {
  const std::vector<Real> bu = bernstein(degree_u, u);
  const std::vector<Real> bv = bernstein(degree_v, v);
  std::array<Real, 3> sum{};
  Real weight = 0;
  for (std::size_t j = 0; j < bv.size(); ++j) {
    for (std::size_t i = 0; i < bu.size(); ++i) {
      const double* const p = &values[channels() * (j * bu.size() + i)];
      const Real b = bu[i] * bv[j];
      const Real w = weights == Weights::none ? 1 : p[3];
      const Real factor = weights == Weights::homogeneous ? b : b * w;
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += factor * p[c];
      }
      weight += b * w;
    }
  }
  return {sum[0] / weight, sum[1] / weight, sum[2] / weight};
}

struct Choice {
  std::array<std::uint32_t, 1> nu{1};
  std::array<std::uint32_t, 1> nv{1};
  std::array<std::uint16_t, 1> diagonals{};
  std::array<double, 1> deviation{};

  [[nodiscard]] CertifiedRates out() { return {nu, nv, diagonals, deviation}; }
};

/// Rates and certificates of a set of patches, all at once.
struct Choices {
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviation;
  Status status;

  Choices(const std::vector<TestPatch>& patches, const RateOptions& options,
          const RunOptions& run = {})
      : nu(patches.size(), 3), nv(patches.size(), 3), diagonals(patches.size()),
        deviation(patches.size()) {
    std::vector<ControlNets<double>> nets;
    for (const TestPatch& patch : patches) {
      nets.push_back(patch.nets());
    }
    const std::span<const ControlNets<double>> views(nets);
    Topology topology;
    EXPECT_EQ(find_topology(views, topology), Status::ok);
    status = choose_rates(views, topology, options, {nu, nv, diagonals, deviation}, run).status;
  }
  [[nodiscard]] std::size_t cells() const {
    return std::inner_product(nu.begin(), nu.end(), nv.begin(), std::size_t{0});
  }
  friend bool operator==(const Choices&, const Choices&) = default;
};

inline Topology topology_of(const TestPatch& patch) {
  Topology topology;
  EXPECT_EQ(find_topology(patch.nets(), topology), Status::ok);
  return topology;
}

/// Vertices of a mesh of one patch whose sides are all different, in the documented order.
inline std::vector<Point> vertices_of(const TestPatch& patch, std::uint32_t nu, std::uint32_t nv) {
  std::vector<Point> points = {patch.at(0.0, 0.0), patch.at(1.0, 0.0), patch.at(0.0, 1.0),
                               patch.at(1.0, 1.0)};
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    points.push_back(patch.at(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
  };
  for (const std::uint32_t j : {0U, nv}) {
    for (std::uint32_t i = 1; i < nu; ++i) {
      add(i, j);
    }
  }
  for (const std::uint32_t i : {0U, nu}) {
    for (std::uint32_t j = 1; j < nv; ++j) {
      add(i, j);
    }
  }
  for (std::uint32_t j = 1; j < nv; ++j) {
    for (std::uint32_t i = 1; i < nu; ++i) {
      add(i, j);
    }
  }
  return points;
}

/// The largest distance of dense samples from the mesh.
inline double found_deviation(const TestPatch& patch, const Topology& topology,
                              const Choice& choice) {
  MeshLayout layout;
  EXPECT_EQ(lay_out_mesh(topology, {choice.nu, choice.nv, choice.diagonals}, layout), Status::ok);
  std::vector<std::uint32_t> numbers(3 * layout.size().triangles);
  EXPECT_EQ(write_triangles(layout, std::span(numbers), {.threads = 1}), Status::ok);
  const std::vector<Point> vertices = vertices_of(patch, choice.nu[0], choice.nv[0]);
  EXPECT_EQ(vertices.size(), layout.size().vertices);
  std::vector<std::array<Point, 3>> triangles;
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    triangles.push_back({vertices[numbers[k]], vertices[numbers[k + 1]], vertices[numbers[k + 2]]});
  }
  constexpr std::uint32_t kInCell = 4;
  double worst = 0;
  for (std::uint32_t j = 0; j <= kInCell * choice.nv[0]; ++j) {
    for (std::uint32_t i = 0; i <= kInCell * choice.nu[0]; ++i) {
      const Point p = patch.at(static_cast<double>(i) / (kInCell * choice.nu[0]),
                               static_cast<double>(j) / (kInCell * choice.nv[0]));
      double least = std::numeric_limits<double>::infinity();
      for (const auto& triangle : triangles) {
        least = std::min(least, squared_distance(p, triangle));
        if (least <= worst) {
          break;
        }
      }
      worst = std::max(worst, least);
    }
  }
  return std::sqrt(worst);
}

} // namespace simdbezier::tests
