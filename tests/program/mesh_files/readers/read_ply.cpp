#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>

#include "tests/program/mesh_files/readers/byte_reader.hpp"

namespace simdbezier::tests {

namespace {

struct PlyHeader {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::vector<std::pair<std::string, std::string>> properties; // type, name
};

double take_number(ByteReader& data, const std::string& type) {
  if (type == "float") {
    return double{data.take<float>()};
  }
  if (type == "double") {
    return data.take<double>();
  }
  EXPECT_EQ(type, "uint");
  return data.take<std::uint32_t>();
}

PlyHeader read_header(std::istringstream& text, ReadMesh& mesh) {
  PlyHeader header;
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "ply");
  std::getline(text, line);
  EXPECT_EQ(line, "format binary_little_endian 1.0");
  bool in_faces = false;
  while (std::getline(text, line) && line != "end_header") {
    std::istringstream words(line);
    std::string first;
    std::string second;
    std::string third;
    words >> first >> second >> third;
    if (first == "comment" && second == "deviation") {
      mesh.deviation = std::strtod(third.c_str(), nullptr);
    } else if (first == "comment" && second == "origin") {
      mesh.origin = origin_behind(line, "origin ");
    } else if (first == "comment") {
      mesh.generator = line.substr(8);
    } else if (first == "element") {
      in_faces = second == "face";
      (in_faces ? header.faces : header.vertices) = std::strtoull(third.c_str(), nullptr, 10);
    } else if (in_faces) {
      words >> mesh.index_type >> second;
      EXPECT_EQ(line, "property list uchar " + mesh.index_type + " vertex_indices");
    } else {
      header.properties.emplace_back(second, third);
    }
  }
  EXPECT_EQ(line, "end_header");
  return header;
}

void take_vertex(ByteReader& data, const PlyHeader& header, ReadMesh& mesh) {
  std::map<std::string, double> number;
  for (const auto& [type, name] : header.properties) {
    EXPECT_TRUE(number.emplace(name, take_number(data, type)).second) << name << " twice";
  }
  mesh.positions.push_back({number.at("x"), number.at("y"), number.at("z")});
  if (number.contains("nx")) {
    mesh.normals.push_back({number.at("nx"), number.at("ny"), number.at("nz")});
  }
  if (number.contains("u")) {
    mesh.uv.push_back({number.at("u"), number.at("v")});
    EXPECT_EQ(number.at("s"), number.at("u"));
    EXPECT_EQ(number.at("t"), number.at("v"));
  }
  if (number.contains("patch")) {
    mesh.patches.push_back(number.at("patch"));
  }
}

} // namespace

ReadMesh read_ply_mesh(const std::string& bytes) {
  ReadMesh mesh;
  std::istringstream text(bytes);
  const PlyHeader header = read_header(text, mesh);
  ByteReader data(std::string_view(bytes).substr(static_cast<std::size_t>(text.tellg())));
  mesh.position_type = header.properties.front().first;
  for (std::size_t k = 0; k < header.vertices && data.rest() > 0; ++k) {
    take_vertex(data, header, mesh);
  }
  for (std::size_t k = 0; k < header.faces && data.rest() > 0; ++k) {
    std::vector<std::uint32_t>& face = mesh.faces.emplace_back(data.take<std::uint8_t>());
    for (std::uint32_t& corner : face) {
      corner = data.take<std::uint32_t>();
    }
  }
  EXPECT_EQ(mesh.positions.size(), header.vertices);
  EXPECT_EQ(mesh.faces.size(), header.faces);
  EXPECT_EQ(data.rest(), 0U);
  return mesh;
}

} // namespace simdbezier::tests
