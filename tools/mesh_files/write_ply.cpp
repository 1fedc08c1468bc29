// Binary PLY, little endian, in T's precision or as floats: the vertices as records, then the
// faces. Some programs look for texture coordinates by the names u v, others by s t: there are
// both.
#include <tools/mesh_files/mesh_formats.hpp>

#include <tools/mesh_files/mesh_bytes.hpp>
#include <tools/mesh_files/vertex_records.hpp>
#include <tools/process/little_endian.hpp>
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
class PlyWriter final : public MeshWriter<T> {
public:
  PlyWriter(const std::string& path, const MeshContents& mesh)
      : MeshWriter<T>(path, mesh), packer_(path, mesh, exact_records<T>(mesh, true)),
        size_(checked_file_size(path, Count(mesh.vertices) * exact_records<T>(mesh, true).size +
                                          face_bytes(mesh))),
        file_(path) {
    const std::string text = ply_head<T>(mesh);
    file_.expect_room(checked_file_size(path, Count(size_) + text.size()));
    file_.text(text);
  }

  [[nodiscard]] bool is_terminal() const override { return file_.is_terminal(); }

private:
  static constexpr std::size_t kIndexBytes = sizeof(std::uint32_t);

  void take_vertices(const VertexBlock<T>& block) override {
    const std::span<const std::byte> records = packer_.pack(block);
    file_.bytes(records.data(), records.size());
  }

  void take_faces(std::span<const std::uint32_t> corners) override {
    faces_.clear();
    append_ply_faces(corners, this->contents().corners, faces_);
    file_.bytes(faces_.data(), faces_.size());
  }

  static Count face_bytes(const MeshContents& mesh) {
    return Count(mesh.faces - mesh.among_quads) * (1 + mesh.corners * kIndexBytes) +
           Count(mesh.among_quads) * (1 + 3 * kIndexBytes);
  }

  void put_on_disk() override { file_.complete(); }
  void put_in_place() override { file_.commit(); }

  RecordPacker<T> packer_;
  std::uintmax_t size_;
  OutputFile file_;
  std::vector<std::byte> faces_;
};

} // namespace

template <typename T>
std::string ply_head(const MeshContents& mesh) {
  const std::string type = sizeof(T) == sizeof(float) || mesh.floats ? "float" : "double";
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += mesh.generator.empty() ? "" : "comment " + mesh.generator + "\n";
  text += mesh.deviation ? "comment deviation " + shortest(*mesh.deviation) + "\n" : "";
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

void append_ply_faces(std::span<const std::uint32_t> corners, unsigned each,
                      std::vector<std::byte>& to) {
  std::size_t at = to.size();
  to.resize(at + ply_face_bytes(each, corners.size() / each, 0));
  for (std::size_t k = 0; k < corners.size(); k += each) {
    const std::size_t count = corners[k + each - 1] == kNoVertex ? 3 : each;
    to[at++] = static_cast<std::byte>(count);
    for (std::size_t c = 0; c < count; ++c, at += sizeof(std::uint32_t)) {
      store_little(&to[at], corners[k + c]);
    }
  }
  to.resize(at);
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_ply_writer(const std::string& path,
                                               const MeshContents& contents) {
  return std::make_unique<PlyWriter<T>>(path, contents);
}

template std::string ply_head<float>(const MeshContents&);
template std::string ply_head<double>(const MeshContents&);
template std::unique_ptr<MeshWriter<float>> make_ply_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_ply_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
