// What the writers of mesh files write, read back by readers of our own: the same mesh bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <sstream>

#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"

namespace simdbezier::tests::mesh_file_test {
namespace {

using tools::MeshFormat;
using tools::VertexStorage;

struct Case {
  const char* name;
  MeshFormat format;
  bool doubles;
  SampleShape shape;
  const char* index_type = "";
};
void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }

const Case kCases[] = {
    {"ObjF32", MeshFormat::obj, false, {}},
    {"ObjF64", MeshFormat::obj, true, {}},
    {"ObjBare", MeshFormat::obj, false, {.normals = false}},
    {"ObjUv", MeshFormat::obj, false, {.normals = false, .uv = true}},
    {"ObjAll", MeshFormat::obj, true, {.uv = true, .patches = true}},
    {"ObjQuads", MeshFormat::obj, false, {.corners = 4}},
    {"ObjEmpty", MeshFormat::obj, false, {.vertices = 0, .faces = 0}},
    {"PlyF32", MeshFormat::ply, false, {}, "int"},
    {"PlyF64", MeshFormat::ply, true, {}, "int"},
    {"PlyBare", MeshFormat::ply, false, {.normals = false}, "int"},
    {"PlyUv", MeshFormat::ply, false, {.normals = false, .uv = true}, "int"},
    {"PlyAll", MeshFormat::ply, true, {.uv = true, .patches = true}, "int"},
    {"PlyPatches", MeshFormat::ply, false, {.normals = false, .patches = true}, "int"},
    {"PlyQuads", MeshFormat::ply, false, {.corners = 4}, "int"},
    {"PlyEmpty", MeshFormat::ply, false, {.vertices = 0, .faces = 0}, "int"},
    {"ObjFloats", MeshFormat::obj, true, {.uv = true, .floats = true}},
    {"PlyFloats", MeshFormat::ply, true, {.floats = true}, "int"},
    {"PlyAllFloats", MeshFormat::ply, true, {.uv = true, .patches = true, .floats = true}, "int"},
    {"PlyFloatsOfFloats", MeshFormat::ply, false, {.floats = true}, "int"},
    {"StlF32", MeshFormat::stl, false, {.normals = false}},
    {"StlF64", MeshFormat::stl, true, {.uv = true}},
    {"StlEmpty", MeshFormat::stl, false, {.vertices = 0, .faces = 0}},
    {"GlbF32", MeshFormat::glb, false, {}, "ushort"},
    {"GlbF64", MeshFormat::glb, true, {}, "ushort"},
    {"GlbBare", MeshFormat::glb, false, {.normals = false}, "ushort"},
    {"GlbOddIndices", MeshFormat::glb, false, {.vertices = 3, .faces = 1}, "ushort"},
    {"GlbUv", MeshFormat::glb, false, {.normals = false, .uv = true}, "ushort"},
    {"GlbAll", MeshFormat::glb, false, {.uv = true, .patches = true}, "ushort"},
    {"Glb65534", MeshFormat::glb, false, {.vertices = 65534, .normals = false}, "ushort"},
    {"Glb65535", MeshFormat::glb, false, {.vertices = 65535, .normals = false}, "ushort"},
    {"Glb65536", MeshFormat::glb, false, {.vertices = 65536, .normals = false}, "uint"},
    {"GlbQuantised", MeshFormat::glb, false, {.storage = VertexStorage::quantised_16}, "ushort"},
    {"GlbQuantisedF64",
     MeshFormat::glb,
     true,
     {.vertices = 65536, .uv = true, .storage = VertexStorage::quantised_16},
     "uint"},
    {"GlbQuantised8",
     MeshFormat::glb,
     false,
     {.vertices = 999, .uv = true, .patches = true, .storage = VertexStorage::quantised_8},
     "ushort"},
    {"GlbQuantisedBare",
     MeshFormat::glb,
     false,
     {.normals = false, .storage = VertexStorage::quantised_8},
     "ushort"},
    {"GlbEmpty", MeshFormat::glb, false, {.vertices = 0, .faces = 0}},
    {"GlbWithoutFaces", MeshFormat::glb, false, {.vertices = 5, .faces = 0}},
    {"RawF32", MeshFormat::raw, false, {}, "<u4"},
    {"RawF64", MeshFormat::raw, true, {}, "<u4"},
    {"RawBare", MeshFormat::raw, false, {.normals = false}, "<u4"},
    {"RawUv", MeshFormat::raw, true, {.normals = false, .uv = true}, "<u4"},
    {"RawAll", MeshFormat::raw, true, {.uv = true, .patches = true}, "<u4"},
    {"RawPatches", MeshFormat::raw, false, {.normals = false, .patches = true}, "<u4"},
    {"RawQuads", MeshFormat::raw, false, {.vertices = 9000, .corners = 4}, "<u4"},
    {"RawFloats", MeshFormat::raw, true, {.uv = true, .patches = true, .floats = true}, "<u4"},
    {"RawEmpty", MeshFormat::raw, false, {.vertices = 0, .faces = 0}, "<u4"},
    {"VtuF32", MeshFormat::vtu, false, {}, "Int32"},
    {"VtuF64", MeshFormat::vtu, true, {}, "Int32"},
    {"VtuBare", MeshFormat::vtu, false, {.normals = false}, "Int32"},
    {"VtuUv", MeshFormat::vtu, true, {.normals = false, .uv = true}, "Int32"},
    {"VtuAll", MeshFormat::vtu, true, {.uv = true, .patches = true}, "Int32"},
    {"VtuPatches", MeshFormat::vtu, false, {.normals = false, .patches = true}, "Int32"},
    {"VtuQuads", MeshFormat::vtu, false, {.vertices = 9000, .corners = 4}, "Int32"},
    {"VtuFloats", MeshFormat::vtu, true, {.uv = true, .patches = true, .floats = true}, "Int32"},
    {"VtuEmpty", MeshFormat::vtu, false, {.vertices = 0, .faces = 0}, "Int32"},
    {"VtuWithoutFaces", MeshFormat::vtu, false, {.vertices = 5, .faces = 0}, "Int32"},
};

ReadMesh read(MeshFormat format, const std::string& bytes) {
  switch (format) {
  case MeshFormat::obj:
    return read_obj_mesh(bytes);
  case MeshFormat::ply:
    return read_ply_mesh(bytes);
  case MeshFormat::stl:
    return read_stl_mesh(bytes);
  case MeshFormat::vtu:
    return read_vtu_mesh(bytes);
  case MeshFormat::raw:
    return read_raw_mesh(bytes);
  case MeshFormat::hdf: // which no case has: only ranks write it
  case MeshFormat::glb:
    break;
  }
  return read_glb_mesh(bytes);
}

class MeshFile : public ::testing::TestWithParam<Case> {
protected:
  static SampleMesh sample() { return make_sample(GetParam().shape, !GetParam().doubles); }
  static std::string bytes(const SampleMesh& mesh, std::size_t block = 1000000) {
    return GetParam().doubles ? written<double>(mesh, GetParam().format, block)
                              : written<float>(mesh, GetParam().format, block);
  }
  static bool is_empty() { return GetParam().shape.vertices == 0 || GetParam().shape.faces == 0; }
  static bool has_floats() {
    return GetParam().shape.floats || GetParam().format == MeshFormat::stl ||
           GetParam().format == MeshFormat::glb;
  }
  // The number that a file should hold for one that is not quantised.
  static double stored(double value) {
    return has_floats() ? double{static_cast<float>(value)} : value;
  }
  // Text says a float by as many digits as it takes.
  static double found(double value) {
    return GetParam().doubles && !GetParam().shape.floats ? value
                                                          : double{static_cast<float>(value)};
  }
  template <std::size_t N>
  static void expect_equal(const double* expected, const std::array<double, N>& values) {
    for (std::size_t c = 0; c < N; ++c) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(stored(expected[c])),
                std::bit_cast<std::uint64_t>(found(values[c])))
          << expected[c] << " and " << values[c];
    }
  }
  // The nearest whole number to value * most.
  static void expect_nearest(double value, double most, double whole) {
    EXPECT_EQ(whole, std::floor(whole));
    EXPECT_LE(std::abs(whole - value * most), 0.5 + 1e-9) << value;
  }
  static void expect_quantised(const SampleMesh& mesh, const ReadMesh& file) {
    const tools::MeshBox& box = *mesh.contents.box;
    EXPECT_EQ(file.translation, box.low);
    EXPECT_EQ(file.scale, 10); // the largest of 8, 8.5 and 10
    const double normal_most = GetParam().shape.storage == VertexStorage::quantised_8 ? 127 : 32767;
    for (std::size_t k = 0; k < file.positions.size(); ++k) {
      const double* const vertex = mesh.vertex(k);
      for (std::size_t c = 0; c < 3; ++c) {
        expect_nearest((vertex[c] - box.low[c]) / file.scale, 65535, file.positions[k][c]);
        if (mesh.contents.normals) {
          expect_nearest(vertex[3 + c], normal_most, file.normals.at(k)[c]);
        }
      }
      for (std::size_t c = 0; c < 2 && mesh.contents.uv; ++c) {
        expect_nearest(vertex[(mesh.contents.normals ? 6U : 3U) + c], 65535, file.uv.at(k)[c]);
      }
    }
  }
};

TEST_P(MeshFile, HasEveryVertexBitForBit) {
  const SampleMesh mesh = sample();
  const ReadMesh file = read(GetParam().format, bytes(mesh));
  if (GetParam().format == MeshFormat::stl) {
    ASSERT_EQ(file.positions.size(), mesh.corners.size());
    for (std::size_t k = 0; k < mesh.corners.size(); ++k) {
      expect_equal(mesh.vertex(mesh.corners[k]), file.positions[k]);
    }
    return;
  }
  const bool is_without = GetParam().format == MeshFormat::glb && is_empty();
  const std::size_t count = is_without ? 0 : mesh.contents.vertices;
  ASSERT_EQ(file.positions.size(), count);
  ASSERT_EQ(file.normals.size(), mesh.contents.normals ? count : 0);
  ASSERT_EQ(file.uv.size(), mesh.contents.uv ? count : 0);
  if (file.quantised) {
    return expect_quantised(mesh, file);
  }
  for (std::size_t k = 0; k < count; ++k) {
    expect_equal(mesh.vertex(k), file.positions[k]);
    if (mesh.contents.normals) {
      expect_equal(mesh.vertex(k) + 3, file.normals[k]);
    }
    if (mesh.contents.uv) {
      expect_equal(mesh.vertex(k) + (mesh.contents.normals ? 6 : 3), file.uv[k]);
    }
  }
}

TEST_P(MeshFile, HasEveryFaceAndPatchNumber) {
  const SampleMesh mesh = sample();
  const ReadMesh file = read(GetParam().format, bytes(mesh));
  ASSERT_EQ(file.faces.size(), mesh.contents.faces);
  for (std::size_t k = 0; k < file.faces.size(); ++k) {
    ASSERT_EQ(file.faces[k].size(), mesh.contents.corners);
    for (std::size_t c = 0; c < mesh.contents.corners && GetParam().format != MeshFormat::stl;
         ++c) {
      EXPECT_EQ(file.faces[k][c], mesh.corners[k * mesh.contents.corners + c]);
    }
  }
  if (GetParam().format != MeshFormat::obj && GetParam().format != MeshFormat::stl) {
    EXPECT_EQ(file.patches, std::vector<double>(mesh.patch.begin(), mesh.patch.end()));
  }
  EXPECT_EQ(file.index_type, GetParam().index_type);
}

TEST_P(MeshFile, SaysItsDeviation) {
  SampleMesh mesh = sample();
  EXPECT_EQ(read(GetParam().format, bytes(mesh)).deviation, std::nullopt);
  if (GetParam().format == MeshFormat::ply) {
    EXPECT_EQ(read(GetParam().format, bytes(mesh)).position_type,
              GetParam().doubles && !has_floats() ? "double" : "float");
  }
  if (GetParam().format == MeshFormat::vtu) {
    EXPECT_EQ(read(GetParam().format, bytes(mesh)).position_type,
              GetParam().doubles && !has_floats() ? "Float64" : "Float32");
  }
  if (GetParam().format == MeshFormat::raw && !is_empty()) {
    EXPECT_EQ(read(GetParam().format, bytes(mesh)).position_type,
              GetParam().doubles && !has_floats() ? "<f8" : "<f4");
  }
  mesh.contents.deviation = 0.1;
  mesh.contents.generator = "test \"1.0\"";
  const ReadMesh file = read(GetParam().format, bytes(mesh));
  ASSERT_TRUE(file.deviation);
  EXPECT_NE(file.generator.find("test \"1.0\""), std::string::npos) << file.generator;
  // What storing adds: half a step of a quantised component, or of a double that becomes a float.
  const double step = GetParam().shape.storage != VertexStorage::full ? 10.0 / 65535 / 2
                      : has_floats() && GetParam().doubles            ? 6 * 0x1p-24
                                                                      : 0;
  EXPECT_GE(*file.deviation, 0.1 + step * std::sqrt(3.0));
  EXPECT_LE(*file.deviation, 0.1 + step * std::sqrt(3.0) * 1.05);
}

// OBJ has the lines of a block by their kinds, so there only their order within a kind is the same.
std::vector<std::string> lines_by_kind(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  std::ranges::stable_sort(lines, {},
                           [](const std::string& line) { return line.substr(0, line.find(' ')); });
  return lines;
}

TEST_P(MeshFile, IsTheSameWhateverTheBlocks) {
  const SampleMesh mesh = sample();
  const std::string whole = bytes(mesh);
  for (const std::size_t block : {1U, 7U, 1000U}) {
    const std::string file = bytes(mesh, block);
    EXPECT_TRUE(GetParam().format == MeshFormat::obj ? lines_by_kind(file) == lines_by_kind(whole)
                                                     : file == whole)
        << "blocks of " << block;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFile, ::testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MeshFileStl, NormalsAreThoseOfTheFacets) {
  SampleMesh mesh = make_sample({.vertices = 300, .faces = 500, .normals = false}, true);
  mesh.corners[3] = mesh.corners[4]; // no area
  const ReadMesh file = read_stl_mesh(written<float>(mesh, MeshFormat::stl));
  EXPECT_EQ(file.normals.at(1), (std::array<double, 3>{0, 0, 0}));
  for (std::size_t k = 0; k < file.normals.size(); ++k) {
    const auto& n = file.normals[k];
    const double length = std::hypot(n[0], n[1], n[2]);
    if (length == 0) {
      const std::uint32_t* corner = &mesh.corners[3 * k];
      EXPECT_TRUE(corner[0] == corner[1] || corner[1] == corner[2] || corner[0] == corner[2]);
      continue;
    }
    EXPECT_NEAR(length, 1, 1e-6);
    std::array<std::array<double, 3>, 2> side{};
    for (std::size_t c = 0; c < 3; ++c) {
      side[0][c] = file.positions[3 * k + 1][c] - file.positions[3 * k][c];
      side[1][c] = file.positions[3 * k + 2][c] - file.positions[3 * k][c];
    }
    // Right-handed: positive determinant, and at right angles to both sides.
    double determinant = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      const std::size_t e = (c + 2) % 3;
      determinant += n[c] * (side[0][d] * side[1][e] - side[0][e] * side[1][d]);
    }
    EXPECT_GT(determinant, 0);
    for (const auto& s : side) {
      EXPECT_NEAR(n[0] * s[0] + n[1] * s[1] + n[2] * s[2], 0, 1e-5);
    }
  }
}

// glTF wants unit length, and the library gives zero where a surface has no normal.
TEST(MeshFileGlb, ReplacesMissingNormals) {
  SampleMesh mesh = make_sample({}, true);
  std::fill_n(mesh.values.begin() + 3, 3, 0.0);
  EXPECT_EQ(read_ply_mesh(written<float>(mesh, MeshFormat::ply)).normals.front(),
            (std::array<double, 3>{0, 0, 0}));
  for (const auto& [storage, one] :
       {std::pair(VertexStorage::full, 1.0), std::pair(VertexStorage::quantised_16, 32767.0),
        std::pair(VertexStorage::quantised_8, 127.0)}) {
    mesh.contents.storage = storage;
    EXPECT_EQ(read_glb_mesh(written<float>(mesh, MeshFormat::glb)).normals.front(),
              (std::array<double, 3>{0, 0, one}));
  }
}

TEST(MeshFileGlb, QuantisesASinglePoint) {
  SampleMesh mesh = make_sample({.vertices = 3, .normals = false}, true);
  mesh.values = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  mesh.contents.box = tools::MeshBox{{1, 2, 3}, {1, 2, 3}};
  mesh.contents.storage = VertexStorage::quantised_16;
  const ReadMesh file = read_glb_mesh(written<float>(mesh, MeshFormat::glb));
  EXPECT_EQ(file.positions.at(2), (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(file.translation, (std::array<double, 3>{1, 2, 3}));
  EXPECT_GT(file.scale, 0);
}

TEST(MeshFormatOf, GoesByTheExtension) {
  EXPECT_EQ(tools::mesh_format_of("a/b.obj"), MeshFormat::obj);
  EXPECT_EQ(tools::mesh_format_of("b.PLY"), MeshFormat::ply);
  EXPECT_EQ(tools::mesh_format_of("b.ply.stl"), MeshFormat::stl);
  EXPECT_EQ(tools::mesh_format_of("b.glb"), MeshFormat::glb);
  EXPECT_EQ(tools::mesh_format_of("b.vtu"), MeshFormat::vtu);
  EXPECT_EQ(tools::mesh_format_of("b.raw"), MeshFormat::raw);
  for (const char* const name : {"", "-", "obj", "b.gltf", "b.glb.gz", "b.", ".ply"}) {
    EXPECT_EQ(tools::mesh_format_of(name), std::nullopt) << name;
  }
}

} // namespace
} // namespace simdbezier::tests::mesh_file_test
