// Meshes do not depend on the caller's rounding mode or flush-to-zero, and leave both as they were.
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>
#include <simdbezier/mesh.hpp>
#include <simdbezier/mesh_layout.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/hash.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::mesh_environment_test {
namespace {

/// Patches of one shape, made before a test changes how sums are rounded.
template <typename T>
struct Patches {
  std::string name;
  std::vector<T> values;
  int degree_u = 3;
  int degree_v = 3;
  Weights weights = Weights::none;

  [[nodiscard]] ControlNets<T> nets() const {
    return ControlNets<T>::packed(std::span<const T>(values), degree_u, degree_v, 3, weights);
  }
  [[nodiscard]] ControlCurves<T> rows() const {
    return ControlCurves<T>::packed(std::span<const T>(values), degree_u, 3, weights);
  }
};

/// Some of the patches are nearly flat; others are so small that squares of sizes are denormal.
template <typename T>
Patches<T> random_patches(int degree_u, int degree_v, Weights weights) {
  Patches<T> made{
      std::to_string(degree_u) + " x " + std::to_string(degree_v), {}, degree_u, degree_v, weights};
  std::mt19937 random(static_cast<unsigned>(16 * degree_u + degree_v));
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const double tiny = sizeof(T) == 4 ? 0x1p-70 : 0x1p-530;
  for (int k = 0; k < 21; ++k) {
    const double scale = k % 3 == 0 ? tiny : 1;
    const double height = k % 5 == 0 ? 1e-6 : 1;
    for (int j = 0; j <= degree_v; ++j) {
      for (int i = 0; i <= degree_u; ++i) {
        for (const double value : {i + noise(random), j + noise(random), height * noise(random)}) {
          made.values.push_back(static_cast<T>(scale * value));
        }
        if (weights != Weights::none) {
          made.values.push_back(static_cast<T>(1 + noise(random)));
        }
      }
    }
  }
  return made;
}

template <typename T>
std::vector<Patches<T>> all_patches() {
  std::vector<Patches<T>> all = {
      random_patches<T>(3, 3, Weights::none), random_patches<T>(2, 4, Weights::none),
      random_patches<T>(1, 3, Weights::homogeneous), random_patches<T>(5, 5, Weights::homogeneous)};
  for (const MeshModel& model : mesh_models()) {
    const std::vector<double> values = shuffled(model, 2).values();
    all.push_back({model.name, std::vector<T>(values.begin(), values.end())});
  }
  return all;
}

/// What a call has made, by its bits.
struct Made {
  std::string call;
  bool ok;
  std::uint64_t bits;
};

template <typename... Values>
Made made_by(std::string call, bool ok, std::span<const Values>... values) {
  Fnv1a hash;
  (hash.add_all(values), ...);
  return {std::move(call), ok, hash.value()};
}

template <typename T>
std::span<const T> flat(const std::vector<std::array<T, 3>>& vectors) {
  return vectors.empty() ? std::span<const T>()
                         : std::span<const T>(vectors.front().data(), 3 * vectors.size());
}

class MeshEnvironmentTest : public IsaTest {
protected:
  template <typename T>
  void add_bounds(const Patches<T>& patches, std::vector<Made>& all) {
    const ControlNets<T> view = patches.nets();
    const std::span<const ControlNets<T>> nets(&view, 1);
    std::vector<double> found(view.count);
    bool ok = static_cast<bool>(certify_grids(nets, 3, 5, {}, std::span(found), {.isa = isa()}));
    all.push_back(made_by(patches.name + ", certified grids", ok, std::span<const double>(found)));
    ok = static_cast<bool>(
        pixel_tolerances(nets, Camera{.eye = {0.1, 0.2, 9}}, 0.3, std::span(found)));
    all.push_back(made_by(patches.name + ", pixels", ok, std::span<const double>(found)));
    const Polylines<T> lines = flatten<T>(patches.rows(), 1e-3);
    const std::vector<double> deviation = {lines.deviation};
    all.push_back(made_by(patches.name + ", polylines", static_cast<bool>(lines.report.status),
                          flat<T>(lines.points), std::span<const double>(deviation)));
  }

  template <typename T>
  void add_mesh(const Patches<T>& patches, std::vector<Made>& all) {
    const MeshPlan<T> plan = plan_mesh<T>(patches.nets(), {.rates = {.normal_degrees = 29},
                                                           .relative_tolerance = 1e-3,
                                                           .topology = {.snap = 1e-3},
                                                           .crease_degrees = 23,
                                                           .threads = 2,
                                                           .isa = isa()});
    std::vector<double> errors(plan.set.size());
    const bool bounded =
        static_cast<bool>(position_errors(plan.set, std::span(errors), {.isa = isa()}));
    all.push_back(made_by(
        patches.name + ", rates", bounded && plan, std::span<const std::uint32_t>(plan.cells_u),
        std::span<const std::uint32_t>(plan.cells_v), std::span<const double>(plan.deviations),
        std::span<const double>(errors)));
    std::vector<std::array<T, 3>> position(plan.layout.size().vertices);
    std::vector<std::array<T, 3>> normal(position.size());
    MeshOutputs<T> out;
    out.position = Vectors<T>::xyz(position);
    out.normal = Vectors<T>::xyz(normal);
    run(CallOptions{.threads = 2}, [&](const CallOptions& options) {
      return evaluate_mesh(plan.set, plan.layout, out, options);
    });
    std::vector<std::uint32_t> triangles(3 * plan.layout.size().triangles);
    const bool written =
        static_cast<bool>(write_triangles(plan.layout, std::span(triangles), {.threads = 2}));
    all.push_back(made_by(patches.name + ", mesh", written, flat<T>(position), flat<T>(normal),
                          std::span<const std::uint32_t>(triangles)));
  }

  template <typename T>
  std::vector<Made> make_all(const std::vector<Patches<T>>& all) {
    std::vector<Made> made;
    for (const Patches<T>& patches : all) {
      add_bounds(patches, made);
      add_mesh(patches, made);
    }
    return made;
  }

  template <typename T>
  void expect_independence() {
    const std::vector<Patches<T>> all = all_patches<T>();
    const std::vector<Made> expected = make_all(all);
    for (const EnvironmentCase& caller : kEnvironments) {
      std::vector<Made> made;
      bool untouched = false;
      {
        const ScopedEnvironment environment(caller.rounding, caller.flush);
        made = make_all(all);
        untouched = environment.untouched();
      }
      EXPECT_TRUE(untouched) << caller.name << ": the caller's environment was not restored";
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_TRUE(expected[k].ok && made[k].ok) << caller.name << ": " << expected[k].call;
        EXPECT_EQ(made[k].bits, expected[k].bits) << caller.name << ": " << expected[k].call;
      }
    }
  }
};

TEST_P(MeshEnvironmentTest, Float) { expect_independence<float>(); }
TEST_P(MeshEnvironmentTest, Double) { expect_independence<double>(); }
INSTANTIATE_FOR_EVERY_ISA(MeshEnvironmentTest);

} // namespace
} // namespace simdbezier::tests::mesh_environment_test
