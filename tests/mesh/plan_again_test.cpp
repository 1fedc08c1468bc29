// plan_again() beside plan_mesh(), and what a plan says of a tolerance that it refuses.
#include <algorithm>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests::plan_again_test {
namespace {

struct Wish {
  std::string name;
  MeshOptions options;
};

std::vector<Wish> wishes() {
  std::vector<Wish> all(7);
  all[0] = {"tolerance", {.rates = {.tolerance = 0.02}}};
  all[1] = {"finer", {.rates = {.tolerance = 1e-4}}};
  all[2] = {"share", {.relative_tolerance = 1e-2}};
  all[3] = {"grid", {.nu = 5, .nv = 4}};
  all[4] = {"crease", {.nu = 4, .nv = 4, .crease_degrees = 20}};
  all[5] = {"parameters", {.rates = {.longest_edge = 0.3}, .parameters = true}};
  all[6] = {"pixels", {.pixels = 2}};
  all[6].options.camera.eye = {0, 0, 9};
  return all;
}

template <typename T>
void expect_equal(const MeshPlan<T>& one, const MeshPlan<T>& other) {
  EXPECT_EQ(one.report.status, other.report.status);
  EXPECT_EQ(one.cells_u, other.cells_u);
  EXPECT_EQ(one.cells_v, other.cells_v);
  EXPECT_EQ(one.errors, other.errors);
  EXPECT_EQ(one.deviations, other.deviations);
  EXPECT_EQ(one.deviation, other.deviation);
  ASSERT_EQ(one.layout.size().vertices, other.layout.size().vertices);
  ASSERT_EQ(one.layout.size().triangles, other.layout.size().triangles);
  const auto triangles_of = [](const MeshPlan<T>& plan) {
    std::vector<std::uint32_t> triangles(3 * plan.layout.size().triangles);
    EXPECT_TRUE(write_triangles<std::uint32_t>(plan.layout, triangles));
    return triangles;
  };
  EXPECT_EQ(triangles_of(one), triangles_of(other));
}

std::vector<double> torus_values() {
  const std::vector<MeshModel> models = mesh_models();
  return std::ranges::find(models, "torus 4 x 3", [](const MeshModel& one) { return one.name; })
      ->values();
}

TEST(PlanAgain, equals_a_plan_from_the_start) {
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue; // whose meshes are not manifold
    }
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    MeshPlan<float> plan = plan_mesh<float>(nets, {.nu = 2, .nv = 2});
    ASSERT_TRUE(plan) << model.name;
    for (const Wish& wish : wishes()) {
      SCOPED_TRACE(model.name + " " + wish.name);
      EXPECT_TRUE(plan_again(nets, wish.options, plan));
      expect_equal(plan, plan_mesh<float>(nets, wish.options));
    }
  }
}

/// The plan that a caller fills in, as one does who has a set and a topology already.
TEST(PlanAgain, takes_what_a_caller_fills_in) {
  const std::vector<double> values = torus_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  MeshPlan<double> plan;
  ASSERT_TRUE(pack(nets, plan.set));
  ASSERT_TRUE(find_topology(nets, plan.topology));
  const MeshOptions options{.rates = {.tolerance = 1e-3}};
  EXPECT_EQ(plan_again(nets, options, plan).status, Status::bad_rates);
  plan.errors.resize(plan.set.size());
  ASSERT_TRUE(position_errors(plan.set, plan.errors));
  EXPECT_TRUE(plan_again(nets, options, plan));
  expect_equal(plan, plan_mesh<double>(nets, options));
}

TEST(PlanAgain, refuses_other_nets_and_keeps_the_plan) {
  const std::vector<double> values = torus_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const MeshOptions options{.rates = {.tolerance = 1e-3}};
  MeshPlan<double> plan = plan_mesh<double>(nets, options);
  ASSERT_TRUE(plan);
  ControlNets<double> fewer = nets;
  fewer.count -= 1;
  EXPECT_EQ(plan_again(fewer, options, plan).status, Status::bad_topology);
  std::vector<double> torn = values;
  torn[0] += 0.5; // a corner that four patches share
  const auto others = ControlNets<double>::packed(std::span<const double>(torn));
  EXPECT_EQ(plan_again(others, options, plan).status, Status::bad_topology);
  EXPECT_FALSE(plan);
  EXPECT_EQ(plan_again(nets, {}, plan).status, Status::bad_tolerance);
  EXPECT_TRUE(plan_again(nets, options, plan));
  expect_equal(plan, plan_mesh<double>(nets, options));

  std::vector<double> twice = values;
  twice.insert(twice.end(), values.begin(), values.begin() + 48);
  const auto repeated = ControlNets<double>::packed(std::span<const double>(twice));
  MeshOptions dropping = options;
  dropping.drop_repeated = true;
  plan = plan_mesh<double>(repeated, dropping);
  ASSERT_FALSE(plan.patches.empty());
  EXPECT_EQ(plan_again(repeated, options, plan).status, Status::bad_topology);
}

/// Patches that no edge had to be cut for are those given.
TEST(PlanAgain, takes_a_plan_of_which_nothing_was_cut) {
  const std::vector<double> values = torus_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  MeshOptions options{.rates = {.tolerance = 1e-2}};
  const MeshPlan<double> whole = plan_mesh<double>(nets, options);
  options.split_edges = true;
  MeshPlan<double> plan = plan_mesh<double>(nets, options);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan.splits.splits, 0U);
  EXPECT_TRUE(plan.patches.empty() && plan.pieces.empty());
  expect_equal(plan, whole);
  EXPECT_TRUE(plan_again(nets, options, plan));
  expect_equal(plan, whole);

  std::vector<double> twice = values; // those left out have no number
  twice.insert(twice.begin(), values.end() - 48, values.end());
  options.drop_repeated = true;
  const MeshPlan<double> once =
      plan_mesh<double>(ControlNets<double>::packed(std::span<const double>(twice)), options);
  ASSERT_TRUE(once);
  EXPECT_TRUE(once.pieces.empty());
  ASSERT_EQ(once.patches.size(), whole.set.size());
  EXPECT_EQ(once.patches.back(), whole.set.size() - 1);
}

struct Refusal {
  std::string name;
  MeshOptions options;
  double moved; ///< how far from the origin the model is
  RateLimit limit;
};

TEST(RateFault, names_what_keeps_a_patch_from_its_tolerance) {
  const double kNone = std::numeric_limits<double>::infinity();
  Refusal refusals[] = {
      {"rounding", {.rates = {.tolerance = 1e-9}}, 1000, RateLimit::errors},
      {"cells", {.rates = {.tolerance = 1e-3, .most_segments = 2}}, 0, RateLimit::cells},
      {"angle", {.rates = {.tolerance = 10, .normal_degrees = 1e-3}}, 0, RateLimit::angle},
      {"angle and cells",
       {.rates = {.tolerance = 1e-3, .normal_degrees = 1e-3, .most_segments = 2}},
       0,
       RateLimit::cells},
      {"length", {.rates = {.longest_edge = 1e-6}}, 0, RateLimit::length},
      {"length beside a tolerance",
       {.rates = {.tolerance = 10, .longest_edge = 1e-6}},
       0,
       RateLimit::length},
      {"length beside an angle",
       {.rates = {.longest_edge = 1e-6, .normal_degrees = 90}},
       0,
       RateLimit::length},
      {"angle beside a length",
       {.rates = {.longest_edge = 10, .normal_degrees = 1e-3}},
       0,
       RateLimit::angle},
      {"length and cells",
       {.rates = {.tolerance = 1e-3, .longest_edge = 1e-6, .most_segments = 2}},
       0,
       RateLimit::cells},
      {"rounding beside a length",
       {.rates = {.tolerance = 1e-9, .longest_edge = 10}},
       1000,
       RateLimit::errors}};
  for (const Refusal& refusal : refusals) {
    std::vector<double> values = torus_values();
    for (double& value : values) {
      value += refusal.moved;
    }
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    const MeshPlan<float> plan = plan_mesh<float>(nets, refusal.options);
    EXPECT_EQ(plan.report.status, Status::bad_tolerance) << refusal.name;
    EXPECT_EQ(plan.fault.limit, refusal.limit) << refusal.name;
    EXPECT_EQ(plan.fault.tolerance, refusal.options.rates.tolerance) << refusal.name;
    EXPECT_GT(plan.fault.error, 0) << refusal.name;
    EXPECT_LT(plan.fault.error, kNone) << refusal.name;
  }
  const std::vector<double> values = torus_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  MeshOptions snapped{.rates = {.tolerance = 1e-3}};
  snapped.topology.snap = 1e-2;
  std::vector<double> apart = values;
  for (std::size_t k = 0; k < 48; ++k) { // one patch
    apart[k] += 4e-3;
  }
  const auto gaping = ControlNets<double>::packed(std::span<const double>(apart));
  const MeshPlan<double> refused = plan_mesh<double>(gaping, snapped);
  EXPECT_EQ(refused.report.status, Status::snap_too_large);
  EXPECT_EQ(refused.fault.limit, RateLimit::snap);
  EXPECT_EQ(plan_mesh<float>(nets, {.rates = {.tolerance = 1e-2}}).fault.limit, RateLimit::none);
  EXPECT_EQ(plan_mesh<float>(nets, {}).fault.limit, RateLimit::none);
}

} // namespace
} // namespace simdbezier::tests::plan_again_test
