// .vtu files as VTK reads and evaluates them (Debian's python3-vtk9). Skipped where it is missing.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::vtk_test {
namespace {

using Json = nlohmann::json;
using Strings = std::vector<std::string>;

// Debian's own Python sees Debian's VTK.
constexpr const char* kPython = "/usr/bin/python3";

class Vtk : public ::testing::Test {
protected:
  void SetUp() override {
    const std::string command = std::string(kPython) + " -c 'import vtk' >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) {
      GTEST_SKIP() << "VTK (package python3-vtk9) is missing: ./run test installs it";
    }
  }
  // What read_by_vtk.py prints for each of these files.
  static std::vector<Json> judged(const Strings& files) {
    std::string command = std::string(kPython) + " " SIMDBEZIER_VTK_SCRIPT;
    for (const std::string& file : files) {
      command += " '" + file + "'";
    }
    std::string text;
    FILE* const pipe = popen(command.c_str(), "r");
    for (char buffer[4096]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) {
      text += buffer;
    }
    EXPECT_EQ(pclose(pipe), 0) << text;
    std::vector<Json> results;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      results.push_back(Json::parse(line, nullptr, false));
      EXPECT_TRUE(results.back().is_object()) << line;
    }
    EXPECT_EQ(results.size(), files.size());
    return results;
  }
};

TEST_F(Vtk, ReadsWhatOurOwnReaderReads) {
  const Strings cases[] = {{"--grid", "4"},
                           {"--grid", "4", "--quads", "--precision", "f64"},
                           {"--relative", "0.05", "--quads", "--parameters", "--no-normals"},
                           {"--cells", "bezier", "--precision", "f64"},
                           {"--cells", "bezier"},
                           {"--cells", "bezier", "--origin", "1,2,3.5"}};
  for (const Strings& options : cases) {
    const TemporaryFolder folder;
    const std::string out = folder.path("m.vtu");
    Strings arguments = {"tessellate", "builtin:teapot", "-o", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run(arguments).exit_code, 0);
    const ReadMesh mesh = read_vtu_mesh(read_file(out));
    const Json vtk = judged({out}).at(0);
    EXPECT_EQ(vtk["complaints"], Json::array());
    EXPECT_EQ(vtk["points"], Json(mesh.positions));
    EXPECT_EQ(vtk["faces"], Json(mesh.faces));
    EXPECT_EQ(vtk["types"].get<std::vector<double>>(), mesh.cell_types);
    EXPECT_EQ(vtk["normals"], !mesh.normals.empty());
    EXPECT_EQ(vtk["tcoords"], !mesh.uv.empty());
    EXPECT_EQ(vtk["fields"]["deviation"]["values"][0], *mesh.deviation);
    if (mesh.origin) {
      EXPECT_EQ(vtk["fields"]["origin"]["values"], Json(*mesh.origin));
    }
    if (!mesh.patches.empty()) {
      EXPECT_EQ(vtk["point_data"]["patch"]["values"].get<std::vector<double>>(), mesh.patches);
    }
    for (const auto& [name, values] : mesh.data) {
      const Json& array = vtk[name == "HigherOrderDegrees" ? "cell_data" : "point_data"][name];
      EXPECT_EQ(array["values"].get<std::vector<double>>(), values);
      EXPECT_EQ(array["components"], mesh.data_components.at(name));
    }
  }
}

TEST_F(Vtk, ReadsArraysOfEveryTypeAndNothing) {
  SampleMesh mesh = make_sample({.vertices = 3, .faces = 1, .normals = false}, true);
  mesh.contents.data = {{"a<b&\"c\"", tools::number_type<std::uint16_t>(), 4},
                        {"\u00e4", tools::number_type<std::int64_t>()}};
  const TemporaryFolder folder;
  const std::string path = folder.path("m.vtu");
  {
    const auto writer = tools::make_mesh_writer<float>(path, tools::MeshFormat::vtu, mesh.contents);
    const std::vector<float> values(mesh.values.begin(), mesh.values.end());
    writer->vertices({values, {}, std::vector<std::byte>(48, std::byte{1})});
    writer->faces(mesh.corners);
    writer->finish();
  }
  const std::string empty = folder.path("empty.vtu");
  write_sample<float>(
      make_sample({.vertices = 0, .faces = 0}, true),
      *tools::make_mesh_writer<float>(empty, tools::MeshFormat::vtu,
                                      make_sample({.vertices = 0, .faces = 0}, true).contents),
      1);
  const std::vector<Json> found = judged({path, empty});
  for (const Json& file : found) {
    EXPECT_EQ(file["complaints"], Json::array());
  }
  EXPECT_EQ(found[0]["point_data"]["a<b&\"c\""]["values"], Json(std::vector<int>(12, 257)));
  EXPECT_EQ(found[0]["point_data"]["\u00e4"]["values"],
            Json(std::vector<std::int64_t>(3, 0x0101010101010101)));
  EXPECT_EQ(found[1]["faces"], Json::array());
}

// Patches of all pairs of these degrees, every second one with weights, which are homogeneous.
std::string patches_of(const std::vector<int>& degrees, bool rational, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_real_distribution<double> weight(0.5, 2);
  std::string text;
  bool weighted = false;
  for (const int across : degrees) {
    for (const int along : degrees) {
      weighted = rational && !weighted;
      text +=
          (weighted ? "8\n" : "5\n") + std::to_string(across) + " " + std::to_string(along) + "\n";
      for (int k = 0; k < (across + 1) * (along + 1); ++k) {
        const double w = weighted ? weight(random) : 1;
        for (int c = 0; c < 3; ++c) {
          text += number_text(w * place(random)) + " ";
        }
        text += (weighted ? number_text(w) : "") + "\n";
      }
    }
  }
  return text;
}

TEST_F(Vtk, EvaluatesCellsToThePatchesPositions) {
  std::mt19937_64 random(58);
  std::uniform_real_distribution<double> share(0, 1);
  struct Case {
    std::vector<int> degrees;
    bool rational;
    Strings options;
    double error;
  };
  const Case cases[] = {{{1, 2, 3, 4, 5, 6, 7, 8, 9}, true, {"--precision", "f64"}, 1e-12},
                        {{1, 2, 3, 4, 5, 6, 7, 8, 9}, false, {"--precision", "f64"}, 1e-12},
                        {{1, 11, 15}, true, {"--precision", "f64"}, 1e-12},
                        {{2, 3}, true, {}, 1e-6}};
  for (const Case& item : cases) {
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bv", patches_of(item.degrees, item.rational, random));
    Strings options = item.options;
    options.insert(options.end(), {"--cells", "bezier"});
    const std::string cells = folder.write("cells.vtu", tessellated(in, "vtu", options));
    std::string samples = "patch,u,v\n";
    const std::size_t patches = item.degrees.size() * item.degrees.size();
    for (std::size_t patch = 0; patch < patches; ++patch) {
      for (int k = 0; k < 8; ++k) {
        const double u = k == 0 ? 0 : k == 1 ? 1 : share(random);
        const double v = k == 1 ? 0 : k == 2 ? 1 : share(random);
        samples += std::to_string(patch) + "," + number_text(u) + "," + number_text(v) + "\n";
      }
    }
    const std::string results = folder.path("results.csv");
    expect_silent_success(run({"evaluate", in, "--samples", folder.write("samples.csv", samples),
                               "--precision", "f64", "-o", results}));
    const std::vector<Json> found = judged({cells, results});
    EXPECT_EQ(found[0]["types"], Json(std::vector<int>(patches, 77)));
    const double difference = found[1]["difference"];
    EXPECT_LE(difference, item.error);
    EXPECT_GT(difference, 0) << "other ways round otherwise";
  }
}

} // namespace
} // namespace simdbezier::tests::vtk_test
