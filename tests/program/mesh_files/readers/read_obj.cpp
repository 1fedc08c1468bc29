#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace simdbezier::tests {

namespace {

template <std::size_t N>
std::array<double, N> numbers(std::istringstream& words) {
  std::array<double, N> values{};
  for (double& value : values) {
    std::string word;
    words >> word;
    char* end = nullptr;
    value = std::strtod(word.c_str(), &end); // streams refuse subnormal numbers
    EXPECT_TRUE(!word.empty() && *end == '\0') << word;
  }
  return values;
}

// "7", "7/7", "7//7" or "7/7/7": as many as the mesh has had before.
std::uint32_t corner(const std::string& word, const ReadMesh& mesh) {
  const std::string number = word.substr(0, word.find('/'));
  std::string expected = number;
  if (!mesh.uv.empty() || !mesh.normals.empty()) {
    expected += "/" + (mesh.uv.empty() ? "" : number);
    expected += mesh.normals.empty() ? "" : "/" + number;
  }
  EXPECT_EQ(word, expected);
  const std::uint64_t named = std::strtoull(number.c_str(), nullptr, 10);
  EXPECT_TRUE(named >= 1 && named <= mesh.positions.size()) << word;
  return static_cast<std::uint32_t>(named - 1);
}

void read_comment(const std::string& line, ReadMesh& mesh) {
  const std::string deviation = "# deviation ";
  if (line.starts_with(deviation)) {
    mesh.deviation = std::strtod(line.c_str() + deviation.size(), nullptr);
  } else if (line.starts_with("# origin ")) {
    mesh.origin = origin_behind(line, "# origin ");
  } else {
    mesh.generator = line.substr(2);
  }
}

void read_line(const std::string& line, ReadMesh& mesh) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "#") {
    return read_comment(line, mesh);
  }
  if (keyword == "v") {
    mesh.positions.push_back(numbers<3>(words));
  } else if (keyword == "vn") {
    mesh.normals.push_back(numbers<3>(words));
  } else if (keyword == "vt") {
    mesh.uv.push_back(numbers<2>(words));
  } else if (keyword == "f") {
    std::vector<std::uint32_t>& face = mesh.faces.emplace_back();
    for (std::string word; words >> word;) {
      face.push_back(corner(word, mesh));
    }
  } else {
    ADD_FAILURE() << "not a line of a mesh: " << line;
  }
  std::string rest;
  EXPECT_FALSE(words >> rest) << line;
}

} // namespace

ReadMesh read_obj_mesh(const std::string& bytes) {
  ReadMesh mesh;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) {
    read_line(line, mesh);
  }
  return mesh;
}

} // namespace simdbezier::tests
