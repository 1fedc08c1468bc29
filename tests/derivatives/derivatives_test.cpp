// Derivatives of any order: against an exact oracle, and against the calls for low orders.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/derivatives/derivative_calls.hpp"
#include "tests/derivatives/derivative_oracle.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::derivatives_test {
namespace {

// Accuracy ---------------------------------------------------------------------------------------

/// A shape, and the component that comes out first.
struct AccuracyCase {
  ShapeCase shape;
  int first_component = 0;
};

const AccuracyCase kAccuracyCases[] = {
    {{1, 1}},
    {{2, 1, 2}},
    {{3, 3}},
    {{5, 4, 4}, 2},
    {{5, 5}},
    {{6, 3, 1}},
    {{4, 7}},
    {{9, 12, 2}},
    {{15, 15}},
    {{1, 1, 3, Weights::homogeneous}},
    {{2, 2, 3, Weights::cartesian}},
    {{3, 3, 3, Weights::homogeneous}},
    {{1, 6, 2, Weights::cartesian}},
    {{7, 5, 4, Weights::cartesian}, 1},
    {{10, 8, 1, Weights::homogeneous}},
};

/// The largest error of a shape, in units of the unit roundoff times DerivativeOracle::size: of
/// random nets, about 1.5 times what was measured.
double allowed(const ShapeCase& c) {
  return ((c.degree_u + c.degree_v) / 2.0 + 4) * (c.weights == Weights::none ? 1 : 2);
}

constexpr std::size_t kAccuracyPatches = 2;

/// Edges, corners, the middle, where cells meet, and the inside; exact in both formats.
SampleList<double> accuracy_samples() {
  SampleList<double> list;
  for (std::size_t patch = 0; patch < kAccuracyPatches; ++patch) {
    for (const auto& [x, y] : {std::pair{-1.0, 1.0},
                               {0.5, -1.0},
                               {1.0, 0.3125},
                               {0.0, 0.0},
                               {0.0, -0.71875},
                               {0.65625, 1.0},
                               {-0.59375, 0.234375},
                               {0.890625, -0.9375},
                               {-0.0625, -0.078125}}) {
      list.add(patch, x, y);
    }
  }
  return list;
}

class DerivativeAccuracy : public DerivativeTest {
protected:
  /// Checks both types on the same control values, which are floats.
  template <typename T>
  void check(const AccuracyCase& c, const std::vector<std::vector<DerivativeOracle>>& oracle,
             int most_u, int most_v, const RandomNets<float>& nets) {
    const std::vector<T> values(nets.values.begin(), nets.values.end());
    PatchSet<T> set;
    ASSERT_TRUE(pack(ControlNets<T>::packed(values.data(), kAccuracyPatches, c.shape.degree_u,
                                            c.shape.degree_v, c.shape.components, c.shape.weights),
                     set));
    const SampleList<double> exact = accuracy_samples();
    const SampleList<T> samples{
        exact.patch, {exact.u.begin(), exact.u.end()}, {exact.v.begin(), exact.v.end()}};
    const std::vector<OrderPair> orders = orders_up_to(most_u, most_v);
    DerivativeBuffers<T> out(orders, exact.patch.size(), oracle.front().size());
    CallOptions options;
    options.first_component = c.first_component;
    derivatives(set, samples.view(), out.list(), options);

    constexpr double kUnit = std::numeric_limits<T>::epsilon() / 2;
    for (std::size_t d = 0; d < orders.size(); ++d) {
      const auto a = static_cast<std::size_t>(orders[d].first);
      const auto b = static_cast<std::size_t>(orders[d].second);
      for (std::size_t k = 0; k < exact.patch.size(); ++k) {
        for (std::size_t i = 0; i < out.dimension; ++i) {
          const DerivativeOracle& o = oracle[k][i];
          const DoubleDouble found = static_cast<double>(out.values[d][k * out.dimension + i]);
          if (o.size[a][b] > static_cast<double>(std::numeric_limits<T>::max())) {
            continue; // a high order of a quotient, on its way to infinity
          }
          const double error = abs(found - o.value[a][b]).to_double();
          ASSERT_LE(error, allowed(c.shape) * kUnit * o.size[a][b])
              << name_of(c.shape) << ", order " << a << "," << b << ", sample " << k
              << ", component " << i << ": " << found.hi << " for " << o.value[a][b].hi;
        }
      }
    }
  }
};

/// Orders above the degree included, which polynomials do not have.
TEST_P(DerivativeAccuracy, every_order_up_to_the_degree_and_above) {
  for (const AccuracyCase& c : kAccuracyCases) {
    const int most_u = std::min(c.shape.degree_u + 1, kMostDerivativeOrder);
    const int most_v = std::min(c.shape.degree_v + 2, kMostDerivativeOrder);
    const RandomNets<float> nets(c.shape, kAccuracyPatches, 42);
    const auto dimension =
        static_cast<std::size_t>(std::min(c.shape.components - c.first_component, 3));
    const SampleList<double> samples = accuracy_samples();
    std::vector<std::vector<DerivativeOracle>> oracle(samples.patch.size());
    for (std::size_t k = 0; k < oracle.size(); ++k) {
      for (std::size_t i = 0; i < dimension; ++i) {
        oracle[k].push_back(exact_derivatives(nets.values, c.shape, samples.patch[k],
                                              static_cast<std::size_t>(c.first_component) + i,
                                              most_u, most_v, samples.u[k], samples.v[k]));
      }
    }
    check<float>(c, oracle, most_u, most_v, nets);
    check<double>(c, oracle, most_u, most_v, nets);
  }
}
INSTANTIATE_FOR_EVERY_ISA(DerivativeAccuracy);

// Bits of the calls for low orders ---------------------------------------------------------------

/// Runs of every length, edges, corners, seams, extrapolation.
template <typename T>
SampleList<T> mixed_samples(std::size_t patches, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  SampleList<T> list;
  list.parameters = Parameters::unit;
  const auto parameter = [&] {
    constexpr double kSpecial[] = {0, 1, 0.5, 1.125};
    const std::uint64_t kind = random.below(8);
    return kind < 4 ? kSpecial[kind] : random.unit();
  };
  while (list.patch.size() < count) {
    const std::size_t patch = random.below(patches);
    for (std::uint64_t run = random.below(40) + 1; run > 0; --run) {
      const double u = parameter();
      list.add(patch, u, parameter());
    }
  }
  return list;
}

struct BitsCase {
  const char* name;
  bool watertight;
  bool local_origins;
};
const BitsCase kBitsCases[] = {
    {"watertight", true, false}, {"open", false, false}, {"local origins", true, true}};

class DerivativeBits : public DerivativeTest {
protected:
  template <typename T>
  void same_as_scattered(const ShapeCase& shape, const BitsCase& c) {
    constexpr std::size_t kPatches = 5;
    const RandomNets<T> nets(shape, kPatches, 7);
    PackOptions packing;
    packing.local_origin = c.local_origins;
    PatchSet<T> set;
    ASSERT_TRUE(pack(nets.view, set, packing));
    const SampleList<T> samples = mixed_samples<T>(kPatches, 700, 3);
    const std::size_t count = samples.patch.size();
    const auto dimension = static_cast<std::size_t>(std::min(shape.components, 3));
    // Second ones of rational patches are sums in another order.
    std::vector<OrderPair> orders = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    if (shape.weights == Weights::none) {
      orders.insert(orders.end(), {{2, 0}, {0, 2}});
    }
    DerivativeBuffers<T> found(orders, count, dimension);
    DerivativeBuffers<T> expected({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}}, count,
                                  dimension);
    Outputs<T> out;
    Vectors<T>* const groups[] = {&out.position, &out.du, &out.dv, &out.duv, &out.duu, &out.dvv};
    for (std::size_t g = 0; g < std::size(groups); ++g) {
      *groups[g] = expected.requests[g].out;
    }
    CallOptions options;
    options.watertight = c.watertight;
    options.threads = 1; // many small calls
    scattered(set, samples.view(), out, options);
    derivatives(set, samples.view(), found.list(), options);
    for (std::size_t d = 0; d < orders.size(); ++d) {
      EXPECT_EQ(std::memcmp(found.values[d].data(), expected.values[d].data(),
                            count * dimension * sizeof(T)),
                0)
          << name_of(shape) << ", " << c.name << ", order " << orders[d].first << ","
          << orders[d].second;
    }
  }
};

TEST_P(DerivativeBits, low_orders_are_those_of_scattered_samples) {
  for (const ShapeCase& shape : all_shapes()) {
    for (const BitsCase& c : kBitsCases) {
      same_as_scattered<float>(shape, c);
      same_as_scattered<double>(shape, c);
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(DerivativeBits);

// Edges ------------------------------------------------------------------------------------------

class DerivativeEdges : public DerivativeTest {
protected:
  /// The edge u = 1 of one patch is the edge v = 0 of another, in the opposite direction.
  template <typename T>
  void check(int degree, Weights weights) {
    const ShapeCase a_shape{2, degree, 3, weights};
    const ShapeCase b_shape{degree, 4, 3, weights};
    RandomNets<T> a(a_shape, 1, 5);
    RandomNets<T> b(b_shape, 1, 6);
    const auto n = static_cast<std::size_t>(degree);
    const std::size_t channels = a_shape.channels();
    for (std::size_t k = 0; k <= n; ++k) {
      std::copy_n(&a.values[(k * 3 + 2) * channels], channels, &b.values[(n - k) * channels]);
    }
    PatchSet<T> a_set;
    PatchSet<T> b_set;
    ASSERT_TRUE(pack(a.view, a_set));
    ASSERT_TRUE(pack(b.view, b_set));
    SampleList<T> on_a;
    SampleList<T> on_b;
    for (int k = -9; k <= 9; ++k) {
      on_a.add(0, 1, k / 9.0);
      on_b.add(0, -k / 9.0, -1);
    }
    const std::size_t count = on_a.patch.size();
    std::vector<OrderPair> along_v;
    std::vector<OrderPair> along_u;
    for (int d = 0; d <= degree; ++d) {
      along_v.emplace_back(0, d);
      along_u.emplace_back(d, 0);
    }
    DerivativeBuffers<T> of_a(along_v, count, 3);
    DerivativeBuffers<T> of_b(along_u, count, 3);
    derivatives(a_set, on_a.view(), of_a.list());
    derivatives(b_set, on_b.view(), of_b.list());
    for (std::size_t d = 0; d <= n; ++d) {
      for (std::size_t k = 0; k < 3 * count; ++k) {
        if (degree >= 6 && k / 3 == count / 2) {
          continue; // the middle belongs to one of two cells, each with derivatives of its own
        }
        ASSERT_EQ(of_a.values[d][k], (d % 2 == 0 ? 1 : -1) * of_b.values[d][k])
            << "degree " << degree << ", order " << d << ", value " << k;
      }
    }
  }
};

TEST_P(DerivativeEdges, both_sides_agree_on_what_runs_along_the_edge) {
  for (const int degree : {1, 2, 3, 5, 6, 11, 15}) {
    for (const Weights weights : {Weights::none, Weights::homogeneous}) {
      check<float>(degree, weights);
      check<double>(degree, weights);
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(DerivativeEdges);

} // namespace
} // namespace simdbezier::tests::derivatives_test
