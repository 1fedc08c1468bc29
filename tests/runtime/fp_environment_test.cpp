// The caller's rounding mode and flush-to-zero neither change the bits nor get lost.
#include <array>
#include <bit>
#include <cfenv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/environment.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::fp_environment_test {
namespace {

/// Nets whose coefficients and results are partly subnormal, beside ordinary ones.
template <typename T>
[[nodiscard]] std::vector<Net> delicate_nets() {
  std::vector<Net> nets = mixed_nets(16);
  const double tiny = sizeof(T) == 4 ? 0x1p-128 : 0x1p-1024;
  for (std::size_t k = 0; k < nets.size(); k += 2) {
    nets[k] = rounded_to<T>(scaled_by(nets[k], {tiny, tiny, tiny}));
  }
  return nets;
}

class EnvironmentTest : public IsaTest {
protected:
  template <typename T>
  void expect_independent_grids() {
    const std::vector<Net> nets = delicate_nets<T>();
    const std::vector<T> points = packed_points<T>(nets);
    const PatchSet<T> set = packed<T>(nets);
    const Grid<T> samples = Grid<T>::uniform(17, 9);
    Planes<T> reference(nets.size() * 17 * 9);
    grid(set, samples, reference.outputs(), {.threads = 1});
    for (const EnvironmentCase& test : kEnvironments) {
      for (const int threads : {1, 2}) {
        Planes<T> planes(reference.count());
        Planes<T> repacked(reference.count());
        bool untouched = false;
        {
          const ScopedEnvironment environment(test.rounding, test.flush);
          grid(set, samples, planes.outputs(), {.threads = threads});
          PatchSet<T> again;
          const Report report = pack(ControlNets<T>{points.data(), nets.size()}, again);
          grid(again, samples, repacked.outputs(), {.threads = threads});
          untouched = environment.untouched() && report.status == Status::ok;
        }
        EXPECT_TRUE(untouched) << test.name << ": the caller's environment was not restored";
        EXPECT_EQ(differing_values(planes, reference), 0u)
            << test.name << ", evaluate (grid), " << threads << " threads";
        EXPECT_EQ(differing_values(repacked, reference), 0u) << test.name << ", pack";
      }
    }
  }

  template <typename T>
  void expect_independent_samples() {
    const std::vector<Net> nets = delicate_nets<T>();
    const PatchSet<T> set = packed<T>(nets);
    const SampleArrays<T> samples = random_samples<T>(nets.size(), 5000);
    for (const Parameters parameters : {Parameters::centred, Parameters::unit}) {
      Planes<T> reference(samples.patch.size());
      scattered(set, samples.view(parameters), reference.outputs(), {.threads = 1});
      for (const EnvironmentCase& test : kEnvironments) {
        for (const int threads : {1, 2}) {
          Planes<T> planes(reference.count());
          bool untouched = false;
          {
            const ScopedEnvironment environment(test.rounding, test.flush);
            scattered(set, samples.view(parameters), planes.outputs(), {.threads = threads});
            untouched = environment.untouched();
          }
          EXPECT_TRUE(untouched) << test.name << ": the caller's environment was not restored";
          EXPECT_EQ(differing_values(planes, reference), 0u)
              << test.name << ", evaluate (scattered), " << threads << " threads";
        }
      }
    }
  }
};

TEST_P(EnvironmentTest, GridFloat) { expect_independent_grids<float>(); }
TEST_P(EnvironmentTest, GridDouble) { expect_independent_grids<double>(); }
TEST_P(EnvironmentTest, ScatteredFloat) { expect_independent_samples<float>(); }
TEST_P(EnvironmentTest, ScatteredDouble) { expect_independent_samples<double>(); }
INSTANTIATE_FOR_EVERY_ISA(EnvironmentTest);

/// What is computed outside of the loops over patches.
TEST(EnvironmentOfSmallFunctions, IsTheLibrarys) {
  const std::vector<Net> nets = delicate_nets<double>();
  const PatchSet<double> set = packed<double>(nets);
  std::vector<double> points = packed_points<double>(nets);
  std::vector<float> weighted(64, 1.0F);
  weighted[4 * 3 + 3] = 0x1p-140F; // a weight that is no fault, before a value that is one
  weighted[4 * 10] = std::numeric_limits<float>::quiet_NaN();
  const auto faulty = ControlNets<float>::packed(weighted.data(), 1, 3, 3, 3, Weights::cartesian);
  std::vector<float> reversed(weighted.size());
  const auto results = [&] {
    std::vector<double> all;
    for (int k = 0; k < 1000; ++k) {
      all.push_back(static_cast<double>(to_centred<float>(k / 999.0)));
    }
    all.push_back(largest_position_bound(set));
    const auto to = MutableNets<float>::packed(reversed.data(), 1, 3, 3, 3, Weights::cartesian);
    const Report report = reverse_u(faulty, to);
    all.push_back(report.status == Status::non_finite_input ? 1 : 0);
    all.push_back(static_cast<double>(report.point));
    return all;
  };
  const std::vector<double> expected = results();
  for (const EnvironmentCase& test : kEnvironments) {
    std::vector<double> found;
    {
      const ScopedEnvironment environment(test.rounding, test.flush);
      found = results();
    }
    EXPECT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(found[k]), std::bit_cast<std::uint64_t>(expected[k]))
          << test.name << ", " << k;
    }
  }
}

/// Calls of most kinds, on a set of delicate nets, or on curves: their first rows.
class ManyCalls {
  using Points = std::vector<std::array<float, 3>>;

public:
  explicit ManyCalls(int threads) : options_{.threads = threads} {
    const std::vector<Net> nets = delicate_nets<float>();
    set_ = packed<float>(nets);
    const std::vector<float> points = packed_points<float>(nets);
    auto rows = ControlCurves<float>::packed(points.data(), nets.size(), 3);
    rows.curve_stride = 48;
    EXPECT_EQ(pack(rows, curves_).status, Status::ok);
  }

  /// Calls f(name, values) for each.
  template <typename F>
  void run(const F& f) const {
    f("square", surface(Grid<float>::uniform(17, 17)));
    f("more than a plan holds", surface(Grid<float>::uniform(150, 150)));
    const float u[] = {0.0F, 0.1F, 0.7F, 1.0F};
    f("given parameters", surface(Grid<float>::at(u, u)));
    const std::vector<std::uint32_t> counts(set_.size(), 7);
    f("a grid each", surface(PatchGrids{counts, counts}));
    f("derivatives", derivatives());
    f("tiles", tiles());
    f("curves", curves(CurveGrid<float>::uniform(17), 17 * curves_.size()));
    f("a row each", curves(CurveGrids{counts}, 7 * curves_.size()));
    std::vector<std::uint32_t> order(set_.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::vector<float> t(order.size(), 0.3F);
    f("samples", surface(Samples<float>{order, t, t}));
    f("samples of curves", curves(CurveSamples<float>{order, t}, order.size()));
  }

private:
  template <typename Where>
  [[nodiscard]] Points surface(const Where& where) const {
    return evaluate(set_, where, {Output::position}, options_).position;
  }
  template <typename Where>
  [[nodiscard]] Points curves(const Where& where, std::size_t count) const {
    Points points(count);
    CurveOutputs<float> out;
    out.position = Vectors<float>::xyz(points);
    EXPECT_EQ(evaluate(curves_, where, out, options_), Status::ok);
    return points;
  }
  [[nodiscard]] Points derivatives() const {
    Points points(set_.size() * 81);
    const PartialDerivative<float> third[] = {{2, 1, Vectors<float>::xyz(points)}};
    EXPECT_EQ(evaluate_derivatives(set_, Grid<float>::uniform(9, 9), third, options_), Status::ok);
    return points;
  }
  [[nodiscard]] Points tiles() const {
    constexpr std::size_t kSide = 17;
    Points points(set_.size() * kSide * kSide);
    const TileFormat format{.outputs = {Output::position}};
    const auto keep = [&](const Tile<float>& tile) {
      const Vectors<float>& p = tile.out.position;
      const std::size_t first = (tile.first_patch * kSide + tile.first_row) * kSide;
      for (std::size_t k = 0; k < tile.samples; ++k) {
        points[first + k] = {p.x[k], p.y[k], p.z[k]};
      }
    };
    EXPECT_EQ(evaluate_tiles(set_, Grid<float>::uniform(kSide, kSide), format, keep, options_),
              Status::ok);
    return points;
  }

  Options options_;
  PatchSet<float> set_;
  CurveSet<float> curves_;
};

TEST(EnvironmentOfManyCalls, IsTheLibrarys) {
  std::vector<std::vector<std::array<float, 3>>> expected;
  ManyCalls(1).run([&](const char*, const auto& values) { expected.push_back(values); });
  for (const int threads : {1, 3}) {
    const ManyCalls calls(threads);
    for (const EnvironmentCase& test : kEnvironments) {
      std::size_t k = 0;
      const ScopedEnvironment environment(test.rounding, test.flush);
      std::feclearexcept(FE_ALL_EXCEPT);
      calls.run([&](const char* name, const auto& values) {
        EXPECT_TRUE(environment.untouched()) << test.name << ", " << name;
        EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), 0) << test.name << ", " << name;
        const bool same =
            values.size() == expected[k].size() &&
            std::memcmp(values.data(), expected[k].data(), values.size() * sizeof(values[0])) == 0;
        EXPECT_TRUE(same && !values.empty()) << test.name << ", " << name;
        ++k;
      });
    }
  }
}

// The counterproof: the environments really do what their names say, in this thread.
TEST(EnvironmentCounterproof, ModesTakeEffect) {
  volatile float one = 1;
  volatile float small = 0x1p-30f;
  volatile float subnormal = 0x1p-130f;
  {
    const ScopedEnvironment environment(FE_UPWARD, false);
    EXPECT_GT(one + small, 1.0f);
  }
  if (flush_bits() != 0) {
    const ScopedEnvironment environment(FE_TONEAREST, true);
    EXPECT_EQ(subnormal * one, 0.0f);
  }
  EXPECT_EQ(one + small, 1.0f);
  EXPECT_NE(subnormal * one, 0.0f);
}

} // namespace
} // namespace simdbezier::tests::fp_environment_test
