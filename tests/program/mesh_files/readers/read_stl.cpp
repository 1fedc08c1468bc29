#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <cstdlib>

#include "tests/program/mesh_files/readers/byte_reader.hpp"

namespace simdbezier::tests {

namespace {

std::array<double, 3> take_vector(ByteReader& data) {
  std::array<double, 3> vector{};
  for (double& value : vector) {
    value = double{data.take<float>()};
  }
  return vector;
}

} // namespace

ReadMesh read_stl_mesh(const std::string& bytes) {
  ReadMesh mesh;
  ByteReader data(bytes);
  const std::string header(data.take_bytes(80));
  EXPECT_FALSE(header.starts_with("solid")) << "which means text";
  const std::string deviation = ", deviation ";
  if (const std::size_t at = header.find(deviation); at != std::string::npos) {
    mesh.deviation = std::strtod(header.c_str() + at + deviation.size(), nullptr);
  }
  mesh.origin = origin_behind(header, ", origin ");
  mesh.generator = header.substr(0, header.find('\0'));
  mesh.position_type = "float";
  const auto count = data.take<std::uint32_t>();
  EXPECT_EQ(data.rest(), std::size_t{50} * count);
  for (std::uint32_t k = 0; k < count && data.rest() > 0; ++k) {
    mesh.normals.push_back(take_vector(data));
    for (std::uint32_t c = 0; c < 3; ++c) {
      mesh.positions.push_back(take_vector(data));
    }
    mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    EXPECT_EQ(data.take<std::uint16_t>(), 0) << "attribute of facet " << k;
  }
  return mesh;
}

} // namespace simdbezier::tests
