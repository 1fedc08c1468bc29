// Bounds of patches that are not bicubic polynomials: kernels bound some patches at once, each in a
// lane. Every instruction set has to give the same bounds, bit for bit, and no patch may depend on
// those in the other lanes.
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>

namespace simdbezier::tests::rate_kernels_test {
namespace {

/// What side v = 0 is: `mixed` is a point in every other patch.
enum class Side { usual, point, mixed };

struct Kind {
  int degree_u;
  int degree_v;
  Weights weights;
  Side side = Side::usual;
};

/// The last kinds have forced diagonals, without which bicubic polynomials are not bounded by these
/// kernels.
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
    {3, 3, Weights::cartesian, Side::mixed},
    {4, 2, Weights::none, Side::mixed},
};

/// A group of the widest registers and a part of one, and full and partial ones of others.
constexpr std::size_t kPatches = 11;

template <typename S>
class Model {
public:
  explicit Model(const Kind& kind) : kind_(kind) {
    std::mt19937 random(static_cast<unsigned>(100 * kind.degree_u + kind.degree_v));
    std::uniform_real_distribution<double> noise(-0.1, 0.1);
    for (std::size_t patch = 0; patch < kPatches; ++patch) {
      for (int j = 0; j <= kind.degree_v; ++j) {
        for (int i = 0; i <= kind.degree_u; ++i) {
          const bool tip =
              j == 0 && (kind.side == Side::point || (kind.side == Side::mixed && patch % 2 == 0));
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
  [[nodiscard]] ControlNets<S> net(std::size_t patch) const {
    ControlNets<S> one = nets();
    one.points += static_cast<std::ptrdiff_t>(patch) * one.patch_stride;
    one.count = 1;
    return one;
  }
  [[nodiscard]] std::vector<S>& values() { return values_; }

private:
  Kind kind_;
  std::vector<S> values_;
};

struct Rated {
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviation;

  explicit Rated(std::size_t patches = kPatches)
      : nu(patches, 3), nv(patches, 4), diagonals(patches), deviation(patches) {}

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
  EXPECT_EQ(choose_rates(sets, topology, options, rated[0].out(), {.isa = isa}).status, Status::ok);
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

/// What patches of a set are asked for: tolerances of all sizes side by side, so that lanes end
/// their searches at different times.
struct Wishes {
  const char* name;
  double longest_edge = kUnlimited;
  double normal_degrees = kUnlimited;
};
constexpr Wishes kWishes[] = {{"tolerances"}, {"edges", 0.07}, {"angles", kUnlimited, 6}};

double tolerance_of(std::size_t patch) {
  constexpr double kTolerances[] = {0.1, 1e-4, 0.003, 10, 0.02};
  return kTolerances[patch % std::size(kTolerances)];
}

template <typename S>
void expect_no_dependence(const Model<S>& model, const Wishes& wishes, Isa isa) {
  std::vector<double> tolerances;
  for (std::size_t patch = 0; patch < kPatches; ++patch) {
    tolerances.push_back(tolerance_of(patch));
  }
  RateOptions options;
  options.longest_edge = wishes.longest_edge;
  options.normal_degrees = wishes.normal_degrees;
  const auto choose = [&](const ControlNets<S>& nets, std::span<const double> wanted) {
    Topology topology;
    EXPECT_EQ(find_topology(nets, topology), Status::ok);
    Rated rated(nets.count);
    options.tolerances = wanted;
    EXPECT_EQ(choose_rates(nets, topology, options, rated.out(), {.isa = isa}).status, Status::ok);
    return rated;
  };
  const Rated all = choose(model.nets(), tolerances);
  for (std::size_t patch = 0; patch < kPatches; ++patch) {
    const Rated alone = choose(model.net(patch), std::span(tolerances).subspan(patch, 1));
    EXPECT_EQ(all.nu[patch], alone.nu[0]) << patch;
    EXPECT_EQ(all.nv[patch], alone.nv[0]) << patch;
    EXPECT_EQ(all.diagonals[patch], alone.diagonals[0]) << patch;
    EXPECT_EQ(all.deviation[patch], alone.deviation[0]) << patch;
    EXPECT_LE(all.deviation[patch], tolerances[patch]) << patch;
  }
}

TEST(RateKernels, patches_do_not_depend_on_their_group) {
  for (const Kind& kind : kKinds) {
    for (const Wishes& wishes : kWishes) {
      for (const Isa isa : available_isas()) {
        SCOPED_TRACE(name_of(kind) + ", " + wishes.name + ", " + std::string(to_string(isa)));
        expect_no_dependence(Model<float>(kind), wishes, isa);
        expect_no_dependence(Model<double>(kind), wishes, isa);
      }
    }
  }
}

TEST(RateKernels, a_patch_at_fault_is_named) {
  // Its quotients are out of range, although its values are not.
  Model<double> model({2, 2, Weights::homogeneous});
  constexpr std::size_t kBad = 5;
  const std::size_t values = model.values().size() / kPatches;
  model.values()[kBad * values] = 1e300;
  model.values()[kBad * values + 3] = 1e-300;
  for (const Isa isa : available_isas()) {
    SCOPED_TRACE(std::string(to_string(isa)));
    Topology topology;
    ASSERT_EQ(find_topology(model.nets(), topology), Status::ok);
    RateOptions options;
    options.tolerance = 0.01;
    Rated rated;
    const Report report = choose_rates(model.nets(), topology, options, rated.out(), {.isa = isa});
    EXPECT_EQ(report.status, Status::non_finite_input);
    EXPECT_EQ(report.item, kBad);
  }
}

/// Kernels see it first, in any component of a point inside, beside patches without fault, and even
/// behind one that has no tolerance left.
TEST(RateKernels, a_value_that_is_not_finite_is_named) {
  constexpr std::size_t kBad = 5;
  const Model<float> sound({3, 3, Weights::none});
  Topology topology;
  ASSERT_EQ(find_topology(sound.nets(), topology), Status::ok);
  for (const float value : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    for (std::size_t component = 0; component < 3; ++component) {
      Model<float> model = sound;
      model.values()[48 * kBad + 3 * 5 + component] = value;
      for (const Isa isa : available_isas()) {
        SCOPED_TRACE(std::string(to_string(isa)) + ", component " + std::to_string(component));
        RateOptions options;
        options.tolerance = 0.01;
        const RunOptions run{.isa = isa};
        std::vector<double> errors(kPatches);
        errors[kBad - 2] = 1;
        RateOptions none_left = options;
        none_left.errors = errors;
        Rated rated;
        for (const Report& report :
             {choose_rates(model.nets(), topology, options, rated.out(), run),
              choose_rates(model.nets(), topology, none_left, rated.out(), run),
              certify_rates(model.nets(), topology, {}, Rated().out(), run)}) {
          EXPECT_EQ(report.status, Status::non_finite_input);
          EXPECT_EQ(report.item, kBad);
        }
      }
    }
  }
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

/// Which direction is called u makes no difference but roundings.
TEST(RateKernels, turned_patches_have_the_same_bound) {
  const Model<double> model({3, 3, Weights::none});
  const auto certify = [](const ControlNets<double>& nets, std::uint32_t nu, std::uint32_t nv) {
    Topology topology;
    EXPECT_EQ(find_topology(nets, topology), Status::ok);
    Rated rated;
    rated.nu.assign(kPatches, nu);
    rated.nv.assign(kPatches, nv);
    const std::span<const ControlNets<double>> sets(&nets, 1);
    EXPECT_EQ(certify_rates(sets, topology, {}, rated.out(), {}).status, Status::ok);
    return rated.deviation;
  };
  ControlNets<double> turned = model.nets();
  std::swap(turned.point_stride, turned.row_stride);
  for (const std::uint32_t nu : {2U, 4U, 5U}) {
    const std::vector<double> first = certify(model.nets(), nu, 2);
    const std::vector<double> second = certify(turned, 2, nu);
    for (std::size_t patch = 0; patch < kPatches; ++patch) {
      EXPECT_NEAR(second[patch] / first[patch], 1, 1e-11) << nu << ", patch " << patch;
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
  EXPECT_EQ(choose_rates(sets, topology, options, rated.out(), {.isa = absent}).status,
            Status::unsupported_isa);
  EXPECT_EQ(certify_rates(sets, topology, {}, rated.out(), {.isa = absent}).status,
            Status::unsupported_isa);
  EXPECT_EQ(certify_grids(sets, 1, 1, {}, rated.deviation, {.isa = absent}).status,
            Status::unsupported_isa);
}

} // namespace
} // namespace simdbezier::tests::rate_kernels_test
