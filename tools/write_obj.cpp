// Wavefront OBJ. Lines may come in any order as long as a face's vertices precede it, so nothing
// has to wait for the end of the mesh.
#include <tools/mesh_writer.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
class ObjWriter final : public MeshWriter<T> {
public:
  ObjWriter(OutputFile& file, const Mesh& mesh) : file_(file), mesh_(mesh) {
    // These are the fewest bytes that there can be: "v 0 0 0", "vn 0 0 1", "f 1 2 3" or "f 1//1
    // 2//2 3//3".
    file.expect_room(mesh.normals ? mesh.vertices() * 17 + mesh.triangles() * 17
                                  : mesh.vertices() * 8 + mesh.triangles() * 8);
  }

  void vertices(std::span<const T> values) override {
    for (std::size_t k = 0; k < values.size(); k += mesh_.stride()) {
      vector("v", values.subspan(k, 3));
    }
    for (std::size_t k = 3; mesh_.normals && k < values.size(); k += mesh_.stride()) {
      vector("vn", values.subspan(k, 3));
    }
  }

  void patches_done(std::size_t first, std::size_t count) override {
    for (std::size_t p = first; p < first + count; ++p) {
      mesh_.for_each_triangle(p, [this](const auto& corners) { face(corners); });
    }
  }

private:
  void vector(std::string_view keyword, std::span<const T> xyz) {
    file_.text(keyword);
    for (const T value : xyz) {
      file_.character(' ');
      file_.number(value);
    }
    file_.character('\n');
  }

  void face(const std::array<std::uint64_t, 3>& corners) {
    file_.character('f');
    for (const std::uint64_t corner : corners) {
      file_.character(' ');
      file_.number(corner + 1);
      if (mesh_.normals) {
        file_.text("//");
        file_.number(corner + 1);
      }
    }
    file_.character('\n');
  }

  OutputFile& file_;
  Mesh mesh_;
};

} // namespace

template <typename T>
std::unique_ptr<MeshWriter<T>> make_obj_writer(OutputFile& file, const Mesh& mesh) {
  return std::make_unique<ObjWriter<T>>(file, mesh);
}

template std::unique_ptr<MeshWriter<float>> make_obj_writer(OutputFile&, const Mesh&);
template std::unique_ptr<MeshWriter<double>> make_obj_writer(OutputFile&, const Mesh&);

} // namespace simdbezier::tools
