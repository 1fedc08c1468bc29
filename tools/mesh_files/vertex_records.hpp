// Vertices as a binary file has them: one record each, little endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// u16, i16 and i8 are normalised: their range stands for 0 to 1 or -1 to 1.
enum class FieldType : std::uint8_t { none, f32, f64, u32, u16, i16, i8 };

[[nodiscard]] std::size_t size_of(FieldType type) noexcept;

/// Where the fields of a record are; every field begins at a multiple of 4 bytes.
struct RecordLayout {
  struct Field {
    FieldType type = FieldType::none;
    std::size_t offset = 0;
    bool operator==(const Field&) const = default;
  };
  Field position;
  Field normal;
  Field uv;
  Field st; ///< u and v once more
  Field patch;
  std::size_t size = 0;
  bool unit_normals = false; ///< zero normals are replaced
  bool operator==(const RecordLayout&) const = default;
};

/// Returns the fields of PLY and VTU: those of the mesh in T's precision or as floats, patch
/// numbers as u32. uv_twice: whether they include `st`.
template <typename T>
[[nodiscard]] RecordLayout exact_records(const MeshContents& contents, bool uv_twice);
/// Returns the fields of GLB: floats or normalised integers, patch numbers as float.
[[nodiscard]] RecordLayout glb_records(const MeshContents& contents);
/// Returns the field of a position as float.
[[nodiscard]] RecordLayout float_positions();

/// The box whose corners quantised positions count from, and its largest side.
struct QuantisedSpace {
  std::array<double, 3> low = {};
  double extent = 1; ///< what 65535 stands for, in all directions, so that normals are not turned
};
[[nodiscard]] QuantisedSpace quantised_space(const MeshBox& box);

/// Writes blocks of vertices as records.
template <typename T>
class RecordPacker {
public:
  /// `path` is for messages.
  RecordPacker(std::string path, const MeshContents& contents, const RecordLayout& layout);
  /// Returns the records, which are valid until the next call. Throws Failure where a field cannot
  /// hold a number.
  [[nodiscard]] std::span<const std::byte> pack(const VertexBlock<T>& block);

private:
  void pack_positions(std::span<const T> values);
  void pack_patches(std::span<const std::uint32_t> patch);
  template <typename Source>
  void pack_numbers(const RecordLayout::Field& field, std::span<const T> values, std::size_t count,
                    Source&& source);

  std::string path_;
  MeshContents contents_;
  RecordLayout layout_;
  QuantisedSpace space_;
  bool records_are_values_;
  std::vector<std::byte> records_;
};

/// The smallest box around stored positions, in the numbers that are stored.
class StoredBounds {
public:
  explicit StoredBounds(const RecordLayout& layout) : layout_(layout) {}
  void include(std::span<const std::byte> records);
  [[nodiscard]] const std::array<double, 3>& low() const noexcept { return low_; }
  [[nodiscard]] const std::array<double, 3>& high() const noexcept { return high_; }

private:
  template <typename Stored>
  void include_as(std::span<const std::byte> records);

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  RecordLayout layout_;
  std::array<double, 3> low_ = {kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high_ = {-kInfinity, -kInfinity, -kInfinity};
};

} // namespace simdbezier::tools
