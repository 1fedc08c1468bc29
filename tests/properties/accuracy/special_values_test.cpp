// Parameters and nets at the edges of what is allowed: corners, extrapolation, scales, NaN, zeros.
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/measure.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::special_values_test {
namespace {

template <typename T>
[[nodiscard]] std::vector<Net> rounded_nets() {
  std::vector<Net> nets = mixed_nets(24);
  for (Net& net : nets) {
    net = rounded_to<T>(net);
  }
  return nets;
}

class SpecialValuesTest : public IsaTest {
protected:
  /// Corners and the ends of the edges, through every call that can reach them.
  template <typename T>
  void expect_exact_corners() {
    const std::vector<Net> nets = rounded_nets<T>();
    const PatchSet<T> set = packed<T>(nets);
    for (const std::size_t n : {2u, 5u, 8u, 9u, 16u, 17u, 33u, 40u}) {
      Planes<T> planes(nets.size() * n * n);
      grid(set, Grid<T>::uniform(n, n), planes.outputs());
      for (std::size_t p = 0; p < nets.size(); ++p) {
        expect_corner(planes, p * n * n, nets[p].at(0, 0));
        expect_corner(planes, p * n * n + n - 1, nets[p].at(0, 3));
        expect_corner(planes, (p + 1) * n * n - n, nets[p].at(3, 0));
        expect_corner(planes, (p + 1) * n * n - 1, nets[p].at(3, 3));
      }
    }
  }

  template <typename T>
  static void expect_corner(const Planes<T>& planes, std::size_t k, const Vector3& point) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(planes.at(0, c, k), static_cast<T>(point[c])) << "sample " << k;
    }
  }

  /// One sample of each kind of parameter that is not finite, between ordinary ones.
  template <typename T>
  void expect_contained_nans() {
    constexpr T kNan = std::numeric_limits<T>::quiet_NaN();
    constexpr T kInf = std::numeric_limits<T>::infinity();
    const std::vector<Net> nets = rounded_nets<T>();
    const PatchSet<T> set = packed<T>(nets);
    SampleArrays<T> clean;
    Random random(3);
    for (std::size_t k = 0; k < 400; ++k) {
      const T x = boundary_centred<T>(random);
      clean.add(k % nets.size(), x, boundary_centred<T>(random));
    }
    SampleArrays<T> spoilt = clean;
    const T bad[] = {kNan, kInf, -kInf};
    for (std::size_t k = 0; k < 400; k += 7) {
      (k % 2 == 0 ? spoilt.u : spoilt.v)[k] = bad[k % 3];
    }
    Planes<T> expected(400);
    Planes<T> found(400);
    scattered(set, clean.view(Parameters::centred), expected.outputs());
    scattered(set, spoilt.view(Parameters::centred), found.outputs());
    for (std::size_t k = 0; k < 400; ++k) {
      expect_sample(found, k, expected, k, k % 7 == 0);
    }
  }

  /// Expects that of a grid with given parameters, where a whole row and a whole column are spoilt.
  template <typename T>
  void expect_contained_nans_on_grids() {
    constexpr T kNan = std::numeric_limits<T>::quiet_NaN();
    constexpr std::size_t kCount = 21;
    const std::vector<Net> nets = rounded_nets<T>();
    const PatchSet<T> set = packed<T>(nets);
    std::vector<T> x;
    for (std::size_t k = 0; k < kCount; ++k) {
      x.push_back(uniform_centred<T>(static_cast<int>(k), static_cast<int>(kCount) - 1));
    }
    std::vector<T> bad_x = x;
    std::vector<T> bad_y = x;
    bad_x[5] = kNan;
    bad_y[7] = std::numeric_limits<T>::infinity();
    const std::size_t samples = kCount * kCount;
    Planes<T> expected(nets.size() * samples);
    Planes<T> found(nets.size() * samples);
    grid(set, Grid<T>{kCount, kCount, x.data(), x.data(), Parameters::centred}, expected.outputs());
    grid(set, Grid<T>{kCount, kCount, bad_x.data(), bad_y.data(), Parameters::centred},
         found.outputs());
    for (std::size_t k = 0; k < found.count(); ++k) {
      const bool bad = k % kCount == 5 || k % samples / kCount == 7;
      expect_sample(found, k, expected, k, bad);
    }
  }

  template <typename T>
  static void expect_sample(const Planes<T>& found, std::size_t k, const Planes<T>& expected,
                            std::size_t other, bool bad) {
    for (std::size_t plane = 0; plane < 12; ++plane) {
      const T value = found.at(plane / 3, plane % 3, k);
      if (bad) {
        EXPECT_TRUE(std::isnan(value)) << "sample " << k << ", plane " << plane;
      } else {
        EXPECT_TRUE(same_bits(value, expected.at(plane / 3, plane % 3, other)))
            << "sample " << k << ", plane " << plane << ": the neighbour of a NaN changed";
      }
    }
    EXPECT_EQ(found.status()[k], bad ? SampleStatus::non_finite : expected.status()[other])
        << "sample " << k;
  }

  /// Scaling a net by a power of two scales positions and tangents exactly and leaves statuses
  /// alone, as long as nothing under- or overflows. Normals may take another path where their
  /// squares would not fit; the family "scaled" judges them.
  template <typename T>
  void expect_scale_invariance(std::initializer_list<int> exponents) {
    const std::vector<Net> nets = rounded_nets<T>();
    const SampleArrays<T> samples = boundary_samples<T>(nets.size());
    Planes<T> plain(samples.patch.size());
    scattered(packed<T>(nets), samples.view(Parameters::centred), plain.outputs());
    for (const int exponent : exponents) {
      const double factor = std::ldexp(1.0, exponent);
      std::vector<Net> scaled_nets;
      for (const Net& net : nets) {
        scaled_nets.push_back(scaled_by(net, {factor, factor, factor}));
      }
      Planes<T> scaled(plain.count());
      scattered(packed<T>(scaled_nets), samples.view(Parameters::centred), scaled.outputs());
      std::size_t different = 0;
      for (std::size_t k = 0; k < plain.count(); ++k) {
        for (std::size_t plane = 0; plane < 9; ++plane) {
          const T expected = std::ldexp(plain.at(plane / 3, plane % 3, k), exponent);
          different += same_bits(scaled.at(plane / 3, plane % 3, k), expected) ? 0 : 1;
        }
        different += scaled.status()[k] == plain.status()[k] ? 0 : 1;
      }
      EXPECT_EQ(different, 0u) << "2^" << exponent;
    }
  }

  template <typename T>
  [[nodiscard]] static SampleArrays<T> boundary_samples(std::size_t patches) {
    SampleArrays<T> samples;
    Random random(4);
    for (std::size_t k = 0; k < 2000; ++k) {
      const T x = boundary_centred<T>(random);
      samples.add(k % patches, x, boundary_centred<T>(random));
    }
    return samples;
  }

  template <typename T>
  void expect_extrapolation();

  template <typename T>
  void expect_no_negative_zeros() {
    Random random(6);
    std::vector<Net> nets;
    for (int n = 0; n < 40; ++n) {
      const std::uint64_t kinds = 1 + random.below(3);
      nets.push_back(bicubic([&](int, int) {
        const auto value = [&] { return random.below(3) < kinds ? -0.0 : random.symmetric(); };
        return Vector3{value(), value(), value()};
      }));
    }
    Planes<T> planes(nets.size() * 17 * 17);
    grid(packed<T>(nets), Grid<T>::uniform(17, 17), planes.outputs());
    std::size_t negative = 0;
    for (std::size_t k = 0; k < 9 * planes.count(); ++k) {
      negative += planes.values()[k] == 0 && std::signbit(planes.values()[k]) ? 1 : 0;
    }
    EXPECT_EQ(negative, 0u) << "of " << 9 * planes.count() << " positions and tangents are -0";
  }
};

/// sum |C_lk| |x|^k |y|^l, and the same for the derivatives, from a net's centred coefficients.
struct Growth {
  double position = 0;
  double du = 0;
  double dv = 0;
};

[[nodiscard]] Growth growth_at(const Net& net, std::size_t c, double x, double y) {
  const auto centred = [](double b0, double b1, double b2, double b3) {
    return std::array<double, 4>{((b0 + b3) + 3 * (b1 + b2)) / 8, 3 * ((b3 - b0) + (b2 - b1)) / 8,
                                 3 * ((b0 - b1) + (b3 - b2)) / 8, ((b3 - b0) - 3 * (b2 - b1)) / 8};
  };
  std::array<std::array<double, 4>, 4> rows;
  for (int j = 0; j < 4; ++j) {
    rows[static_cast<std::size_t>(j)] =
        centred(net.at(j, 0)[c], net.at(j, 1)[c], net.at(j, 2)[c], net.at(j, 3)[c]);
  }
  Growth growth;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto column = centred(rows[0][k], rows[1][k], rows[2][k], rows[3][k]);
    for (std::size_t l = 0; l < 4; ++l) {
      const double size = std::abs(column[l]);
      const auto power = [](double base, std::size_t e) {
        return std::pow(std::abs(base), static_cast<double>(e));
      };
      growth.position += size * power(x, k) * power(y, l);
      growth.du += k == 0 ? 0 : 2 * static_cast<double>(k) * size * power(x, k - 1) * power(y, l);
      growth.dv += l == 0 ? 0 : 2 * static_cast<double>(l) * size * power(x, k) * power(y, l - 1);
    }
  }
  return growth;
}

// The pointwise bound (docs/accuracy.md), which holds for any x, y. A term passes at most 8
// roundings: its coefficient's own, 3 fused operations along u, and along v those of y^2, of the
// odd part, of its product with y and of the last sum. Without fusing these are 12. A derivative by
// u adds 2 (4) in the column; one by v adds none, as a slope's odd part has no product more than a
// value's.
template <typename T>
void SpecialValuesTest::expect_extrapolation() {
  const std::vector<Net> nets = rounded_nets<T>();
  const PatchSet<T> set = packed<T>(nets);
  SampleArrays<T> samples;
  Random random(10);
  for (std::size_t k = 0; k < 1500; ++k) {
    const double range = k % 3 == 0 ? 100 : 2;
    const auto x = static_cast<T>(range * random.symmetric());
    samples.add(k % nets.size(), x, static_cast<T>(range * random.symmetric()));
  }
  Planes<T> planes(samples.patch.size());
  scattered(set, samples.view(Parameters::centred), planes.outputs());
  const bool fma = fuses_multiply_add(isa());
  const double position_roundings = 1.01 * (fma ? 8 : 12) * kUnitRoundoff<T>;
  const double tangent_roundings = 1.01 * (fma ? 10 : 16) * kUnitRoundoff<T>;
  double worst = 0;
  for (std::size_t k = 0; k < planes.count(); ++k) {
    const Net& net = nets[samples.patch[k]];
    const auto x = static_cast<double>(samples.u[k]);
    const auto y = static_cast<double>(samples.v[k]);
    const OracleSample truth = oracle_sample(net, x, y);
    for (std::size_t c = 0; c < 3; ++c) {
      const Growth growth = growth_at(net, c, x, y);
      const auto ratio = [&](std::size_t group, DoubleDouble exact, double bound) {
        const double error = std::abs((exact - static_cast<double>(planes.at(group, c, k))).hi);
        return error == 0 ? 0 : error / bound;
      };
      worst = std::max({worst, ratio(0, truth.position[c], position_roundings * growth.position),
                        ratio(1, truth.du[c], tangent_roundings * growth.du),
                        ratio(2, truth.dv[c], tangent_roundings * growth.dv)});
    }
  }
  EXPECT_LE(worst, 1.0) << "error / bound";
  EXPECT_GT(worst, 0.01) << "the bound says nothing";
}

TEST_P(SpecialValuesTest, CornersAreControlPointsFloat) { expect_exact_corners<float>(); }
TEST_P(SpecialValuesTest, CornersAreControlPointsDouble) { expect_exact_corners<double>(); }
TEST_P(SpecialValuesTest, NansStayInTheirSampleFloat) { expect_contained_nans<float>(); }
TEST_P(SpecialValuesTest, NansStayInTheirSampleDouble) { expect_contained_nans<double>(); }
TEST_P(SpecialValuesTest, NansStayInTheirRowFloat) { expect_contained_nans_on_grids<float>(); }
TEST_P(SpecialValuesTest, NansStayInTheirRowDouble) { expect_contained_nans_on_grids<double>(); }
TEST_P(SpecialValuesTest, ScalesFloat) {
  expect_scale_invariance<float>({-60, -37, -20, -3, 1, 17, 33, 45, 60});
}
TEST_P(SpecialValuesTest, ScalesDouble) {
  expect_scale_invariance<double>({-700, -300, -60, -20, 20, 60, 300, 700});
}
TEST_P(SpecialValuesTest, ExtrapolatesFloat) { expect_extrapolation<float>(); }
TEST_P(SpecialValuesTest, ExtrapolatesDouble) { expect_extrapolation<double>(); }
TEST_P(SpecialValuesTest, NoNegativeZerosFloat) { expect_no_negative_zeros<float>(); }
TEST_P(SpecialValuesTest, NoNegativeZerosDouble) { expect_no_negative_zeros<double>(); }
INSTANTIATE_FOR_EVERY_ISA(SpecialValuesTest);

} // namespace
} // namespace simdbezier::tests::special_values_test
