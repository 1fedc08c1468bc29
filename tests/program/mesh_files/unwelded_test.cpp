// Meshes whose patches stay apart, as the program has always written them, and in every format.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::unwelded_test {
namespace {

std::string tessellated(const std::string& in, const std::string& extension,
                        const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out." + extension);
  std::vector<std::string> arguments = {"tessellate", in, "--no-weld", "-o", out};
  arguments.insert(arguments.end(), options.begin(), options.end());
  expect_silent_success(run(arguments));
  return read_file(out);
}

// The unit square at z = 0 and at z = 1.
std::string two_squares(const TemporaryFolder& folder) {
  std::vector<Net> nets = {flat_net(), flat_net()};
  for (Vector3& point : nets[1].points) {
    point[2] = 1;
  }
  return folder.write("squares.bez", bez_text(nets));
}

// What the faces enclose together with the origin.
double volume_of(const ReadMesh& mesh) {
  double sum = 0;
  for (const std::vector<std::uint32_t>& face : mesh.faces) {
    const Vector3& a = mesh.positions[face[0]];
    for (std::size_t c = 2; c < face.size(); ++c) {
      const Vector3& b = mesh.positions[face[c - 1]];
      const Vector3& d = mesh.positions[face[c]];
      sum += a[0] * (b[1] * d[2] - b[2] * d[1]) + a[1] * (b[2] * d[0] - b[0] * d[2]) +
             a[2] * (b[0] * d[1] - b[1] * d[0]);
    }
  }
  return sum / 6;
}

TEST(UnweldedMesh, IsTheSameTextAsEver) {
  const TemporaryFolder folder;
  const std::string positions = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
  std::string normals;
  for (int k = 0; k < 8; ++k) {
    normals += "vn 0 0 1\n";
  }
  EXPECT_EQ(tessellated(two_squares(folder), "obj", {"--grid", "2"}),
            positions + normals +
                "f 1//1 2//2 4//4\nf 1//1 4//4 3//3\nf 5//5 6//6 8//8\nf 5//5 8//8 7//7\n");
  EXPECT_EQ(tessellated(two_squares(folder), "obj", {"--grid", "2", "--no-normals"}),
            positions + "f 1 2 4\nf 1 4 3\nf 5 6 8\nf 5 8 7\n");
}

TEST(UnweldedMesh, IsTheSamePlyAsEver) {
  std::string expected = "ply\nformat binary_little_endian 1.0\nelement vertex 8\n"
                         "property float x\nproperty float y\nproperty float z\n"
                         "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string zero(4, '\0');
  const std::string one("\0\0\x80\x3f", 4); // as a float
  for (const std::string& z : {zero, one}) {
    expected += zero + zero + z + one + zero + z + zero + one + z + one + one + z;
  }
  for (const std::string corners : {"013", "032", "457", "476"}) {
    expected += '\3';
    for (const char corner : corners) {
      expected += static_cast<char>(corner - '0') + std::string(3, '\0');
    }
  }
  const TemporaryFolder folder;
  EXPECT_TRUE(tessellated(two_squares(folder), "ply", {"--grid", "2", "--no-normals"}) == expected);
}

TEST(UnweldedMesh, IsOneMeshInAllFormats) {
  const std::vector<std::string> options = {"--grid", "9x6"};
  const ReadMesh ply = read_ply_mesh(tessellated("builtin:teapot", "ply", options));
  const ReadMesh glb = read_glb_mesh(tessellated("builtin:teapot", "glb", options));
  const ReadMesh stl = read_stl_mesh(tessellated("builtin:teapot", "stl", options));
  const ReadMesh obj = read_obj_mesh(tessellated("builtin:teapot", "obj", options));
  ASSERT_EQ(ply.positions.size(), 32U * 9 * 6);
  ASSERT_EQ(ply.faces.size(), 32U * 8 * 5 * 2);
  EXPECT_EQ(glb.positions, ply.positions);
  EXPECT_EQ(glb.normals, ply.normals);
  EXPECT_EQ(glb.faces, ply.faces);
  EXPECT_EQ(obj.faces, ply.faces);
  ASSERT_EQ(stl.faces.size(), ply.faces.size());
  for (std::size_t k = 0; k < ply.faces.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(stl.positions[3 * k + c], ply.positions[ply.faces[k][c]]);
    }
  }
}

struct Flipped {
  const char* extension;
  std::vector<std::string> options;
};

// Faces and normals turn around, and positions stay, whatever else a vertex has.
TEST(UnweldedMesh, FlipTurnsFacesAndNormalsOnly) {
  const std::vector<Flipped> cases = {{"obj", {}},
                                      {"obj", {"--no-normals"}},
                                      {"obj", {"--quads", "--no-normals"}},
                                      {"ply", {}},
                                      {"ply", {"--no-normals"}},
                                      {"ply", {"--quads", "--no-normals"}},
                                      {"stl", {}},
                                      {"stl", {"--no-normals"}},
                                      {"glb", {}},
                                      {"glb", {"--no-normals"}},
                                      {"raw", {}},
                                      {"raw", {"--quads"}},
                                      {"vtu", {}},
                                      {"vtu", {"--quads", "--no-normals"}}};
  for (const std::string precision : {"f32", "f64"}) {
    for (const auto& [extension, more] : cases) {
      SCOPED_TRACE(precision + " " + extension + (more.empty() ? "" : " " + more[0]));
      std::vector<std::string> options = {"--grid", "5x4", "--precision", precision};
      options.insert(options.end(), more.begin(), more.end());
      const ReadMesh mesh = read_mesh(extension, tessellated("builtin:teapot", extension, options));
      options.emplace_back("--flip");
      const ReadMesh flipped =
          read_mesh(extension, tessellated("builtin:teapot", extension, options));
      // In STL each face has corners of its own, in its own order.
      EXPECT_EQ(std::multiset(flipped.positions.begin(), flipped.positions.end()),
                std::multiset(mesh.positions.begin(), mesh.positions.end()));
      EXPECT_GT(std::abs(volume_of(mesh)), 1);
      EXPECT_NEAR(volume_of(flipped), -volume_of(mesh), 1e-4);
      ASSERT_EQ(flipped.normals.size(), mesh.normals.size());
      for (std::size_t k = 0; extension != std::string("stl") && k < mesh.normals.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(flipped.normals[k][c], -mesh.normals[k][c], 1e-4);
        }
      }
    }
  }
}

// A side on which a coordinate is 0 exactly, and beside which it is rounded to less than 0: what is
// quantised comes to the border of the box.
TEST(UnweldedMesh, IsQuantisedWhereItsBoxTouchesZero) {
  constexpr double kHeights[] = {0.1, 0.7, 0.3, 0.9};
  constexpr double kFactors[] = {0.3, 0.9, 0.2, 1.0};
  for (const double sign : {1.0, -1.0}) {
    Net net;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        net.at(j, i) = {j == 3 ? sign * kFactors[i] : 0, i / 3.0, kHeights[i] * (1 + j % 2)};
      }
    }
    const TemporaryFolder folder;
    const std::string in = folder.write("zero.bez", bez_text(std::span(&net, 1)));
    const std::vector<std::string> options = {"--grid", "5x3000"};
    std::vector<std::string> quantised = options;
    quantised.insert(quantised.end(), {"--quantise", "16"});
    const ReadMesh full = read_glb_mesh(tessellated(in, "glb", options));
    const ReadMesh mesh = read_glb_mesh(tessellated(in, "glb", quantised));
    ASSERT_EQ(mesh.positions.size(), full.positions.size());
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(mesh.translation[c] + mesh.scale * mesh.positions[k][c] / 65535,
                    full.positions[k][c], mesh.scale / 65535 * 0.51);
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::unwelded_test
