// Files as other people's programs read them: Khronos' validator and three.js's loader (GLB),
// assimp (PLY, STL, OBJ). Skipped where they are not installed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>

#include <nlohmann/json.hpp>
#include <tools/mesh_files/mesh_formats.hpp>

#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::other_readers_test {
namespace {

using Json = nlohmann::json;
using tools::MeshFormat;
using tools::VertexStorage;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  for (char buffer[4096]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) {
    text += buffer;
  }
  EXPECT_EQ(pclose(pipe), 0) << command << "\n" << text;
  return text;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string write(const TemporaryFolder& folder, const std::string& name, const SampleMesh& mesh) {
  const std::string path = folder.path(name);
  const MeshFormat format = *tools::mesh_format_of(name);
  write_sample<double>(mesh, *tools::make_mesh_writer<double>(path, format, mesh.contents), 1000);
  return path;
}

struct GlbCase {
  const char* name;
  SampleShape shape;
  std::optional<std::array<double, 3>> origin = std::nullopt;
};

// What the validator and the loader say, one object a file.
std::vector<Json> judged(const std::string& files) {
  const std::string command =
      "node " SIMDBEZIER_NODE_FOLDER "/check_glb.mjs " SIMDBEZIER_NODE_MODULES;
  std::vector<Json> results;
  std::istringstream lines(output_of(command + files));
  for (std::string line; std::getline(lines, line);) {
    results.push_back(Json::parse(line, nullptr, false));
  }
  return results;
}

class KhronosAndThree : public ::testing::Test {
protected:
  void SetUp() override {
    if (!is_installed("node") || !std::filesystem::exists(SIMDBEZIER_NODE_MODULES "/three") ||
        !std::filesystem::exists(SIMDBEZIER_NODE_MODULES "/gltf-validator")) {
      GTEST_SKIP() << "node, or its packages in " SIMDBEZIER_NODE_MODULES
                      ", are missing: ./run test installs them";
    }
  }
  static void expect_clean(const Json& result, const std::string& name) {
    ASSERT_TRUE(result.is_object()) << name;
    EXPECT_EQ(result["issues"]["numErrors"], 0) << name << result["issues"].dump(1);
    EXPECT_EQ(result["issues"]["numWarnings"], 0) << name << result["issues"].dump(1);
  }
};

TEST_F(KhronosAndThree, AgreeWithEveryVariant) {
  const std::vector<GlbCase> cases = {
      {"full", {}},
      {"bare", {.normals = false}},
      {"odd", {.vertices = 3, .faces = 1}},
      {"all", {.uv = true, .patches = true}},
      {"65535", {.vertices = 65535, .faces = 40000}},
      {"65536", {.vertices = 65536, .faces = 40000}},
      {"quantised", {.vertices = 30000, .uv = true, .storage = VertexStorage::quantised_16}},
      {"smallest",
       {.vertices = 70000, .uv = true, .patches = true, .storage = VertexStorage::quantised_8}},
      {"quantised bare", {.normals = false, .storage = VertexStorage::quantised_16}},
      {"moved", {}, {{500000.015, -1e7, 0.1}}},
      {"quantised and moved", {.storage = VertexStorage::quantised_16}, {{500000.015, -1e7, 0.1}}}};
  const TemporaryFolder folder;
  std::string files;
  for (const GlbCase& item : cases) {
    SampleMesh mesh = make_sample(item.shape, false);
    mesh.contents.deviation = 0.125;
    mesh.contents.generator = "a \"test\"\\\n";
    mesh.contents.origin = item.origin;
    files += " '" + write(folder, std::string(item.name) + ".glb", mesh) + "'";
  }
  const std::vector<Json> results = judged(files);
  ASSERT_EQ(results.size(), cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const SampleShape& shape = cases[k].shape;
    expect_clean(results[k], cases[k].name);
    const Json& three = results[k]["three"];
    EXPECT_EQ(three["meshes"], 1);
    EXPECT_EQ(three["vertices"], shape.vertices);
    EXPECT_EQ(three["triangles"], shape.faces);
    EXPECT_EQ(three["attributes"].size(),
              1U + (shape.normals ? 1 : 0) + (shape.uv ? 1 : 0) + (shape.patches ? 1 : 0));
    const double deviation = three["deviation"];
    EXPECT_GE(deviation, 0.125);
    EXPECT_EQ(
        three["extras"],
        (Json{{"deviation", deviation}, {"vertices", shape.vertices}, {"triangles", shape.faces}}));
    const auto origin = cases[k].origin.value_or(std::array<double, 3>{});
    // Where a viewer places vertices is as near to them as the file says.
    const SampleMesh mesh = make_sample(shape, false);
    for (std::size_t c = 0; c < 3; ++c) {
      double low = 1e9;
      double high = -1e9;
      for (std::size_t v = 0; v < shape.vertices; ++v) {
        low = std::min(low, mesh.vertex(v)[c]);
        high = std::max(high, mesh.vertex(v)[c]);
      }
      const double error = deviation - 0.125 + 0x1p-50 * std::abs(origin[c]);
      EXPECT_NEAR(three["low"][c].get<double>(), low + origin[c], error) << cases[k].name;
      EXPECT_NEAR(three["high"][c].get<double>(), high + origin[c], error) << cases[k].name;
    }
  }
}

TEST_F(KhronosAndThree, AgreeWithParts) {
  const TemporaryFolder folder;
  SampleMesh mesh = make_sample({.vertices = 3000, .faces = 2998, .patches = true}, true);
  for (std::uint32_t k = 0; k < 2998; ++k) {
    mesh.corners[std::size_t{3} * k] = k;
    mesh.corners[std::size_t{3} * k + 1] = k + 1;
    mesh.corners[std::size_t{3} * k + 2] = k + 2;
  }
  write_sample<float>(
      mesh, *tools::make_split_glb_writer<float>(folder.path("mesh.glb"), mesh.contents, 30000),
      500);
  std::string files;
  for (const std::string& name : folder.names()) {
    files += " " + folder.path(name);
  }
  const std::vector<Json> results = judged(files);
  ASSERT_EQ(results.size(), folder.names().size());
  ASSERT_GT(results.size(), 3U);
  std::size_t triangles = 0;
  for (const Json& result : results) {
    expect_clean(result, "a part");
    triangles += result["three"]["triangles"].get<std::size_t>();
  }
  EXPECT_EQ(triangles, 2998U);
}

// Doubles are loaded, but not drawn: floats have to be floats.
TEST_F(KhronosAndThree, LoadFloatsOfDoubles) {
  const TemporaryFolder folder;
  const SampleMesh mesh = make_sample({.uv = true, .floats = true}, false);
  const std::vector<Json> results = judged(" " + write(folder, "floats.ply", mesh));
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(
      results[0],
      (Json{{"position", "Float32Array"}, {"normal", "Float32Array"}, {"uv", "Float32Array"}}));
}

TEST_F(KhronosAndThree, AgreeWithNothing) {
  const TemporaryFolder folder;
  const SampleMesh mesh = make_sample({.vertices = 0, .faces = 0}, true);
  const std::string path = folder.path("empty.glb");
  write_sample<float>(mesh, *tools::make_mesh_writer<float>(path, MeshFormat::glb, mesh.contents),
                      1);
  // three.js wants a scene, which nothing has.
  const std::string script =
      "const v=require(process.argv[1]);"
      "v.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[2])))"
      ".then(r=>console.log(JSON.stringify(r)))";
  const Json report = Json::parse(
      output_of("node -e \"" + script + "\" " SIMDBEZIER_NODE_MODULES "/gltf-validator " + path),
      nullptr, false);
  expect_clean(report, "empty");
}

struct Counts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

// Writes the teapot, and what the program says about it.
Counts write_teapot(const std::string& path, const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"tessellate", "builtin:teapot", "--stats=json", "-o", path};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json stats = Json::parse(outcome.out, nullptr, false);
  return {stats.value("vertices", std::size_t{0}), stats.value("triangles", std::size_t{0})};
}

const std::vector<std::vector<std::string>> kTeapots = {
    {"--no-weld", "--grid", "16"},
    {"--grid", "16", "--precision", "f64"},
    {"--relative", "1e-3"},
    {"--relative", "1e-3", "--crease", "30", "--flip"}};

TEST_F(KhronosAndThree, AgreeWithTheTeapot) {
  std::vector<std::vector<std::string>> teapots = kTeapots;
  teapots.push_back({"--relative", "1e-3", "--quantise", "16"});
  teapots.push_back({"--relative", "1e-3", "--quantise", "8"});
  for (const std::vector<std::string>& options : teapots) {
    const TemporaryFolder folder;
    const std::string path = folder.path("teapot.glb");
    const Counts expected = write_teapot(path, options);
    const std::vector<Json> results = judged(" " + path);
    ASSERT_EQ(results.size(), 1U);
    expect_clean(results[0], options.back());
    EXPECT_GT(expected.triangles, 1000U);
    EXPECT_EQ(results[0]["three"]["vertices"], expected.vertices);
    EXPECT_EQ(results[0]["three"]["triangles"], expected.triangles);
  }
}

// The number behind "Faces:" and the like.
std::uint64_t number_of(const std::string& text, const std::string& what) {
  const std::size_t at = text.find("\n" + what);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no '" << what << "' in\n" << text;
    return 0;
  }
  return std::strtoull(text.c_str() + at + 1 + what.size(), nullptr, 10);
}

TEST(Assimp, LoadsAsManyVerticesAndFaces) {
  if (!is_installed("assimp")) {
    GTEST_SKIP() << "assimp (package assimp-utils) is missing: ./run test installs it";
  }
  const std::vector<std::pair<std::string, SampleShape>> cases = {
      {"f.ply", {.vertices = 900, .faces = 1000}},
      {"bare.ply", {.vertices = 900, .faces = 1000, .normals = false}},
      {"all.ply", {.vertices = 900, .faces = 1000, .uv = true, .patches = true}},
      {"floats.ply", {.vertices = 900, .faces = 1000, .uv = true, .floats = true}},
      {"quads.ply", {.vertices = 900, .faces = 1000, .corners = 4}},
      {"f.stl", {.vertices = 900, .faces = 1000}},
      {"f.obj", {.vertices = 900, .faces = 1000}},
      {"bare.obj", {.vertices = 900, .faces = 1000, .normals = false}},
      {"all.obj", {.vertices = 900, .faces = 1000, .uv = true}},
      {"quads.obj", {.vertices = 900, .faces = 1000, .corners = 4}},
      {"f.glb", {.vertices = 900, .faces = 1000, .uv = true}}};
  const TemporaryFolder folder;
  for (const auto& [name, shape] : cases) {
    SampleMesh mesh = make_sample(shape, false);
    mesh.contents.deviation = 0.125;
    mesh.contents.generator = "a test";
    const std::string path = write(folder, name, mesh);
    const std::string text = output_of("assimp info " + path + " --raw");
    EXPECT_EQ(number_of(text, "Faces:"), shape.faces) << name;
    // STL and OBJ have no vertices but corners.
    const bool shared = name.ends_with("ply") || name.ends_with("glb");
    EXPECT_EQ(number_of(text, "Vertices:"), shared ? shape.vertices : shape.faces * shape.corners)
        << name;
  }
}

TEST(Assimp, LoadsTheTeapot) {
  if (!is_installed("assimp")) {
    GTEST_SKIP() << "assimp (package assimp-utils) is missing: ./run test installs it";
  }
  for (const std::vector<std::string>& options : kTeapots) {
    for (const std::string extension : {"ply", "stl", "obj"}) {
      const TemporaryFolder folder;
      const std::string path = folder.path("teapot." + extension);
      const Counts expected = write_teapot(path, options);
      const std::string text = output_of("assimp info " + path + " --raw");
      EXPECT_EQ(number_of(text, "Faces:"), expected.triangles) << path;
      EXPECT_EQ(number_of(text, "Vertices:"),
                extension == "ply" ? expected.vertices : 3 * expected.triangles)
          << path;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::other_readers_test
