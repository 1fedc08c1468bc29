// Local origins, relative output and certificates, against the oracle, on every instruction set.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::origins_test {
namespace {

constexpr std::size_t kSamples = 8; // a direction, all uniform, ends included

struct Case {
  const char* name;
  Net (*make)(Random&);
  PackOptions options;
  double most; ///< of |error| / (u max|b|), b as packed; published bounds: 21 (30 without FMA)
};

PackOptions with_local_origin() {
  PackOptions options;
  options.local_origin = true;
  return options;
}

PackOptions relative_to(double x) {
  PackOptions options;
  options.relative_to[0] = options.relative_to[1] = options.relative_to[2] = x;
  return options;
}

// Far away only the last addition rounds at the size of the result: 1/2 u max|P| for it, and as
// much again at the most for what the parameters and residuals leave.
const Case kCases[] = {
    {"plain_wave", [](Random& r) { return wave_net(r); }, {}, 21},
    {"plain_off1e6", [](Random& r) { return offset_net(r, 1e6); }, {}, 21},
    {"local_wave", [](Random& r) { return wave_net(r); }, with_local_origin(), 22},
    {"local_signs", [](Random& r) { return signs_net(r); }, with_local_origin(), 22},
    {"local_off1e3", [](Random& r) { return offset_net(r, 1e3); }, with_local_origin(), 1},
    {"local_off1e6", [](Random& r) { return offset_net(r, 1e6); }, with_local_origin(), 1},
    {"relative_off1e6", [](Random& r) { return offset_net(r, 1e6); }, relative_to(1e6), 21},
};

struct Worst {
  double relative = 0;    ///< |position error| / (u max|b|)
  double certificate = 0; ///< any |error| / its certified bound
};

/// The net that the oracle sees: the doubles that were packed, less the common origin.
Net shifted(const Net& net, const PackOptions& options) {
  return translated(net,
                    {-options.relative_to[0], -options.relative_to[1], -options.relative_to[2]});
}

template <typename T>
class Origins : public IsaTest {
protected:
  void check(const Case& c) {
    Random random(7);
    std::vector<Net> nets;
    for (int i = 0; i < 100; ++i) {
      // Short coordinates where there is a shift, so that the oracle's net is exact in double.
      const Net net = rounded_to<T>(c.make(random));
      nets.push_back(c.options.relative_to[0] != 0 ? rounded_to<float>(net) : net);
    }
    const std::vector<double> points = packed_points<double>(nets);
    PatchSet<T> set;
    ASSERT_TRUE(pack(ControlNets<double>{points.data(), nets.size()}, set, c.options));
    EXPECT_EQ(set.has_local_origins(), c.options.local_origin);
    Planes<T> found(nets.size() * kSamples * kSamples);
    grid(set, Grid<T>::uniform(kSamples, kSamples), found.outputs());
    Worst worst;
    for (std::size_t n = 0; n < nets.size(); ++n) {
      measure(set, n, shifted(nets[n], c.options), found, worst);
    }
    const double most = fuses_multiply_add(isa()) || c.most <= 1 ? c.most : c.most * 32 / 21;
    EXPECT_LE(worst.relative, most) << c.name;
    EXPECT_GT(worst.relative, 0.1) << c.name << ": implausibly exact";
    EXPECT_LE(worst.certificate, 1) << c.name;
    EXPECT_GT(worst.certificate, 0.01) << c.name << ": the certificate says nothing";
  }

private:
  void measure(const PatchSet<T>& set, std::size_t n, const Net& net, const Planes<T>& found,
               Worst& worst) {
    const ErrorBounds bounds = error_bounds(set, n, isa());
    for (std::size_t k = 0; k < kSamples * kSamples; ++k) {
      const auto x = uniform_centred<T>(static_cast<int>(k % kSamples), kSamples - 1);
      const auto y = uniform_centred<T>(static_cast<int>(k / kSamples), kSamples - 1);
      const OracleSample exact = oracle_sample(net, static_cast<double>(x), static_cast<double>(y));
      const std::size_t at = n * kSamples * kSamples + k;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto error = [&](std::size_t group, const Vector3dd& value) {
          const DoubleDouble computed(static_cast<double>(found.at(group, c, at)));
          return std::abs((computed - value[c]).to_double());
        };
        const double position = error(0, exact.position);
        worst.relative =
            std::max(worst.relative, position / (kUnitRoundoff<T> * largest_coordinate(net, c)));
        worst.certificate =
            std::max({worst.certificate, position / bounds.position[c],
                      error(1, exact.du) / bounds.du[c], error(2, exact.dv) / bounds.dv[c]});
      }
    }
  }
};

using OriginsF32 = Origins<float>;
using OriginsF64 = Origins<double>;
INSTANTIATE_FOR_EVERY_ISA(OriginsF32);
INSTANTIATE_FOR_EVERY_ISA(OriginsF64);

TEST_P(OriginsF32, errors_stay_within_bounds_and_certificates) {
  for (const Case& c : kCases) {
    check(c);
  }
}
TEST_P(OriginsF64, errors_stay_within_bounds_and_certificates) {
  for (const Case& c : kCases) {
    check(c);
  }
}

class Certificates : public ::testing::Test {
protected:
  Certificates() {
    Random random(3);
    const std::vector<Net> nets{wave_net(random), offset_net(random, 1e3)};
    set_ = packed<float>(nets);
  }
  PatchSet<float> set_;
};

TEST_F(Certificates, no_fma_costs_more_and_twice_at_most) {
  if (!has_class(false)) {
    GTEST_SKIP() << "every instruction set fuses";
  }
  const ErrorBounds separate = error_bounds(set_, 0, available_isas().front());
  for (const Isa isa : available_isas()) {
    const ErrorBounds bounds = error_bounds(set_, 0, isa);
    for (int c = 0; c < 3; ++c) {
      if (fuses_multiply_add(isa)) {
        EXPECT_LT(bounds.position[c], separate.position[c]);
        EXPECT_GE(2 * bounds.position[c], separate.position[c]);
      } else {
        EXPECT_EQ(bounds.position[c], separate.position[c]);
      }
    }
  }
}

TEST_F(Certificates, tolerance_helper_agrees_with_the_largest_bound) {
  const double largest = largest_position_bound(set_);
  const ErrorBounds far = error_bounds(set_, 1);
  EXPECT_EQ(largest, std::max({far.position[0], far.position[1], far.position[2]}));
  EXPECT_TRUE(meets_tolerance(set_, largest));
  EXPECT_FALSE(meets_tolerance(set_, std::nextafter(largest, 0)));
}

TEST_F(Certificates, of_nothing_and_of_what_cannot_run) {
  EXPECT_EQ(error_bounds(set_, 2).position[0], 0);
  EXPECT_EQ(largest_position_bound(PatchSet<double>{}), 0);
  const Isa absent = absent_isa();
  EXPECT_EQ(error_bounds(set_, 0, absent).dv[2], std::numeric_limits<double>::infinity());
  EXPECT_FALSE(meets_tolerance(set_, 1e30, absent));
}

TEST(PackOptionsTest, an_origin_that_is_not_finite_is_refused) {
  const float points[48] = {};
  PatchSet<float> set;
  const Report report = pack(ControlNets<float>{points, 1}, set,
                             relative_to(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(to_string(report.status), to_string(Status::non_finite_input));
  EXPECT_TRUE(set.empty());
}

} // namespace
} // namespace simdbezier::tests::origins_test
