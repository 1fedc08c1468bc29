// VTKHDF files by many processes, as h5py and VTK read them, beside the program's own files of the
// same meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/parts/mpi_ranks.hpp"
#include "tests/program/parts/part_models.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::hdf_test {
namespace {

using Json = nlohmann::json;

// Curvatures are NaN where there is no normal, and NaN is not JSON.
constexpr double kNan = 1e300;
std::string replaced_nan(std::string text) {
  while (text.find("NaN") != std::string::npos) {
    text = replaced(text, "NaN", "1e300");
  }
  return text;
}

class Hdf : public MpiRanks {
protected:
  void SetUp() override {
    MpiRanks::SetUp();
    if (IsSkipped()) {
      return;
    }
    const std::string out = folder_.path("any.hdf");
    const Answer answer = run_ranks(1, "tessellate builtin:teapot --grid 2 -o " + out);
    if (answer.exit_code == 2) {
      EXPECT_NE(answer.err.find("hdf needs HDF5"), std::string::npos) << answer.err;
      GTEST_SKIP() << "simdbezier-mpi is built without HDF5";
    }
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    std::filesystem::remove(out);
  }
  // What a script prints about the file; nothing where Debian's Python lacks the module.
  static Json as_read_by(const std::string& module, const std::string& script,
                         const std::string& path) {
    const std::string python = "/usr/bin/python3 ";
    if (std::system((python + "-c 'import " + module + "' 2>/dev/null").c_str()) != 0) {
      return {};
    }
    std::string text;
    FILE* const pipe = popen((python + script + " '" + path + "'").c_str(), "r");
    for (char buffer[4096]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) {
      text += buffer;
    }
    EXPECT_EQ(pclose(pipe), 0) << text;
    return Json::parse(replaced_nan(text), nullptr, false);
  }
};

std::vector<double> flat(const std::vector<std::array<double, 3>>& points) {
  std::vector<double> values;
  for (const auto& point : points) {
    values.insert(values.end(), point.begin(), point.end());
  }
  return values;
}

// The mesh of a .vtu file, in which all is.
void expect_mesh(const Json& found, const ReadMesh& mesh) {
  EXPECT_EQ(found["points"], Json(mesh.positions));
  EXPECT_EQ(found["faces"], Json(mesh.faces));
  EXPECT_EQ(found["types"].get<std::vector<double>>(), mesh.cell_types);
  const auto values = [&](const char* group, const std::string& name) {
    return found[group].value(name, Json::object()).value("values", std::vector<double>());
  };
  EXPECT_EQ(values("point_data", "Normals"), flat(mesh.normals));
  EXPECT_EQ(values("point_data", "patch"), mesh.patches);
  std::vector<double> uv;
  for (const auto& [u, v] : mesh.uv) {
    uv.insert(uv.end(), {u, v});
  }
  EXPECT_EQ(values("point_data", "TCoords"), uv);
  for (auto [name, data] : mesh.data) {
    std::ranges::replace_if(
        data, [](double value) { return std::isnan(value); }, kNan);
    EXPECT_EQ(values("point_data", name), data) << name;
  }
  using Values = std::vector<double>;
  EXPECT_EQ(values("fields", "deviation"), mesh.deviation ? Values{*mesh.deviation} : Values());
  EXPECT_EQ(values("fields", "origin"),
            mesh.origin ? Values(mesh.origin->begin(), mesh.origin->end()) : Values());
}

// What VTK 9.1 asks for in addition, and does not say what it makes of it.
void expect_form(const Json& found, const ReadMesh& mesh, bool doubles) {
  EXPECT_EQ(found["attributes"]["Type"], "b'UnstructuredGrid'");
  EXPECT_EQ(found["attributes"]["Version"], "[1 0]");
  EXPECT_EQ(found["point_type"], doubles ? "float64" : "float32");
  EXPECT_EQ(found["index_types"], Json({"int32", "int32"}));
  EXPECT_EQ(found["counts"]["NumberOfPoints"], Json({mesh.positions.size()}));
  EXPECT_EQ(found["counts"]["NumberOfCells"], Json({mesh.faces.size()}));
  EXPECT_EQ(found["counts"]["NumberOfConnectivityIds"], Json({found["corners"]}));
  EXPECT_EQ(found["ends"], mesh.faces.size() + 1);
}

TEST_P(Hdf, holds_what_the_program_writes_whichever_ranks_wrote_it) {
  constexpr const char* kOptions[] = {
      "--relative 1e-2", "--grid 4x3 --quads --parameters --curvature",
      "--tolerance 0.05 --precision f64 --crease 30 --quads", "--no-weld --grid 3 --no-normals",
      "--grid 3 --precision f64 --vertex-precision f32 --origin 1,2,3.5"};
  constexpr int kRanks[] = {1, 2, 3, 5, 7};
  constexpr int kPatches[] = {65536, 9, 2};
  std::size_t number = 0;
  for (const PartModel& model : part_models(folder_)) {
    for (const std::string options : kOptions) {
      if (!in_form(number++, 13)) {
        continue;
      }
      SCOPED_TRACE(model.name + " " + options);
      const std::string words = "tessellate '" + model.path + "' " + options + " -o ";
      const std::string whole = folder_.path("whole.vtu");
      ASSERT_EQ(
          std::system(
              (std::string(SIMDBEZIER_PROGRAM) + " " + words + whole + " 2>/dev/null").c_str()),
          0);
      std::string first;
      const std::string out = folder_.path("out.hdf");
      for (std::size_t k = 0; k < 3; ++k) {
        const int ranks = kRanks[(number + 2 * k) % std::size(kRanks)];
        const Answer answer =
            run_ranks(ranks, words + out + " --shard-patches " + std::to_string(kPatches[k]),
                      1 + static_cast<int>(k % 2));
        ASSERT_EQ(answer.exit_code, 0) << answer.err;
        EXPECT_FALSE(has_leftovers());
        const std::string bytes = read_file(out);
        first = k == 0 ? bytes : first;
        EXPECT_TRUE(bytes == first) << ranks << " ranks, " << kPatches[k] << " patches at a time";
      }
      const ReadMesh mesh = read_vtu_mesh(read_file(whole));
      if (const Json vtk = as_read_by("vtk", SIMDBEZIER_VTK_SCRIPT, out); !vtk.is_null()) {
        EXPECT_EQ(vtk["complaints"], Json::array());
        expect_mesh(vtk, mesh);
      }
      if (const Json h5py = as_read_by("h5py", SIMDBEZIER_H5PY_SCRIPT, out); !h5py.is_null()) {
        expect_mesh(h5py, mesh);
        expect_form(h5py, mesh, mesh.position_type == "Float64");
      }
    }
  }
}

TEST_P(Hdf, faults_leave_nothing) {
  // Of a run that was killed, and longer than the file.
  folder_.write(".out.hdf.simdbezier-mpi.tmp", std::string(1 << 20, 'x'));
  const std::string words = "tessellate builtin:teapot -o " + folder_.path("out.hdf");
  const Answer answer = run_ranks(2, words + " --grid 2");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_FALSE(has_leftovers());
  const std::string bytes = read_file(folder_.path("out.hdf"));
  EXPECT_LT(bytes.size(), 1U << 20);
  struct Fault {
    const char* name;
    const char* message;
  };
  // HDF5 writes little, and ranks write much at a time.
  for (const Fault& fault : {Fault{"disk_full", "out.hdf: expected room to write, found"},
                             Fault{"disk_full_for_much", "out.hdf: expected room to write, found"},
                             Fault{"sync_fails", "out.hdf: expected room to write, found"},
                             Fault{"rename_refused", "out.hdf: expected a place"}}) {
    SCOPED_TRACE(fault.name);
    const Answer failed =
        run_ranks(2, words + " --grid 120", 1,
                  std::string("LD_PRELOAD=" SIMDBEZIER_FAULT_LIBRARY " SIMDBEZIER_TEST_FAULT=") +
                      fault.name + " ");
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_NE(failed.err.find(fault.message), std::string::npos) << failed.err;
    EXPECT_FALSE(has_leftovers());
    EXPECT_TRUE(read_file(folder_.path("out.hdf")) == bytes);
  }
}

TEST(OneProcess, names_the_program_that_writes_vtkhdf) {
  const TemporaryFolder folder;
  for (const char* const command : {"tessellate", "plan"}) {
    std::vector<std::string> words = {command, "builtin:teapot", "-o", folder.path("a.hdf")};
    if (command == std::string("plan")) {
      words.insert(words.end(), {"--shards", "2"});
    }
    expect_failure(run(words), 2, "a.hdf' (which simdbezier-mpi writes)");
  }
  expect_failure(run({"tessellate", "builtin:teapot", "-o", "-", "--to", "hdf"}), 2,
                 "'hdf' (which simdbezier-mpi writes)");
  EXPECT_TRUE(folder.names().empty());
}

INSTANTIATE_TEST_SUITE_P(All, Hdf, ::testing::Range(std::size_t{0}, std::size(kLaunchers)));

} // namespace
} // namespace simdbezier::tests::hdf_test
