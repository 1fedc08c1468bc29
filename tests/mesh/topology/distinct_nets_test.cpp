// find_distinct_nets(): models without their repetitions.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <span>
#include <vector>

#include <simdbezier/topology.hpp>

namespace simdbezier::tests::distinct_nets_test {
namespace {

/// Bilinear patches whose points are apart from each other's: number n has the values 12 n to
/// 12 n + 11. Equal numbers repeat each other.
std::vector<double> squares(std::span<const int> numbers) {
  std::vector<double> values;
  for (const int number : numbers) {
    for (int k = 0; k < 12; ++k) {
      values.push_back(12 * number + k);
    }
  }
  return values;
}

struct Case {
  const char* name;
  std::vector<int> numbers;
  std::vector<std::size_t> views; ///< how many patches each has
  std::vector<std::uint32_t> kept;
  std::vector<std::size_t> parts;
};

const Case kCases[] = {
    {"no repetition", {1, 2, 3}, {3}, {0, 1, 2}, {3}},
    {"in the middle", {1, 1, 2, 1, 3}, {5}, {0, 2, 4}, {1, 1, 1}},
    {"at the end", {1, 2, 2, 2}, {4}, {0, 1}, {2}},
    {"a view that repeats another", {1, 2, 2, 1, 3}, {2, 2, 1}, {0, 1, 4}, {2, 1}},
    {"empty views", {4, 4, 5}, {0, 1, 0, 2, 0}, {0, 2}, {1, 1}},
    {"nothing", {}, {}, {}, {}},
};

TEST(DistinctNets, are_views_of_all_others) {
  for (const Case& test : kCases) {
    SCOPED_TRACE(test.name);
    const std::vector<double> values = squares(test.numbers);
    std::vector<ControlNets<double>> nets;
    const double* next = values.data();
    for (const std::size_t count : test.views) {
      nets.push_back(ControlNets<double>::packed(std::span(next, 12 * count), 1, 1));
      next += 12 * count;
    }
    Topology topology;
    ASSERT_EQ(find_topology<double>(nets, topology), Status::ok);
    DistinctNets<double> distinct;
    ASSERT_EQ(find_distinct_nets<double>(nets, topology, distinct), Status::ok);
    EXPECT_EQ(distinct.patches, test.kept);
    std::vector<std::size_t> parts;
    std::vector<const double*> points;
    for (const ControlNets<double>& part : distinct.nets) {
      parts.push_back(part.count);
      for (std::size_t patch = 0; patch < part.count; ++patch) {
        points.push_back(part.points + static_cast<std::ptrdiff_t>(patch) * part.patch_stride);
      }
    }
    EXPECT_EQ(parts, test.parts);
    ASSERT_EQ(points.size(), test.kept.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k], values.data() + 12 * test.kept[k]) << k;
    }
    ASSERT_EQ(find_topology<double>(distinct.nets, topology), Status::ok);
    EXPECT_EQ(topology.counts().patches, test.kept.size());
    EXPECT_EQ(topology.counts().repeated_patches, 0U);
  }
}

// Repetitions may run any way round: through their memory, backwards.
TEST(DistinctNets, know_patches_whichever_way_round) {
  std::mt19937 random(3);
  std::array<float, 48> values{};
  for (float& value : values) {
    value = static_cast<float>(random() % 1000);
  }
  const auto given = ControlNets<float>::packed(std::span<const float>(values));
  ControlNets<float> transposed = given;
  std::swap(transposed.row_stride, transposed.point_stride);
  ControlNets<float> reversed = given;
  reversed.memory = {};
  reversed.points += 45;
  reversed.row_stride *= -1;
  reversed.point_stride *= -1;
  const std::array nets = {transposed, given, reversed};
  Topology topology;
  ASSERT_EQ(find_topology<float>(nets, topology), Status::ok);
  DistinctNets<float> distinct;
  ASSERT_EQ(find_distinct_nets<float>(nets, topology, distinct), Status::ok);
  EXPECT_EQ(distinct.patches, std::vector<std::uint32_t>{0});
  ASSERT_EQ(distinct.nets.size(), 1U);
  EXPECT_EQ(distinct.nets[0].row_stride, transposed.row_stride);
}

TEST(DistinctNets, refuse_another_models_topology) {
  const std::vector<double> values = squares(std::array{1, 1, 2});
  const auto nets = ControlNets<double>::packed(std::span<const double>(values), 1, 1);
  Topology topology;
  ASSERT_EQ(find_topology(nets, topology), Status::ok);
  const auto one = std::span(&nets, 1);
  DistinctNets<double> distinct{{nets, nets}, {7}};
  EXPECT_EQ(find_distinct_nets<double>(one, Topology(), distinct), Status::unequal_lengths);
  EXPECT_EQ(find_distinct_nets<double>(one.first(0), topology, distinct), Status::unequal_lengths);
  const std::span<const ControlNets<double>> null(static_cast<const ControlNets<double>*>(nullptr),
                                                  1);
  EXPECT_EQ(find_distinct_nets<double>(null, topology, distinct), Status::null_input);
  EXPECT_EQ(distinct.nets.size(), 2U);
  EXPECT_EQ(distinct.patches, std::vector<std::uint32_t>{7});
}

} // namespace
} // namespace simdbezier::tests::distinct_nets_test
