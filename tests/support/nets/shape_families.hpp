// Families of nets of every degree, and with weights; see generators.hpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

using MakeShaped = Net (*)(Degrees, Random&);

/// One family: nets by `make`, with weights of that ratio where it is not 0.
struct ShapeFamilyRow {
  const char* name;
  MakeShaped make;
  SampleRule rule;
  Degrees degrees;
  double weight_ratio = 0;
  bool homogeneous = false;
  bool with_origins = false;
};

[[nodiscard]] inline Net far_net(Degrees degrees, Random& random) {
  return shaped_offset_net(degrees, random, 1e3);
}
[[nodiscard]] inline Net octant_net(Degrees /*degrees*/, Random& /*random*/) {
  return sphere_octant();
}

inline constexpr Degrees kUnequalDegrees[] = {{1, 3}, {3, 1}, {2, 3},  {5, 2},  {3, 7}, {7, 3},
                                              {6, 5}, {5, 6}, {1, 15}, {15, 4}, {12, 9}};

/// Every degree with random and sign nets, unequal degrees with height fields, nets far from the
/// origin, weights in ratios up to 1e4. Bicubic polynomial nets have families of their own.
[[nodiscard]] inline std::vector<ShapeFamilyRow> shape_family_rows() {
  std::vector<ShapeFamilyRow> rows;
  for (int n = 1; n <= 15; ++n) {
    if (n != 3) {
      rows.push_back({"random", shaped_random_net, SampleRule::seams, {n, n}});
      rows.push_back({"signs", shaped_signs_net, SampleRule::dyadic, {n, n}});
    }
  }
  for (const Degrees& degrees : kUnequalDegrees) {
    const SampleRule rule = degrees.u % 2 == 0 ? SampleRule::grid : SampleRule::seams;
    rows.push_back({"wave", shaped_wave_net, rule, degrees});
  }
  for (const Degrees& degrees : {Degrees{2, 2}, {4, 4}, {7, 7}, {3, 9}}) {
    rows.push_back({"off1e3", far_net, SampleRule::dyadic, degrees, 0, false, true});
  }
  for (const Degrees& degrees : {Degrees{3, 3}, {2, 5}, {7, 7}}) {
    rows.push_back({"weights1", shaped_wave_net, SampleRule::dyadic, degrees, 1});
    rows.push_back({"weights4", shaped_wave_net, SampleRule::seams, degrees, 4, false, true});
    rows.push_back({"weights100", shaped_wave_net, SampleRule::dyadic, degrees, 1e2});
    rows.push_back({"weights1e4", shaped_wave_net, SampleRule::dyadic, degrees, 1e4});
  }
  rows.push_back({"weights_random", shaped_random_net, SampleRule::dyadic, {15, 15}, 4});
  rows.push_back({"weights_far", far_net, SampleRule::dyadic, {3, 3}, 4, false, true});
  rows.push_back({"homogeneous", shaped_wave_net, SampleRule::boundary, {3, 2}, 4, true});
  rows.push_back({"octant", octant_net, SampleRule::boundary, {2, 2}, 0, false, true});
  return rows;
}

/// "wave_12x9"
[[nodiscard]] inline std::string shape_family_name(const ShapeFamilyRow& row) {
  std::string name = row.name;
  name += '_';
  name += std::to_string(row.degrees.u);
  name += 'x';
  name += std::to_string(row.degrees.v);
  return name;
}

template <typename T>
[[nodiscard]] Family<T> shape_family(const ShapeFamilyRow& row, std::uint64_t seed,
                                     std::size_t net_count, std::size_t samples_per_net) {
  Random random(seed);
  Family<T> family{shape_family_name(row), row.rule, {}, {}, row.with_origins};
  for (std::size_t k = 0; k < net_count; ++k) {
    Net net = row.make(row.degrees, random);
    if (row.weight_ratio > 0) {
      net = weighted(std::move(net), row.weight_ratio, random);
    }
    if (row.homogeneous) {
      net = homogeneous(std::move(net));
    }
    family.nets.push_back(rounded_to<T>(std::move(net)));
    family.samples.push_back(draw_samples<T>(row.rule, samples_per_net, random));
  }
  return family;
}

template <typename T>
[[nodiscard]] std::vector<Family<T>> shape_families(std::size_t net_count,
                                                    std::size_t samples_per_net) {
  std::vector<Family<T>> families;
  std::uint64_t seed = 1000;
  for (const ShapeFamilyRow& row : shape_family_rows()) {
    families.push_back(shape_family<T>(row, seed++, net_count, samples_per_net));
  }
  return families;
}

} // namespace simdbezier::tests
