#include <tools/mesh_files/record_file.hpp>

#include <utility>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/process/little_endian.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
class RecordWriter final : public MeshWriter<T> {
public:
  RecordWriter(const std::string& path, const MeshContents& mesh, RecordFile format)
      : MeshWriter<T>(path, mesh), format_(std::move(format)), packer_(path, mesh, format_.records),
        size_(checked_file_size(path,
                                Count(mesh.vertices) * format_.records.size +
                                    format_.face_bytes<Count>(mesh, mesh.faces, mesh.among_quads))),
        file_(path) {
    file_.expect_room(checked_file_size(path, Count(size_) + format_.head.size()));
    file_.text(format_.head);
  }

  [[nodiscard]] bool is_terminal() const override { return file_.is_terminal(); }

private:
  void take_vertices(const VertexBlock<T>& block) override {
    const std::span<const std::byte> records = packer_.pack(block);
    file_.bytes(records.data(), records.size());
  }
  void take_faces(std::span<const std::uint32_t> corners) override {
    faces_.clear();
    format_.append_faces(corners, this->contents().corners, faces_);
    file_.bytes(faces_.data(), faces_.size());
  }
  void put_on_disk() override { file_.complete(); }
  void put_in_place() override { file_.commit(); }

  RecordFile format_;
  RecordPacker<T> packer_;
  std::uintmax_t size_;
  OutputFile file_;
  std::vector<std::byte> faces_;
};

} // namespace

void RecordFile::append_faces(std::span<const std::uint32_t> corners, unsigned each,
                              std::vector<std::byte>& to) const {
  std::size_t at = to.size();
  const std::size_t most = (counts_corners ? 1 : 0) + each * sizeof(std::uint32_t);
  to.resize(at + corners.size() / each * most);
  for (std::size_t k = 0; k < corners.size(); k += each) {
    std::size_t count = each;
    if (counts_corners) {
      count = corners[k + each - 1] == kNoVertex ? 3 : each;
      to[at++] = static_cast<std::byte>(count);
    }
    for (std::size_t c = 0; c < count; ++c, at += sizeof(std::uint32_t)) {
      store_little(&to[at], corners[k + c]);
    }
  }
  to.resize(at);
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_record_writer(const std::string& path,
                                                  const MeshContents& contents, RecordFile file) {
  return std::make_unique<RecordWriter<T>>(path, contents, std::move(file));
}

template std::unique_ptr<MeshWriter<float>> make_record_writer(const std::string&,
                                                               const MeshContents&, RecordFile);
template std::unique_ptr<MeshWriter<double>> make_record_writer(const std::string&,
                                                                const MeshContents&, RecordFile);

} // namespace simdbezier::tools
