#include "tests/program/commands/mesh_parsers.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <gtest/gtest.h>

namespace simdbezier::tests {

namespace {

// Takes values off the front of a byte string.
class Bytes {
public:
  explicit Bytes(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  template <typename T>
  T take() {
    T value{};
    if (bytes_.size() - at_ < sizeof value) {
      ADD_FAILURE() << "the data ends early";
      at_ = bytes_.size();
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  [[nodiscard]] std::size_t rest() const { return bytes_.size() - at_; }

private:
  const std::string& bytes_;
  std::size_t at_;
};

template <typename T>
Vector3 take_vector(Bytes& bytes) {
  const auto x = static_cast<double>(bytes.take<T>());
  const auto y = static_cast<double>(bytes.take<T>());
  return {x, y, static_cast<double>(bytes.take<T>())};
}

// "7//7" or "7".
bool parse_corner(const std::string& word, bool normals, std::size_t& corner) {
  char* end = nullptr;
  corner = std::strtoull(word.c_str(), &end, 10);
  return (normals ? "//" + std::to_string(corner) : "") == end && corner >= 1;
}

bool parse_obj_line(std::istringstream line, ParsedMesh& mesh) {
  std::string keyword;
  line >> keyword;
  if (keyword == "v" || keyword == "vn") {
    Vector3 value{};
    line >> value[0] >> value[1] >> value[2];
    (keyword == "v" ? mesh.positions : mesh.normals).push_back(value);
  } else if (keyword == "f") {
    std::array<std::size_t, 3> corners{};
    for (std::size_t& corner : corners) {
      std::string word;
      line >> word;
      if (!parse_corner(word, !mesh.normals.empty(), corner) || corner > mesh.positions.size()) {
        return false; // a vertex must come before its faces
      }
      --corner;
    }
    mesh.triangles.push_back(corners);
  } else {
    return false;
  }
  std::string rest;
  return !line.fail() && !(line >> rest);
}

struct PlyHeader {
  std::size_t size = 0; // bytes
  std::size_t vertices = 0;
  std::size_t faces = 0;
  bool normals = false;
  std::string scalar;
};

// Reads the numbers, then demands that the header is, line by line, the one that goes with them.
PlyHeader parse_ply_header(const std::string& bytes) {
  PlyHeader header;
  std::istringstream text(bytes);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line) && line != "end_header";) {
    lines.push_back(line);
  }
  header.size = static_cast<std::size_t>(text.tellg());
  header.normals = lines.size() > 6 && lines[6].ends_with(" nx");
  if (lines.size() != (header.normals ? 11U : 8U)) {
    ADD_FAILURE() << "a PLY header of " << lines.size() << " lines";
    header.size = bytes.size();
    return header;
  }
  header.scalar = lines[3] == "property double x" ? "double" : "float";
  const std::string property = "property " + header.scalar + " ";
  const std::string& faces = lines[lines.size() - 2];
  header.vertices = std::strtoull(lines[2].c_str() + sizeof "element vertex", nullptr, 10);
  header.faces = std::strtoull(faces.c_str() + sizeof "element face", nullptr, 10);
  std::vector<std::string> expected = {"ply",
                                       "format binary_little_endian 1.0",
                                       "element vertex " + std::to_string(header.vertices),
                                       property + "x",
                                       property + "y",
                                       property + "z"};
  if (header.normals) {
    expected.insert(expected.end(), {property + "nx", property + "ny", property + "nz"});
  }
  expected.push_back("element face " + std::to_string(header.faces));
  expected.push_back("property list uchar int vertex_indices");
  EXPECT_EQ(lines, expected);
  return header;
}

} // namespace

ParsedMesh parse_obj(const std::string& text) {
  ParsedMesh mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!parse_obj_line(std::istringstream(line), mesh)) {
      ADD_FAILURE() << "not an OBJ line: " << line;
      return {};
    }
  }
  return mesh;
}

ParsedMesh parse_ply(const std::string& bytes) {
  ParsedMesh mesh;
  const PlyHeader header = parse_ply_header(bytes);
  mesh.scalar = header.scalar;
  Bytes data(bytes, header.size);
  const auto vector = [&] {
    return mesh.scalar == "float" ? take_vector<float>(data) : take_vector<double>(data);
  };
  for (std::size_t k = 0; k < header.vertices && data.rest() > 0; ++k) {
    mesh.positions.push_back(vector());
    if (header.normals) {
      mesh.normals.push_back(vector());
    }
  }
  std::size_t no_triangles = 0; // counted: a mesh has more corners than expectations are fast
  std::size_t no_vertices = 0;
  for (std::size_t k = 0; k < header.faces && data.rest() > 0; ++k) {
    no_triangles += data.take<unsigned char>() == 3 ? 0 : 1;
    std::array<std::size_t, 3> corners{};
    for (std::size_t& corner : corners) {
      corner = static_cast<std::size_t>(data.take<std::int32_t>());
      no_vertices += corner < header.vertices ? 0 : 1;
    }
    mesh.triangles.push_back(corners);
  }
  EXPECT_EQ(no_triangles, 0U);
  EXPECT_EQ(no_vertices, 0U);
  EXPECT_EQ(mesh.positions.size(), header.vertices);
  EXPECT_EQ(mesh.triangles.size(), header.faces);
  EXPECT_EQ(data.rest(), 0U);
  return mesh;
}

ParsedCsv parse_csv(const std::string& text) {
  ParsedCsv csv;
  std::istringstream lines(text);
  std::getline(lines, csv.header);
  const auto commas = std::ranges::count(csv.header, ',');
  for (std::string line; std::getline(lines, line);) {
    std::vector<double> row;
    const char* at = line.c_str();
    for (char* end = nullptr; *at != '\0'; at = *end == ',' ? end + 1 : end) {
      row.push_back(std::strtod(at, &end));
      if (end == at || (*end != ',' && *end != '\0')) {
        ADD_FAILURE() << "not a CSV line: " << line;
        return csv;
      }
    }
    if (std::ranges::count(line, ',') != commas) {
      ADD_FAILURE() << "not as many fields as the header has: " << line;
      return csv;
    }
    csv.rows.push_back(std::move(row));
  }
  return csv;
}

} // namespace simdbezier::tests
