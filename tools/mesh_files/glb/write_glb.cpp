// Binary glTF: one file, or several where one would be too large for the format.
#include <tools/mesh_files/mesh_formats.hpp>

#include <tools/mesh_files/glb/glb_file.hpp>
#include <tools/mesh_files/glb/split_glb.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
class GlbWriter final : public MeshWriter<T> {
public:
  GlbWriter(const std::string& path, const MeshContents& mesh)
      : MeshWriter<T>(path, mesh), packer_(path, mesh, glb_records(mesh)),
        file_(path, mesh, GlbParts{mesh.vertices, mesh.faces, glb_records(mesh)}) {}

private:
  void take_vertices(const VertexBlock<T>& block) override { file_.vertices(packer_.pack(block)); }
  void take_faces(std::span<const std::uint32_t> corners) override { file_.indices(corners); }
  void put_on_disk() override { file_.complete(); }
  void put_in_place() override { file_.commit(); }

  RecordPacker<T> packer_;
  GlbFile file_;
};

template <typename T>
class SplitGlbWriter final : public MeshWriter<T> {
public:
  SplitGlbWriter(const std::string& path, const MeshContents& mesh, std::uint64_t most_bytes)
      : MeshWriter<T>(path, mesh), packer_(path, mesh, glb_records(mesh)),
        files_(path, mesh, most_bytes) {}

private:
  void take_vertices(const VertexBlock<T>& block) override { files_.vertices(packer_.pack(block)); }
  void take_faces(std::span<const std::uint32_t> corners) override { files_.triangles(corners); }
  void put_on_disk() override { files_.complete(); }
  void put_in_place() override { files_.commit(); }

  RecordPacker<T> packer_;
  SplitGlb files_;
};

} // namespace

template <typename T>
std::unique_ptr<MeshWriter<T>> make_glb_writer(const std::string& path,
                                               const MeshContents& contents) {
  // The header has 32 bits for the file's size.
  return make_split_glb_writer<T>(path, contents, std::numeric_limits<std::uint32_t>::max());
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_split_glb_writer(const std::string& path,
                                                     const MeshContents& contents,
                                                     std::uint64_t most_bytes) {
  const GlbParts whole{contents.vertices, contents.faces, glb_records(contents)};
  const Count bytes = Count(whole.vertices) * whole.layout.size +
                      Count(whole.triangles) * (3 * whole.index_bytes()) + 3 +
                      glb_frame_bytes(contents);
  if (bytes.within(most_bytes)) {
    return std::make_unique<GlbWriter<T>>(path, contents);
  }
  if constexpr (sizeof(std::size_t) > sizeof(std::uint32_t)) {
    return std::make_unique<SplitGlbWriter<T>>(path, contents, most_bytes);
  } else { // memory ends before the format does
    bad_input(path + ": expected a file of less than 4 GiB, found a larger one");
  }
}

template std::unique_ptr<MeshWriter<float>> make_glb_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_glb_writer(const std::string&,
                                                             const MeshContents&);
template std::unique_ptr<MeshWriter<float>>
make_split_glb_writer(const std::string&, const MeshContents&, std::uint64_t);
template std::unique_ptr<MeshWriter<double>>
make_split_glb_writer(const std::string&, const MeshContents&, std::uint64_t);

} // namespace simdbezier::tools
