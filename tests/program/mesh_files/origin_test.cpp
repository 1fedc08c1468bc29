// Models far from 0 and tiny ones: what formats round counts, and meshes may have an origin of
// their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::origin_test {
namespace {

using Point = std::array<double, 3>;
using Words = std::vector<std::string>;

// Half of a cylinder of radius 1 about the axis through this point along z, as two rational patches
// that share an edge. Offsets are whole numbers and weights powers of two where that is possible,
// so that the file says what it means.
constexpr Point kCentre = {500000.25, -300000.5, 64};
const double kHalf = std::sqrt(0.5);
constexpr double kArc[5][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};

std::string text_of(const Point& point, double weight, bool homogeneous) {
  std::string text;
  for (const double value : point) {
    text += number_text(homogeneous ? value * weight : value) + " ";
  }
  return text + number_text(weight) + "\n";
}

std::string cylinder(const std::string& format) {
  std::string text = format == "obj" ? "cstype rat bezier\ndeg 1 2\n" : "";
  const auto point = [&](int k, int z) {
    text += format == "obj" ? "v " : "";
    text += text_of({kCentre[0] + kArc[k][0], kCentre[1] + kArc[k][1], kCentre[2] + z},
                    k % 2 == 1 ? kHalf : 1, format != "obj");
  };
  if (format == "obj") { // with shared vertices
    for (int k = 0; k < 10; ++k) {
      point(k / 2, k % 2);
    }
    return text + "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 1\nparm v 0 1\nend\n"
                  "surf 0 1 0 1 5 6 7 8 9 10\nparm u 0 1\nparm v 0 1\nend\n";
  }
  for (const int first : {0, 2}) {
    text += "8\n2 1\n";
    for (int k = 0; k < 6; ++k) {
      point(first + k / 2, k % 2);
    }
  }
  return text;
}

// Where programs put the vertices, relative to the cylinder's centre.
std::vector<Point> places(const ReadMesh& mesh) {
  const Point origin = mesh.origin.value_or(Point{});
  std::vector<Point> result = mesh.positions;
  for (Point& place : result) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = mesh.quantised ? place[c] / 65535 : place[c];
      place[c] = (mesh.translation[c] + origin[c] - kCentre[c]) + mesh.scale * value;
    }
  }
  return result;
}

struct Stored {
  const char* name;
  const char* extension;
  Words options;
  bool fits_at_zero; ///< whether floats are no part of it, so that no origin is needed
};
void PrintTo(const Stored& item, std::ostream* out) { *out << item.name; }

const Stored kStored[] = {
    {"ObjF32", "obj", {}, false},
    {"PlyF32", "ply", {}, false},
    {"StlF32", "stl", {}, false},
    {"GlbF32", "glb", {}, false},
    {"Quantised16F32", "glb", {"--quantise", "16"}, false},
    {"ObjF64", "obj", {"--precision", "f64"}, true},
    {"PlyF64", "ply", {"--precision", "f64"}, true},
    {"StlF64", "stl", {"--precision", "f64"}, false},
    {"GlbF64", "glb", {"--precision", "f64"}, false},
    {"Quantised8F64", "glb", {"--precision", "f64", "--quantise", "8"}, false},
    {"FloatObj", "obj", {"--precision", "f64", "--vertex-precision", "f32"}, false},
    {"FloatPly", "ply", {"--precision", "f64", "--vertex-precision", "f32"}, false},
    {"DoublePly", "ply", {"--precision", "f64", "--vertex-precision", "f64"}, true},
    {"RawF32", "raw", {}, false},
    {"RawF64", "raw", {"--precision", "f64"}, true},
    {"VtuF32", "vtu", {}, false},
    {"VtuF64", "vtu", {"--precision", "f64"}, true},
    {"FloatVtu", "vtu", {"--precision", "f64", "--vertex-precision", "f32"}, false},
};

class FarModel : public ::testing::TestWithParam<Stored> {
protected:
  // Runs tessellate on a model, and returns what it said and wrote.
  static std::pair<Outcome, std::string> made(const std::string& format, const Words& options,
                                              const char* tolerance = "0.001") {
    const TemporaryFolder folder;
    const std::string out = folder.path(std::string("out.") + GetParam().extension);
    Words arguments = {"tessellate",  folder.write("in." + format, cylinder(format)),
                       "--tolerance", tolerance,
                       "-o",          out};
    arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(folder.names().size(), outcome.exit_code == 0 ? 2U : 1U);
    return {outcome, outcome.exit_code == 0 ? read_file(out) : ""};
  }

  static void expect_cylinder(const std::string& bytes, double tolerance) {
    const ReadMesh mesh = read_mesh(GetParam().extension, bytes);
    ASSERT_TRUE(mesh.deviation);
    EXPECT_LE(*mesh.deviation, tolerance);
    EXPECT_GT(mesh.faces.size(), 30U);
    for (const Point& place : places(mesh)) {
      EXPECT_NEAR(std::hypot(place[0], place[1]), 1, *mesh.deviation);
      EXPECT_GE(place[1], -*mesh.deviation);
      EXPECT_LE(std::abs(place[2] - 0.5), 0.5 + *mesh.deviation);
    }
  }
};

TEST_P(FarModel, IsWithinItsToleranceAroundAnOriginOfItsOwn) {
  for (const std::string format : {"bv", "obj"}) {
    for (const std::string origin : {"auto", "500000,-300000,64.5", "500001.3,-300000.1,1e-3"}) {
      const auto [outcome, bytes] = made(format, {"--origin", origin});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      expect_cylinder(bytes, 0.001);
      const ReadMesh mesh = read_mesh(GetParam().extension, bytes);
      const bool by_node = std::string(GetParam().extension) == "glb";
      EXPECT_EQ(mesh.origin.has_value(), !by_node);
      EXPECT_EQ(outcome.err.starts_with("simdbezier: positions count from the origin "), !by_node)
          << outcome.err;
      if (by_node) {
        EXPECT_NEAR(mesh.translation[0], kCentre[0], 2);
      }
    }
  }
}

TEST_P(FarModel, IsWithinItsToleranceOrRefusedAtZero) {
  for (const Words& none : {Words{}, {"--origin", "none"}, {"--origin", "0,-0,0"}}) {
    const auto [outcome, bytes] = made("bv", none);
    if (GetParam().fits_at_zero) {
      EXPECT_EQ(outcome.err, "");
      expect_cylinder(bytes, 0.001);
    } else {
      expect_failure(outcome, 1,
                     "--tolerance: expected a distance above the error of rounding, 0.");
      EXPECT_NE(outcome.err.find(" (--origin auto makes it smaller), found 0.001 for patch 0 of"),
                std::string::npos)
          << outcome.err;
    }
  }
}

// Tolerances just above what is stored: they are kept, not nearly kept.
TEST_P(FarModel, KeepsTolerancesNextToRounding) {
  std::size_t kept = 0;
  for (const char* const tolerance :
       {"0.9", "0.5", "0.3", "0.15", "0.12", "0.1", "0.09", "0.08", "0.07", "0.06"}) {
    const auto [outcome, bytes] = made("bv", {}, tolerance);
    if (outcome.exit_code == 0) {
      const ReadMesh mesh = read_mesh(GetParam().extension, bytes);
      EXPECT_LE(*mesh.deviation, std::strtod(tolerance, nullptr));
      for (const Point& place : places(mesh)) {
        EXPECT_NEAR(std::hypot(place[0], place[1]), 1, *mesh.deviation) << tolerance;
      }
      ++kept;
    }
  }
  EXPECT_GT(kept, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, FarModel, ::testing::ValuesIn(kStored),
                         [](const auto& test) { return std::string(test.param.name); });

std::string square(const std::string& x, const std::string& size) {
  const double first = std::strtod(x.c_str(), nullptr);
  const std::string last = number_text(first + std::strtod(size.c_str(), nullptr));
  return "1\n1 1\n" + x + " 0 0\n" + last + " 0 0\n" + x + " " + size + " 0\n" + last + " " + size +
         " " + size + "\n";
}

// Sizes below the smallest float: whole where there are doubles, and refused elsewhere, by the
// tolerance or where there is none.
TEST(TinyModel, IsWholeOrRefused) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bpt", square("0", "1e-100"));
  for (const char* const name :
       {"out.obj", "out.ply", "out.stl", "out.glb", "out.vtu", "out.raw"}) {
    for (const Words& finer :
         {Words{"--relative", "1e-2"}, {"--grid", "3"}, {"--grid", "3", "--no-weld"}}) {
      const std::string out = folder.path(name);
      Words arguments = {"tessellate", in, "-o", out, "--precision", "f64"};
      arguments.insert(arguments.end(), finer.begin(), finer.end());
      const Outcome outcome = run(arguments);
      const std::string extension = std::string(name).substr(4);
      if (extension == "stl" || extension == "glb") {
        expect_failure(outcome, 1,
                       finer[0] == "--relative"
                           ? "--relative: expected a distance above the error of rounding, "
                           : "expected a mesh larger than the error of storing its vertices, ");
        continue;
      }
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      double largest = 0;
      for (const Point& place : read_mesh(extension, read_file(out)).positions) {
        largest = std::max(largest, place[2]);
      }
      EXPECT_EQ(largest, 1e-100);
      std::filesystem::remove(out);
    }
  }
  EXPECT_EQ(folder.names(), Words{"in.bpt"});
}

// A point has no size that storing could lose, wherever it is.
TEST(TinyModel, MayBeOnePoint) {
  const TemporaryFolder folder;
  for (const std::string point : {"0.1 2 -3\n", "1e6 0.1 0\n", "0 0 0\n", "1e-100 0 1e-60\n"}) {
    const std::string in = folder.write("in.bpt", "1\n1 1\n" + point + point + point + point);
    for (const std::string extension : {"obj", "ply", "stl", "glb", "vtu", "raw"}) {
      for (const char* const precision : {"f32", "f64"}) {
        for (const Words& more : {Words{}, {"--no-weld"}, {"--quantise", "16"}}) {
          if (extension != "glb" && !more.empty() && more[0] == "--quantise") {
            continue;
          }
          Words options = {"--grid", "3", "--precision", precision};
          options.insert(options.end(), more.begin(), more.end());
          SCOPED_TRACE(point + extension + " " + precision + (more.empty() ? "" : " " + more[0]));
          const ReadMesh mesh = read_mesh(extension, tessellated(in, extension, options));
          ASSERT_FALSE(mesh.positions.empty());
          std::istringstream text(point);
          for (std::size_t c = 0; c < 3; ++c) {
            double expected = 0;
            text >> expected;
            const double value =
                mesh.quantised ? mesh.positions[0][c] / 65535 : mesh.positions[0][c];
            EXPECT_NEAR(mesh.translation[c] + mesh.scale * value, expected,
                        1e-6 * std::abs(expected) + 1e-45);
          }
        }
      }
    }
  }
}

// The middle in few digits, so that coordinates lose none.
TEST(OwnOrigin, KeepsDigitsOfPoints) {
  const TemporaryFolder folder;
  for (const std::string x : {"0", "1", "-3000.5", "500000.015", "1e15", "-1e300"}) {
    const double first = std::strtod(x.c_str(), nullptr);
    const std::string size = number_text(std::max(1.0, std::abs(first) * 0x1p-20));
    const std::string in = folder.write("in.bpt", square(x, size));
    const std::string out = folder.path("out.ply");
    const Outcome outcome = run({"tessellate", in, "-o", out, "--grid", "2", "--precision", "f64",
                                 "--origin", "auto", "--stats=json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const ReadMesh mesh = read_ply_mesh(read_file(out));
    ASSERT_TRUE(mesh.origin) << x;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["origin"].get<Point>(), *mesh.origin);
    double least = std::numeric_limits<double>::infinity();
    for (const Point& place : mesh.positions) {
      least = std::min(least, place[0] + (*mesh.origin)[0]);
    }
    EXPECT_EQ(least, first);
    EXPECT_LE(std::abs(mesh.positions.front()[0]), std::strtod(size.c_str(), nullptr));
  }
}

TEST(OwnOrigin, ThatIsTooFarIsRefused) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bpt", square("1e308", "1"));
  expect_failure(run({"tessellate", in, "-o", folder.path("out.obj"), "--origin", "-1.7e308,0,0"}),
                 1,
                 "--origin: expected an origin whose distance from all points a double can hold");
  EXPECT_EQ(folder.names(), Words{"in.bpt"});
}

// The file's own points fit floats; the origin is at fault, whichever command moves them.
TEST(OwnOrigin, ThatMovesPointsOutOfFloatsIsNamed) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bpt", square("1", "1"));
  const std::string message = "--origin: expected an origin whose distance from all points f32 can "
                              "hold, found 1e+300 from " +
                              in + ":3\n";
  for (const Words& more : {Words{}, {"--no-weld"}, {"--shard", "1/1"}}) {
    Words arguments = {"tessellate", in, "-o", folder.path("out.ply"), "--origin=-1e300,0,0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_failure(run(arguments), 1, message);
  }
  EXPECT_EQ(folder.names(), Words{"in.bpt"});
}

// A picture stays what it is when everything counts from another point.
TEST(OwnOrigin, MovesTheCameraAsWell) {
  const TemporaryFolder folder;
  const auto triangles = [&](const std::string& camera, const std::string& origin) {
    const Outcome outcome =
        run({"tessellate", "builtin:teapot", "--pixels", "0.5", "--precision", "f64",
             "--stats=json", "--camera", camera, "--origin", origin, "-o", folder.path("out.stl")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false).value("triangles", std::size_t{0});
  };
  const std::size_t expected = triangles("8,0,2,0,0,1.5", "none");
  EXPECT_EQ(triangles("8,0,2,0,0,1.5", "4,-2,0.5"), expected);
  EXPECT_NE(triangles("9,0,2,0,0,1.5", "none"), expected) << "it would not show";
}

TEST(OwnOrigin, OfManyPatchesLeavesThemOneMesh) {
  const ReadMesh at_zero = welded("builtin:teapot", {"--precision", "f64"});
  const TemporaryFolder folder;
  for (const char* const origin : {"auto", "1000,2000,3000", "0.1,0.2,0.3"}) {
    const std::string out = folder.path("out.ply");
    ASSERT_EQ(
        run({"tessellate", "builtin:teapot", "-o", out, "--precision", "f64", "--origin", origin})
            .exit_code,
        0);
    const ReadMesh mesh = read_ply_mesh(read_file(out));
    ASSERT_EQ(mesh.positions.size(), at_zero.positions.size()) << origin;
    EXPECT_EQ(mesh.faces.size(), at_zero.faces.size()); // equal diagonals may change places
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(mesh.positions[k][c] + (*mesh.origin)[c], at_zero.positions[k][c], 1e-11);
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::origin_test
