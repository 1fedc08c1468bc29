// simdbezier tessellate --drop-repeated, and what info says of repetitions.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::repeated_patches_test {
namespace {

using Json = nlohmann::ordered_json;

// Every second patch follows once more, at once or behind all others, as it is or the other way
// round.
MeshModel with_repetitions(const MeshModel& model) {
  MeshModel result = model;
  result.patches.clear();
  std::vector<PatchPoints> late;
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    result.patches.push_back(model.patches[k]);
    PatchPoints again = model.patches[k];
    if (k % 4 == 2) {
      std::ranges::reverse(again);
    }
    if (k % 2 == 0) {
      (k % 8 < 4 ? result.patches : late).push_back(again);
    }
  }
  result.patches.insert(result.patches.end(), late.begin(), late.end());
  return result;
}

TEST(DropRepeated, MakesTheMeshOfTheModelWithoutRepetitions) {
  const std::vector<std::vector<std::string>> ways = {{"--grid", "5x4", "--flip"},
                                                      {"--relative", "1e-2", "--crease", "30"},
                                                      {"--angle", "20", "--precision", "f64"},
                                                      {"--pixels", "3", "--camera", "9,8,7,0,0,0"}};
  std::size_t oriented = 0;
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue;
    }
    const TemporaryFolder folder;
    const std::string once = folder.write("once.bez", bez_of(model));
    const std::string more = folder.write("more.bez", bez_of(with_repetitions(model)));
    for (std::vector<std::string> way : ways) {
      SCOPED_TRACE(model.name + " " + way[0]);
      if (model.orientable && way[0] != "--angle") {
        way.emplace_back("--orient");
        ++oriented;
      }
      const std::string expected = tessellated(once, "glb", way);
      way.emplace_back("--drop-repeated");
      EXPECT_TRUE(tessellated(more, "glb", way) == expected);
      EXPECT_TRUE(tessellated(once, "glb", way) == expected); // there may be none
    }
  }
  EXPECT_GT(oriented, 10U);
}

TEST(DropRepeated, IsSeenInStatistics) {
  const TemporaryFolder folder;
  const auto stats = [&](const MeshModel& model, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"tessellate",  folder.write("in.bez", bez_of(model)),
                                          "--grid",      "3",
                                          "-o",          folder.path("out.ply"),
                                          "--stats=json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Json::parse(run(arguments).out, nullptr, false);
  };
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue;
    }
    SCOPED_TRACE(model.name);
    const MeshModel repeated = with_repetitions(model);
    const std::size_t repetitions = repeated.patches.size() - model.patches.size();
    const Json whole = stats(repeated, {});
    const Json distinct = stats(repeated, {"--drop-repeated"});
    const Json once = stats(model, {});
    EXPECT_EQ(whole["patches"], repeated.patches.size());
    EXPECT_EQ(whole["repeated_patches"], repetitions);
    EXPECT_EQ(distinct["repeated_patches"], repetitions);
    for (const char* const name : {"patches", "vertices", "triangles", "open_edges",
                                   "non_manifold_edges", "turned_edges", "orientable"}) {
      EXPECT_EQ(distinct[name], once[name]) << name;
    }
  }
}

TEST(DropRepeated, NamesPatchesByTheirPlacesInTheFile) {
  const TemporaryFolder folder;
  Net far = flat_net(); // where floats are too coarse for the tolerance
  for (Vector3& point : far.points) {
    point[2] = 1e6;
  }
  const std::string in =
      folder.write("in.bez", bez_text(std::vector{flat_net(), flat_net(), far, far}));
  expect_failure(run({"tessellate", in, "--tolerance", "1e-3", "--drop-repeated", "-o",
                      folder.path("out.ply")}),
                 1, "for patch 2 of " + in);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.bez"});
}

// Vertices come in blocks of patches, of which the second one has none.
TEST(RepeatedPatches, FillBlocksWithoutVertices) {
  constexpr std::size_t kCount = 4096 + 1;
  const TemporaryFolder folder;
  std::string text = std::to_string(kCount) + "\n";
  for (std::size_t k = 0; k < kCount; ++k) {
    text += "1 1 0 0 0 1 0 0 0 1 0 1 1 0\n";
  }
  const std::string in = folder.write("in.bpt", text);
  for (const std::string extension : {"obj", "ply", "stl", "glb", "vtu", "raw"}) {
    for (const char* const more : {"--no-normals", "--parameters", "--flip"}) {
      if (extension == "stl" && more == std::string("--parameters")) {
        continue;
      }
      const ReadMesh mesh = read_mesh(extension, tessellated(in, extension, {"--grid", "2", more}));
      EXPECT_EQ(mesh.faces.size(), 2 * kCount) << extension << " " << more;
      EXPECT_GE(mesh.positions.size(), 4U);
    }
  }
}

TEST(InfoOfRepetitions, CountsThemWhicheverWayRound) {
  const TemporaryFolder folder;
  Net transposed;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      transposed.at(j, i) = quadratic_net().at(i, j);
    }
  }
  const std::string in = folder.write(
      "in.bez", bez_text(std::vector{quadratic_net(), flat_net(), transposed, transposed}));
  EXPECT_EQ(Json::parse(run({"info", in, "--json"}).out, nullptr, false)["repeated_patches"], 2);
  const std::string text = run({"info", in}).out;
  EXPECT_NE(text.find("\nrepeated patches   2\n"), std::string::npos) << text;
  EXPECT_NE(run({"info", "builtin:teapot"})
                .out.find("\norientation        0 edges between patches that disagree\n"),
            std::string::npos);
}

} // namespace
} // namespace simdbezier::tests::repeated_patches_test
