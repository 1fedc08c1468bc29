// Patches of any shape from a file to the results: corners, curvatures, meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::any_shape_test {
namespace {

class AnyShapeTest : public ::testing::TestWithParam<const char*> {};

// The corners of a 2x2 grid are control points, whichever way u and v run in the format.
TEST_P(AnyShapeTest, EvaluatesToItsCorners) {
  for (const std::string precision : {"f32", "f64"}) {
    const Outcome outcome = run(
        {"evaluate", sample_path(GetParam()), "--grid", "2", "--precision", precision, "-o", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const ParsedCsv csv = parse_csv(outcome.out);
    const std::vector<ExpectedPatch> patches = sample_patches(GetParam());
    ASSERT_EQ(csv.rows.size(), patches.size() * 4);
    for (std::size_t k = 0; k < csv.rows.size(); ++k) {
      const ExpectedPatch& patch = patches[k / 4];
      const WeightedPoint corner =
          patch.point(k % 2 == 0 ? 0 : patch.degree_u, k % 4 / 2 == 0 ? 0 : patch.degree_v);
      EXPECT_EQ(csv.rows[k][3], corner.x) << "row " << k;
      EXPECT_EQ(csv.rows[k][4], corner.y) << "row " << k;
      EXPECT_EQ(csv.rows[k][5], corner.z) << "row " << k;
    }
  }
}

// The middle of the patch of degrees 1 in u and 2 in v tells rational from polynomial.
TEST_P(AnyShapeTest, UsesItsWeights) {
  const std::vector<ExpectedPatch> patches = sample_patches(GetParam());
  std::size_t number = 0;
  while (patches[number].point != weighted_point) {
    ++number;
  }
  const ExpectedPatch& patch = patches[number];
  WeightedPoint sum{0, 0, 0, 0};
  for (int j = 0; j <= patch.degree_v; ++j) {
    for (int i = 0; i <= patch.degree_u; ++i) {
      const WeightedPoint point = patch.point(i, j);
      const double binomial = patch.degree_v == 2 && j == 1 ? 2 : 1;
      const double weight = binomial * (patch.rational ? point.w : 1);
      sum = {sum.x + weight * point.x, sum.y + weight * point.y, sum.z + weight * point.z,
             sum.w + weight};
    }
  }
  const Outcome outcome =
      run({"evaluate", sample_path(GetParam()), "--samples", "-", "--precision", "f64", "-o", "-"},
          {.input = "patch,u,v\n" + std::to_string(number) + ",0.5,0.5\n"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const ParsedCsv csv = parse_csv(outcome.out);
  EXPECT_NEAR(csv.rows.at(0).at(3), sum.x / sum.w, 1e-14);
  EXPECT_NEAR(csv.rows.at(0).at(4), sum.y / sum.w, 1e-14);
  EXPECT_NEAR(csv.rows.at(0).at(5), sum.z / sum.w, 1e-14);
}

TEST_P(AnyShapeTest, BecomesTriangles) {
  const TemporaryFolder folder;
  expect_silent_success(run({"tessellate", sample_path(GetParam()), "--no-weld", "--grid", "3x2",
                             "-o", folder.path("out.obj")}));
  const ParsedMesh mesh = parse_obj(read_file(folder.path("out.obj")));
  const std::size_t patches = sample_patches(GetParam()).size();
  EXPECT_EQ(mesh.positions.size(), patches * 6);
  EXPECT_EQ(mesh.normals.size(), patches * 6);
  EXPECT_EQ(mesh.triangles.size(), patches * 4);
}

INSTANTIATE_TEST_SUITE_P(All, AnyShapeTest, ::testing::ValuesIn(kSampleFormats),
                         [](const auto& test) { return std::string(test.param); });

// The paraboloid z = (a u^2 + b v^2) / 2 over the unit square; u^2 has control values 0 0 1.
TEST(Curvature, OfAParaboloid) {
  constexpr double kA = 3;
  constexpr double kB = -2;
  const TemporaryFolder folder;
  std::string text = "1\n2 2\n";
  for (int j = 0; j <= 2; ++j) {
    for (int i = 0; i <= 2; ++i) {
      const double height = ((i == 2 ? kA : 0) + (j == 2 ? kB : 0)) / 2;
      text += number_text(i / 2.0) + " " + number_text(j / 2.0) + " " + number_text(height) + "\n";
    }
  }
  const std::string in = folder.write("in.bpt", text);
  for (const std::string outputs : {"curvature", "position,curvature"}) {
    const Outcome outcome = run(
        {"evaluate", in, "--grid", "5x4", "--precision", "f64", "--outputs", outputs, "-o", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const ParsedCsv csv = parse_csv(outcome.out);
    ASSERT_EQ(csv.rows.size(), 20U);
    for (const auto& row : csv.rows) {
      const double p = kA * row[1];
      const double q = kB * row[2];
      const double w = 1 + p * p + q * q; // do Carmo, 3.3: a graph's curvatures
      const double gaussian = kA * kB / (w * w);
      const double mean = ((1 + q * q) * kA + (1 + p * p) * kB) / (2 * w * std::sqrt(w));
      const double root = std::sqrt(mean * mean - gaussian);
      const double expected[] = {gaussian, mean, mean - root, mean + root};
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(row[row.size() - 4 + k], expected[k], 1e-12) << "at " << row[1] << row[2];
      }
    }
  }
}

TEST(AnyShape, ScatteredSamplesMayComeFromDifferentShapes) {
  const std::string in = sample_path("itd");
  const Outcome grid = run({"evaluate", in, "--grid", "5", "-o", "-"});
  ASSERT_EQ(grid.exit_code, 0) << grid.err;
  const ParsedCsv all = parse_csv(grid.out);
  std::string samples = "patch,u,v\n";
  for (std::size_t k = 0; k < all.rows.size(); ++k) {
    const auto& row = all.rows[k * 31 % all.rows.size()];
    samples += number_text(row[0]) + "," + number_text(row[1]) + "," + number_text(row[2]) + "\n";
  }
  const Outcome scattered = run({"evaluate", in, "--samples", "-", "-o", "-"}, {.input = samples});
  ASSERT_EQ(scattered.exit_code, 0) << scattered.err;
  const ParsedCsv csv = parse_csv(scattered.out);
  ASSERT_EQ(csv.rows.size(), all.rows.size());
  for (std::size_t k = 0; k < all.rows.size(); ++k) {
    EXPECT_EQ(csv.rows[k], all.rows[k * 31 % all.rows.size()]);
  }
}

// What f32 cannot hold is named with its place, weights like coordinates.
TEST(AnyShape, SinglePrecisionNamesWhatItCannotHold) {
  const TemporaryFolder folder;
  const std::string rational = "group 1\n8 1 1\n0 0 0 1\n1 0 0 1\n0 1 0 1\n1 1 0 W\n";
  const std::string points = "4 1\n0 0 0\n1 0 0\n0 1 0\n";
  const struct {
    std::string text, message;
  } cases[] = {
      {replaced(rational, "W", "1e-60"),
       ":6: expected a weight within the range of f32, found 1e-60"},
      {replaced(rational, "W", "1e60"), ":6: expected "},
      {points + "1 1e39 0\n" + replaced(rational, "W", "1"),
       ":5: expected coordinates within the range of f32, found 1e+39"},
  };
  for (const auto& item : cases) {
    const std::string in = folder.write("in.bv", item.text);
    expect_failure(run({"evaluate", in, "-o", "-"}), 1, in + item.message);
    EXPECT_EQ(run({"evaluate", in, "--precision", "f64", "-o", "-"}).exit_code, 0);
  }
}

} // namespace
} // namespace simdbezier::tests::any_shape_test
