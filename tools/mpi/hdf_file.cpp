#include <tools/mpi/hdf_file.hpp>

#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <hdf5.h>

#include <tools/mesh_files/vertex_records.hpp>
#include <tools/mesh_files/vtu_file.hpp>
#include <tools/mpi/placed_bytes.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kFaceArrays = 3; // Connectivity, Offsets and Types, behind all of vertices

// The arrays of a .vtu file under the names that VTKHDF has for them, a group before a slash.
template <typename T>
std::vector<VtuArray> arrays_of(const MeshContents& mesh) {
  std::vector<VtuArray> arrays;
  for (const VtuSection& section : vtu_sections<T>(mesh)) {
    for (VtuArray array : section.arrays) {
      if (section.name == "PointData") {
        array.name = "PointData/" + array.name;
      }
      array.name[0] = static_cast<char>(std::toupper(array.name[0]));
      array.count += array.name == "Offsets" ? 1 : 0; // the first one as well, which is 0
      arrays.push_back(std::move(array));
    }
  }
  return arrays;
}

std::size_t item_bytes(const VtuArray& array) { return array.components * array.type.bytes; }

void expect_done(herr_t code) {
  if (code < 0) {
    bad_input("expected room to write, found " + in_quotes(std::strerror(errno)));
  }
}

// What HDF5 hands out, given back.
class Handle {
public:
  explicit Handle(hid_t id) : id_(id) { expect_done(id < 0 ? -1 : 0); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { H5Idec_ref(id_); }
  [[nodiscard]] hid_t id() const noexcept { return id_; }

private:
  hid_t id_;
};

// Dimensions of none are those of a single item.
Handle space_of(const std::vector<hsize_t>& dimensions) {
  return Handle(dimensions.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(dimensions.size()),
                                                      dimensions.data(), nullptr));
}

hid_t stored_type(const NumberType& type) {
  if (type.name.starts_with("Float")) {
    return type.bytes == sizeof(float) ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  }
  if (type.name.starts_with("UInt")) {
    return type.bytes == 1 ? H5T_STD_U8LE : H5T_STD_U32LE;
  }
  return type.bytes == sizeof(std::int32_t) ? H5T_STD_I32LE : H5T_STD_I64LE;
}

hid_t access_of_file() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // which would print errors
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  // File systems of clusters may lack locks, and the file has no other user.
  H5Pset_file_locking(access, 0, 1);
  return access;
}

// Arrays get their place when they are made, and others fill them.
hid_t creation_of_arrays() {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(creation, 0); // the same mesh has the same bytes
  return creation;
}

class HdfHead {
public:
  explicit HdfHead(const std::string& path)
      : access_(access_of_file()), arrays_(creation_of_arrays()),
        file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_.id())),
        root_(H5Gcreate2(file_.id(), "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)) {}

  void group(const char* name) {
    const Handle made(H5Gcreate2(root_.id(), name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  void attribute(const char* name, const std::string& text) { // VTK takes fixed lengths only
    const Handle type(H5Tcopy(H5T_C_S1));
    expect_done(H5Tset_size(type.id(), text.size()));
    attribute(name, type.id(), type.id(), {}, text.data());
  }
  void attribute(const char* name, const std::array<std::int64_t, 2>& values) {
    attribute(name, H5T_STD_I64LE, H5T_NATIVE_INT64, {values.size()}, values.data());
  }
  void numbers(const char* name, std::int64_t value) {
    dataset(name, H5T_STD_I64LE, H5T_NATIVE_INT64, {1}, &value);
  }
  void numbers(const char* name, const std::vector<hsize_t>& dimensions, const double* values) {
    dataset(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, dimensions, values);
  }
  // Returns where the array begins.
  std::uint64_t array(const VtuArray& array) {
    std::vector<hsize_t> dimensions = {array.count, array.components};
    dimensions.resize(array.components > 1 ? 2 : 1);
    return dataset(array.name.c_str(), stored_type(array.type), 0, dimensions, nullptr);
  }
  void complete() { expect_done(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL)); }

private:
  void attribute(const char* name, hid_t stored, hid_t given,
                 const std::vector<hsize_t>& dimensions, const void* values) {
    const Handle space = space_of(dimensions);
    const Handle made(H5Acreate2(root_.id(), name, stored, space.id(), H5P_DEFAULT, H5P_DEFAULT));
    expect_done(H5Awrite(made.id(), given, values));
  }
  haddr_t dataset(const char* name, hid_t stored, hid_t given,
                  const std::vector<hsize_t>& dimensions, const void* values) {
    const Handle space = space_of(dimensions);
    const Handle made(
        H5Dcreate2(root_.id(), name, stored, space.id(), H5P_DEFAULT, arrays_.id(), H5P_DEFAULT));
    if (values != nullptr) {
      expect_done(H5Dwrite(made.id(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
    }
    return H5Dget_offset(made.id());
  }

  Handle access_;
  Handle arrays_;
  Handle file_;
  Handle root_;
};

template <typename T>
class HdfShardWriter final : public MeshWriter<T> {
public:
  HdfShardWriter(RankFile& file, const MeshContents& whole, std::span<const std::uint64_t> begins,
                 const MeshContents& shard, const ShardPlace& place)
      : MeshWriter<T>("", shard), whole_(whole.vertices),
        is_last_(place.first_face + shard.faces == whole.faces),
        corners_(place.first_face * whole.corners - place.quads_before),
        packer_("", shard, exact_records<T>(shard, false)),
        record_bytes_(exact_records<T>(shard, false).size) {
    const std::vector<VtuArray> arrays = arrays_of<T>(whole);
    for (std::size_t k = 0; k < arrays.size(); ++k) {
      const std::uint64_t first = arrays[k].name == "Connectivity"  ? corners_
                                  : k + kFaceArrays < arrays.size() ? place.first_vertex
                                                                    : place.first_face;
      item_bytes_.push_back(item_bytes(arrays[k]));
      arrays_.emplace_back(file, begins[k] + first * item_bytes_.back());
    }
  }
  [[nodiscard]] std::uint64_t foreign_vertices() const noexcept override { return whole_; }

private:
  void take_vertices(const VertexBlock<T>& block) override {
    std::size_t array = 0;
    deal(packer_.pack(block), record_bytes_, array);
    deal(block.data, this->contents().data_bytes(), array);
  }
  // Gives its part of each row to each of the arrays from this one on.
  void deal(std::span<const std::byte> rows, std::size_t row_bytes, std::size_t& array) {
    for (std::size_t from = 0; from < row_bytes; from += item_bytes_[array++]) {
      const std::size_t bytes = item_bytes_[array];
      std::vector<std::byte>& to = arrays_[array].bytes();
      std::size_t end = to.size();
      to.resize(end + rows.size() / row_bytes * bytes);
      for (std::size_t at = from; at < rows.size(); at += row_bytes, end += bytes) {
        std::memcpy(&to[end], &rows[at], bytes);
      }
      arrays_[array].flush_when_full();
    }
  }
  void take_faces(std::span<const std::uint32_t> corners) override {
    const std::size_t each = this->contents().corners;
    for (std::size_t k = 0; k < corners.size(); k += each) {
      const bool is_quad = each == 4 && corners[k + 3] != kNoVertex;
      append_index(offsets(), corners_);
      types().bytes().push_back(std::byte{is_quad ? kVtkQuad : kVtkTriangle});
      for (const std::uint32_t corner : corners.subspan(k, is_quad ? 4 : 3)) {
        append_index(connectivity(), corner);
        ++corners_;
      }
    }
    for (std::size_t k = arrays_.size() - kFaceArrays; k < arrays_.size(); ++k) {
      arrays_[k].flush_when_full();
    }
  }
  void append_index(PlacedBytes& to, std::uint64_t value) {
    std::vector<std::byte>& bytes = to.bytes();
    const std::size_t at = bytes.size();
    bytes.resize(at + index_bytes());
    index_bytes() == sizeof(std::int32_t)
        ? store_little(&bytes[at], static_cast<std::int32_t>(value))
        : store_little(&bytes[at], static_cast<std::int64_t>(value));
  }
  void put_on_disk() override {
    if (is_last_) {
      append_index(offsets(), corners_);
    }
    for (PlacedBytes& array : arrays_) {
      array.flush();
    }
  }
  void put_in_place() override {}

  [[nodiscard]] PlacedBytes& connectivity() { return *(arrays_.end() - 3); }
  [[nodiscard]] PlacedBytes& offsets() { return *(arrays_.end() - 2); }
  [[nodiscard]] PlacedBytes& types() { return arrays_.back(); }
  [[nodiscard]] std::size_t index_bytes() const { return *(item_bytes_.end() - 2); }

  std::uint64_t whole_;
  bool is_last_;
  std::uint64_t corners_; // of all faces before the next one
  RecordPacker<T> packer_;
  std::size_t record_bytes_;
  std::vector<std::size_t> item_bytes_; // of each array
  std::vector<PlacedBytes> arrays_;
};

} // namespace

template <typename T>
std::uint64_t hdf_bytes(const MeshContents& whole) {
  std::uint64_t bytes = std::uint64_t{1} << 16; // for HDF5, which takes a few thousand
  for (const VtuArray& array : arrays_of<T>(whole)) {
    bytes += array.count * item_bytes(array);
  }
  return bytes;
}

template <typename T>
std::vector<std::uint64_t> write_hdf_head(const RankFile& file, const MeshContents& whole) try {
  const std::vector<VtuArray> arrays = arrays_of<T>(whole);
  std::vector<std::uint64_t> begins;
  HdfHead head(file.temporary_path());
  head.attribute("Version", std::array<std::int64_t, 2>{1, 0});
  head.attribute("Type", "UnstructuredGrid");
  if (!whole.generator.empty()) {
    head.attribute("generator", whole.generator);
  }
  // All is one piece, because the numbers of vertices in a piece begin at 0.
  head.numbers("NumberOfPoints", static_cast<std::int64_t>(whole.vertices));
  head.numbers("NumberOfCells", static_cast<std::int64_t>(whole.faces));
  head.numbers("NumberOfConnectivityIds",
               static_cast<std::int64_t>(arrays[arrays.size() - kFaceArrays].count));
  for (const char* const group : {"PointData", "CellData", "FieldData"}) {
    head.group(group);
  }
  if (whole.has_bound()) {
    head.numbers("FieldData/deviation", {1}, &*whole.deviation);
  }
  if (whole.origin) {
    head.numbers("FieldData/origin", {1, 3}, whole.origin->data());
  }
  for (const VtuArray& array : arrays) {
    begins.push_back(head.array(array));
  }
  head.complete();
  return begins;
} catch (const Failure& failure) {
  bad_input(file.path() + ": " + failure.what());
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_hdf_shard_writer(RankFile& file, const MeshContents& whole,
                                                     std::span<const std::uint64_t> arrays,
                                                     const MeshContents& shard,
                                                     const ShardPlace& place) {
  return std::make_unique<HdfShardWriter<T>>(file, whole, arrays, shard, place);
}

#define SIMDBEZIER_HDF_FILE(T)                                                                     \
  template std::uint64_t hdf_bytes<T>(const MeshContents&);                                        \
  template std::vector<std::uint64_t> write_hdf_head<T>(const RankFile&, const MeshContents&);     \
  template std::unique_ptr<MeshWriter<T>> make_hdf_shard_writer(                                   \
      RankFile&, const MeshContents&, std::span<const std::uint64_t>, const MeshContents&,         \
      const ShardPlace&);
SIMDBEZIER_HDF_FILE(float)
SIMDBEZIER_HDF_FILE(double)
#undef SIMDBEZIER_HDF_FILE

} // namespace simdbezier::tools
