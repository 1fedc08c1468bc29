#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <nlohmann/json.hpp>

#include "tests/program/mesh_files/readers/byte_reader.hpp"

namespace simdbezier::tests {

namespace {

double take_raw_number(ByteReader& data, const std::string& type) {
  if (type == "<f4") {
    return double{data.take<float>()};
  }
  if (type == "<f8") {
    return data.take<double>();
  }
  EXPECT_EQ(type, "<u4");
  return data.take<std::uint32_t>();
}

template <std::size_t N>
std::array<double, N> take_numbers(ByteReader& data, const std::string& type) {
  std::array<double, N> numbers{};
  for (double& number : numbers) {
    number = take_raw_number(data, type);
  }
  return numbers;
}

void take_field(ByteReader& data, const std::string& name, const std::string& format,
                ReadMesh& mesh) {
  const std::string type = format.substr(format.find('<'));
  const std::string shape = format.substr(0, format.find('<'));
  EXPECT_EQ(shape, name == "patch" ? "" : name == "uv" ? "(2,)" : "(3,)");
  if (name == "position") {
    mesh.position_type = type;
    mesh.positions.push_back(take_numbers<3>(data, type));
  } else if (name == "normal") {
    mesh.normals.push_back(take_numbers<3>(data, type));
  } else if (name == "uv") {
    mesh.uv.push_back(take_numbers<2>(data, type));
  } else {
    EXPECT_EQ(name, "patch");
    mesh.patches.push_back(take_raw_number(data, type));
  }
}

} // namespace

ReadMesh read_raw_mesh(const std::string& bytes) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  ReadMesh mesh;
  ByteReader data(bytes);
  const auto length = data.take<std::uint64_t>();
  EXPECT_EQ((8 + length) % 64, 0U);
  const auto header = nlohmann::json::parse(data.take_bytes(length));
  EXPECT_EQ(header.at("format"), "simdbezier raw mesh 1");
  mesh.generator = header.value("generator", "");
  if (header.contains("deviation")) {
    mesh.deviation = header["deviation"].get<double>();
  }
  if (header.contains("origin")) {
    mesh.origin = header["origin"].get<std::array<double, 3>>();
  }
  const auto& vertex = header.at("vertex");
  for (std::size_t k = 0; k < header.at("vertices"); ++k) {
    const std::size_t before = data.rest();
    for (std::size_t f = 0; f < vertex.at("names").size(); ++f) {
      EXPECT_EQ(before - data.rest(), vertex.at("offsets")[f]);
      take_field(data, vertex["names"][f], vertex.at("formats")[f], mesh);
    }
    EXPECT_EQ(before - data.rest(), vertex.at("itemsize"));
  }
  mesh.index_type = "<u4";
  const std::size_t corners = header.at("corners");
  for (std::size_t k = 0; k < header.at("faces") && data.rest() > 0; ++k) {
    std::vector<std::uint32_t>& face = mesh.faces.emplace_back(corners);
    for (std::uint32_t& corner : face) {
      corner = data.take<std::uint32_t>();
    }
    if (face.back() == kNone) {
      face.pop_back();
    }
  }
  EXPECT_EQ(data.rest(), 0U);
  return mesh;
}

} // namespace simdbezier::tests
