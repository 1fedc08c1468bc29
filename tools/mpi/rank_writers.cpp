#include <tools/mpi/rank_writers.hpp>

#include <vector>

#include <tools/mesh_files/mesh_bytes.hpp>
#include <tools/mesh_files/record_file.hpp>
#include <tools/mpi/hdf_file.hpp>
#include <tools/mpi/placed_bytes.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
RecordFile record_file(MeshFormat format, const MeshContents& whole) {
  return format == MeshFormat::raw ? raw_file<T>(whole) : ply_file<T>(whole);
}

template <typename T>
class RecordShardWriter final : public MeshWriter<T> {
public:
  RecordShardWriter(RankFile& file, const RecordFile& format, const MeshContents& whole,
                    const MeshContents& shard, const ShardPlace& place)
      : MeshWriter<T>("", shard), whole_(whole.vertices), format_(format),
        packer_("", shard, format.records),
        vertices_(file, format.head.size() + place.first_vertex * format.records.size),
        faces_(file,
               format.head.size() + whole.vertices * format.records.size +
                   format.face_bytes<std::uint64_t>(whole, place.first_face, place.quads_before)) {}
  [[nodiscard]] std::uint64_t foreign_vertices() const noexcept override { return whole_; }

private:
  void take_vertices(const VertexBlock<T>& block) override {
    const std::span<const std::byte> records = packer_.pack(block);
    vertices_.bytes().insert(vertices_.bytes().end(), records.begin(), records.end());
    vertices_.flush_when_full();
  }
  void take_faces(std::span<const std::uint32_t> corners) override {
    format_.append_faces(corners, this->contents().corners, faces_.bytes());
    faces_.flush_when_full();
  }
  void put_on_disk() override {
    vertices_.flush();
    faces_.flush();
  }
  void put_in_place() override {}

  std::uint64_t whole_;
  RecordFile format_;
  RecordPacker<T> packer_;
  PlacedBytes vertices_;
  PlacedBytes faces_;
};

// Positions of a shard's vertices stay in memory, since facets repeat them.
template <typename T>
class StlShardWriter final : public MeshWriter<T> {
public:
  StlShardWriter(RankFile& file, const MeshContents& whole, const MeshContents& shard,
                 const ShardPlace& place, std::span<const T> foreign)
      : MeshWriter<T>("", shard), foreign_(foreign), packer_("", shard, float_positions()),
        facets_(file, stl_head(whole).size() + place.first_face * kStlFacetBytes) {}
  [[nodiscard]] std::uint64_t foreign_vertices() const noexcept override {
    return foreign_.size() / this->contents().stride();
  }

private:
  void keep(std::span<const T> values) {
    const std::span<const std::byte> records = packer_.pack({values});
    for (std::size_t at = 0; at < records.size(); at += sizeof(StlPosition)) {
      positions_.push_back({load_little<float>(&records[at]), load_little<float>(&records[at + 4]),
                            load_little<float>(&records[at + 8])});
    }
  }
  void take_vertices(const VertexBlock<T>& block) override { keep(block.values); }
  void take_faces(std::span<const std::uint32_t> corners) override {
    if (!foreign_.empty()) { // they stand behind all others
      keep(foreign_);
      foreign_ = {};
    }
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      append_stl_facet(
          {positions_[corners[k]], positions_[corners[k + 1]], positions_[corners[k + 2]]},
          facets_.bytes());
      facets_.flush_when_full();
    }
  }
  void put_on_disk() override { facets_.flush(); }
  void put_in_place() override {}

  std::span<const T> foreign_;
  RecordPacker<T> packer_;
  std::vector<StlPosition> positions_;
  PlacedBytes facets_;
};

} // namespace

std::string formats_of_ranks() {
  return kHasHdf ? "ply, raw, stl or hdf"
                 : "ply, raw or stl (hdf needs HDF5, without which simdbezier-mpi was built)";
}

bool is_written_by_ranks(MeshFormat format) {
  return format == MeshFormat::ply || format == MeshFormat::raw || format == MeshFormat::stl ||
         (kHasHdf && format == MeshFormat::hdf);
}

template <typename T>
std::uint64_t ranked_bytes(MeshFormat format, const MeshContents& whole) {
  if (format == MeshFormat::stl) {
    return stl_head(whole).size() + whole.faces * kStlFacetBytes;
  }
  if constexpr (kHasHdf) {
    if (format == MeshFormat::hdf) {
      return hdf_bytes<T>(whole);
    }
  }
  const RecordFile file = record_file<T>(format, whole);
  return file.head.size() + whole.vertices * file.records.size +
         file.face_bytes<std::uint64_t>(whole, whole.faces, whole.among_quads);
}

template <typename T>
std::vector<std::uint64_t> write_head(RankFile& file, MeshFormat format,
                                      const MeshContents& whole) {
  if constexpr (kHasHdf) {
    if (format == MeshFormat::hdf) {
      return write_hdf_head<T>(file, whole);
    }
  }
  const std::string head =
      format == MeshFormat::stl ? stl_head(whole) : record_file<T>(format, whole).head;
  file.write(0, std::as_bytes(std::span(head)));
  return {};
}

template <typename T>
std::unique_ptr<MeshWriter<T>>
make_rank_writer(RankFile& file, MeshFormat format, const MeshContents& whole,
                 std::span<const std::uint64_t> arrays, const MeshContents& shard,
                 const ShardPlace& place, std::span<const T> foreign) {
  if (format == MeshFormat::stl) {
    return std::make_unique<StlShardWriter<T>>(file, whole, shard, place, foreign);
  }
  if constexpr (kHasHdf) {
    if (format == MeshFormat::hdf) {
      return make_hdf_shard_writer<T>(file, whole, arrays, shard, place);
    }
  }
  return std::make_unique<RecordShardWriter<T>>(file, record_file<T>(format, whole), whole, shard,
                                                place);
}

#define SIMDBEZIER_RANK_WRITERS(T)                                                                 \
  template std::uint64_t ranked_bytes<T>(MeshFormat, const MeshContents&);                         \
  template std::vector<std::uint64_t> write_head<T>(RankFile&, MeshFormat, const MeshContents&);   \
  template std::unique_ptr<MeshWriter<T>> make_rank_writer(                                        \
      RankFile&, MeshFormat, const MeshContents&, std::span<const std::uint64_t>,                  \
      const MeshContents&, const ShardPlace&, std::span<const T>);
SIMDBEZIER_RANK_WRITERS(float)
SIMDBEZIER_RANK_WRITERS(double)
#undef SIMDBEZIER_RANK_WRITERS

} // namespace simdbezier::tools
