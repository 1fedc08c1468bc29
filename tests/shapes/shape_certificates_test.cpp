// Certificates of patches of any shape: packed coefficients are evaluated here as the library's
// contract says (columns in X, rows in Y, a half's own parameter, one reciprocal), in T and without
// its kernels, and compared with exact rational surfaces. Kernels are judged by the accuracy suite.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/shapes/scalar_cell.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/nets/shape_nets.hpp"
#include "tests/support/oracle/exact_polynomials.hpp"

namespace simdbezier::tests::shape_certificates_test {
namespace {

/// The exact surface of a net whose weights are given beside Cartesian points.
class ExactSurface {
public:
  template <typename T>
  ExactSurface(const ShapeCase& c, const std::vector<T>& values) : case_(c) {
    for (std::size_t k = 0; k < c.points(); ++k) {
      const bool rational = c.weights != Weights::none;
      const Rational weight =
          rational ? exact(static_cast<double>(values[(k + 1) * c.channels() - 1])) : Rational(1);
      for (std::size_t i = 0; i < c.channels(); ++i) {
        const Rational value = exact(static_cast<double>(values[k * c.channels() + i]));
        values_.push_back(rational && i + 1 < c.channels() ? value * weight : value);
      }
    }
  }

  [[nodiscard]] Sample<Rational> at(std::size_t c, const Rational& u, const Rational& v) const {
    const Sample<Rational> h = channel(c, u, v);
    if (case_.weights == Weights::none) {
      return h;
    }
    const Sample<Rational> w = channel(case_.channels() - 1, u, v);
    const Rational s = h.position / w.position;
    return {s, (h.du - s * w.du) / w.position, (h.dv - s * w.dv) / w.position};
  }

private:
  [[nodiscard]] Sample<Rational> channel(std::size_t c, const Rational& u,
                                         const Rational& v) const {
    std::vector<Rational> values;
    std::vector<Rational> slopes;
    for (int j = 0; j <= case_.degree_v; ++j) {
      std::vector<Rational> row;
      for (int i = 0; i <= case_.degree_u; ++i) {
        const auto k = static_cast<std::size_t>(j * (case_.degree_u + 1) + i);
        row.push_back(values_[k * case_.channels() + c]);
      }
      const ExactCurve curve = exact_curve(std::move(row), u);
      values.push_back(curve.value);
      slopes.push_back(curve.first);
    }
    const ExactCurve s = exact_curve(std::move(values), v);
    return {s.value, exact_curve(std::move(slopes), v).value, s.first};
  }

  const ShapeCase& case_;
  std::vector<Rational> values_;
};

/// Judges both classes of results by the same exact samples, which take most of the time.
template <typename T>
class CertificateCheck {
public:
  CertificateCheck(const ShapeCase& c, const RandomNets<T>& nets, const PackOptions& options)
      : surface_(c, nets.values) {
    EXPECT_TRUE(pack(nets.view, set_, options)) << c;
    for (const Isa isa : available_isas()) {
      bounds_[fuses_multiply_add(isa) ? 1 : 0] = error_bounds(set_, 0, isa);
    }
  }

  /// Returns the largest |error| / bound of each class that the library has here, over random
  /// samples, a third of them on edges; 0 of others.
  [[nodiscard]] std::array<double, 2> worst(std::uint64_t seed) {
    Random random(seed);
    const detail::PatchStorage<T>& storage = set_.storage()->buckets[0];
    const detail::NetShape& s = storage.shape;
    for (int k = 0; k < 12; ++k) {
      // Tiny parameters are those that lose most in a half of a patch.
      const T x = static_cast<T>(random.symmetric() / 2 * (k % 4 == 0 ? 1e-3 : 1));
      const T y = static_cast<T>(random.symmetric() / 2 * (k % 4 == 1 ? 1e-3 : 1));
      const Local<T> u(x, s.cells_u());
      const Local<T> v(y, s.cells_v());
      const Rational exact_u = exact(static_cast<double>(x)) + Rational(1, 2);
      const Rational exact_v = exact(static_cast<double>(y)) + Rational(1, 2);
      for (std::size_t c = 0; c < static_cast<std::size_t>(s.components); ++c) {
        const Edge edge = k % 3 != 0    ? Edge::none
                          : v.cell == 0 ? Edge::v0
                          : u.cell == 0 ? Edge::u0
                                        : Edge::u1;
        const Sample<Rational> value = surface_.at(c,
                                                   edge == Edge::u0   ? Rational(0)
                                                   : edge == Edge::u1 ? Rational(1)
                                                                      : exact_u,
                                                   edge == Edge::v0 ? Rational(0) : exact_v);
        for (const bool fma : {false, true}) {
          if (has_class(fma)) {
            const ScalarCell<T> cell(storage, v.cell * s.cells_u() + u.cell, fma);
            compare(cell, c, edge, u.x, v.x, value, fma ? 1 : 0);
          }
        }
      }
    }
    return worst_;
  }

private:
  enum class Edge { none, v0, u0, u1 };

  void compare(const ScalarCell<T>& cell, std::size_t c, Edge edge, T u, T v,
               const Sample<Rational>& value, std::size_t which) {
    const ErrorBounds& bounds = bounds_[which];
    double& worst = worst_[which];
    if (edge == Edge::none) {
      const Sample<T> found = cell.inside(c, u, v);
      worst = std::max({worst, ratio(found.position, value.position, bounds.position[c]),
                        ratio(found.du, value.du, bounds.du[c]),
                        ratio(found.dv, value.dv, bounds.dv[c])});
    } else {
      const bool along_u = edge == Edge::v0;
      const Slope<T> found = cell.on_edge(c,
                                          along_u            ? detail::kEdgeV0
                                          : edge == Edge::u0 ? detail::kEdgeU0
                                                             : detail::kEdgeU1,
                                          along_u ? u : v);
      worst = std::max({worst, ratio(found.value, value.position, bounds.position[c]),
                        along_u ? ratio(found.first, value.du, bounds.du[c])
                                : ratio(found.first, value.dv, bounds.dv[c])});
    }
  }

  [[nodiscard]] static double ratio(T found, const Rational& value, double bound) {
    if (std::isinf(bound)) {
      return 0;
    }
    if (!std::isfinite(found)) {
      return std::numeric_limits<double>::infinity();
    }
    const Rational error = abs(value - exact(static_cast<double>(found)));
    return error.get_d() / bound;
  }

  ExactSurface surface_;
  PatchSet<T> set_;
  ErrorBounds bounds_[2];
  std::array<double, 2> worst_{};
};

enum class Family { random, signs, smooth };

/// Control values of a family, `offset` from zero; weights up to `ratio` apart.
template <typename T>
void fill(RandomNets<T>& nets, const ShapeCase& c, Family family, double offset, double ratio,
          std::uint64_t seed) {
  Random random(seed);
  for (std::size_t k = 0; k < nets.values.size(); ++k) {
    const double x = random.symmetric();
    const bool weight = c.weights != Weights::none && k % c.channels() + 1 == c.channels();
    const double value = family == Family::signs    ? random.sign()
                         : family == Family::smooth ? 1 + 1e-4 * x
                                                    : x;
    nets.values[k] =
        static_cast<T>(weight ? (random.sign() > 0 ? 1 + std::abs(x) : ratio) : offset + value);
  }
}

template <typename T>
void expect_certified(bool origins, double offset, double ratio) {
  PackOptions options;
  options.local_origin = origins;
  double all = 0;
  for (int n = 1; n <= kMostDegree; ++n) {
    for (const ShapeCase& c : {ShapeCase{n, n, 1}, ShapeCase{n, (n + 4) % 15 + 1, 1},
                               ShapeCase{n, n, 1, Weights::cartesian},
                               ShapeCase{(n + 7) % 15 + 1, n, 1, Weights::cartesian}}) {
      for (const Family family : {Family::random, Family::signs, Family::smooth}) {
        RandomNets<T> nets(c, 1, 1);
        fill(nets, c, family, offset, ratio, static_cast<std::uint64_t>(n));
        const std::array<double, 2> of_class = CertificateCheck<T>(c, nets, options).worst(7);
        for (const bool fma : {false, true}) {
          if (!has_class(fma)) {
            continue;
          }
          const double worst = of_class[fma ? 1 : 0];
          EXPECT_LE(worst, 1) << c << " family " << static_cast<int>(family) << " fma " << fma;
          EXPECT_GT(worst, family == Family::random ? 1e-9 : -1) << c << ": as good as infinite";
          all = std::max(all, worst);
        }
      }
    }
  }
  EXPECT_GT(all, 0.05) << "the certificates say nothing";
}

TEST(ShapeCertificates, hold_for_every_degree_and_weight) {
  expect_certified<float>(false, 0, 10);
  expect_certified<double>(false, 0, 100);
}
TEST(ShapeCertificates, hold_around_local_origins) {
  expect_certified<float>(true, 1000, 10);
  expect_certified<double>(true, 0, 1e4);
}
TEST(ShapeCertificates, hold_far_from_the_origin) { expect_certified<float>(false, 1e5, 4); }

/// Points as large as float holds them, and somewhat smaller ones.
TEST(ShapeCertificates, are_infinite_where_sums_may_overflow) {
  std::size_t infinite = 0;
  std::size_t finite = 0;
  for (const int n : {1, 3, 4, 7, 15}) {
    for (const ShapeCase& c : {ShapeCase{n, n, 1}, ShapeCase{n, 3, 1, Weights::cartesian}}) {
      for (int octaves = 0; octaves < 40; octaves += 2) {
        RandomNets<float> nets(c, 1, 1);
        fill(nets, c, Family::signs, 0, 4, static_cast<std::uint64_t>(n));
        for (std::size_t k = 0; k < nets.values.size(); ++k) {
          if (c.weights == Weights::none || (k + 1) % c.channels() != 0) {
            nets.values[k] *= std::ldexp(std::numeric_limits<float>::max(), -octaves);
          }
        }
        PatchSet<float> set;
        if (!pack(nets.view, set)) {
          continue; // coefficients overflow
        }
        const double bound = error_bounds(set, 0, available_isas().front()).du[0];
        ++(std::isinf(bound) ? infinite : finite);
        for (const double worst : CertificateCheck<float>(c, nets, {}).worst(7)) {
          EXPECT_LE(worst, 1) << c << " octaves " << octaves;
        }
      }
    }
  }
  EXPECT_GT(infinite, 10U);
  EXPECT_GT(finite, 10U);
}

/// What has no certificate: components that are not there, and patches outside of the set.
TEST(ShapeCertificates, components_that_are_not_there_have_none) {
  const RandomNets<float> nets({4, 6, 5, Weights::cartesian}, 2, 3);
  PatchSet<float> set;
  ASSERT_TRUE(pack(nets.view, set));
  const ErrorBounds bounds = error_bounds(set, 1);
  for (int c = 0; c < kMostComponents; ++c) {
    EXPECT_EQ(bounds.position[c] > 0, c < 5) << c;
    EXPECT_EQ(bounds.du[c] > 0, c < 5) << c;
    EXPECT_EQ(bounds.dv[c] > 0, c < 5) << c;
  }
  EXPECT_EQ(error_bounds(set, 2).position[0], 0);
  const double most = *std::max_element(std::begin(bounds.position), std::end(bounds.position));
  EXPECT_GE(largest_position_bound(set), most);
}

TEST(ShapeCertificates, mixed_sets_find_every_patch) {
  const RandomNets<float> first({3, 3}, 2, 1);
  const RandomNets<float> second({5, 2, 3, Weights::homogeneous}, 2, 2);
  const std::vector<ControlNets<float>> nets{first.view, second.view};
  PatchSet<float> mixed;
  PatchSet<float> alone;
  ASSERT_TRUE(pack(std::span<const ControlNets<float>>(nets), mixed));
  ASSERT_TRUE(pack(second.view, alone));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(error_bounds(mixed, 3).position[c], error_bounds(alone, 1).position[c]);
    EXPECT_EQ(error_bounds(mixed, 3).dv[c], error_bounds(alone, 1).dv[c]);
  }
}

} // namespace
} // namespace simdbezier::tests::shape_certificates_test
