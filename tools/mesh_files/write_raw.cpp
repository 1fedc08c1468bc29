// Raw arrays: eight bytes that say how long the header is, the header in JSON, the vertices as
// records, and the corners of faces. The header describes the records as numpy.dtype() takes them,
// so that the file can be read in three lines of Python (docs/formats.md).
#include <tools/mesh_files/json_text.hpp>
#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/mesh_files/record_file.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

/// Records begin at a multiple of so many bytes, so that they can be mapped into memory.
constexpr std::size_t kAlignment = 64;

std::string number_of(FieldType type) {
  return type == FieldType::f64 ? "<f8" : type == FieldType::u32 ? "<u4" : "<f4";
}

std::string records_of(const RecordLayout& layout) {
  std::string names;
  std::string formats;
  std::string offsets;
  const auto add = [&](const char* name, const RecordLayout::Field& field, int components) {
    if (field.type != FieldType::none) {
      const char* const comma = names.empty() ? "" : ",";
      const std::string shape = components == 1 ? "" : "(" + std::to_string(components) + ",)";
      names += comma + quoted(name);
      formats += comma + quoted(shape + number_of(field.type));
      offsets += comma + std::to_string(field.offset);
    }
  };
  add("position", layout.position, 3);
  add("normal", layout.normal, 3);
  add("uv", layout.uv, 2);
  add("patch", layout.patch, 1);
  return joined({R"({"names":[)", names, R"(],"formats":[)", formats, R"(],"offsets":[)", offsets,
                 "],", member("itemsize", layout.size), "}"});
}

std::string head_of(const MeshContents& mesh, const RecordLayout& layout) {
  std::string text =
      joined({"{", member("format", quoted("simdbezier raw mesh 1")), ",",
              member("vertices", mesh.vertices), ",", member("vertex", records_of(layout)), ",",
              member("faces", mesh.faces), ",", member("corners", mesh.corners)});
  text += mesh.has_bound() ? "," + member("deviation", shortest(*mesh.deviation)) : "";
  text += mesh.origin ? "," + member("origin", list(*mesh.origin)) : "";
  text += mesh.generator.empty() ? "" : "," + member("generator", quoted(mesh.generator));
  text += "}";
  std::array<char, sizeof(std::uint64_t)> length;
  const std::size_t rest = (length.size() + text.size() + 1) % kAlignment;
  text.append(rest == 0 ? 0 : kAlignment - rest, ' ');
  text += "\n";
  store_little(length.data(), std::uint64_t{text.size()});
  return std::string(length.data(), length.size()) + text;
}

} // namespace

template <typename T>
RecordFile raw_file(const MeshContents& contents) {
  const RecordLayout layout = exact_records<T>(contents, false);
  return {head_of(contents, layout), layout, false};
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_raw_writer(const std::string& path,
                                               const MeshContents& contents) {
  return make_record_writer<T>(path, contents, raw_file<T>(contents));
}

template RecordFile raw_file<float>(const MeshContents&);
template RecordFile raw_file<double>(const MeshContents&);
template std::unique_ptr<MeshWriter<float>> make_raw_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_raw_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
