// What tessellate says about meshes, where it writes them, and what it refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <simdbezier/simdbezier.hpp>

#include <ostream>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/welded_mesh.hpp"

namespace simdbezier::tests {
namespace {

using Json = nlohmann::ordered_json;

const char* const kExtensions[] = {"obj", "ply", "stl", "glb"};

// Every way of making a mesh, for what has to hold for all of them.
const std::vector<std::vector<std::string>> kWays = {{"--grid", "9"},
                                                     {"--relative", "1e-3"},
                                                     {"--relative", "1e-4", "--precision", "f64"},
                                                     {"--relative", "1e-3", "--crease", "30"},
                                                     {"--angle", "10", "--flip"},
                                                     {"--no-weld", "--grid", "9"}};

TEST(MeshBytes, AreThoseOfOneThread) {
  for (const std::vector<std::string>& way : kWays) {
    for (const std::string extension : kExtensions) {
      std::vector<std::string> one = way;
      one.insert(one.end(), {"--threads", "1"});
      std::vector<std::string> many = way;
      many.insert(many.end(), {"--threads", "3"});
      EXPECT_TRUE(tessellated("builtin:teapot", extension, one) ==
                  tessellated("builtin:teapot", extension, many))
          << way[0] << " " << extension;
    }
  }
}

TEST(MeshBytes, AreTheSameOnAllInstructionSetsOfAClass) {
  std::vector<std::string> names;
  for (const Isa isa : available_isas()) {
    if (isa == Isa::avx2 || isa == Isa::avx512) {
      names.emplace_back(to_string(isa));
    }
  }
  if (names.size() < 2) {
    GTEST_SKIP() << "this machine or build has not both AVX2 and AVX-512";
  }
  for (const std::vector<std::string>& way : kWays) {
    for (const std::string extension : kExtensions) {
      const auto on = [&](const std::string& isa) {
        return tessellated("builtin:teapot", extension, way,
                           {.environment = {{"SIMDBEZIER_ISA", isa}}});
      };
      EXPECT_TRUE(on(names[0]) == on(names[1])) << way[0] << " " << extension;
    }
  }
}

TEST(MeshStatistics, AreOneObjectWithTheseNames) {
  const TemporaryFolder folder;
  const Outcome outcome = run({"tessellate", "builtin:teapot", "--relative", "1e-3", "--stats=json",
                               "-o", folder.path("out.glb")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const Json stats = Json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(stats.is_object()) << outcome.out;
  std::vector<std::string> names;
  for (const auto& [name, value] : stats.items()) {
    names.push_back(name);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"patches", "vertices", "triangles", "deviation", "diagonal",
                                      "open_edges", "non_manifold_edges", "samples", "seconds"}));
  names.clear();
  for (const auto& [name, value] : stats["seconds"].items()) {
    names.push_back(name);
    EXPECT_GE(value.get<double>(), 0) << name;
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"read", "pack", "rates", "topology", "evaluate", "write"}));
  const ReadMesh mesh = read_glb_mesh(read_file(folder.path("out.glb")));
  EXPECT_EQ(stats["patches"], 32);
  EXPECT_EQ(stats["vertices"], mesh.positions.size());
  EXPECT_EQ(stats["triangles"], mesh.faces.size());
  EXPECT_EQ(stats["deviation"].get<double>(), *mesh.deviation);
  EXPECT_NEAR(stats["diagonal"].get<double>(), 8.2763594, 1e-6);
  EXPECT_LE(stats["deviation"].get<double>(), 1e-3 * stats["diagonal"].get<double>());
  EXPECT_EQ(stats["open_edges"], 16);
  EXPECT_EQ(stats["non_manifold_edges"], 0);
  EXPECT_EQ(stats["samples"], mesh.positions.size());
}

TEST(MeshStatistics, StateWhatFilesState) {
  for (const std::string extension : kExtensions) {
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--precision", "f64"}, {"--quantise", "8"}}) {
      if (!more.empty() && more[0] == "--quantise" && extension != "glb") {
        continue;
      }
      const TemporaryFolder folder;
      const std::string out = folder.path("out." + extension);
      std::vector<std::string> arguments = {
          "tessellate", "builtin:teapot", "--grid", "5", "--stats=json", "-o", out};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Json stats = Json::parse(run(arguments).out, nullptr, false);
      const std::string bytes = read_file(out);
      const ReadMesh mesh = extension == "obj"   ? read_obj_mesh(bytes)
                            : extension == "ply" ? read_ply_mesh(bytes)
                            : extension == "stl" ? read_stl_mesh(bytes)
                                                 : read_glb_mesh(bytes);
      EXPECT_EQ(stats["deviation"].get<double>(), mesh.deviation.value_or(0)) << extension;
    }
  }
}

// Meshes of sheets state nothing in their files, which are as they always were.
TEST(MeshStatistics, AreOfSheetsAsWell) {
  const auto stats = [](const std::string& grid, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"tessellate", "builtin:teapot", "--no-weld", "--grid",
                                          grid, "--stats=json", "-o", "/dev/null", "--to", "glb"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Json::parse(run(arguments).out, nullptr, false);
  };
  const Json found = stats("16");
  EXPECT_EQ(found["vertices"], 8192);
  EXPECT_EQ(found["samples"], 8192);
  EXPECT_EQ(found["triangles"], 14400);
  EXPECT_EQ(found["open_edges"], 4 * 32 - 8);
  EXPECT_EQ(found["non_manifold_edges"], 0);
  EXPECT_NEAR(found["diagonal"].get<double>(), 8.2763594, 1e-6);
  // The best diagonals of the welded mesh are no worse, and each is at most twice as good.
  const double deviation = found["deviation"];
  const std::string json =
      run({"tessellate", "builtin:teapot", "--stats=json", "-o", "/dev/null", "--to", "glb"}).out;
  const double best = Json::parse(json, nullptr, false)["deviation"];
  EXPECT_GE(deviation, best);
  EXPECT_LE(deviation, 2 * best);
  EXPECT_LT(stats("31")["deviation"], deviation / 3.5);
  EXPECT_GT(stats("16", {"--quantise", "16"})["deviation"], deviation);
}

// Three sheets on one edge, and a cube without one face.
TEST(MeshStatistics, CountEdges) {
  for (const MeshModel& model : mesh_models()) {
    const TemporaryFolder folder;
    const Outcome outcome = run({"tessellate", folder.write("in.bez", bez_of(model)), "--grid", "3",
                                 "--stats=json", "-o", folder.path("out.ply")});
    const Json stats = Json::parse(outcome.out, nullptr, false);
    if (model.manifold) {
      EXPECT_EQ(stats["open_edges"] > 0, model.loops > 0) << model.name;
    }
    EXPECT_EQ(stats["non_manifold_edges"] > 0, !model.manifold) << model.name;
    const ReadMesh mesh = read_ply_mesh(read_file(folder.path("out.ply")));
    EXPECT_EQ(stats["triangles"], mesh.faces.size()) << model.name;
  }
}

TEST(MeshStatistics, AreReadableToo) {
  const TemporaryFolder folder;
  for (const std::string option : {"--stats", "--stats=text"}) {
    const Outcome outcome =
        run({"tessellate", "builtin:teapot", option, "--quads", "-o", folder.path("out.ply")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "");
    for (const char* const part :
         {"patches            32\n", "\nvertices ", "\ntriangles ", " at most, certified; ",
          "edges of patches   16 open, 0 non-manifold\n", "\nseconds            read "}) {
      EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
    }
  }
}

TEST(MeshToStandardOutput, IsTheFile) {
  for (const std::string extension : kExtensions) {
    const Outcome outcome =
        run({"tessellate", "builtin:teapot", "--grid", "5", "-o", "-", "--to", extension});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out == tessellated("builtin:teapot", extension, {"--grid", "5"}))
        << extension;
  }
}

TEST(MeshToStandardOutput, LeavesRoomForReadableStatistics) {
  const Outcome outcome =
      run({"tessellate", "builtin:teapot", "-o", "-", "--to", "ply", "--stats"});
  EXPECT_TRUE(outcome.out.starts_with("ply\n"));
  EXPECT_TRUE(outcome.err.starts_with("patches ")) << outcome.err;
}

struct Refused {
  const char* name;
  int exit_code;
  std::vector<std::string> options;
  const char* message;
};
void PrintTo(const Refused& item, std::ostream* out) { *out << item.name; }

const Refused kRefused[] = {
    {"ToleranceZero",
     1,
     {"--tolerance", "0"},
     "--tolerance: expected a distance above 0, found '0'"},
    {"ToleranceNegative", 1, {"--tolerance", "-1"}, "--tolerance: expected a distance above 0"},
    {"ToleranceNan", 1, {"--tolerance", "nan"}, "--tolerance: expected a distance above 0"},
    {"ToleranceInfinite", 1, {"--tolerance", "inf"}, "--tolerance: expected a distance above 0"},
    {"ToleranceWord", 2, {"--tolerance", "fine"}, "--tolerance: expected a distance above 0"},
    {"ToleranceEmpty", 2, {"--tolerance", ""}, "--tolerance: expected a distance above 0"},
    {"ToleranceBelowRounding",
     1,
     {"--tolerance", "1e-9"},
     "--tolerance: expected a distance above the error of rounding, "},
    {"ToleranceBeyondRates",
     1,
     {"--tolerance", "1e-10", "--precision", "f64"},
     "--tolerance: expected a distance that 4096 cells a direction can keep, found 1e-10 for "
     "patch"},
    {"RelativeZero", 1, {"--relative", "0"}, "--relative: expected a share above 0, found '0'"},
    {"RelativeBelowRounding",
     1,
     {"--relative", "1e-12"},
     "--relative: expected a distance above the error of rounding, "},
    {"AngleZero", 1, {"--angle", "0"}, "--angle: expected degrees above 0 and at most 180"},
    {"AngleLarge", 1, {"--angle", "181"}, "--angle: expected degrees above 0 and at most 180"},
    {"AngleTiny", 1, {"--angle", "1e-9"}, "--angle: expected "},
    {"PixelsZero", 1, {"--pixels", "0", "--camera", "9,0,0,0,0,0"}, "--pixels: expected a number"},
    {"PixelsWithoutCamera", 2, {"--pixels", "1"}, "--pixels: expected with --camera"},
    {"CameraWithoutPixels", 2, {"--camera", "9,0,0,0,0,0"}, "--camera: expected with --pixels"},
    {"ViewAngleWithoutCamera", 2, {"--view-angle", "30"}, "--view-angle: expected with --camera"},
    {"PictureWithoutCamera", 2, {"--picture", "4x4"}, "--picture: expected with --camera"},
    {"CameraInItsTarget",
     1,
     {"--pixels", "1", "--camera", "1,2,3,1,2,3"},
     "--camera: expected six numbers separated by commas, for two different points, found"},
    {"CameraOfFive", 2, {"--pixels", "1", "--camera", "1,2,3,4,5"}, "--camera: expected six"},
    {"CameraOfSeven", 2, {"--pixels", "1", "--camera", "1,2,3,4,5,6,7"}, "--camera: expected six"},
    {"CameraOfWords", 2, {"--pixels", "1", "--camera", "1,2,x,4,5,6"}, "--camera: expected six"},
    {"PictureEmpty",
     2,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--picture", "0x5"},
     "--picture: expected WxH, each from 1 to 65536, found '0x5'"},
    {"PictureOfOneNumber",
     2,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--picture", "50"},
     "--picture: expected WxH"},
    {"ViewAngleFlat",
     1,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--view-angle", "180"},
     "--view-angle: expected degrees above 0 and below 180"},
    {"CreaseNegative", 1, {"--crease", "-1"}, "--crease: expected degrees from 0 to 180"},
    {"CreaseNan", 1, {"--crease", "nan"}, "--crease: expected degrees from 0 to 180"},
    {"CreaseWithoutNormals",
     2,
     {"--crease", "30", "--no-normals"},
     "--crease: expected without --no-normals, found both"},
    {"SnapZero", 1, {"--snap", "0"}, "--snap: expected a distance above 0"},
    {"GridBeyondRates",
     1,
     {"--grid", "5000"},
     "--grid: expected at most 4097 samples a direction without --no-weld, found 5000x5000"},
    {"GridAndTolerance",
     2,
     {"--grid", "4", "--tolerance", "1"},
     "--tolerance: expected without --grid, found both"},
    {"GridAndRelative",
     2,
     {"--grid", "4", "--relative", "1"},
     "--relative: expected without --grid"},
    {"ToleranceOfSheets",
     2,
     {"--no-weld", "--tolerance", "1"},
     "--tolerance: expected without --no-weld, found both"},
    {"CreaseOfSheets", 2, {"--no-weld", "--crease", "1"}, "--crease: expected without --no-weld"},
    {"OrientOfSheets", 2, {"--no-weld", "--orient"}, "--orient: expected without --no-weld"},
    {"SnapOfSheets", 2, {"--no-weld", "--snap", "1"}, "--snap: expected without --no-weld"},
    {"StatsUnknown", 2, {"--stats=xml"}, "--stats: expected text or json, found 'xml'"},
    {"QuantisedPly", 2, {"--quantise", "16"}, "--quantise: expected an output in glb"},
    {"QuantisedWords", 2, {"--quantise", "12"}, "--quantise: expected 16 or 8, found '12'"},
    {"OtherFormat", 2, {"--to", "obj"}, "--to: expected the format of "},
    {"UnknownFormat", 2, {"--to", "fbx"}, "--to: expected obj, ply, stl or glb, found 'fbx'"},
};

class RefusedOptions : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedOptions, AreNamedInOneLine) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.ply", "before");
  std::vector<std::string> arguments = {"tessellate", "builtin:teapot", "-o", out};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  expect_failure(run(arguments), GetParam().exit_code, GetParam().message);
  EXPECT_EQ(read_file(out), "before");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.ply"});
}

INSTANTIATE_TEST_SUITE_P(All, RefusedOptions, ::testing::ValuesIn(kRefused),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(RefusedMeshOptions, MoreVerticesThanIndices) {
  const TemporaryFolder folder;
  std::vector<Net> nets(300, flat_net());
  for (std::size_t k = 0; k < nets.size(); ++k) {
    for (Vector3& point : nets[k].points) {
      point[2] = static_cast<double>(k);
    }
  }
  const std::string in = folder.write("in.bez", bez_text(nets));
  expect_failure(run({"tessellate", in, "--grid", "4097", "-o", folder.path("out.ply")}), 1,
                 "--grid: expected at most 4294967295 vertices, found more");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.bez"});
}

TEST(RefusedMeshOptions, SurfacesOfOneSide) {
  std::size_t found = 0;
  for (const MeshModel& model : mesh_models()) {
    if (model.orientable) {
      continue;
    }
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bez", bez_of(model));
    expect_failure(run({"tessellate", in, "--orient", "-o", folder.path("out.ply")}), 1,
                   "--orient: expected patches that can be turned to agree with their neighbours, "
                   "found a surface of one side in " +
                       in);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.bez"});
    ++found;
  }
  EXPECT_GT(found, 0U);
}

TEST(RefusedMeshOptions, QuadsInFormatsOfTriangles) {
  for (const std::string extension : {"stl", "glb"}) {
    expect_failure(run({"tessellate", "builtin:teapot", "--quads", "-o", "out." + extension}), 2,
                   "--quads: expected an output in obj or ply, found 'out." + extension + "'");
  }
}

TEST(RefusedMeshOptions, JsonAmongData) {
  expect_failure(run({"tessellate", "builtin:teapot", "--stats=json", "-o", "-", "--to", "ply"}), 2,
                 "--stats: expected json for an output that is not standard output");
}

TEST(RefusedMeshOptions, StandardOutputWithoutAFormat) {
  expect_failure(run({"tessellate", "builtin:teapot", "-o", "-"}), 2,
                 "-o: expected a name that ends in .obj, .ply, .stl or .glb, or - with --to");
}

// Vertices and faces come and go block by block.
TEST(MeshMemory, DoesNotGrowWithTheMesh) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory of a sanitizer";
#endif
  for (const char* const format : kExtensions) {
    const auto memory = [&](const char* grid, const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {"tessellate", "builtin:teapot", "--to",   format,
                                            "-o",         "/dev/null",      "--grid", grid};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return outcome.memory;
    };
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--no-weld"}, {"--threads", "1"}}) {
      // 48 MB of vertices, and as much of faces; STL and GLB keep 64 MiB before they use the disk.
      const long spilled = std::string(format) == "stl" || std::string(format) == "glb" ? 66 : 0;
      EXPECT_LT(memory("250", more) - memory("4", more), (24L + spilled) << 10) << format;
    }
  }
}

} // namespace
} // namespace simdbezier::tests
