// Shared edges so small that their even parts underflow: every placement and a curve give the same
// bits, the signs of zeros included (docs/accuracy.md, "Zeros on edges that underflow").
//
// An edge's even part is then below the smallest denormal and rounds to -0 in the FMA class. Where
// the odd part vanishes, too, nothing but the constant of the packed edge decides about the sign.
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/curves/curve_results.hpp"
#include "tests/properties/watertight/shaped_edges.hpp"
#include "tests/support/evaluation.hpp"

namespace simdbezier::tests::underflow_edges_test {
namespace {

constexpr std::size_t kGridSizes[] = {3, 5, 9, 17, 24};

/// What an edge's control values are, in units that shrink from case to case.
struct TinyEdge {
  const char* name;
  std::vector<double> values;
};

/// Their constant coefficients are zero, and all of their even parts are negative near the middle.
[[nodiscard]] std::vector<TinyEdge> tiny_edges() {
  return {{"cubic", {-3, 1, 1, -3}},
          {"cubic, more bits", {-39, 13, 13, -39}},
          // 98 A + 90 B = 0 makes c1 + c3 X^2 vanish at X = 1/8, far from where E does.
          {"cubic whose odd part has a zero",
           {-45 * 512. - 3, 49 * 512. + 1, -49 * 512. + 1, 45 * 512. - 3}},
          {"quartic", {-11, 2, 1, 2, -11}},
          {"quartic, fourth power alone", {-1, 1, -1, 1, -1}},
          {"quintic", {-25, 1, 2, 2, 1, -25}},
          {"quintic, fourth power alone", {-5, 3, -1, -1, 3, -5}}};
}

/// The control values of an edge as they are; none of them is rounded.
template <typename T>
[[nodiscard]] std::vector<double> scaled_values(const TinyEdge& edge, int exponent) {
  std::vector<double> values;
  for (const double value : edge.values) {
    values.push_back(std::ldexp(value, exponent));
    EXPECT_EQ(static_cast<double>(static_cast<T>(values.back())), values.back()) << edge.name;
  }
  return values;
}

class UnderflowTest : public CurveTest {
protected:
  /// One patch in each placement; all other points are random.
  [[nodiscard]] static std::vector<Net> placed(const std::vector<double>& values, EdgeForm form,
                                               Random& random) {
    ShapedEdge edge;
    for (std::size_t k = 0; k < values.size(); ++k) {
      edge.points.push_back({values[k], -values[k], 2 * values[k]});
      if (form != EdgeForm::polynomial) {
        edge.weights.push_back(k == 0 || k + 1 == values.size() ? 1 : 2);
      }
    }
    const ShapedEdgeRule rule{static_cast<int>(values.size()) - 1, EdgeKind::plain, form, 4};
    std::vector<Net> nets;
    for (int k = 0; k < kPlacements; ++k) {
      const int across = k % 2 == 0 ? rule.degree : random.integer(1, 8);
      nets.push_back(shaped_net_around(edge, placement(k), across, rule, random));
      if (k < kPlacements / 2) {
        leave_the_edge(nets.back());
      }
    }
    return nets;
  }

  /// All other points become zero, so that nothing else counts in the certificate.
  static void leave_the_edge(Net& net) {
    for (Vector3& point : net.points) {
      for (double& value : point) {
        value = std::abs(value) > 1e-9 ? 0 : value;
      }
    }
  }

  template <typename T>
  void expect_equal_bits(const TinyEdge& edge, int exponent, EdgeForm form, bool origins) {
    Random random(static_cast<std::uint64_t>(exponent + 2000));
    const std::vector<double> values = scaled_values<T>(edge, exponent);
    const std::vector<Net> nets = placed(values, form, random);
    const PatchSet<T> set = packed_mixed<T>(nets, {.local_origin = origins});
    for (const std::size_t n : kGridSizes) {
      Planes<T> planes(nets.size() * n * n, {true, n % 2 == 0, false, false});
      grid(set, Grid<T>::uniform(n, n), planes.outputs());
      const auto at = [&](std::size_t p, std::size_t t) {
        return planes.vector(0, p * n * n + side_sample(placement(static_cast<int>(p)), t, n, n));
      };
      std::size_t different = 0;
      for (std::size_t t = 0; t < n; ++t) {
        for (std::size_t p = 1; p < nets.size(); ++p) {
          for (std::size_t c = 0; c < 3; ++c) {
            different += same_bits(at(p, t)[c], at(0, t)[c]) ? 0 : 1;
          }
        }
      }
      EXPECT_EQ(different, 0U) << edge.name << " times 2^" << exponent << ", form "
                               << static_cast<int>(form) << ", " << n << " samples";
      if (form == EdgeForm::polynomial && !origins) {
        expect_curve<T>(values, n, at, edge.name);
        expect_certified<T>(set, values, n, at, edge.name);
      }
    }
  }

  /// A curve with the edge's control points, both ways.
  template <typename T, typename At>
  void expect_curve(const std::vector<double>& values, std::size_t n, const At& at,
                    const char* name) {
    CurveBatch<T> batch{1, static_cast<int>(values.size()) - 1, 3, Weights::none, {}};
    for (const double value : values) {
      batch.points.insert(batch.points.end(), {static_cast<T>(value), static_cast<T>(-value),
                                               static_cast<T>(2 * value)});
    }
    CurveResults<T> forward(n, 3);
    CurveResults<T> backward(n, 3);
    evaluate(packed<T>(batch), CurveGrid<T>::uniform(n), forward.outputs());
    evaluate(packed<T>(batch.reversed()), CurveGrid<T>::uniform(n), backward.outputs());
    for (std::size_t t = 0; t < n; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_TRUE(same_bits(forward.at(0, c, t), at(0, t)[c])) << name << ", sample " << t;
        EXPECT_TRUE(same_bits(backward.at(0, c, n - 1 - t), at(0, t)[c])) << name << " reversed";
      }
    }
  }

  /// The first patch has no points but the edge's: its certificate still holds although the edge's
  /// constant was replaced by a denormal.
  template <typename T, typename At>
  void expect_certified(const PatchSet<T>& set, const std::vector<double>& values, std::size_t n,
                        const At& at, const char* name) {
    const ErrorBounds bounds = error_bounds(set, 0, isa());
    for (std::size_t t = 0; t < n; ++t) {
      std::vector<long double> b(values.begin(), values.end());
      const long double u = static_cast<long double>(t) / static_cast<long double>(n - 1);
      for (std::size_t level = b.size() - 1; level > 0; --level) {
        for (std::size_t i = 0; i < level; ++i) {
          b[i] = (1 - u) * b[i] + u * b[i + 1];
        }
      }
      const auto error = std::abs(static_cast<double>(at(0, t)[0] - b[0]));
      const double parameter = std::numeric_limits<T>::epsilon() * 8 * std::abs(values[0]);
      EXPECT_LE(error, bounds.position[0] + parameter) << name << ", sample " << t << " of " << n;
    }
  }

  template <typename T>
  void run_all(std::initializer_list<int> exponents) {
    for (const TinyEdge& edge : tiny_edges()) {
      for (const int exponent : exponents) {
        expect_equal_bits<T>(edge, exponent, EdgeForm::polynomial, false);
        expect_equal_bits<T>(edge, exponent, EdgeForm::polynomial, true);
        expect_equal_bits<T>(edge, exponent, EdgeForm::homogeneous, false);
      }
    }
  }
};

TEST_P(UnderflowTest, SharedEdgesFloat) { run_all<float>({-100, -125, -143, -146, -149}); }
TEST_P(UnderflowTest, SharedEdgesDouble) { run_all<double>({-960, -1020, -1068, -1071, -1074}); }

INSTANTIATE_FOR_EVERY_ISA(UnderflowTest);

} // namespace
} // namespace simdbezier::tests::underflow_edges_test
