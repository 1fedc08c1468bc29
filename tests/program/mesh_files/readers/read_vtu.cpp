#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <functional>
#include <sstream>

#include "tests/program/mesh_files/readers/byte_reader.hpp"

namespace simdbezier::tests {

namespace {

struct Array {
  std::string section = {};
  std::string name = {};
  std::string type = {};
  std::size_t components = 1;
  std::size_t offset = 0;
  std::vector<double> values = {};
};

struct Counts {
  std::size_t points = 0;
  std::size_t cells = 0;
};

std::string attribute(const std::string& line, const std::string& name) {
  const std::string begin = " " + name + "=\"";
  const std::size_t at = line.find(begin);
  if (at == std::string::npos) {
    return "";
  }
  const std::size_t first = at + begin.size();
  std::string text = line.substr(first, line.find('"', first) - first);
  const std::pair<std::string, std::string> escapes[] = {
      {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}};
  for (const auto& [escape, character] : escapes) {
    for (std::size_t k = 0; (k = text.find(escape, k)) != std::string::npos; ++k) {
      text.replace(k, escape.size(), character);
    }
  }
  return text;
}

std::size_t number_in(const std::string& line, const std::string& name) {
  return std::strtoull(attribute(line, name).c_str(), nullptr, 10);
}

double take_vtk_number(ByteReader& data, const std::string& type) {
  const auto as = [&]<typename V>(V) { return static_cast<double>(data.take<V>()); };
  const std::map<std::string, std::function<double()>> readers = {{"Float32", [&] { return as(float()); }},
                                                                  {"Float64", [&] { return as(double()); }},
                                                                  {"Int8", [&] { return as(std::int8_t()); }},
                                                                  {"UInt8", [&] { return as(std::uint8_t()); }},
                                                                  {"Int16", [&] { return as(std::int16_t()); }},
                                                                  {"Int32", [&] { return as(std::int32_t()); }},
                                                                  {"UInt32", [&] { return as(std::uint32_t()); }},
                                                                  {"Int64", [&] { return as(std::int64_t()); }}};
  return readers.at(type)();
}

std::size_t bytes_of(const std::string& type) {
  return std::strtoull(type.c_str() + type.find_first_of("0123456789"), nullptr, 10) / 8;
}

void take_fields(const std::string& line, ReadMesh& mesh) {
  const std::string name = attribute(line, "Name");
  const std::string values = line.substr(line.find('>') + 1);
  EXPECT_EQ(attribute(line, "format"), "ascii");
  EXPECT_EQ(attribute(line, "type"), "Float64");
  EXPECT_EQ(attribute(line, "NumberOfTuples"), "1");
  if (name == "deviation") {
    mesh.deviation = std::strtod(values.c_str(), nullptr);
  } else {
    EXPECT_EQ(name, "origin");
    EXPECT_EQ(attribute(line, "NumberOfComponents"), "3");
    mesh.origin = origin_behind(values, "");
  }
}

void note_attributes(const std::string& line, const std::string& section, ReadMesh& mesh) {
  for (const char* const name : {"Normals", "TCoords", "RationalWeights", "HigherOrderDegrees"}) {
    if (const std::string value = attribute(line, name); !value.empty()) {
      mesh.attributes[section + "." + name] = value;
    }
  }
}

// Reads the text, and makes an array of every element whose bytes come behind it.
std::vector<Array> take_text(std::istringstream& text, ReadMesh& mesh, Counts& counts) {
  std::vector<Array> arrays;
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "<?xml version=\"1.0\"?>");
  std::string section;
  while (std::getline(text, line) && !line.starts_with("<AppendedData")) {
    if (line.starts_with("<!-- ")) {
      mesh.generator = line.substr(5, line.size() - 9);
    } else if (line.starts_with("<VTKFile")) {
      EXPECT_EQ(line, R"(<VTKFile type="UnstructuredGrid" version="1.0" )"
                      R"(byte_order="LittleEndian" header_type="UInt64">)");
    } else if (line.starts_with("<Piece")) {
      counts = {number_in(line, "NumberOfPoints"), number_in(line, "NumberOfCells")};
    } else if (line.starts_with("<DataArray") && section == "FieldData") {
      take_fields(line, mesh);
    } else if (line.starts_with("<DataArray")) {
      EXPECT_EQ(attribute(line, "format"), "appended");
      const bool has_rows = !attribute(line, "NumberOfComponents").empty();
      arrays.push_back({section, attribute(line, "Name"), attribute(line, "type"),
                        has_rows ? number_in(line, "NumberOfComponents") : 1,
                        number_in(line, "offset")});
    } else {
      section = line.substr(1, line.find_first_of(" >") - 1);
      note_attributes(line, section, mesh);
    }
  }
  EXPECT_EQ(line, "<AppendedData encoding=\"raw\">");
  return arrays;
}

template <std::size_t N>
std::vector<std::array<double, N>> rows(const Array& array) {
  EXPECT_EQ(array.components, N) << array.name;
  std::vector<std::array<double, N>> all(array.values.size() / N);
  for (std::size_t k = 0; k < array.values.size(); ++k) {
    all[k / N][k % N] = array.values[k];
  }
  return all;
}

void put(const Array& array, ReadMesh& mesh) {
  if (array.section == "Points") {
    mesh.positions = rows<3>(array);
    mesh.position_type = array.type;
  } else if (array.name == "Normals") {
    mesh.normals = rows<3>(array);
    EXPECT_EQ(array.type, mesh.position_type);
  } else if (array.name == "TCoords") {
    mesh.uv = rows<2>(array);
    EXPECT_EQ(array.type, mesh.position_type);
  } else if (array.name == "patch") {
    EXPECT_EQ(array.type, "UInt32");
    mesh.patches = array.values;
  } else if (array.name == "types") {
    mesh.cell_types = array.values;
  } else {
    mesh.data[array.name] = array.values;
    mesh.data_types[array.name] = array.type;
    mesh.data_components[array.name] = array.components;
  }
}

void put_faces(ReadMesh& mesh) {
  const std::vector<double> corners = mesh.data.extract("connectivity").mapped();
  const std::vector<double> ends = mesh.data.extract("offsets").mapped();
  mesh.index_type = mesh.data_types.at("connectivity");
  EXPECT_EQ(mesh.data_types.at("offsets"), mesh.index_type);
  std::size_t first = 0;
  for (const double end : ends) {
    std::vector<std::uint32_t>& face = mesh.faces.emplace_back();
    for (; first < static_cast<std::size_t>(end); ++first) {
      face.push_back(static_cast<std::uint32_t>(corners.at(first)));
    }
  }
  EXPECT_EQ(first, corners.size());
}

} // namespace

ReadMesh read_vtu_mesh(const std::string& bytes) {
  ReadMesh mesh;
  std::istringstream text(bytes);
  Counts counts;
  std::vector<Array> arrays = take_text(text, mesh, counts);
  ByteReader data(std::string_view(bytes).substr(static_cast<std::size_t>(text.tellg())));
  EXPECT_EQ(data.take_bytes(1), "_");
  const std::size_t all = data.rest();
  for (Array& array : arrays) {
    EXPECT_EQ(array.offset, all - data.rest()) << array.name;
    const std::size_t count = data.take<std::uint64_t>() / bytes_of(array.type);
    if (array.name != "connectivity") {
      const bool of_points = array.section.starts_with("Point");
      EXPECT_EQ(count, array.components * (of_points ? counts.points : counts.cells)) << array.name;
    }
    for (std::size_t k = 0; k < count && data.rest() > 0; ++k) {
      array.values.push_back(take_vtk_number(data, array.type));
    }
    put(array, mesh);
  }
  EXPECT_EQ(data.take_bytes(data.rest()), "\n</AppendedData>\n</VTKFile>\n");
  put_faces(mesh);
  EXPECT_EQ(mesh.faces.size(), counts.cells);
  EXPECT_EQ(mesh.cell_types.size(), counts.cells);
  return mesh;
}

} // namespace simdbezier::tests
