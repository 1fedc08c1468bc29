// Files of VTK: what they have beside a mesh in other formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::vtu_test {
namespace {

using Strings = std::vector<std::string>;

constexpr std::size_t kQuadOrTriangle[] = {0, 0, 0, 5, 9}; // VTK's cell types by their corners

// The mesh itself is judged in .ply, whose reader and writer share nothing with those of .vtu.
TEST(Vtu, HasTheMeshOfOtherFormats) {
  const Strings cases[] = {
      {"--grid", "5"},
      {"--grid", "5", "--quads"},
      {"--relative", "1e-2", "--quads", "--parameters"},
      {"--relative", "1e-2", "--precision", "f64", "--no-normals"},
      {"--relative", "1e-2", "--precision", "f64", "--vertex-precision", "f32"},
      {"--no-weld", "--grid", "6", "--quads", "--parameters", "--flip"},
      {"--grid", "5", "--crease", "30"}};
  for (const Strings& options : cases) {
    const ReadMesh vtu = read_vtu_mesh(tessellated("builtin:teapot", "vtu", options));
    const ReadMesh ply = read_ply_mesh(tessellated("builtin:teapot", "ply", options));
    EXPECT_EQ(vtu.positions, ply.positions);
    EXPECT_EQ(vtu.normals, ply.normals);
    EXPECT_EQ(vtu.uv, ply.uv);
    EXPECT_EQ(vtu.faces, ply.faces);
    EXPECT_EQ(vtu.deviation, ply.deviation);
    EXPECT_EQ(vtu.generator, ply.generator);
    EXPECT_EQ(vtu.origin, ply.origin);
    EXPECT_EQ(vtu.position_type, ply.position_type == "float" ? "Float32" : "Float64");
    EXPECT_EQ(vtu.attributes.contains("PointData.Normals"), !vtu.normals.empty());
    EXPECT_EQ(vtu.attributes.contains("PointData.TCoords"), !vtu.uv.empty());
    EXPECT_EQ(vtu.patches.size(), vtu.uv.size());
    EXPECT_TRUE(vtu.data.empty());
    for (std::size_t k = 0; k < vtu.faces.size(); ++k) {
      EXPECT_EQ(vtu.cell_types.at(k), kQuadOrTriangle[vtu.faces[k].size()]);
    }
  }
}

TEST(Vtu, IsThisText) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez", bez_text(std::vector<Net>{flat_net()}));
  const std::string bytes =
      tessellated(in, "vtu", {"--grid", "2", "--no-weld", "--parameters", "--curvature"});
  const std::string begin = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="2">
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" offset="0"/>
</Points>
<PointData Normals="Normals" TCoords="TCoords">
<DataArray type="Float32" Name="Normals" NumberOfComponents="3" format="appended" offset="56"/>
<DataArray type="Float32" Name="TCoords" NumberOfComponents="2" format="appended" offset="112"/>
<DataArray type="UInt32" Name="patch" format="appended" offset="152"/>
<DataArray type="Float32" Name="gaussian" format="appended" offset="176"/>
<DataArray type="Float32" Name="mean" format="appended" offset="200"/>
<DataArray type="Float32" Name="kmin" format="appended" offset="224"/>
<DataArray type="Float32" Name="kmax" format="appended" offset="248"/>
</PointData>
<Cells>
<DataArray type="Int32" Name="connectivity" format="appended" offset="272"/>
<DataArray type="Int32" Name="offsets" format="appended" offset="304"/>
<DataArray type="UInt8" Name="types" format="appended" offset="320"/>
</Cells>
<CellData>
</CellData>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="raw">
_)";
  EXPECT_EQ(bytes.substr(0, begin.size()), begin);
  EXPECT_EQ(bytes.size(),
            begin.size() + 330 + std::string("\n</AppendedData>\n</VTKFile>\n").size());
}

// Cells of both kinds, and arrays of every type beside them.
TEST(Vtu, HasDataOfEveryTypeAndMixedCells) {
  SampleMesh mesh = make_sample({.vertices = 24, .faces = 30, .corners = 4, .uv = true}, false);
  for (const std::size_t face : {1U, 2U, 17U}) {
    mesh.corners[4 * face + 3] = tools::kNoVertex;
  }
  mesh.contents.among_quads = 3;
  mesh.contents.data = {{"a<b&\"c\"", tools::number_type<double>(), 2},
                        {"e", tools::number_type<std::int8_t>()},
                        {"f", tools::number_type<std::int64_t>(), 3}};
  ASSERT_EQ(mesh.contents.data_bytes(), 41U);
  const auto byte_of = [](std::size_t vertex, std::size_t k) {
    return static_cast<std::byte>(vertex * 7 + k * 31);
  };
  for (const std::size_t block : {1U, 24U}) {
    const TemporaryFolder folder;
    const std::string path = folder.path("m.vtu");
    const auto writer =
        tools::make_mesh_writer<double>(path, tools::MeshFormat::vtu, mesh.contents);
    for (std::size_t first = 0; first < 24; first += block) {
      std::vector<std::byte> data;
      for (std::size_t k = first * 41; k < (first + block) * 41; ++k) {
        data.push_back(k % 41 % 8 == 7 ? std::byte{0x3f} : byte_of(k / 41, k % 41)); // no nan
      }
      const std::size_t stride = mesh.contents.stride();
      writer->vertices(
          {std::span<const double>(mesh.values).subspan(first * stride, block * stride), {}, data});
    }
    writer->faces(mesh.corners);
    writer->finish();
    const ReadMesh file = read_vtu_mesh(read_file(path));
    EXPECT_EQ(file.data_types.at("a<b&\"c\""), "Float64");
    EXPECT_EQ(file.data_components.at("a<b&\"c\""), 2U);
    EXPECT_EQ(file.data_types.at("e"), "Int8");
    EXPECT_EQ(file.data_components.at("f"), 3U);
    ASSERT_EQ(file.data.at("e").size(), 24U);
    for (std::size_t k = 0; k < 24; ++k) {
      EXPECT_EQ(file.data.at("e")[k], static_cast<std::int8_t>(byte_of(k, 16)));
      const bool triangle = k == 1 || k == 2 || k == 17;
      EXPECT_EQ(file.faces.at(k).size(), triangle ? 3U : 4U);
      EXPECT_EQ(file.cell_types.at(k), triangle ? 5 : 9);
    }
  }
}

// One line of a CSV file of results, as numbers.
std::vector<std::vector<double>> results(const std::string& text) {
  std::vector<std::vector<double>> lines;
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line); // the header
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    lines.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) {
      lines.back().push_back(std::strtod(field.c_str(), nullptr));
    }
  }
  return lines;
}

// What `evaluate` finds where the file says that vertices lie: x y z, nx ny nz, and four
// curvatures.
std::vector<std::vector<double>> evaluated(const std::string& in, const ReadMesh& mesh) {
  std::string samples = "patch,u,v\n";
  for (std::size_t k = 0; k < mesh.patches.size(); ++k) {
    samples += std::to_string(static_cast<std::size_t>(mesh.patches[k])) + "," +
               number_text(mesh.uv[k][0]) + "," + number_text(mesh.uv[k][1]) + "\n";
  }
  const TemporaryFolder folder;
  const std::string out = folder.path("out.csv");
  expect_silent_success(
      run({"evaluate", in, "--samples", folder.write("s.csv", samples), "--precision", "f64",
           "--outputs", "position,normal,curvature", "-o", out}));
  return results(read_file(out));
}

// Which patches' normals the mesh has the other way round, by vertices inside of them: on edges,
// those of several patches are merged.
std::map<double, bool> turned_patches(const ReadMesh& mesh,
                                      const std::vector<std::vector<double>>& expected) {
  const auto is_inside = [](double share) { return share > 0 && share < 1; };
  std::map<double, bool> turned;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    double dot = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      dot += mesh.normals[k][c] * expected[k][6 + c];
    }
    if (is_inside(mesh.uv[k][0]) && is_inside(mesh.uv[k][1]) && std::abs(dot) > 0.99) {
      turned[mesh.patches[k]] = dot < 0;
    }
  }
  return turned;
}

// A bulged patch beside two, so that --split-edges cuts it.
MeshModel bulge_beside_two() {
  MeshModel model;
  model.name = "BulgeBesideTwo";
  const double across[] = {2, 1, 1};
  const double from[] = {0, 0, 1};
  for (std::size_t p = 0; p < 3; ++p) {
    PatchPoints& patch = model.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double u = static_cast<double>(i) / 3;
        const double v = static_cast<double>(j) / 3;
        patch[j][i] = {from[p] + across[p] * u, p == 0 ? v : v - 1, p == 0 ? v * (1 + u) : 0};
      }
    }
  }
  return model;
}

// Patches and parameters are those of the file, also where patches are cut or left out, and so are
// curvatures, whose signs are those of turned patches.
TEST(Vtu, HasThePlacesAndCurvaturesOfTheFilesPatches) {
  const Strings cases[] = {{"--grid", "4"},
                           {"--grid", "4", "--flip"},
                           {"--grid", "4", "--orient"},
                           {"--grid", "4", "--no-weld"},
                           {"--grid", "4", "--no-weld", "--flip"},
                           {"--grid", "3", "--drop-repeated", "--split-edges", "--snap", "1e-9"}};
  std::size_t turned = 0;
  std::size_t compared = 0;
  std::vector<MeshModel> models = mesh_models();
  models.push_back(bulge_beside_two());
  for (const MeshModel& model : models) {
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bez", bez_of(model));
    for (Strings options : cases) {
      if (!model.orientable && options.back() == "--orient") {
        continue;
      }
      options.insert(options.end(), {"--parameters", "--curvature", "--precision", "f64"});
      const ReadMesh mesh = read_vtu_mesh(tessellated(in, "vtu", options));
      const auto expected = evaluated(in, mesh);
      ASSERT_EQ(expected.size(), mesh.positions.size());
      const std::map<double, bool> is_turned = turned_patches(mesh, expected);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const std::vector<double>& at = expected[k];
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(mesh.positions[k][c], at[3 + c], 1e-9) << model.name << " " << k;
        }
        const double gaussian = mesh.data.at("gaussian")[k];
        ASSERT_EQ(std::isnan(gaussian), std::isnan(at[9]));
        if (std::isnan(gaussian)) {
          continue;
        }
        const bool other = is_turned.at(mesh.patches[k]);
        const double error = 1e-6 * (1 + std::abs(at[9]) + at[10] * at[10]);
        EXPECT_NEAR(gaussian, at[9], error);
        EXPECT_NEAR(mesh.data.at("mean")[k], other ? -at[10] : at[10], error);
        EXPECT_NEAR(mesh.data.at("kmin")[k], other ? -at[12] : at[11], error);
        EXPECT_NEAR(mesh.data.at("kmax")[k], other ? -at[11] : at[12], error);
        turned += other && std::abs(at[10]) > 1e-3 ? 1 : 0;
        ++compared;
      }
    }
  }
  EXPECT_GT(turned, 100U);
  EXPECT_GT(compared, 1000U);
}

// Without parameters, curvatures are those of the lowest patch that has the vertex.
TEST(Vtu, HasCurvaturesOfTheLowestPatch) {
  for (const char* const precision : {"f32", "f64"}) {
    const Strings options = {"--grid", "5", "--curvature", "--precision", precision};
    Strings split = options;
    split.emplace_back("--parameters");
    const ReadMesh whole = read_vtu_mesh(tessellated("builtin:teapot", "vtu", options));
    const ReadMesh parts = read_vtu_mesh(tessellated("builtin:teapot", "vtu", split));
    EXPECT_TRUE(whole.patches.empty());
    ASSERT_LT(whole.positions.size(), parts.positions.size());
    std::map<std::array<double, 3>, std::size_t> first; // by positions
    for (std::size_t k = 0; k < parts.positions.size(); ++k) {
      first.try_emplace(parts.positions[k], k);
    }
    std::map<std::array<double, 3>, int> times;
    for (const auto& position : whole.positions) {
      ++times[position];
    }
    for (std::size_t k = 0; k < whole.positions.size(); ++k) {
      const double found = whole.data.at("mean")[k];
      const double expected = parts.data.at("mean")[first.at(whole.positions[k])];
      EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)) ||
                  times[whole.positions[k]] > 1);
    }
  }
}

// A block of patches that own no vertices, because the first patch has them.
TEST(Vtu, HasBlocksWithoutVertices) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez", bez_text(std::vector<Net>(5000, quadratic_net())));
  const ReadMesh mesh = read_vtu_mesh(tessellated(in, "vtu", {"--grid", "2", "--curvature"}));
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.data.at("mean").size(), 4U);
  EXPECT_EQ(mesh.faces.size(), 10000U);
}

} // namespace
} // namespace simdbezier::tests::vtu_test
