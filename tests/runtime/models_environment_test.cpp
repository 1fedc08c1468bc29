// Calls that compute in the caller's thread what they plan with: for models of ordinary and of
// denormal size, the caller's rounding mode and flush-to-zero neither change the bits nor get lost.
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/environment.hpp"
#include "tests/support/hash.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::models_environment_test {
namespace {

/// A model and what is made of it before the environment changes.
struct Model {
  explicit Model(double scale)
      : seventh(scale / 7), tolerance(scale / 16), nets(mixed_nets(4)),
        points(scaled_points(scale)), control{points.data(), nets.size()},
        set(packed<double>(scaled(scale))) {}

  [[nodiscard]] std::vector<Net> scaled(double scale) const {
    std::vector<Net> all;
    for (const Net& net : nets) {
      all.push_back(scaled_by(net, {scale, scale, scale}));
    }
    return all;
  }
  [[nodiscard]] std::vector<double> scaled_points(double scale) const {
    return packed_points<double>(scaled(scale));
  }

  double seventh; // in the usual environment, as are the points
  double tolerance;
  std::vector<Net> nets;
  std::vector<double> points;
  ControlNets<double> control;
  PatchSet<double> set;
};

template <typename V>
void add(Fnv1a& hash, const std::vector<V>& values) {
  hash.add_bytes(values.data(), values.size() * sizeof(V));
}

struct CallCase {
  const char* name;
  std::function<void(const Model&, Fnv1a&)> call;
};

void add_mesh(Fnv1a& hash, const Model& model, const MeshOptions& options) {
  const auto mesh = tessellate<double>(model.control, options);
  hash.add(static_cast<int>(mesh.report.status.code()));
  hash.add(mesh.deviation);
  add(hash, mesh.positions);
  add(hash, mesh.normals);
  add(hash, mesh.triangles);
  add(hash, mesh.deviations);
}

const CallCase kCalls[] = {
    {"tessellate",
     [](const Model& model, Fnv1a& hash) {
       add_mesh(hash, model, {.rates = {.normal_degrees = 40}, .relative_tolerance = 5e-2});
     }},
    {"tessellate, snapped and creased",
     [](const Model& model, Fnv1a& hash) {
       add_mesh(hash, model,
                {.nu = 5, .nv = 4, .topology = {.snap = model.seventh}, .crease_degrees = 17});
     }},
    {"position_errors",
     [](const Model& model, Fnv1a& hash) {
       std::vector<double> errors(model.set.size());
       hash.add(static_cast<int>(position_errors(model.set, std::span<double>(errors)).code()));
       add(hash, errors);
     }},
    {"pixel_tolerances",
     [](const Model& model, Fnv1a& hash) {
       std::vector<double> tolerances(model.set.size());
       const Camera camera{.eye = {0.1, 0.2, 7}, .direction = {0.3, -0.1, -1}};
       const ControlNets<double> nets[] = {model.control};
       hash.add(static_cast<int>(pixel_tolerances<double>(nets, camera, 0.7, tolerances).code()));
       add(hash, tolerances);
     }},
    {"quantisation_box",
     [](const Model& model, Fnv1a& hash) {
       QuantisationBox box;
       const ControlNets<double> nets[] = {model.control};
       hash.add(
           static_cast<int>(quantisation_box<double>(nets, VertexFormat::snorm16, box).code()));
       hash.add_bytes(box.low.data(), sizeof box.low);
       hash.add(box.step);
     }},
    {"flatten",
     [](const Model& model, Fnv1a& hash) {
       const auto rows =
           ControlCurves<double>::packed(model.points.data(), 4 * model.set.size(), 3);
       const auto lines = flatten<double>(rows, model.tolerance);
       hash.add(static_cast<int>(lines.report.status.code()));
       hash.add(lines.deviation);
       add(hash, lines.points);
     }},
    {"find_adjacency",
     [](const Model& model, Fnv1a& hash) {
       std::vector<EdgeLink> links(kPatchEdges * model.set.size());
       hash.add(static_cast<int>(find_adjacency(model.control, links).code()));
       for (const EdgeLink& link : links) {
         hash.add(static_cast<int>(link.kind));
         hash.add(link.patch);
       }
     }},
};

TEST(ModelsEnvironment, CallsAreIndependent) {
  for (const double size : {1.0, 0x1p-1060}) {
    const Model model(size);
    for (const CallCase& test : kCalls) {
      Fnv1a reference;
      test.call(model, reference);
      for (const EnvironmentCase& caller : kEnvironments) {
        Fnv1a found;
        bool untouched = false;
        {
          const ScopedEnvironment environment(caller.rounding, caller.flush);
          test.call(model, found);
          untouched = environment.untouched();
        }
        const std::string where =
            std::string(test.name) + ", size " + std::to_string(size) + ", " + caller.name;
        EXPECT_TRUE(untouched) << where << ": the caller's environment was not restored";
        EXPECT_EQ(found.text(), reference.text()) << where;
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::models_environment_test
