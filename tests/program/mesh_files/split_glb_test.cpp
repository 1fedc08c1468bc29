// Meshes that are cut into several GLB files because one would be too large: here at a few thousand
// bytes instead of 4 GiB.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>
#include <sys/stat.h>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/process/failure.hpp>

#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::split_glb_test {
namespace {

using tools::VertexStorage;

constexpr std::uint64_t kMostBytes = 8000;

// Strips of triangles whose vertices are numbered as they are met, as those of patches are; now and
// then one names a vertex of long ago.
SampleMesh strips(VertexStorage storage, bool normals) {
  SampleMesh mesh = make_sample(
      {.vertices = 2000, .faces = 1998, .normals = normals, .patches = true, .storage = storage},
      true);
  for (std::uint32_t k = 0; k < 1998; ++k) {
    const std::uint32_t first = k % 97 == 96 ? k / 2 : k;
    std::copy_n(std::array{first, k + 1, k + 2}.begin(), 3, &mesh.corners[std::size_t{3} * k]);
  }
  return mesh;
}

// A triangle by what its corners are, whatever their numbers.
using Corner = std::vector<double>;
std::vector<Corner> corners_of(const ReadMesh& mesh) {
  std::vector<Corner> corners;
  for (const std::vector<std::uint32_t>& face : mesh.faces) {
    for (const std::uint32_t vertex : face) {
      Corner corner(mesh.positions.at(vertex).begin(), mesh.positions.at(vertex).end());
      if (!mesh.normals.empty()) {
        corner.insert(corner.end(), mesh.normals.at(vertex).begin(), mesh.normals.at(vertex).end());
      }
      corner.push_back(mesh.patches.at(vertex));
      corners.push_back(corner);
    }
  }
  return corners;
}

void write_parts(const SampleMesh& mesh, const std::string& path, std::size_t block) {
  write_sample<float>(mesh, *tools::make_split_glb_writer<float>(path, mesh.contents, kMostBytes),
                      block);
}

struct Case {
  const char* name;
  VertexStorage storage;
  bool normals;
};
void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }

class SplitGlb : public ::testing::TestWithParam<Case> {
protected:
  static SampleMesh sample() { return strips(GetParam().storage, GetParam().normals); }
};

TEST_P(SplitGlb, HasTheSameTrianglesInTheSameOrder) {
  const TemporaryFolder folder;
  SampleMesh mesh = sample();
  mesh.contents.deviation = 0.25;
  write_parts(mesh, folder.path("mesh.glb"), 300);
  const std::size_t parts = folder.names().size();
  EXPECT_GT(parts, 4U);
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::string bytes = read_file(folder.path("mesh-" + std::to_string(k) + ".glb"));
    EXPECT_LE(bytes.size(), kMostBytes);
    EXPECT_TRUE(k + 1 == parts || bytes.size() > kMostBytes - 200) << "room was left";
    const ReadMesh part = read_glb_mesh(bytes);
    EXPECT_GE(part.deviation, 0.25);
    const std::vector<Corner> more = corners_of(part);
    corners.insert(corners.end(), more.begin(), more.end());
  }
  EXPECT_EQ(corners, corners_of(read_glb_mesh(written<float>(mesh, tools::MeshFormat::glb))));
}

TEST_P(SplitGlb, IsTheSameWhateverTheBlocks) {
  const SampleMesh mesh = sample();
  std::map<std::string, std::string> first;
  for (const std::size_t block : {1U, 13U, 5000U}) {
    const TemporaryFolder folder;
    write_parts(mesh, folder.path("mesh.glb"), block);
    std::map<std::string, std::string> files;
    for (const std::string& name : folder.names()) {
      files[name] = read_file(folder.path(name));
    }
    first = first.empty() ? files : first;
    EXPECT_TRUE(files == first) << "blocks of " << block;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SplitGlb,
                         ::testing::Values(Case{"Full", VertexStorage::full, true},
                                           Case{"Bare", VertexStorage::full, false},
                                           Case{"Quantised", VertexStorage::quantised_16, true},
                                           Case{"Smallest", VertexStorage::quantised_8, true}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SplitGlbFiles, AppearTogether) {
  const TemporaryFolder folder;
  const SampleMesh mesh = strips(VertexStorage::full, true);
  const std::vector<float> values(mesh.values.begin(), mesh.values.end());
  {
    const auto writer =
        tools::make_split_glb_writer<float>(folder.path("m.glb"), mesh.contents, kMostBytes);
    writer->vertices({values, mesh.patch});
    writer->faces(mesh.corners);
    for (const std::string& name : folder.names()) {
      EXPECT_TRUE(name.ends_with(".tmp")) << name;
    }
    EXPECT_GT(folder.names().size(), 3U);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(SplitGlbFiles, AreNoPipes) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path("pipe.glb");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const SampleMesh mesh = strips(VertexStorage::full, true);
  try {
    static_cast<void>(tools::make_split_glb_writer<float>(pipe, mesh.contents, kMostBytes));
    FAIL() << "nothing failed";
  } catch (const tools::Failure& failure) {
    EXPECT_EQ(failure.what(), pipe + ": expected a mesh that fits into one GLB file, found 2000 "
                                     "vertices and 1998 triangles");
  }
}

TEST(SplitGlbFiles, WantVerticesInOrder) {
  const TemporaryFolder folder;
  SampleMesh mesh = strips(VertexStorage::full, true);
  std::reverse(mesh.corners.begin(), mesh.corners.end());
  try {
    write_parts(mesh, folder.path("m.glb"), 100);
    FAIL() << "nothing failed";
  } catch (const tools::Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("too far apart for one GLB file"), std::string::npos)
        << failure.what();
  }
  EXPECT_TRUE(folder.names().empty());
}

} // namespace
} // namespace simdbezier::tests::split_glb_test
