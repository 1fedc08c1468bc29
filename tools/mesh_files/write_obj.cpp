// Wavefront OBJ, without patch numbers: of each block of vertices all v, then all vt, then all vn
// lines. Lines may come in any order as long as a face's vertices precede it, so nothing
// has to wait for the end of the mesh.
#include <tools/mesh_files/mesh_formats.hpp>

#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// Returns the fewest bytes there can be: "v 0 0 0", "vt 0 0", "vn 0 0 1", "f 1 2 3", and "/1" or
// "//1".
Count fewest_bytes(const MeshContents& contents) {
  const std::size_t vertex = 8 + (contents.uv ? 7U : 0U) + (contents.normals ? 9U : 0U);
  const std::size_t corner = 2 + (contents.normals ? 3U : contents.uv ? 2U : 0U);
  return Count(contents.vertices) * vertex +
         Count(contents.faces - contents.among_quads) * (2 + corner * contents.corners) +
         Count(contents.among_quads) * (2 + corner * 3);
}

template <typename T>
class ObjWriter final : public MeshWriter<T> {
public:
  ObjWriter(const std::string& path, const MeshContents& mesh)
      : MeshWriter<T>(path, mesh), file_(path) {
    file_.expect_room(checked_file_size(path, fewest_bytes(mesh)));
    if (!mesh.generator.empty()) {
      file_.text("# " + mesh.generator + "\n");
    }
    if (mesh.deviation) {
      file_.text("# " + worded_deviation(*mesh.deviation) + "\n");
    }
    if (mesh.origin) {
      file_.text("# origin " + spaced(*mesh.origin) + "\n");
    }
  }

  [[nodiscard]] bool takes_faces_early() const noexcept override { return true; }
  [[nodiscard]] bool is_terminal() const override { return file_.is_terminal(); }

private:
  using MeshWriter<T>::contents;

  void take_vertices(const VertexBlock<T>& block) override {
    lines("v", block.values, 0, 3);
    if (contents().uv) {
      lines("vt", block.values, contents().normals ? 6 : 3, 2);
    }
    if (contents().normals) {
      lines("vn", block.values, 3, 3);
    }
  }

  // Writes one line a vertex, with `count` of its values from `first` on.
  void lines(std::string_view keyword, std::span<const T> values, std::size_t first,
             std::size_t count) {
    for (std::size_t k = first; k < values.size(); k += contents().stride()) {
      file_.text(keyword);
      for (const T value : values.subspan(k, count)) {
        file_.character(' ');
        contents().floats ? file_.number(as_float(this->path(), value)) : file_.number(value);
      }
      file_.character('\n');
    }
  }

  void take_faces(std::span<const std::uint32_t> corners) override {
    for (std::size_t k = 0; k < corners.size(); k += contents().corners) {
      file_.character('f');
      for (const std::uint32_t corner : corners.subspan(k, contents().corners)) {
        if (corner != kNoVertex) {
          file_.character(' ');
          name(std::uint64_t{corner} + 1);
        }
      }
      file_.character('\n');
    }
  }

  // Writes "7", "7/7", "7//7" or "7/7/7".
  void name(std::uint64_t number) {
    file_.number(number);
    if (contents().uv) {
      file_.character('/');
      file_.number(number);
    }
    if (contents().normals) {
      file_.text(contents().uv ? "/" : "//");
      file_.number(number);
    }
  }

  void put_on_disk() override { file_.complete(); }
  void put_in_place() override { file_.commit(); }

  OutputFile file_;
};

} // namespace

template <typename T>
std::unique_ptr<MeshWriter<T>> make_obj_writer(const std::string& path,
                                               const MeshContents& contents) {
  return std::make_unique<ObjWriter<T>>(path, contents);
}

template std::unique_ptr<MeshWriter<float>> make_obj_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_obj_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
