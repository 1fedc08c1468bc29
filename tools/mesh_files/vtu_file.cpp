#include <tools/mesh_files/vtu_file.hpp>

#include <cassert>
#include <string_view>

#include <tools/mesh_files/mesh_formats.hpp>

namespace simdbezier::tools {

namespace {

constexpr const char* kEnd = "\n</AppendedData>\n</VTKFile>\n";
constexpr std::size_t kSizeBytes = sizeof(std::uint64_t);

std::string in_attribute(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += c;
    }
  }
  return escaped;
}

// Two hyphens would end it.
std::string comment(std::string_view text) {
  std::string lines = "<!-- ";
  for (const char c : text) {
    lines += c == '-' && lines.back() == '-' ? " -" : std::string(1, c);
  }
  return lines + " -->\n";
}

std::string field(const std::string& name, const std::string& components,
                  const std::string& values) {
  return R"(<DataArray type="Float64" Name=")" + name + "\"" + components +
         R"( NumberOfTuples="1" format="ascii">)" + values + "</DataArray>\n";
}

std::string fields(const MeshContents& contents) {
  std::string text;
  if (contents.has_bound()) {
    text += field("deviation", "", shortest(*contents.deviation));
  }
  if (contents.origin) {
    text += field("origin", R"( NumberOfComponents="3")", spaced(*contents.origin));
  }
  return text.empty() ? "" : "<FieldData>\n" + text + "</FieldData>\n";
}

std::uint64_t bytes_of(const std::string& path, const VtuArray& array) {
  return checked_file_size(path, Count(array.count) * array.components * array.type.bytes);
}

// offset: that of the array's size behind the text, which becomes that of the next array.
std::string element(const VtuArray& array, std::uint64_t bytes, std::uint64_t& offset) {
  const std::string text =
      "<DataArray type=\"" + array.type.name + "\" Name=\"" + in_attribute(array.name) + "\"" +
      (array.components > 1 ? " NumberOfComponents=\"" + std::to_string(array.components) + "\""
                            : "") +
      R"( format="appended" offset=")" + std::to_string(offset) + "\"/>\n";
  offset += kSizeBytes + bytes;
  return text;
}

} // namespace

VtuFile::VtuFile(const std::string& path, const MeshContents& contents, std::uint64_t cells,
                 std::vector<VtuSection> sections)
    : file_(path) {
  std::string text = "<?xml version=\"1.0\"?>\n";
  text += contents.generator.empty() ? "" : comment(contents.generator);
  text += R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian")"
          " header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
          fields(contents) + "<Piece NumberOfPoints=\"" + std::to_string(contents.vertices) +
          "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n";
  Count all(0);
  std::uint64_t offset = 0;
  for (const VtuSection& section : sections) {
    text += "<" + section.name + section.attributes + ">\n";
    for (const VtuArray& array : section.arrays) {
      sizes_.push_back(bytes_of(path, array));
      all = all + sizes_.back() + kSizeBytes;
      text += element(array, sizes_.back(), offset);
    }
    text += "</" + section.name + ">\n";
  }
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  file_.expect_room(checked_file_size(path, all + text.size() + std::string_view(kEnd).size()));
  file_.text(text);
}

void VtuFile::begin_array() {
  assert(missing_ == 0 && begun_ < sizes_.size());
  missing_ = kSizeBytes;
  number(sizes_[begun_]);
  missing_ = sizes_[begun_++];
}

void VtuFile::bytes(const void* data, std::size_t size) {
  assert(size <= missing_);
  missing_ -= size;
  file_.bytes(data, size);
}

void VtuFile::complete() {
  assert(missing_ == 0 && begun_ == sizes_.size());
  file_.text(kEnd);
  file_.complete();
}

} // namespace simdbezier::tools
