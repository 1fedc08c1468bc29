// Certificates of fine meshes, by dense samples of some patches of each model.
#include <string>

#include <gtest/gtest.h>

#include "tests/mesh/support/dense_deviation.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::dense_test {
namespace {

struct DenseCase {
  const char* file;
  double finest; ///< share of the box's diagonal, in the long form
};

/// Finer meshes of the last two have more than 10^8 triangles.
constexpr DenseCase kCases[] = {{"teapot.bpt", 1e-6},    {"gumbo.bez", 1e-6},
                                {"pawn2.bez.gz", 1e-6},  {"teacup.bez", 1e-6},
                                {"bigguy.bez.gz", 1e-5}, {"car4.bez.gz", 1e-5}};

/// How many patches of each model are sampled, at all tolerances; in the short form one at the
/// coarsest.
std::size_t dense_patches() { return by_form<std::size_t>(0, 8); }

template <typename T>
class DenseMeshes : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DenseMeshes, Scalars);

template <typename T>
void expect_certified(const std::vector<PatchPoints>& patches, double relative,
                      std::size_t samples_of) {
  std::vector<T> values;
  std::vector<PatchPoints> rounded = patches; // to what the mesh is of
  for (PatchPoints& patch : rounded) {
    for (auto& row : patch) {
      for (Point& point : row) {
        for (double& value : point) {
          values.push_back(static_cast<T>(value));
          value = static_cast<double>(values.back());
        }
      }
    }
  }
  MeshOptions options;
  options.relative_tolerance = relative;
  options.normals = false;
  options.local_origin = true;
  const auto nets = ControlNets<T>::packed(std::span<const T>(values));
  const MeshPlan<T> plan = plan_mesh<T>(nets, options);
  if (std::is_same_v<T, float> && plan.report.status == Status::bad_tolerance) {
    EXPECT_LT(relative, 1e-5) << "a few roundings of a float are more than this only";
    return;
  }
  ASSERT_EQ(plan.report.status, Status::ok) << "patch " << plan.report.item;
  const Mesh<T> mesh = tessellate<T>(nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_LE(mesh.deviation, relative * plan.diagonal);
  double found = 0;
  for (std::size_t k = 0; k < samples_of; ++k) {
    const std::size_t p = k * patches.size() / samples_of;
    const double own = found_deviation(plan, mesh, rounded[p], p, 3);
    EXPECT_LE(own, plan.deviations[p]) << "patch " << p;
    found = std::max(found, own / plan.deviations[p]);
  }
  EXPECT_GT(found, 0.1) << "a certificate that says next to nothing";
}

TYPED_TEST(DenseMeshes, are_as_close_as_certified) {
  for (const DenseCase& one : kCases) {
    const std::vector<PatchPoints> patches = patches_of(data_nets(one.file));
    if (patches.empty()) {
      GTEST_SKIP() << "no data";
    }
    const std::size_t samples_of = std::min(dense_patches(), patches.size());
    const double finest = samples_of == 0 ? 1e-4 : one.finest;
    for (const double relative : {1e-4, 1e-5, 1e-6}) {
      if (relative >= 0.99 * finest) {
        SCOPED_TRACE(std::string(one.file) + ", " + std::to_string(relative * 1e6) + "e-6");
        expect_certified<TypeParam>(patches, relative, std::max<std::size_t>(samples_of, 1));
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::dense_test
