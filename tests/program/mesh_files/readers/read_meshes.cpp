#include "tests/program/mesh_files/readers/read_meshes.hpp"

#include <gtest/gtest.h>

#include "tests/program/formats/sample_nets.hpp"

namespace simdbezier::tests {

std::string bez_of(const MeshModel& model) {
  std::vector<Net> nets;
  for (const PatchPoints& patch : model.patches) {
    Net& net = nets.emplace_back();
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        net.at(j, i) = patch[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
      }
    }
  }
  return bez_text(nets);
}

std::string tessellated(const std::string& in, const std::string& extension,
                        const std::vector<std::string>& options,
                        const Circumstances& circumstances) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out." + extension);
  std::vector<std::string> arguments = {"tessellate", in, "-o", out};
  arguments.insert(arguments.end(), options.begin(), options.end());
  expect_silent_success(run(arguments, circumstances));
  return read_file(out);
}

ReadMesh welded(const std::string& in, const std::vector<std::string>& options) {
  return read_ply_mesh(tessellated(in, "ply", options));
}

TriangleCensus census_of(const ReadMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const std::vector<std::uint32_t>& face : mesh.faces) {
    EXPECT_EQ(face.size(), 3U);
    corners.insert(corners.end(), face.begin(), face.end());
  }
  return count_triangles(std::span<const std::uint32_t>(corners), mesh.positions.size());
}

} // namespace simdbezier::tests
