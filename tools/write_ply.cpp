// Binary PLY: the vertices as they lie in memory, then the faces.
#include <tools/mesh_writer.hpp>

#include <bit>
#include <cstring>

namespace simdbezier::tools {

namespace {

template <typename T>
std::string header(const Mesh& mesh) {
  const std::string type = sizeof(T) == sizeof(float) ? "float" : "double";
  const std::string order = std::endian::native == std::endian::little ? "little" : "big";
  std::string text = "ply\nformat binary_" + order + "_endian 1.0\n";
  text += "element vertex " + std::to_string(mesh.vertices()) + "\n";
  for (const char* const name : {"x", "y", "z"}) {
    text += "property " + type + " " + name + "\n";
  }
  for (const char* const name : {"nx", "ny", "nz"}) {
    text += mesh.normals ? "property " + type + " " + name + "\n" : "";
  }
  text += "element face " + std::to_string(mesh.triangles()) + "\n";
  return text + "property list uchar int vertex_indices\nend_header\n";
}

template <typename T>
class PlyWriter final : public MeshWriter<T> {
public:
  PlyWriter(OutputFile& file, const Mesh& mesh) : file_(file), mesh_(mesh) {
    const std::string text = header<T>(mesh);
    file_.expect_room(text.size() + mesh.vertices() * mesh.stride() * sizeof(T) +
                      mesh.triangles() * kFaceBytes);
    file_.text(text);
  }

  void vertices(std::span<const T> values) override {
    file_.bytes(values.data(), values.size_bytes());
  }

  void patches_done(std::size_t first, std::size_t count) override {
    if (first + count == mesh_.patches) {
      for (std::size_t p = 0; p < mesh_.patches; ++p) {
        mesh_.for_each_triangle(p, [this](const auto& corners) { face(corners); });
      }
    }
  }

private:
  static constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);

  void face(const std::array<std::uint64_t, 3>& corners) {
    std::array<unsigned char, kFaceBytes> bytes;
    bytes[0] = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = static_cast<std::int32_t>(corners[k]);
      std::memcpy(&bytes[1 + k * sizeof index], &index, sizeof index);
    }
    file_.bytes(bytes.data(), bytes.size());
  }

  OutputFile& file_;
  Mesh mesh_;
};

} // namespace

template <typename T>
std::unique_ptr<MeshWriter<T>> make_ply_writer(OutputFile& file, const Mesh& mesh) {
  return std::make_unique<PlyWriter<T>>(file, mesh);
}

template std::unique_ptr<MeshWriter<float>> make_ply_writer(OutputFile&, const Mesh&);
template std::unique_ptr<MeshWriter<double>> make_ply_writer(OutputFile&, const Mesh&);

} // namespace simdbezier::tools
