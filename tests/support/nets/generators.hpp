// The control-net families of the suite with their sample points, from fixed seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/nets/data_files.hpp"
#include "tests/support/nets/net_shapes.hpp"
#include "tests/support/nets/worst_nets.hpp"

namespace simdbezier::tests {

/// Where on its nets a family is sampled.
enum class SampleRule : std::uint8_t {
  dyadic,   ///< u, v uniform multiples of the unit roundoff: u, 1-u and 2u-1 are all exact
  tiny,     ///< u, v = m 2^-k, k up to 30: neither 1-u nor 2u-1 is exact
  grid,     ///< a uniform 16 x 16 grid, x_i = (2i-N)/N
  boundary, ///< a mix with samples on, and 2^-1 … 2^-24 away from, the four sides
  seams,    ///< the same, and as many on and about the two middle lines
  fixed     ///< given with each net
};

template <typename T>
struct Family {
  std::string name;
  SampleRule rule = SampleRule::dyadic;
  std::vector<Net> nets;
  std::vector<std::vector<Parameters2<T>>> samples; ///< one list per net
  bool with_origins = true;                         ///< also measured with local origins
};

inline constexpr int kGridSamples = 16;

template <typename T>
[[nodiscard]] T dyadic_unit(Random& random) {
  const std::uint64_t steps = std::uint64_t{1} << (sizeof(T) == 4 ? 24 : 53);
  return static_cast<T>(static_cast<double>(random.below(steps + 1)) * kUnitRoundoff<T>);
}

template <typename T>
[[nodiscard]] T boundary_centred(Random& random) {
  const double side = random.sign();
  switch (random.below(3)) {
  case 0:
    return static_cast<T>(side);
  case 1: {
    const double gap = 1.0 / static_cast<double>(std::uint64_t{1} << random.integer(1, 24));
    return static_cast<T>(side * (1 - gap));
  }
  default:
    return static_cast<T>(2 * static_cast<double>(dyadic_unit<T>(random)) - 1);
  }
}

/// Where patches of high degree are cut.
template <typename T>
[[nodiscard]] T seam_centred(Random& random) {
  switch (random.below(4)) {
  case 0:
    return T(0);
  case 1: {
    const double gap = 1.0 / static_cast<double>(std::uint64_t{1} << random.integer(1, 24));
    return static_cast<T>(random.sign() * gap);
  }
  default:
    return boundary_centred<T>(random);
  }
}

template <typename T>
[[nodiscard]] T uniform_centred(int i, int intervals) {
  return static_cast<T>(2 * i - intervals) / static_cast<T>(intervals);
}

template <typename T>
[[nodiscard]] std::vector<Parameters2<T>> grid_parameters(int nu, int nv) {
  std::vector<Parameters2<T>> list;
  for (int iv = 0; iv < nv; ++iv) {
    for (int iu = 0; iu < nu; ++iu) {
      list.push_back(at_centred(uniform_centred<T>(iu, nu - 1), uniform_centred<T>(iv, nv - 1)));
    }
  }
  return list;
}

template <typename T>
[[nodiscard]] std::vector<Parameters2<T>> draw_samples(SampleRule rule, std::size_t count,
                                                       Random& random) {
  if (rule == SampleRule::grid) {
    return grid_parameters<T>(kGridSamples, kGridSamples);
  }
  const auto tiny = [&] {
    const auto scale = static_cast<double>(std::uint64_t{1} << random.integer(0, 30));
    return static_cast<T>(random.unit() / scale);
  };
  std::vector<Parameters2<T>> list;
  for (std::size_t k = 0; k < count; ++k) {
    switch (rule) {
    case SampleRule::tiny: {
      const T u = tiny();
      list.push_back(at_unit(u, tiny()));
      break;
    }
    case SampleRule::boundary: {
      const T x = boundary_centred<T>(random);
      list.push_back(at_centred(x, boundary_centred<T>(random)));
      break;
    }
    case SampleRule::seams: {
      const T x = seam_centred<T>(random);
      list.push_back(at_centred(x, seam_centred<T>(random)));
      break;
    }
    default: {
      const T u = dyadic_unit<T>(random);
      list.push_back(at_unit(u, dyadic_unit<T>(random)));
    }
    }
  }
  return list;
}

/// One row of the table of families.
struct FamilyRow {
  const char* name;
  SampleRule rule;
  Net (*make)(Random&, std::size_t);
};

// The second argument is the net's number within the family, for families that sweep a range.
inline constexpr FamilyRow kFamilies[] = {
    {"wave", SampleRule::dyadic, [](Random& r, std::size_t) { return wave_net(r); }},
    {"waveu", SampleRule::tiny, [](Random& r, std::size_t) { return wave_net(r); }},
    {"grid", SampleRule::grid, [](Random& r, std::size_t) { return wave_net(r); }},
    {"random", SampleRule::dyadic, [](Random& r, std::size_t) { return random_net(r); }},
    {"signs", SampleRule::dyadic, [](Random& r, std::size_t) { return signs_net(r); }},
    {"off1e3", SampleRule::dyadic, [](Random& r, std::size_t) { return offset_net(r, 1e3); }},
    {"off1e6", SampleRule::dyadic, [](Random& r, std::size_t) { return offset_net(r, 1e6); }},
    {"off1e9", SampleRule::dyadic, [](Random& r, std::size_t) { return offset_net(r, 1e9); }},
    {"flat", SampleRule::dyadic, [](Random& r, std::size_t) { return flat_net(r); }},
    {"aspect1e4", SampleRule::dyadic, [](Random& r, std::size_t) { return aspect_net(r, 1e4); }},
    {"aspect1e6", SampleRule::dyadic, [](Random& r, std::size_t) { return aspect_net(r, 1e6); }},
    {"sheared", SampleRule::dyadic, [](Random& r, std::size_t) { return sheared_net(r); }},
    {"collapsed", SampleRule::boundary,
     [](Random& r, std::size_t k) { return collapsed_net(r, static_cast<int>(k % 4)); }},
    {"coincident", SampleRule::boundary, [](Random& r, std::size_t) { return coincident_net(r); }},
    {"cusp", SampleRule::boundary, [](Random& r, std::size_t) { return cusp_net(r); }},
    {"constant", SampleRule::boundary, [](Random& r, std::size_t) { return constant_net(r); }},
    {"scaled", SampleRule::dyadic,
     [](Random& r, std::size_t k) {
       const double factor = std::ldexp(1.0, static_cast<int>(k % 121) - 60);
       return scaled_by(wave_net(r), {factor, factor, factor});
     }},
    {"graded", SampleRule::boundary,
     [](Random& r, std::size_t k) {
       return graded_net(r, std::ldexp(1.0, -6 - static_cast<int>(k % 19)));
     }},
};

/// A few families in turn: nets that reach the plain path, poles and far origins.
[[nodiscard]] inline std::vector<Net> mixed_nets(std::size_t count) {
  Random random(11);
  std::vector<Net> nets;
  for (std::size_t k = 0; k < count; ++k) {
    switch (k % 4) {
    case 0:
      nets.push_back(wave_net(random));
      break;
    case 1:
      nets.push_back(collapsed_net(random, static_cast<int>(k / 4 % 4)));
      break;
    case 2:
      nets.push_back(offset_net(random, 1e4));
      break;
    default:
      nets.push_back(random_net(random));
    }
  }
  return nets;
}

/// Hill-climbed nets, each at the parameter where it was found and at random ones.
template <typename T>
[[nodiscard]] Family<T> worst_family(std::size_t samples_per_net, Random& random) {
  Family<T> family{"worst", SampleRule::fixed, {}, {}};
  for (const WorstNet& worst : kWorstNets) {
    if (worst.is_double != (sizeof(T) == 8)) {
      continue;
    }
    family.nets.push_back(worst_net(worst));
    auto samples = draw_samples<T>(SampleRule::dyadic, samples_per_net, random);
    samples.front() = at_centred(static_cast<T>(worst.x), static_cast<T>(worst.y));
    family.samples.push_back(std::move(samples));
  }
  return family;
}

/// The teapot's nets as given, or turned and moved by 17 where asked; empty without its file.
template <typename T>
[[nodiscard]] Family<T> teapot_family(const char* name, SampleRule rule, bool moved,
                                      std::size_t samples_per_net, Random& random) {
  Family<T> family{name, rule, {}, {}};
  const Matrix3 rotation = random_rotation(random);
  for (Net& net : data_nets("teapot.bpt")) {
    if (moved) {
      net = translated(rotated(std::move(net), rotation), {17, 17, 17});
    }
    family.nets.push_back(rounded_to<T>(std::move(net)));
    family.samples.push_back(draw_samples<T>(rule, samples_per_net, random));
  }
  return family;
}

/// Every family. The counts are per family; teapots and worst nets have as many nets as exist and
/// take samples in proportion.
template <typename T>
[[nodiscard]] std::vector<Family<T>> all_families(std::size_t net_count,
                                                  std::size_t samples_per_net) {
  std::vector<Family<T>> families;
  std::uint64_t seed = 1;
  for (const FamilyRow& row : kFamilies) {
    Random random(seed++);
    Family<T> family{row.name, row.rule, {}, {}};
    for (std::size_t k = 0; k < net_count; ++k) {
      family.nets.push_back(rounded_to<T>(row.make(random, k)));
      family.samples.push_back(draw_samples<T>(row.rule, samples_per_net, random));
    }
    // In float an offset of 1e9 leaves nothing of a unit patch.
    if (sizeof(T) == 8 || family.name != "off1e9") {
      families.push_back(std::move(family));
    }
  }
  Random random(seed);
  const std::size_t many = net_count * samples_per_net / 32 + 1;
  families.push_back(worst_family<T>(many, random));
  families.push_back(teapot_family<T>("teapot", SampleRule::dyadic, false, many, random));
  families.push_back(teapot_family<T>("teapot17", SampleRule::dyadic, true, many, random));
  families.push_back(teapot_family<T>("poles", SampleRule::boundary, false, many, random));
  families.push_back(teapot_family<T>("poles17", SampleRule::boundary, true, many, random));
  std::erase_if(families, [](const Family<T>& family) { return family.nets.empty(); });
  return families;
}

} // namespace simdbezier::tests
