// simdbezier tessellate: meshes without gaps, as independent readers find them in files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::welded_mesh_test {
namespace {

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Twice the area times the normal.
Point turn(const ReadMesh& mesh, const std::vector<std::uint32_t>& face, std::size_t c = 2) {
  const Point& a = mesh.positions[face[0]];
  return cross(mesh.positions[face[c - 1]] - a, mesh.positions[face[c]] - a);
}

const std::vector<std::vector<std::string>> kResolutions = {
    {"--grid", "2"},
    {"--grid", "5x4"},
    {},
    {"--relative", "1e-1"},
    {"--relative", "1e-3"},
    {"--relative", "1e-3", "--thorough"},
    {"--angle", "20"},
    {"--relative", "1e-3", "--precision", "f64"}};

class WeldedModel : public ::testing::TestWithParam<MeshModel> {};

TEST_P(WeldedModel, HangsTogetherAsTheModelDoes) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez", bez_of(GetParam()));
  for (const std::vector<std::string>& options : kResolutions) {
    SCOPED_TRACE(options.empty() ? "" : options[0] + " " + options[1]);
    const ReadMesh mesh = welded(in, options);
    const TriangleCensus census = census_of(mesh);
    EXPECT_EQ(census.degenerate, 0U);
    EXPECT_EQ(census.unused, 0U);
    EXPECT_EQ(census.repeated > 0, GetParam().repeated); // their meshes coincide
    if (GetParam().repeated) {
      continue;
    }
    EXPECT_EQ(census.crowded > 0, !GetParam().manifold);
    if (GetParam().manifold) {
      EXPECT_EQ(census.loops, GetParam().loops);
      EXPECT_EQ(census.euler, GetParam().euler);
    }
    EXPECT_EQ(census.disagreeing > 0, !GetParam().agree);
    EXPECT_GT(mesh.deviation.value_or(0), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, WeldedModel, ::testing::ValuesIn(mesh_models()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name + std::to_string(test.index);
                         });

TEST(WeldedMesh, HasEveryPositionOfTheTeapotOnce) {
  const ReadMesh mesh = welded("builtin:teapot", {"--grid", "32"});
  const std::set<Point> different(mesh.positions.begin(), mesh.positions.end());
  // Vertices that touch in a point without an edge in common stay apart: there is one such pair.
  EXPECT_EQ(different.size(), 30877U);
  EXPECT_EQ(mesh.positions.size(), 30878U);
  for (const auto& face : mesh.faces) {
    EXPECT_GT(dot(turn(mesh, face), turn(mesh, face)), 0);
  }
}

TEST(WeldedMesh, HasFewerTrianglesByAThoroughSearch) {
  const ReadMesh usual = welded("builtin:teapot", {"--relative", "1e-3"});
  const ReadMesh thorough = welded("builtin:teapot", {"--relative", "1e-3", "--thorough"});
  EXPECT_LT(5 * thorough.faces.size(), 4 * usual.faces.size());
  ASSERT_TRUE(thorough.deviation && usual.deviation);
  EXPECT_LE(*thorough.deviation, 1.05 * *usual.deviation);
}

TEST(WeldedMesh, IsOneMeshInAllFormats) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--grid", "6"}, {"--relative", "1e-3"}}) {
    const ReadMesh ply = welded("builtin:teapot", options);
    const ReadMesh obj = read_obj_mesh(tessellated("builtin:teapot", "obj", options));
    const ReadMesh glb = read_glb_mesh(tessellated("builtin:teapot", "glb", options));
    const ReadMesh stl = read_stl_mesh(tessellated("builtin:teapot", "stl", options));
    EXPECT_EQ(glb.positions, ply.positions);
    EXPECT_EQ(glb.normals, ply.normals);
    EXPECT_EQ(glb.faces, ply.faces);
    EXPECT_EQ(obj.faces, ply.faces);
    ASSERT_EQ(stl.faces.size(), ply.faces.size());
    for (std::size_t k = 0; k < ply.faces.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(stl.positions[3 * k + c], ply.positions[ply.faces[k][c]]);
      }
    }
    for (const ReadMesh& mesh : {ply, obj, glb, stl}) {
      EXPECT_EQ(mesh.deviation, ply.deviation);
      EXPECT_NE(mesh.generator.find("simdbezier "), std::string::npos);
    }
  }
}

TEST(WeldedMesh, FlipTurnsFacesAndNormals) {
  const ReadMesh mesh = welded("builtin:teapot", {"--grid", "5"});
  const ReadMesh flipped = welded("builtin:teapot", {"--grid", "5", "--flip"});
  ASSERT_EQ(flipped.positions, mesh.positions);
  for (std::size_t k = 0; k < mesh.normals.size(); ++k) {
    EXPECT_EQ(flipped.normals[k],
              (Point{0 - mesh.normals[k][0], 0 - mesh.normals[k][1], 0 - mesh.normals[k][2]}));
  }
  ASSERT_EQ(flipped.faces.size(), mesh.faces.size());
  for (std::size_t k = 0; k < mesh.faces.size(); ++k) {
    EXPECT_LT(dot(turn(mesh, mesh.faces[k]), turn(flipped, flipped.faces[k])), 0);
  }
}

TEST(WeldedMesh, QuadsCoverTheSameCells) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--grid", "5"}, {"--relative", "1e-2"}}) {
    std::vector<std::string> with = options;
    with.emplace_back("--quads");
    const ReadMesh mesh = welded("builtin:teapot", options);
    const ReadMesh quads = welded("builtin:teapot", with);
    EXPECT_EQ(quads.positions, mesh.positions);
    std::size_t triangles = 0;
    std::set<std::set<std::uint32_t>> cut;
    for (const auto& face : quads.faces) {
      ASSERT_TRUE(face.size() == 3 || face.size() == 4);
      for (std::size_t c = 2; c < face.size(); ++c, ++triangles) {
        cut.insert({face[0], face[c - 1], face[c]});
      }
    }
    std::set<std::set<std::uint32_t>> whole;
    for (const auto& face : mesh.faces) {
      whole.insert({face.begin(), face.end()});
    }
    EXPECT_EQ(triangles, mesh.faces.size());
    EXPECT_TRUE(cut == whole);
    EXPECT_EQ(read_obj_mesh(tessellated("builtin:teapot", "obj", with)).faces, quads.faces);
  }
}

TEST(WeldedMesh, OrientMakesNeighboursAgree) {
  std::size_t turned = 0;
  for (const MeshModel& model : mesh_models()) {
    if (!model.manifold || !model.orientable) {
      continue;
    }
    const TemporaryFolder folder;
    MeshModel mixed = model;
    for (std::size_t k = 1; k < mixed.patches.size(); k += 2) {
      std::ranges::reverse(mixed.patches[k]);
    }
    const std::string in = folder.write("in.bez", bez_of(mixed));
    turned += census_of(welded(in, {"--grid", "3"})).disagreeing;
    EXPECT_EQ(census_of(welded(in, {"--grid", "3", "--orient"})).disagreeing, 0U) << model.name;
  }
  EXPECT_GT(turned, 0U);
}

// How far u and v of one face are apart, at most.
double widest_face(const ReadMesh& mesh) {
  double widest = 0;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto& a = mesh.uv.at(face[k]);
      const auto& b = mesh.uv.at(face[(k + 1) % face.size()]);
      widest = std::max({widest, std::abs(a[0] - b[0]), std::abs(a[1] - b[1])});
    }
  }
  return widest / (mesh.quantised ? 65535 : 1);
}

struct WithParameters {
  const char* extension;
  std::vector<std::string> options;
};
const WithParameters kWithParameters[] = {{"obj", {}},
                                          {"ply", {}},
                                          {"glb", {}},
                                          {"obj", {"--no-normals"}},
                                          {"ply", {"--quads"}},
                                          {"ply", {"--crease", "30"}},
                                          {"ply", {"--crease", "0", "--precision", "f64"}},
                                          {"glb", {"--quantise", "16"}},
                                          {"obj", {"--no-weld"}},
                                          {"glb", {"--no-weld", "--no-normals"}},
                                          {"vtu", {"--quads"}},
                                          {"raw", {"--quads"}}};

// The same faces, whose vertices have their own u, v in every patch.
TEST(WeldedMesh, ParametersAreEachPatchsOwn) {
  constexpr std::size_t kCells = 4;
  for (const MeshModel& model : mesh_models()) {
    if (model.name.starts_with("ball")) {
      continue; // points have one vertex, whose u is none
    }
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bez", bez_of(model));
    for (const auto& [extension, more] : kWithParameters) {
      SCOPED_TRACE(model.name + " " + extension + (more.empty() ? "" : " " + more[0]));
      std::vector<std::string> options = {"--grid", std::to_string(kCells + 1)};
      options.insert(options.end(), more.begin(), more.end());
      const ReadMesh whole = read_mesh(extension, tessellated(in, extension, options));
      options.emplace_back("--parameters");
      const ReadMesh mesh = read_mesh(extension, tessellated(in, extension, options));
      EXPECT_TRUE(whole.uv.empty());
      ASSERT_EQ(mesh.uv.size(), mesh.positions.size());
      EXPECT_EQ(mesh.uv.size(), model.patches.size() * (kCells + 1) * (kCells + 1));
      EXPECT_NEAR(widest_face(mesh), 1.0 / kCells, 1e-4);
      EXPECT_EQ(mesh.deviation, whole.deviation);
      ASSERT_EQ(mesh.faces.size(), whole.faces.size());
      for (std::size_t k = 0; k < mesh.faces.size(); ++k) {
        ASSERT_EQ(mesh.faces[k].size(), whole.faces[k].size());
        for (std::size_t c = 0; c < mesh.faces[k].size(); ++c) {
          const std::uint32_t a = mesh.faces[k][c];
          const std::uint32_t b = whole.faces[k][c];
          EXPECT_EQ(mesh.positions[a], whole.positions[b]);
          EXPECT_TRUE(mesh.normals.empty() || mesh.normals[a] == whole.normals.at(b));
        }
      }
    }
  }
}

// Two unit squares side by side in different planes, with a gap between them.
std::string two_squares(const TemporaryFolder& folder, double gap, double slope) {
  std::vector<Net> nets = {flat_net(), flat_net()};
  for (Vector3& point : nets[1].points) {
    point = {1 + gap + point[0], point[1], slope * point[0]};
  }
  return folder.write("squares.bez", bez_text(nets));
}

TEST(WeldedMesh, SnapJoinsWhatNearlyMeets) {
  const TemporaryFolder folder;
  const std::string in = two_squares(folder, 1e-4, 0);
  EXPECT_EQ(welded(in, {"--grid", "3"}).positions.size(), 18U);
  EXPECT_EQ(welded(in, {"--grid", "3", "--snap", "1e-5"}).positions.size(), 18U);
  const ReadMesh joined = welded(in, {"--grid", "3", "--snap", "1e-3"});
  EXPECT_EQ(joined.positions.size(), 15U);
  EXPECT_EQ(census_of(joined).loops, 1U);
  EXPECT_GE(*joined.deviation, 1e-4);
}

// Two halves beside a square.
TEST(WeldedMesh, SplitEdgesJoinsHalves) {
  const TemporaryFolder folder;
  std::vector<Net> nets = {flat_net(), flat_net(), flat_net()};
  for (std::size_t k = 0; k < 2; ++k) {
    for (Vector3& point : nets[k].points) {
      point = {point[0] - 1, (point[1] + static_cast<double>(k)) / 2, 0};
    }
  }
  const std::string in = folder.write("halves.bez", bez_text(nets));
  for (const std::string precision : {"f32", "f64"}) {
    const std::vector<std::string> options = {"--grid", "3", "--precision", precision};
    EXPECT_EQ(welded(in, options).positions.size(), 24U);
    std::vector<std::string> with = options;
    with.emplace_back("--split-edges");
    const ReadMesh joined = welded(in, with);
    EXPECT_EQ(joined.positions.size(), 25U);
    EXPECT_EQ(census_of(joined).loops, 1U);
    EXPECT_EQ(census_of(joined).euler, 1);
    with.insert(with.end(), {"--stats=json", "-o", folder.path("out.ply")});
    with.insert(with.begin(), {"tessellate", in});
    const std::string stats = run(with).out;
    EXPECT_NE(stats.find("\"split_edges\": 2"), std::string::npos) << stats;
    EXPECT_NE(stats.find("\"unjoined_edges\": 0"), std::string::npos) << stats;
  }
}

TEST(WeldedMesh, CreasesHaveNormalsOnBothSides) {
  const TemporaryFolder folder;
  const std::string in = two_squares(folder, 0, 1); // 45 degrees
  const ReadMesh smooth = welded(in, {"--grid", "3"});
  EXPECT_EQ(smooth.positions.size(), 15U);
  EXPECT_EQ(welded(in, {"--grid", "3", "--crease", "50"}).positions.size(), 15U);
  const ReadMesh sharp = welded(in, {"--grid", "3", "--crease", "40"});
  EXPECT_EQ(sharp.positions.size(), 18U);
  const auto are_of_one_patch = [](const ReadMesh& mesh) {
    return std::ranges::all_of(mesh.normals, [](const Point& n) {
      return n == Point{0, 0, 1} || (std::abs(n[0] + n[2]) < 1e-6 && n[1] == 0);
    });
  };
  EXPECT_TRUE(are_of_one_patch(sharp));
  EXPECT_FALSE(are_of_one_patch(smooth));
}

TEST(WeldedMesh, TakesPatchesOfAnyFormatAndShape) {
  for (const char* const format : kSampleFormats) {
    const ReadMesh mesh = welded(sample_path(format), {"--relative", "1e-2"});
    EXPECT_GT(mesh.faces.size(), 1U) << format;
    EXPECT_EQ(census_of(mesh).degenerate, 0U) << format;
  }
}

TEST(WeldedMesh, NormalsMayBeLeftOut) {
  const ReadMesh mesh = welded("builtin:teapot", {"--grid", "4", "--no-normals"});
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.positions, welded("builtin:teapot", {"--grid", "4"}).positions);
}

TEST(WeldedMesh, IsQuantisedWithinItsDeviation) {
  const ReadMesh full = read_glb_mesh(tessellated("builtin:teapot", "glb", {"--grid", "5"}));
  for (const std::string bits : {"16", "8"}) {
    const ReadMesh mesh =
        read_glb_mesh(tessellated("builtin:teapot", "glb", {"--grid", "5", "--quantise", bits}));
    ASSERT_TRUE(mesh.quantised);
    EXPECT_GT(*mesh.deviation, *full.deviation);
    ASSERT_EQ(mesh.positions.size(), full.positions.size());
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(mesh.translation[c] + mesh.scale * mesh.positions[k][c] / 65535,
                    full.positions[k][c], *mesh.deviation - *full.deviation);
      }
    }
  }
}

// A weight so small that no useful bound on rounding is known: positions are finite all the same.
TEST(WeldedMesh, OfVeryDifferentWeightsIsWrittenAsFloats) {
  const TemporaryFolder folder;
  std::string text = "8\n3 3\n";
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double w = i == 1 && j == 1 ? 1e-9 : 1;
      text += number_text(w * i) + " " + number_text(w * j) + " 0 " + number_text(w) + "\n";
    }
  }
  const std::string in = folder.write("light.bv", text);
  const ReadMesh ply = read_ply_mesh(tessellated(in, "ply", {"--grid", "9"}));
  const ReadMesh glb = read_glb_mesh(tessellated(in, "glb", {"--grid", "9"}));
  const ReadMesh stl = read_stl_mesh(tessellated(in, "stl", {"--grid", "9"}));
  EXPECT_EQ(glb.positions, ply.positions);
  const std::pair<const char*, const char*> kSaid[] = {
      {"obj", "\n# no bound on the deviation is known\n"},
      {"ply", "\ncomment no bound on the deviation is known\n"},
      {"stl", "binary STL, no bound on the deviation is known, simdbezier"},
      {"glb", nullptr},
      {"vtu", nullptr},
      {"raw", nullptr}};
  for (const auto& [extension, words] : kSaid) {
    const std::string bytes = tessellated(in, extension, {"--grid", "9"});
    EXPECT_EQ(bytes.find(words != nullptr ? words : "deviation") != std::string::npos,
              words != nullptr)
        << extension;
  }
  EXPECT_EQ(stl.faces.size(), ply.faces.size());
  for (const std::string option : {"--angle", "--tolerance", "--relative"}) {
    expect_failure(
        run({"tessellate", in, option, "0.1", "-o", folder.path("out.ply")}), 1,
        option + ": expected a patch whose error of rounding is bounded, found patch 0 of " + in);
  }
  const std::string stats =
      run({"tessellate", in, "--grid", "9", "--stats", "-o", folder.path("out.ply")}).err;
  EXPECT_NE(stats.find("deviation          not bounded\n"), std::string::npos) << stats;
  const ReadMesh mesh = read_glb_mesh(tessellated(in, "glb", {"--grid", "9", "--quantise", "16"}));
  ASSERT_EQ(mesh.positions.size(), ply.positions.size());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(mesh.translation[c] + mesh.scale * mesh.positions[k][c] / 65535,
                  ply.positions[k][c], mesh.scale / 65535);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::welded_mesh_test
