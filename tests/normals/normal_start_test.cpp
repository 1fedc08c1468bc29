// Doubtful normals that kernels decide by the leading coefficient alone (kernels/poly/
// normal_start.hpp), against the whole series: equal bits and statuses.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/normals/fallback_surface.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::normal_start_test {
namespace {

/// Puts control points into the place of others: (j, i) into where a rule says so.
struct Shape {
  const char* name;
  void (*change)(Surface&);
};

void merge_row(Surface& s, int j, int from) {
  for (int i = 0; i <= s.shape.degree_u; ++i) {
    s.at(j, i) = s.at(from, 0);
  }
}
void merge_column(Surface& s, int i, int from) {
  for (int j = 0; j <= s.shape.degree_v; ++j) {
    s.at(j, i) = s.at(0, from);
  }
}

constexpr Shape kShapes[] = {
    {"random", [](Surface&) {}},
    {"v = 0 is a point", [](Surface& s) { merge_row(s, 0, 0); }},
    {"v = 1 is a point", [](Surface& s) { merge_row(s, s.shape.degree_v, s.shape.degree_v); }},
    {"u = 0 is a point", [](Surface& s) { merge_column(s, 0, 0); }},
    {"u = 1 is a point", [](Surface& s) { merge_column(s, s.shape.degree_u, s.shape.degree_u); }},
    {"v = 0 and the next row are points",
     [](Surface& s) {
       merge_row(s, 0, 0);
       merge_row(s, 1, 1);
     }},
    {"u = 1 and the column before it are one point",
     [](Surface& s) {
       merge_column(s, s.shape.degree_u, s.shape.degree_u);
       merge_column(s, s.shape.degree_u - 1, s.shape.degree_u);
     }},
    {"v = 0 without a slope across",
     [](Surface& s) {
       for (int i = 0; i <= s.shape.degree_u; ++i) {
         s.at(1, i) = s.at(0, i);
       }
     }},
    {"three points of a corner are one", [](Surface& s) { s.at(0, 1) = s.at(1, 0) = s.at(0, 0); }},
    {"two points of the last corner are one",
     [](Surface& s) {
       s.at(s.shape.degree_v, s.shape.degree_u - 1) = s.at(s.shape.degree_v, s.shape.degree_u);
     }},
    {"a plane",
     [](Surface& s) {
       for (Point& p : s.points) {
         p[2] = 0;
       }
     }},
    {"nearly a line",
     [](Surface& s) {
       for (Point& p : s.points) {
         p = {p[0], 2 * p[0] + std::ldexp(p[1], -18), std::ldexp(p[2], -17) - p[0]};
       }
     }},
    {"a line", // whose tangents are parallel but for rounding errors
     [](Surface& s) {
       for (Point& p : s.points) {
         int exponent = 0;
         const double digits = std::round(64 * std::frexp(p[0], &exponent));
         p = {std::ldexp(digits, exponent), std::ldexp(3 * digits, exponent),
              std::ldexp(5 * digits, exponent)};
       }
     }},
};

class NormalStartTest : public IsaTest {
protected:
  /// scale: a power of two by which products leave the range in which kernels have a quick test, so
  /// that every sample takes the second look.
  template <typename T>
  void expect_bits_of_the_series(int scale) {
    int statuses[4] = {0, 0, 0, 0};
    Random random(17);
    for (const Shape& shape : kShapes) {
      for (const auto& [degree_u, degree_v] : {std::pair{3, 3}, {3, 3}, {2, 4}, {5, 3}, {7, 2}}) {
        Surface surface(degree_u, degree_v, false);
        for (Point& p : surface.points) {
          p = {std::ldexp(random.symmetric(), scale), std::ldexp(random.symmetric(), scale),
               std::ldexp(random.symmetric(), scale)};
        }
        shape.change(surface);
        expect_bits_of_the_series<T>(surface, random, shape.name, statuses);
      }
    }
    EXPECT_GT(statuses[static_cast<int>(SampleStatus::regular)], 4000);
    EXPECT_GT(statuses[static_cast<int>(SampleStatus::limit)], 400);
  }

  template <typename T>
  void expect_bits_of_the_series(const Surface& surface, Random& random, const char* name,
                                 int* statuses) {
    constexpr double kPlaces[] = {0, 0, 1, 1, 0.5, 0x1p-20, 1 - 0x1p-20, -0.125};
    constexpr std::size_t kSamples = 101;
    const std::vector<std::uint32_t> patch(kSamples, 0);
    std::vector<T> u(kSamples);
    std::vector<T> v(kSamples);
    for (std::size_t k = 0; k < kSamples; ++k) {
      u[k] = static_cast<T>(k % 3 == 0 ? random.unit() : kPlaces[random.below(8)]);
      v[k] = static_cast<T>(k % 3 == 1 ? random.unit() : kPlaces[random.below(8)]);
    }
    const std::vector<T> values = control_values<T>(surface);
    PatchSet<T> set;
    ASSERT_TRUE(pack(
        ControlNets<T>::packed(values.data(), 1, surface.shape.degree_u, surface.shape.degree_v, 3),
        set));
    std::vector<T> normals(3 * kSamples);
    std::vector<SampleStatus> found(kSamples);
    Outputs<T> out;
    out.normal = Vectors<T>::xyz(normals);
    out.status = found;
    scattered(set, Samples<T>{patch, u, v}, out);
    for (std::size_t k = 0; k < kSamples; ++k) {
      const Answer whole = resolve<T>(surface, u[k] - T(0.5), v[k] - T(0.5));
      const std::string where =
          std::string(name) + " at " + std::to_string(u[k]) + ", " + std::to_string(v[k]);
      EXPECT_EQ(found[k], whole.status) << where;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(static_cast<double>(normals[3 * k + c])),
                  std::bit_cast<std::uint64_t>(whole.normal[c]))
            << where;
      }
      ++statuses[static_cast<int>(whole.status)];
    }
  }
};

TEST_P(NormalStartTest, the_start_in_float_has_the_bits_of_the_whole_series) {
  expect_bits_of_the_series<float>(60);
}
TEST_P(NormalStartTest, the_start_in_double_has_the_bits_of_the_whole_series) {
  expect_bits_of_the_series<double>(300);
}
// Differences over a size whose inverse is infinite are infinite or nan, and so is their bound.
TEST_P(NormalStartTest, nothing_is_certain_where_differences_are_infinite) {
  Surface surface(2, 1, false);
  surface.points = {{-4, 1, 4}, {1, -3, -4}, {-4, -1, -4}, {-4, 1, 4}, {1, -3, 3}, {1, 1, 3}};
  for (Point& p : surface.points) {
    p = {std::ldexp(p[0], -1045), std::ldexp(p[1], -1045), std::ldexp(p[2], -1045)};
  }
  Random random(17);
  int statuses[4] = {0, 0, 0, 0};
  expect_bits_of_the_series<double>(surface, random, "denormals", statuses);
  EXPECT_GT(statuses[static_cast<int>(SampleStatus::limit)], 10);
}
INSTANTIATE_FOR_EVERY_ISA(NormalStartTest);

} // namespace
} // namespace simdbezier::tests::normal_start_test
