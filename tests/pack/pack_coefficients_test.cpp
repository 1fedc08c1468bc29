// Packing: the bits of a set do not depend on instruction set, threads or layout; coefficients of
// floats are the exact ones rounded once; faults are reported lowest first.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "src/storage/patch_storage.hpp"
#include "tests/support/oracle/exact_rational.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::pack_coefficients_test {
namespace {

constexpr std::size_t kNet = detail::kCoefficients;

template <typename T>
std::vector<T> random_points(std::size_t count, double size) {
  Random random(11);
  std::vector<T> points(count * kNet);
  for (T& x : points) {
    x = static_cast<T>(size * random.symmetric());
  }
  return points;
}

template <typename T>
void expect_same(const PatchSet<T>& a, const PatchSet<T>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  const detail::PatchStorage<T>& s = a.storage()->buckets[0];
  const detail::PatchStorage<T>& t = b.storage()->buckets[0];
  const auto same = [&](const T* x, const T* y, std::size_t n) {
    return (x == nullptr && y == nullptr) || std::memcmp(x, y, a.size() * n * sizeof(T)) == 0;
  };
  EXPECT_TRUE(same(s.coefficients, t.coefficients, kNet)) << what;
  EXPECT_TRUE(same(s.edges, t.edges, detail::kEdgeBlock)) << what;
  EXPECT_EQ(s.given.in_double, t.given.in_double) << what;
  EXPECT_EQ(std::memcmp(s.given.values, t.given.values, a.size() * kNet * s.given.value_bytes()), 0)
      << what;
  EXPECT_TRUE(same(s.origins, t.origins, detail::kOriginBlock)) << what;
  EXPECT_TRUE(same(s.normal_floor, t.normal_floor, 1)) << what;
}

template <typename T, typename S>
void expect_equal_everywhere() {
  for (const std::size_t count : {1U, 7U, 8U, 9U, 35U}) {
    const std::vector<S> points = random_points<S>(count, 1000);
    for (const int kind : {0, 1, 2}) {
      PackOptions options;
      options.local_origin = kind == 1;
      options.relative_to[1] = kind == 2 ? 0.1 : 0;
      options.isa = available_isas().front();
      PatchSet<T> expected;
      ASSERT_TRUE(pack(ControlNets<S>{points.data(), count}, expected, options));
      std::vector<S> planes(points.size()); // last patch first
      for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t patch = k / kNet;
        planes[k % 3 * count * 16 + (count - 1 - patch) * 16 + k % kNet / 3] = points[k];
      }
      ControlNets<S> other{planes.data() + (count - 1) * 16, count};
      other.patch_stride = -16;
      other.row_stride = 4;
      other.point_stride = 1;
      other.component_stride = static_cast<std::ptrdiff_t>(count * 16);
      for (const Isa isa : available_isas()) {
        options.isa = isa;
        for (const int threads : {1, 3}) {
          options.threads = threads;
          PatchSet<T> set;
          ASSERT_TRUE(pack(ControlNets<S>{points.data(), count}, set, options));
          expect_same(expected, set, std::string(to_string(isa)));
          ASSERT_TRUE(pack(other, set, options));
          expect_same(expected, set, std::string(to_string(isa)) + " planes");
        }
      }
    }
  }
}

TEST(PackKernel, bits_do_not_depend_on_instruction_set_threads_or_layout) {
  expect_equal_everywhere<float, float>();
  expect_equal_everywhere<double, double>();
  expect_equal_everywhere<float, double>();
  expect_equal_everywhere<double, float>();
}

/// Rows: powers of X; columns: Bernstein control values.
const Rational kBasis[4][4] = {{Rational(1, 8), Rational(3, 8), Rational(3, 8), Rational(1, 8)},
                               {Rational(-3, 4), Rational(-3, 4), Rational(3, 4), Rational(3, 4)},
                               {Rational(3, 2), Rational(-3, 2), Rational(-3, 2), Rational(3, 2)},
                               {-1, 3, -3, 1}};

/// Largest |C - exact| / (ulp of C), times 2.
template <typename T>
double worst_in_half_ulps(Isa isa) {
  const std::vector<T> points = random_points<T>(9, 1);
  PackOptions options;
  options.isa = isa;
  PatchSet<T> set;
  EXPECT_TRUE(pack(ControlNets<T>{points.data(), 9}, set, options));
  double worst = 0;
  for (std::size_t e = 0; e < 9 * kNet; ++e) {
    const std::size_t c = e % kNet / 16;
    const std::size_t k = e % 16 / 4;
    const std::size_t l = e % 4;
    Rational sum = 0;
    for (std::size_t p = 0; p < 16; ++p) {
      sum += kBasis[k][p % 4] * kBasis[l][p / 4] *
             exact(static_cast<double>(points[e / kNet * kNet + 3 * p + c]));
    }
    const T got = set.storage()->buckets[0].coefficients[e];
    const T ulp =
        std::nextafter(std::fabs(got), std::numeric_limits<T>::infinity()) - std::fabs(got);
    const Rational error = abs(sum - exact(static_cast<double>(got)));
    worst = std::max(worst, Rational(2 * error / exact(static_cast<double>(ulp))).get_d());
  }
  return worst;
}

TEST(PackKernel, coefficients_are_rounded_once) {
  for (const Isa isa : available_isas()) {
    EXPECT_LE(worst_in_half_ulps<float>(isa), 1.0) << to_string(isa);
    EXPECT_LE(worst_in_half_ulps<double>(isa), 1.0 + 0x1p-40) << to_string(isa);
  }
}

TEST(PackKernel, the_lowest_fault_is_reported_and_the_set_kept) {
  for (const Isa isa : available_isas()) {
    for (const int threads : {1, 3}) {
      std::vector<float> points = random_points<float>(50, 1);
      PackOptions options;
      options.isa = isa;
      options.threads = threads;
      PatchSet<float> set;
      ASSERT_TRUE(pack(ControlNets<float>{points.data(), 3}, set, options));
      points[49 * kNet] = points[21 * kNet + 4] = std::numeric_limits<float>::quiet_NaN();
      points[21 * kNet + 47] = std::numeric_limits<float>::infinity();
      points[20 * kNet + 3] = 1e37F; // large, and no fault
      const Report report = pack(ControlNets<float>{points.data(), 50}, set, options);
      EXPECT_EQ(report.status, Status::non_finite_input);
      EXPECT_EQ(report.item, 21U);
      EXPECT_EQ(report.point, 1);
      EXPECT_EQ(report.component, 1);
      EXPECT_EQ(set.size(), 3U);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::pack_coefficients_test
