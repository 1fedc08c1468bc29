// Patches as Bézier cells in files of VTK. vtk_test.cpp lets VTK evaluate them.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::bezier_cells_test {
namespace {

using Strings = std::vector<std::string>;

// The number of a cell's point (i, j), by counting the points that VTK has in front of it.
std::size_t vtk_point(std::size_t i, std::size_t j, std::size_t n, std::size_t m) {
  const bool at_u = i == 0 || i == n;
  const bool at_v = j == 0 || j == m;
  if (at_u && at_v) {
    return j == 0 ? (i == 0 ? 0 : 1) : (i == 0 ? 3 : 2);
  }
  const std::size_t along = n - 1;
  const std::size_t across = m - 1;
  if (at_v) {
    return 4 + (j == 0 ? 0 : along + across) + i - 1;
  }
  if (at_u) {
    return 4 + (i == n ? along : 2 * along + across) + j - 1;
  }
  return 4 + 2 * (along + across) + (j - 1) * along + i - 1;
}

TEST(BezierCells, AreThePatchesOfTheFile) {
  for (const std::string format : kSampleFormats) {
    for (const std::string precision : {"f32", "f64"}) {
      const ReadMesh mesh = read_vtu_mesh(
          tessellated(sample_path(format), "vtu", {"--cells", "bezier", "--precision", precision}));
      const std::vector<ExpectedPatch> patches = sample_patches(format);
      const bool rational = std::ranges::any_of(patches, &ExpectedPatch::rational);
      EXPECT_EQ(mesh.attributes.at("CellData.HigherOrderDegrees"), "HigherOrderDegrees");
      EXPECT_EQ(mesh.attributes.contains("PointData.RationalWeights"), rational);
      EXPECT_EQ(mesh.position_type, precision == "f32" ? "Float32" : "Float64");
      EXPECT_EQ(mesh.deviation, 0) << "all of these numbers are floats, and quotients exact";
      EXPECT_FALSE(mesh.generator.empty());
      ASSERT_EQ(mesh.faces.size(), patches.size());
      std::size_t first = 0;
      for (std::size_t p = 0; p < patches.size(); ++p) {
        const auto n = static_cast<std::size_t>(patches[p].degree_u);
        const auto m = static_cast<std::size_t>(patches[p].degree_v);
        EXPECT_EQ(mesh.cell_types[p], 77);
        EXPECT_EQ(mesh.data.at("HigherOrderDegrees")[3 * p], n);
        EXPECT_EQ(mesh.data.at("HigherOrderDegrees")[3 * p + 1], m);
        ASSERT_EQ(mesh.faces[p].size(), (n + 1) * (m + 1));
        for (std::size_t j = 0; j <= m; ++j) {
          for (std::size_t i = 0; i <= n; ++i) {
            const std::size_t k = mesh.faces[p][vtk_point(i, j, n, m)];
            EXPECT_EQ(k, first + vtk_point(i, j, n, m));
            const WeightedPoint point = patches[p].point(static_cast<int>(i), static_cast<int>(j));
            EXPECT_EQ(mesh.positions[k], (std::array<double, 3>{point.x, point.y, point.z}));
            if (rational) {
              EXPECT_EQ(mesh.data.at("RationalWeights")[k], patches[p].rational ? point.w : 1);
            }
          }
        }
        first += (n + 1) * (m + 1);
      }
      EXPECT_EQ(mesh.positions.size(), first);
    }
  }
}

std::string bilinear(const std::string& kind, const std::string& scale, const std::string& weight) {
  std::string text = kind + "\n1 1\n";
  for (const char* const point : {"0 0 0", "1 0 0", "0 1 0", "1 1 0"}) {
    std::istringstream values(point);
    for (std::string value; values >> value;) {
      text += (value == "0" ? value : scale) + " ";
    }
    text += weight + "\n";
  }
  return text;
}

struct DeviationCase {
  const char* name;
  std::string text;
  Strings options;
  double least;
  double most;
};

TEST(BezierCells, StateWhatRoundingDoes) {
  const DeviationCase cases[] = {
      {"exact", bilinear("5", "0.5", ""), {}, 0, 0},
      {"no float", bilinear("5", "0.1", ""), {}, 1e-9, 4e-9},
      {"double", bilinear("5", "0.1", ""), {"--precision", "f64"}, 0, 0},
      {"stored as float",
       bilinear("5", "0.1", ""),
       {"--precision", "f64", "--vertex-precision", "f32"},
       1e-9,
       4e-9},
      {"halved", bilinear("8", "1", "2"), {}, 0, 0},
      {"a third", bilinear("8", "1", "3"), {"--precision", "f64"}, 1e-17, 1e-16},
      {"weight of no float", bilinear("8", "0.1", "0.1"), {}, 1e-9, 1e-7},
      {"moved",
       bilinear("5", "1e6", ""),
       {"--origin", "0.1,0,0", "--precision", "f64"},
       1e-17,
       1e-9}};
  for (const DeviationCase& item : cases) {
    const TemporaryFolder folder;
    const std::string out = folder.path("out.vtu");
    Strings arguments = {"tessellate", folder.write("in.bv", item.text), "-o", out, "--cells",
                         "bezier"};
    arguments.insert(arguments.end(), item.options.begin(), item.options.end());
    EXPECT_EQ(run(arguments).exit_code, 0) << item.name;
    const ReadMesh mesh = read_vtu_mesh(read_file(out));
    ASSERT_TRUE(mesh.deviation) << item.name;
    EXPECT_GE(*mesh.deviation, item.least) << item.name;
    EXPECT_LE(*mesh.deviation, item.most) << item.name;
  }
}

TEST(BezierCells, AreCountedByStats) {
  const TemporaryFolder folder;
  const Outcome outcome = run({"tessellate", "builtin:teapot", "--cells", "bezier", "--no-weld",
                               "--stats=json", "-o", folder.path("out.vtu")});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* const line :
       {"\"patches\": 32", "\"vertices\": 512", "\"triangles\": 0", "\"open_edges\": 120"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
  }
}

TEST(BezierCells, RefuseWhatTheyCannotHold) {
  struct Refused {
    std::string text;
    Strings options;
    std::string message;
  };
  const Refused cases[] = {
      {bilinear("8", "1e-40", "1e-40"),
       {},
       "expected weights that a float can hold with all digits"},
      {bilinear("8", "1e39", "1e39"), {}, "expected weights that a float can hold with all digits"},
      {bilinear("5", "1e39", ""), {}, "expected coordinates that a float can hold, found 1e+39"},
      {bilinear("8", "1e-320", "1e-320"),
       {"--precision", "f64"},
       "expected weights that a double can hold with all digits"},
      {bilinear("5", "1e-46", ""), {}, "expected a mesh larger than the error of storing"}};
  for (const Refused& item : cases) {
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bv", item.text);
    Strings arguments = {"tessellate", in, "--cells", "bezier", "-o", folder.path("out.vtu")};
    arguments.insert(arguments.end(), item.options.begin(), item.options.end());
    expect_failure(run(arguments), 1, item.message);
    EXPECT_EQ(folder.names(), Strings{"in.bv"});
  }
}

TEST(BezierCells, TakeNoOptionsOfTriangles) {
  const Strings cases[] = {{"--grid", "4"},     {"--tolerance", "1"},
                           {"--relative", "1"}, {"--angle", "5"},
                           {"--weld"},          {"--snap", "1"},
                           {"--split-edges"},   {"--point-size", "1"},
                           {"--crease", "3"},   {"--orient"},
                           {"--flip"},          {"--drop-repeated"},
                           {"--quads"},         {"--parameters"},
                           {"--curvature"},     {"--pixels", "1", "--camera", "9,0,0,0,0,0"}};
  for (const Strings& options : cases) {
    Strings arguments = {"tessellate", "builtin:teapot", "-o", "out.vtu", "--cells", "bezier"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_failure(run(arguments), 2, options[0] + ": expected without --cells bezier, found both");
  }
  const std::pair<Strings, std::string> others[] = {
      {{"-o", "out.ply", "--cells", "bezier"},
       "--cells bezier: expected an output in vtu, found ply"},
      {{"-o", "out.vtu", "--cells", "quads"},
       "--cells: expected bezier or triangles, found 'quads'"},
      {{"-o", "out.glb", "--curvature"}, "--curvature: expected an output in vtu, found glb"}};
  for (const auto& [options, message] : others) {
    Strings arguments = {"tessellate", "builtin:teapot"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_failure(run(arguments), 2, message);
  }
  const Strings triangles = {"--cells", "triangles", "--grid", "3"};
  EXPECT_EQ(tessellated("builtin:teapot", "vtu", triangles),
            tessellated("builtin:teapot", "vtu", {"--grid", "3"}));
}

} // namespace
} // namespace simdbezier::tests::bezier_cells_test
