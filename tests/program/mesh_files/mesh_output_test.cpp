// What tessellate says about meshes, and where it writes them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <simdbezier/simdbezier.hpp>

#include <cstdlib>
#include <ostream>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::mesh_output_test {
namespace {

using Json = nlohmann::ordered_json;

const char* const kExtensions[] = {"obj", "ply", "stl", "glb", "vtu", "raw"};

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
  EXPECT_EQ(names, (std::vector<std::string>{"patches", "vertices", "triangles", "deviation",
                                             "diagonal", "open_edges", "non_manifold_edges",
                                             "turned_edges", "orientable", "repeated_patches",
                                             "samples", "samples_per_second", "seconds"}));
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
  EXPECT_EQ(stats["turned_edges"], 0);
  EXPECT_EQ(stats["orientable"], true);
  EXPECT_EQ(stats["repeated_patches"], 0);
  EXPECT_EQ(stats["samples"], mesh.positions.size());
  EXPECT_NEAR(stats["samples_per_second"].get<double>() *
                  stats["seconds"]["evaluate"].get<double>(),
              stats["samples"].get<double>(), 0.5);
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
      const ReadMesh mesh = read_mesh(extension, read_file(out));
      EXPECT_EQ(stats["deviation"].get<double>(), mesh.deviation.value_or(0)) << extension;
    }
  }
}

// Meshes of sheets state nothing in their files, which are as they always were.
TEST(MeshStatistics, AreOfSheetsAsWell) {
  const auto stats = [](const std::string& grid, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "tessellate", "builtin:teapot", "--no-weld", "--grid", grid, "--stats=json",
        "-o",         "/dev/null",      "--to",      "glb"};
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
    const bool one_side = model.name.starts_with("ring turned by half");
    EXPECT_EQ(stats["orientable"], !one_side) << model.name;
    EXPECT_TRUE(!one_side || stats["turned_edges"] > 0) << model.name;
    EXPECT_EQ(stats["repeated_patches"], model.name.starts_with("one patch twice") ? 1 : 0)
        << model.name;
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
          "edges of patches   16 open, 0 non-manifold, 0 between patches that disagree\n",
          "\nrepeated patches   0\n", "\nseconds            read "}) {
      EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
    }
  }
}

// Six digits of a bound are a bound, and not more than one of their last digit larger.
TEST(MeshStatistics, PrintBoundsThatAreRoundedUp) {
  const TemporaryFolder folder;
  for (const char* const grid : {"3", "4", "5", "6", "7", "8", "9", "10"}) {
    const auto printed = [&](const char* form) {
      const Outcome outcome =
          run({"tessellate", "builtin:teapot", form, "--grid", grid, "-o", folder.path("out.ply")});
      return outcome.out + outcome.err;
    };
    const Json stats = Json::parse(printed("--stats=json"), nullptr, false);
    const std::string text = printed("--stats");
    const std::size_t at = text.find("\ndeviation ");
    ASSERT_NE(at, std::string::npos) << text;
    char* end = nullptr;
    const double bound = std::strtod(text.c_str() + at + 11, &end);
    const double share = std::strtod(text.c_str() + text.find("; ", at) + 2, nullptr);
    const double deviation = stats["deviation"];
    const double exact_share = deviation / stats["diagonal"].get<double>();
    EXPECT_GE(bound, deviation);
    EXPECT_LE(bound, deviation * (1 + 1e-5));
    EXPECT_GE(share, exact_share);
    EXPECT_LE(share, exact_share * (1 + 1e-5));
  }
}

// The mesh has no name yet when its statistics are printed.
TEST(MeshStatistics, ThatCannotBePrintedLeaveNoMesh) {
  for (const std::string extension : kExtensions) {
    for (const char* const standard : {"/dev/full", "closed"}) {
      const TemporaryFolder folder;
      const std::string old = folder.write("old." + extension, "before");
      for (const std::string& out : {old, folder.path("new." + extension)}) {
        expect_failure(run({"tessellate", "builtin:teapot", "--stats=json", "-o", out},
                           {.append_path = standard}),
                       1, "standard output: expected room to write");
      }
      EXPECT_EQ(read_file(old), "before");
      EXPECT_EQ(folder.names(), std::vector<std::string>{"old." + extension});
    }
  }
}

// A mesh so small that no more than its last bytes are refused.
TEST(MeshStatistics, AreNotPrintedWhereThereIsNoMesh) {
  for (const std::string extension : kExtensions) {
    const Outcome outcome = run({"tessellate", "builtin:teapot", "--grid", "2", "--stats=json",
                                 "-o", "/dev/full", "--to", extension});
    expect_failure(outcome, 1, "/dev/full: expected room to write");
    EXPECT_EQ(outcome.out, "") << extension;
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
      // 48 MB of vertices, and as much of faces; some keep 64 MiB before they use the disk.
      const long spilled = std::string(format) == "obj" || std::string(format) == "ply" ? 0 : 66;
      EXPECT_LT(memory("250", more) - memory("4", more), (24L + spilled) << 10) << format;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::mesh_output_test
