// VTK's .vtu of triangles or quads, see vtu_file.hpp. Its arrays follow one after the other: what a
// vertex has besides its position waits until the last position has been written, and the sizes of
// cells, where they differ, until the last one of these.
#include <tools/mesh_files/mesh_formats.hpp>

#include <algorithm>

#include <tools/mesh_files/vertex_records.hpp>
#include <tools/mesh_files/vtu_file.hpp>
#include <tools/process/spill_file.hpp>

namespace simdbezier::tools {

namespace {

// VTK wants offsets and corners in one type, and counts in signed ones.
bool is_large(const MeshContents& mesh) {
  return !(Count(mesh.faces) * mesh.corners + mesh.vertices)
              .within(std::numeric_limits<std::int32_t>::max());
}

template <typename T>
class VtuWriter final : public MeshWriter<T> {
public:
  VtuWriter(const std::string& path, const MeshContents& mesh)
      : MeshWriter<T>(path, mesh), sections_(vtu_sections<T>(mesh)),
        packer_(path, mesh, exact_records<T>(mesh, false)),
        record_bytes_(exact_records<T>(mesh, false).size), rest_(path), sizes_(path),
        file_(path, mesh, mesh.faces, sections_), large_(is_large(mesh)) {
    file_.begin_array();
  }

  [[nodiscard]] bool is_terminal() const override { return file_.is_terminal(); }

private:
  using MeshWriter<T>::contents;

  [[nodiscard]] std::size_t position_bytes() const {
    return 3 * sections_.front().arrays.front().type.bytes;
  }
  [[nodiscard]] std::size_t rest_bytes() const {
    return record_bytes_ - position_bytes() + contents().data_bytes();
  }

  void take_vertices(const VertexBlock<T>& block) override {
    const std::span<const std::byte> records = packer_.pack(block);
    const std::size_t data_bytes = contents().data_bytes();
    block_.clear();
    std::span<const std::byte> data = block.data;
    for (std::size_t at = 0; at < records.size(); at += record_bytes_) {
      const auto record = records.subspan(at, record_bytes_);
      file_.bytes(record.data(), position_bytes());
      append(record.subspan(position_bytes()));
      append(data.first(data_bytes));
      data = data.subspan(data_bytes);
    }
    rest_.append(block_.data(), block_.size());
  }

  void append(std::span<const std::byte> bytes) {
    block_.insert(block_.end(), bytes.begin(), bytes.end());
  }

  // Calls visit(the bytes of some vertices) for all that have been kept.
  template <typename Visit>
  void for_rest(Visit&& visit) {
    constexpr std::size_t kBlock = 4096;
    for (std::uint64_t first = 0; first < contents().vertices; first += kBlock) {
      block_.resize(std::min<std::uint64_t>(kBlock, contents().vertices - first) * rest_bytes());
      rest_.read(first * rest_bytes(), block_.data(), block_.size());
      visit(std::span<const std::byte>(block_));
    }
  }

  void write_rest() {
    std::size_t offset = 0;
    for (const VtuArray& array : sections_[1].arrays) {
      const std::size_t bytes = array.components * array.type.bytes;
      file_.begin_array();
      for_rest([&](std::span<const std::byte> block) {
        for (std::size_t at = offset; at < block.size(); at += rest_bytes()) {
          file_.bytes(&block[at], bytes);
        }
      });
      offset += bytes;
    }
    file_.begin_array(); // of corners
    in_faces_ = true;
  }

  void take_faces(std::span<const std::uint32_t> corners) override {
    if (!in_faces_) {
      write_rest();
    }
    for (const std::uint32_t corner : corners) {
      if (corner != kNoVertex) {
        index(corner);
      }
    }
    for (std::size_t k = 3; contents().among_quads > 0 && k < corners.size(); k += 4) {
      const std::uint8_t size = corners[k] == kNoVertex ? 3 : 4;
      sizes_.append(&size, 1);
    }
  }

  void index(std::uint64_t value) {
    large_ ? file_.number(static_cast<std::int64_t>(value))
           : file_.number(static_cast<std::int32_t>(value));
  }

  // Calls visit(number of corners) for every face.
  template <typename Visit>
  void for_sizes(Visit&& visit) {
    auto size = static_cast<std::uint8_t>(contents().corners);
    for (std::uint64_t k = 0; k < contents().faces; ++k) {
      if (contents().among_quads > 0) {
        sizes_.read(k, &size, 1);
      }
      visit(size);
    }
  }

  void put_on_disk() override {
    if (!in_faces_) {
      write_rest();
    }
    file_.begin_array();
    std::uint64_t end = 0;
    for_sizes([&](std::uint8_t size) { index(end += size); });
    file_.begin_array();
    for_sizes([&](std::uint8_t size) { file_.number(size == 3 ? kVtkTriangle : kVtkQuad); });
    file_.complete();
  }
  void put_in_place() override { file_.commit(); }

  std::vector<VtuSection> sections_;
  RecordPacker<T> packer_;
  std::size_t record_bytes_;
  SpillFile rest_; // of every vertex, the arrays of PointData one after the other
  SpillFile sizes_;
  VtuFile file_;
  bool large_;
  bool in_faces_ = false;
  std::vector<std::byte> block_;
};

} // namespace

template <typename T>
std::vector<VtuSection> vtu_sections(const MeshContents& mesh) {
  const NumberType real =
      sizeof(T) == sizeof(float) || mesh.floats ? number_type<float>() : number_type<double>();
  const NumberType index =
      is_large(mesh) ? number_type<std::int64_t>() : number_type<std::int32_t>();
  VtuSection data{"PointData", "", {}};
  if (mesh.normals) {
    data.attributes += R"( Normals="Normals")";
    data.arrays.push_back({"Normals", real, 3, mesh.vertices});
  }
  if (mesh.uv) {
    data.attributes += R"( TCoords="TCoords")";
    data.arrays.push_back({"TCoords", real, 2, mesh.vertices});
  }
  if (mesh.patches > 0) {
    data.arrays.push_back({"patch", number_type<std::uint32_t>(), 1, mesh.vertices});
  }
  for (const PointData& item : mesh.data) {
    data.arrays.push_back({item.name, item.type, item.components, mesh.vertices});
  }
  const std::uint64_t corners = mesh.faces * mesh.corners - mesh.among_quads;
  return {{"Points", "", {{"Points", real, 3, mesh.vertices}}},
          data,
          {"Cells",
           "",
           {{"connectivity", index, 1, corners},
            {"offsets", index, 1, mesh.faces},
            {"types", number_type<std::uint8_t>(), 1, mesh.faces}}},
          {"CellData", "", {}}};
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_vtu_writer(const std::string& path,
                                               const MeshContents& contents) {
  return std::make_unique<VtuWriter<T>>(path, contents);
}

template std::vector<VtuSection> vtu_sections<float>(const MeshContents&);
template std::vector<VtuSection> vtu_sections<double>(const MeshContents&);
template std::unique_ptr<MeshWriter<float>> make_vtu_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_vtu_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
