// Meshes that a format cannot hold, and writers that are given up.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>

#include <tools/process/failure.hpp>

#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::refused_mesh_test {
namespace {

using tools::MeshContents;
using tools::MeshFormat;
using tools::VertexStorage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Runs it, expects a failure of one line, and returns its text.
std::string failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const tools::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), 1);
    EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos);
    return failure.what();
  }
  ADD_FAILURE() << "nothing failed";
  return "";
}

struct Refused {
  const char* name;
  MeshFormat format;
  std::function<void(MeshContents&)> change;
  std::string expected;
};
void PrintTo(const Refused& item, std::ostream* out) { *out << item.name; }

std::vector<Refused> refused_contents() {
  const auto vertices = [](MeshContents& mesh) { mesh.vertices = 4294967296; };
  const auto faces = [](std::uint64_t count) {
    return [count](MeshContents& mesh) { mesh.faces = count; };
  };
  const auto quads = [](MeshContents& mesh) { mesh.corners = 4; };
  const auto quantised = [](MeshContents& mesh) { mesh.storage = VertexStorage::quantised_8; };
  const auto huge = [](MeshContents& mesh) { mesh.box->high[1] = 1e39; };
  const std::string most = ": expected at most 4294967295 vertices in ";
  const std::string counted = ": expected a file whose bytes can be counted, found more than";
  return {
      {"ObjVertices", MeshFormat::obj, vertices, most + "an OBJ file, found 4294967296"},
      {"PlyVertices", MeshFormat::ply, vertices, most + "a PLY file, found 4294967296"},
      {"StlVertices", MeshFormat::stl, vertices, most + "an STL file, found 4294967296"},
      {"GlbVertices", MeshFormat::glb, vertices, most + "a GLB file, found 4294967296"},
      {"ObjFaces", MeshFormat::obj, faces(std::uint64_t{1} << 63), counted},
      {"PlyFaces", MeshFormat::ply, faces(std::uint64_t{1} << 63), counted},
      {"PlyRoom", MeshFormat::ply, faces(std::uint64_t{1} << 56), ": expected room for"},
      {"ObjRoom", MeshFormat::obj, faces(std::uint64_t{1} << 56), ": expected room for"},
      {"StlFaces", MeshFormat::stl, faces(4294967296),
       ": expected at most 4294967295 faces in an STL file, found 4294967296"},
      {"StlQuads", MeshFormat::stl, quads, ": expected triangles in an STL file, found quads"},
      {"GlbQuads", MeshFormat::glb, quads, ": expected triangles in a GLB file, found quads"},
      {"GlbPatches", MeshFormat::glb, [](MeshContents& mesh) { mesh.patches = 16777217; },
       ": expected at most 16777216 numbered patches in a GLB file, found 16777217"},
      {"PlyQuantised", MeshFormat::ply, quantised,
       ": expected floating-point vertices in a PLY file, found quantised vertices"},
      {"StlHuge", MeshFormat::stl, huge, "expected coordinates that a float can hold, found 1e+39"},
      {"GlbHuge", MeshFormat::glb, huge, "expected coordinates that a float can hold, found 1e+39"},
  };
}

class RefusedMesh : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedMesh, IsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.write("mesh.out", "before");
  SampleMesh mesh = make_sample({}, false);
  GetParam().change(mesh.contents);
  const std::string found = failure_of([&] {
    static_cast<void>(tools::make_mesh_writer<double>(path, GetParam().format, mesh.contents));
  });
  EXPECT_TRUE(found.starts_with(path) && found.find(GetParam().expected) != std::string::npos)
      << found;
  EXPECT_EQ(read_file(path), "before");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"mesh.out"});
}

INSTANTIATE_TEST_SUITE_P(All, RefusedMesh, ::testing::ValuesIn(refused_contents()),
                         [](const auto& test) { return std::string(test.param.name); });

const MeshFormat kFormats[] = {MeshFormat::obj, MeshFormat::ply, MeshFormat::stl,
                               MeshFormat::glb, MeshFormat::vtu, MeshFormat::raw};

TEST(RefusedNumbers, AreNotFinite) {
  for (const MeshFormat format : kFormats) {
    for (const double bad : {kInfinity, -kInfinity, std::nan("")}) {
      for (const std::size_t place : {17U, 20U, 23U}) { // position, normal, uv of vertex 2
        const TemporaryFolder folder;
        SampleMesh mesh = make_sample({.uv = true}, true);
        mesh.values[place] = bad;
        const std::string path = folder.path("mesh.out");
        const std::string found = failure_of([&] {
          write_sample<float>(mesh, *tools::make_mesh_writer<float>(path, format, mesh.contents),
                              2);
        });
        EXPECT_TRUE(found.starts_with(path + ": expected finite numbers, found ")) << found;
        EXPECT_TRUE(found.ends_with(" at vertex 2")) << found;
        EXPECT_TRUE(folder.names().empty());
      }
    }
  }
}

TEST(RefusedNumbers, DoNotFitIntoFloats) {
  for (const MeshFormat format : {MeshFormat::stl, MeshFormat::glb}) {
    const TemporaryFolder folder;
    SampleMesh mesh = make_sample({}, false);
    mesh.contents.box.reset();
    mesh.values[6] = -1e39;
    const std::string found = failure_of([&] {
      write_sample<double>(
          mesh, *tools::make_mesh_writer<double>(folder.path("m"), format, mesh.contents), 5);
    });
    EXPECT_NE(found.find("expected coordinates that a float can hold, found -1e+39"),
              std::string::npos)
        << found;
    EXPECT_TRUE(folder.names().empty());
  }
}

// Control points that fit floats, of a patch whose error bound is infinite.
TEST(RefusedNumbers, AreNotThoseThatFitIntoFloats) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bv", "4 1 0 0 0 3e38 0 0 0 3e38 0 3e38 3e38 0\n");
  for (const char* const name :
       {"out.stl", "out.glb", "out.obj", "out.ply", "out.vtu", "out.raw"}) {
    for (const char* const precision : {"f32", "f64"}) {
      const Outcome made =
          run({"tessellate", in, "-o", folder.path(name), "--grid", "3", "--precision", precision});
      EXPECT_EQ(made.exit_code, 0) << name << ": " << made.err;
    }
  }
}

TEST(RefusedNumbers, AreOutsideOfTheBox) {
  const TemporaryFolder folder;
  SampleMesh mesh = make_sample({.storage = VertexStorage::quantised_16}, false);
  mesh.values[7] = -3.500001;
  const std::string found = failure_of([&] {
    write_sample<double>(
        mesh,
        *tools::make_mesh_writer<double>(folder.path("m.glb"), MeshFormat::glb, mesh.contents), 5);
  });
  EXPECT_NE(found.find("expected positions within their box"), std::string::npos) << found;
  EXPECT_TRUE(folder.names().empty());
}

// A writer that is given up leaves what there was.
TEST(RefusedMeshes, LeaveNothingWithoutFinish) {
  for (const MeshFormat format : kFormats) {
    const TemporaryFolder folder;
    const std::string path = folder.write("mesh.out", "before");
    const SampleMesh mesh = make_sample({}, true);
    const std::vector<float> values(mesh.values.begin(), mesh.values.end());
    {
      const auto writer = tools::make_mesh_writer<float>(path, format, mesh.contents);
      writer->vertices({values});
      writer->faces(mesh.corners);
      EXPECT_EQ(folder.names().size(), 2U) << "where does it write to?";
    }
    EXPECT_EQ(read_file(path), "before");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"mesh.out"});
  }
}

} // namespace
} // namespace simdbezier::tests::refused_mesh_test
