// Binary PLY, little endian, in T's precision or as floats: the vertices as records, then the
// faces. Some programs look for texture coordinates by the names u v, others by s t: there are
// both.
#include <tools/mesh_files/mesh_formats.hpp>

#include <tools/mesh_files/record_file.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// Larger indices are unsigned, which not every reader expects.
constexpr std::uint64_t kMostSignedVertices = std::uint64_t{1} << 31;

std::string properties(const std::string& type, std::initializer_list<const char*> names) {
  std::string text;
  for (const char* const name : names) {
    text += "property " + type + " " + name + "\n";
  }
  return text;
}

template <typename T>
std::string head_of(const MeshContents& mesh) {
  const std::string type = sizeof(T) == sizeof(float) || mesh.floats ? "float" : "double";
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += mesh.generator.empty() ? "" : "comment " + mesh.generator + "\n";
  text += mesh.deviation ? "comment " + worded_deviation(*mesh.deviation) + "\n" : "";
  text += mesh.origin ? "comment origin " + spaced(*mesh.origin) + "\n" : "";
  text += "element vertex " + std::to_string(mesh.vertices) + "\n";
  text += properties(type, {"x", "y", "z"});
  text += mesh.normals ? properties(type, {"nx", "ny", "nz"}) : "";
  text += mesh.uv ? properties(type, {"u", "v", "s", "t"}) : "";
  text += mesh.patches > 0 ? properties("uint", {"patch"}) : "";
  text += "element face " + std::to_string(mesh.faces) + "\n";
  text += mesh.vertices <= kMostSignedVertices ? "property list uchar int "
                                               : "property list uchar uint ";
  return text + "vertex_indices\nend_header\n";
}

} // namespace

template <typename T>
RecordFile ply_file(const MeshContents& contents) {
  return {head_of<T>(contents), exact_records<T>(contents, true), true};
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_ply_writer(const std::string& path,
                                               const MeshContents& contents) {
  return make_record_writer<T>(path, contents, ply_file<T>(contents));
}

template RecordFile ply_file<float>(const MeshContents&);
template RecordFile ply_file<double>(const MeshContents&);
template std::unique_ptr<MeshWriter<float>> make_ply_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_ply_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
