// simdbezier tessellate --no-weld: what it writes, read back by parsers of our own.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::tessellate_test {
namespace {

ParsedMesh tessellate(const std::string& in, const std::string& extension,
                      const std::vector<std::string>& options = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"tessellate", in, "--no-weld", "-o",
                                        folder.path("out." + extension)};
  arguments.insert(arguments.end(), options.begin(), options.end());
  expect_silent_success(run(arguments));
  const std::string bytes = read_file(folder.path("out." + extension));
  return extension == "obj" ? parse_obj(bytes) : parse_ply(bytes);
}

Vector3 difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector3 cross_product(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot_product(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Twice the triangle's area times its normal by the right-hand rule.
Vector3 turn(const ParsedMesh& mesh, const std::array<std::size_t, 3>& triangle) {
  const Vector3& a = mesh.positions[triangle[0]];
  return cross_product(difference(mesh.positions[triangle[1]], a),
                       difference(mesh.positions[triangle[2]], a));
}

struct Format {
  const char* name;
  const char* extension;
  const char* precision;
  bool normals;
};
void PrintTo(const Format& item, std::ostream* out) { *out << item.name; }

class MeshTest : public ::testing::TestWithParam<Format> {
protected:
  static ParsedMesh mesh(const std::string& in, const std::string& grid) {
    std::vector<std::string> options = {"--precision", GetParam().precision, "--grid", grid};
    if (!GetParam().normals) {
      options.push_back("--no-normals");
    }
    return tessellate(in, GetParam().extension, options);
  }
};

TEST_P(MeshTest, HasEveryVertexAndTriangleOnce) {
  const ParsedMesh teapot = mesh("builtin:teapot", "7x5");
  EXPECT_EQ(teapot.positions.size(), 32U * 7 * 5);
  EXPECT_EQ(teapot.normals.size(), GetParam().normals ? teapot.positions.size() : 0);
  EXPECT_EQ(teapot.triangles.size(), 32U * 6 * 4 * 2);
  if (std::string(GetParam().extension) == "ply") {
    EXPECT_EQ(teapot.scalar, std::string(GetParam().precision) == "f32" ? "float" : "double");
  }
}

TEST_P(MeshTest, LiesOnTheSurfaceInGridOrder) {
  const TemporaryFolder folder;
  const std::vector<Net> nets = {flat_net(), flat_net(), flat_net()};
  const ParsedMesh flat = mesh(folder.write("in.bez", bez_text(nets)), "5x3");
  ASSERT_EQ(flat.positions.size(), 45U);
  for (std::size_t k = 0; k < 45; ++k) {
    const Vector3 expected = {static_cast<double>(k % 5) / 4, static_cast<double>(k % 15 / 5) / 2,
                              0};
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(flat.positions[k][c], expected[c], 1e-6) << "vertex " << k;
    }
    if (GetParam().normals) {
      EXPECT_EQ(flat.normals.at(k), (Vector3{0, 0, 1})) << "vertex " << k;
    }
  }
}

TEST_P(MeshTest, CoversThePlaneCounterClockwise) {
  const TemporaryFolder folder;
  const std::vector<Net> nets = {flat_net()};
  const ParsedMesh flat = mesh(folder.write("in.bez", bez_text(nets)), "9x6");
  double area = 0;
  for (const auto& triangle : flat.triangles) {
    const double z = turn(flat, triangle)[2];
    EXPECT_NEAR(z, 1.0 / (8 * 5), 1e-6);
    area += z / 2;
  }
  EXPECT_NEAR(area, 1, 1e-5);
}

TEST_P(MeshTest, TurnsCounterClockwiseAboutItsNormals) {
  if (!GetParam().normals) {
    GTEST_SKIP() << "this mesh has no normals";
  }
  const ParsedMesh teapot = mesh("builtin:teapot", "16");
  for (const auto& triangle : teapot.triangles) {
    const Vector3 around = turn(teapot, triangle);
    if (dot_product(around, around) < 1e-12) {
      continue; // at a collapsed edge
    }
    for (const std::size_t corner : triangle) {
      EXPECT_GT(dot_product(around, teapot.normals[corner]), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, MeshTest,
    ::testing::Values(Format{"ObjF32", "obj", "f32", true}, Format{"ObjF64", "obj", "f64", true},
                      Format{"ObjBare", "obj", "f32", false}, Format{"PlyF32", "ply", "f32", true},
                      Format{"PlyF64", "ply", "f64", true}, Format{"PlyBare", "ply", "f64", false}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Tessellate, BothFormatsHoldTheSameNumbers) {
  for (const std::string precision : {"f32", "f64"}) {
    const std::vector<std::string> options = {"--precision", precision, "--grid", "9x8"};
    const ParsedMesh obj = tessellate("builtin:teapot", "obj", options);
    const ParsedMesh ply = tessellate("builtin:teapot", "ply", options);
    EXPECT_EQ(obj.triangles, ply.triangles);
    // Text may carry a float by fewer digits than its double has.
    for (std::size_t k = 0; precision == "f32" && k < obj.positions.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(static_cast<float>(obj.positions[k][c]), static_cast<float>(ply.positions[k][c]));
        EXPECT_EQ(static_cast<float>(obj.normals[k][c]), static_cast<float>(ply.normals[k][c]));
      }
    }
    if (precision == "f64") {
      EXPECT_EQ(obj.positions, ply.positions);
      EXPECT_EQ(obj.normals, ply.normals);
    }
  }
}

TEST(Tessellate, DefaultsToSixteenSquaredInFloat) {
  const ParsedMesh mesh = tessellate("builtin:teapot", "ply");
  EXPECT_EQ(mesh.positions.size(), 32U * 256);
  EXPECT_EQ(mesh.normals.size(), 32U * 256);
  EXPECT_EQ(mesh.scalar, "float");
}

TEST(Tessellate, GridsLargerThanABlockAreTheSameSurface) {
  // 700x600 samples are evaluated in pieces; they must be what evaluate gives for single samples.
  const TemporaryFolder folder;
  std::vector<Net> nets = {distinct_net(1), distinct_net(2)};
  for (Net& net : nets) { // bumps, for each normal of a line takes the library's second look
    for (std::size_t k = 0; k < net.points.size(); ++k) {
      net.points[k][1] = static_cast<double>(k / 4);
      net.points[k][2] = 0.2 * static_cast<double>(k * 7 % 5);
    }
  }
  const std::string in = folder.write("in.bez", bez_text(nets));
  const ParsedMesh mesh = tessellate(in, "ply", {"--grid", "700x600", "--precision", "f64"});
  ASSERT_EQ(mesh.positions.size(), 2U * 700 * 600);
  std::string samples = "patch,x,y\n";
  std::vector<std::size_t> vertices;
  for (std::size_t k = 0; k < mesh.positions.size(); k += 997) {
    const auto i = static_cast<int>(k % 700);
    const auto j = static_cast<int>(k % 420000 / 700);
    samples += std::to_string(k / 420000) + "," + number_text((2 * i - 699) / 699.0) + "," +
               number_text((2 * j - 599) / 599.0) + "\n";
    vertices.push_back(k);
  }
  const Outcome outcome = run({"evaluate", in, "--samples", folder.write("s.csv", samples),
                               "--precision", "f64", "--outputs", "position,normal", "-o", "-"});
  const ParsedCsv csv = parse_csv(outcome.out);
  ASSERT_EQ(csv.rows.size(), vertices.size());
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(csv.rows[row][3 + c], mesh.positions[vertices[row]][c]);
      EXPECT_EQ(csv.rows[row][6 + c], mesh.normals[vertices[row]][c]);
    }
  }
}

TEST(Tessellate, ThreadsDoNotChangeTheFile) {
  const TemporaryFolder folder;
  const std::string one = folder.path("one.ply");
  expect_silent_success(
      run({"tessellate", "builtin:teapot", "--no-weld", "--threads", "1", "-o", one}));
  for (const char* const threads : {"0", "2", "3", "7"}) {
    const std::string many = folder.path("many.ply");
    expect_silent_success(
        run({"tessellate", "builtin:teapot", "--no-weld", "--threads", threads, "-o", many}));
    EXPECT_TRUE(read_file(one) == read_file(many)) << threads << " threads";
  }
}

} // namespace
} // namespace simdbezier::tests::tessellate_test
