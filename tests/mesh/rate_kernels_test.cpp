// Bounds of patches that are not bicubic polynomials: kernels measure their control vectors, and
// every instruction set has to give the same bounds, bit for bit.
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>

namespace simdbezier::tests::rate_kernels_test {
namespace {

enum class Side { usual, point }; ///< what side v = 0 is

struct Kind {
  int degree_u;
  int degree_v;
  Weights weights;
  Side side = Side::usual;
};

/// Registers of vectors are full, nearly so, or alone; the last kinds have forced diagonals.
constexpr Kind kKinds[] = {
    {1, 1, Weights::none},
    {2, 2, Weights::none},
    {3, 2, Weights::none},
    {4, 4, Weights::none},
    {7, 1, Weights::none},
    {15, 15, Weights::none},
    {1, 2, Weights::cartesian},
    {2, 2, Weights::homogeneous},
    {3, 3, Weights::cartesian},
    {5, 4, Weights::homogeneous},
    {15, 2, Weights::cartesian},
    {3, 3, Weights::none, Side::point},
    {3, 3, Weights::cartesian, Side::point},
    {4, 2, Weights::none, Side::point},
};

constexpr std::size_t kPatches = 6;

template <typename S>
class Model {
public:
  explicit Model(const Kind& kind) : kind_(kind) {
    std::mt19937 random(static_cast<unsigned>(100 * kind.degree_u + kind.degree_v));
    std::uniform_real_distribution<double> noise(-0.1, 0.1);
    for (std::size_t patch = 0; patch < kPatches; ++patch) {
      for (int j = 0; j <= kind.degree_v; ++j) {
        for (int i = 0; i <= kind.degree_u; ++i) {
          const bool tip = j == 0 && kind.side == Side::point;
          const double u = tip ? 0 : 1.0 * i / kind.degree_u;
          const double v = 1.0 * j / kind.degree_v;
          const double w = 1 + (tip ? 0 : 5 * noise(random));
          const double scale = kind.weights == Weights::homogeneous ? w : 1;
          const double x = u + (tip ? 0 : noise(random)) + 2.0 * static_cast<double>(patch);
          const double z = tip ? 0 : u * u - u * v + noise(random);
          for (const double value : {x, v, z}) {
            values_.push_back(static_cast<S>(scale * value));
          }
          if (kind.weights != Weights::none) {
            values_.push_back(static_cast<S>(w));
          }
        }
      }
    }
  }
  [[nodiscard]] ControlNets<S> nets() const {
    return ControlNets<S>::packed(std::span<const S>(values_), kind_.degree_u, kind_.degree_v, 3,
                                  kind_.weights);
  }
  [[nodiscard]] std::vector<S>& values() { return values_; }

private:
  Kind kind_;
  std::vector<S> values_;
};

struct Rated {
  std::vector<std::uint32_t> nu = std::vector<std::uint32_t>(kPatches, 3);
  std::vector<std::uint32_t> nv = std::vector<std::uint32_t>(kPatches, 4);
  std::vector<std::uint16_t> diagonals = std::vector<std::uint16_t>(kPatches);
  std::vector<double> deviation = std::vector<double>(kPatches);

  [[nodiscard]] CertifiedRates out() { return {nu, nv, diagonals, deviation}; }
  friend bool operator==(const Rated&, const Rated&) = default;
};

/// Chosen rates, certificates of given ones, and those of grids.
template <typename S>
std::array<Rated, 3> rate(const ControlNets<S>& nets, Isa isa, double scale = 1) {
  Topology topology;
  EXPECT_EQ(find_topology(nets, topology), Status::ok);
  std::array<Rated, 3> rated;
  const std::span<const ControlNets<S>> sets(&nets, 1);
  RateOptions options;
  options.tolerance = 0.01 * scale;
  options.isa = isa;
  EXPECT_EQ(choose_rates(sets, topology, options, rated[0].out()).status, Status::ok);
  EXPECT_EQ(certify_rates(sets, topology, {}, rated[1].out(), {.isa = isa}).status, Status::ok);
  EXPECT_EQ(certify_grids(sets, 5, 2, {}, rated[2].deviation, {.isa = isa}).status, Status::ok);
  return rated;
}

std::string name_of(const Kind& kind) {
  return std::to_string(kind.degree_u) + "x" + std::to_string(kind.degree_v) + ", weights " +
         std::to_string(static_cast<int>(kind.weights)) + ", side " +
         std::to_string(static_cast<int>(kind.side));
}

template <typename S>
void expect_equal_bounds() {
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(name_of(kind));
    const Model<S> model(kind);
    const std::array<Rated, 3> first = rate(model.nets(), available_isas().front());
    for (const double deviation : first[0].deviation) {
      EXPECT_GT(deviation, 0);
      EXPECT_LE(deviation, 0.01);
    }
    for (const Isa isa : available_isas()) {
      SCOPED_TRACE(std::string(to_string(isa)));
      EXPECT_EQ(rate(model.nets(), isa), first);
    }
  }
}

TEST(RateKernels, bounds_are_equal_on_all_instruction_sets) {
  expect_equal_bounds<float>();
  expect_equal_bounds<double>();
}

TEST(RateKernels, powers_of_two_scale_bounds) {
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(name_of(kind));
    for (const double scale : {0x1p-900, 0x1p40, 0x1p900}) {
      Model<double> model(kind);
      const std::array<Rated, 3> original = rate(model.nets(), Isa::automatic);
      const std::size_t channels = kind.weights == Weights::none ? 3 : 4;
      for (std::size_t k = 0; k < model.values().size(); ++k) {
        model.values()[k] *= k % channels < 3 ? scale : 1;
      }
      const std::array<Rated, 3> scaled = rate(model.nets(), Isa::automatic, scale);
      for (std::size_t call = 0; call < original.size(); ++call) {
        EXPECT_EQ(scaled[call].nu, original[call].nu);
        EXPECT_EQ(scaled[call].nv, original[call].nv);
        for (std::size_t patch = 0; patch < kPatches; ++patch) {
          EXPECT_EQ(scaled[call].deviation[patch], scale * original[call].deviation[patch]);
        }
      }
    }
  }
}

/// Weights that are all equal make no difference but roundings: no derivative of w is other than 0.
TEST(RateKernels, equal_weights_have_the_polynomial_bound) {
  for (const Kind& kind : {Kind{2, 2, Weights::none}, Kind{4, 3, Weights::none}}) {
    SCOPED_TRACE(name_of(kind));
    Model<double> model(kind);
    std::vector<double> weighted;
    for (std::size_t k = 0; k < model.values().size(); k += 3) {
      weighted.insert(weighted.end(), &model.values()[k], &model.values()[k] + 3);
      weighted.push_back(4);
    }
    const auto rational = ControlNets<double>::packed(
        std::span<const double>(weighted), kind.degree_u, kind.degree_v, 3, Weights::cartesian);
    const std::array<Rated, 3> with = rate(rational, Isa::automatic);
    const std::array<Rated, 3> without = rate(model.nets(), Isa::automatic);
    for (std::size_t call = 0; call < with.size(); ++call) {
      EXPECT_EQ(with[call].nu, without[call].nu);
      for (std::size_t patch = 0; patch < kPatches; ++patch) {
        EXPECT_NEAR(with[call].deviation[patch] / without[call].deviation[patch], 1, 1e-11);
      }
    }
  }
}

TEST(RateKernels, absent_instruction_sets_are_a_status) {
  const Model<float> model(kKinds[0]);
  const ControlNets<float> nets = model.nets();
  const std::span<const ControlNets<float>> sets(&nets, 1);
  Topology topology;
  ASSERT_EQ(find_topology(nets, topology), Status::ok);
  Rated rated;
  const auto absent = static_cast<Isa>(99);
  RateOptions options;
  options.tolerance = 1;
  options.isa = absent;
  EXPECT_EQ(choose_rates(sets, topology, options, rated.out()).status, Status::unsupported_isa);
  EXPECT_EQ(certify_rates(sets, topology, {}, rated.out(), {.isa = absent}).status,
            Status::unsupported_isa);
  EXPECT_EQ(certify_grids(sets, 1, 1, {}, rated.deviation, {.isa = absent}).status,
            Status::unsupported_isa);
}

} // namespace
} // namespace simdbezier::tests::rate_kernels_test
