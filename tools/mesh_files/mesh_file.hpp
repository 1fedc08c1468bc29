// Files of meshes: what a mesh consists of, and a writer for every format.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace simdbezier::tools {

/// What a format can hold besides positions and triangles, and how much of it.
struct MeshAbilities {
  static constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();

  bool quads = false;
  bool normals = false;
  bool quantised = false;  ///< see VertexStorage
  bool doubles = false;    ///< positions are rounded to floats where this is false
  bool moved = false;      ///< programs that read it put the mesh at its origin by themselves
  bool point_data = false; ///< further numbers of vertices, and patches as Bézier cells
  std::uint64_t most_faces = kAny;
  std::uint64_t most_patches = kAny; ///< the patches whose numbers vertices can have
};

/// The formats that can be written. Each row has a name, which is also the extension of files, what
/// messages call such a file, and its abilities; write_NAME.cpp has its writer. Help and messages
/// list these rows.
// clang-format off
#define SIMDBEZIER_EACH_MESH_FORMAT(X)                                                             \
  X(obj, "an OBJ file", {.quads = true, .normals = true, .doubles = true})                         \
  X(ply, "a PLY file",  {.quads = true, .normals = true, .doubles = true})                         \
  X(stl, "an STL file", {.most_faces = 0xFFFFFFFF}) /* has normals of facets only */               \
  X(glb, "a GLB file",  {.normals = true, .quantised = true, .moved = true,                        \
                         .most_patches = std::uint64_t{1} << 24}) /* their numbers are floats */ \
  X(vtu, "a VTU file",  {.quads = true, .normals = true, .doubles = true, .point_data = true})     \
  X(raw, "raw arrays",  {.quads = true, .normals = true, .doubles = true})
/// Those that only simdbezier-mpi writes (tools/mpi).
#define SIMDBEZIER_EACH_FORMAT_OF_RANKS(X)                                                         \
  X(hdf, "a VTKHDF file", {.quads = true, .normals = true, .doubles = true, .point_data = true})
// clang-format on

#define SIMDBEZIER_DECLARE_MESH_FORMAT(NAME, ...) NAME,
enum class MeshFormat : std::uint8_t {
  SIMDBEZIER_EACH_MESH_FORMAT(SIMDBEZIER_DECLARE_MESH_FORMAT)
      SIMDBEZIER_EACH_FORMAT_OF_RANKS(SIMDBEZIER_DECLARE_MESH_FORMAT)
};
#undef SIMDBEZIER_DECLARE_MESH_FORMAT

/// Returns the format that a file's name asks for by its extension. ranks: whether it may be one
/// that only ranks write.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::string& path, bool ranks = false);

[[nodiscard]] const MeshAbilities& mesh_abilities(MeshFormat format);

/// Returns "" or a word behind a name that is none of ours, where it is nearly one, or of ranks.
[[nodiscard]] std::string mesh_format_hint(const std::string& path);

/// Returns "obj", ….
[[nodiscard]] std::string mesh_format_name(MeshFormat format);
/// Returns "obj, ply, … or glb", every name behind `prefix`: all formats that one process writes,
/// or those of them with the ability.
[[nodiscard]] std::string mesh_format_names(const std::string& prefix,
                                            bool MeshAbilities::*ability = nullptr);

struct MeshBox {
  std::array<double, 3> low = {};
  std::array<double, 3> high = {};
};

/// Returns the length of the box's diagonal.
[[nodiscard]] double diagonal_of(const MeshBox& box);

/// Returns the largest absolute value of a coordinate in the box.
[[nodiscard]] double largest_coordinate(const MeshBox& box);

/// How GLB stores vertices. Quantised: positions and uv in 16 bits, normals in 16 or 8 bits a
/// component, which takes the extension KHR_mesh_quantization.
enum class VertexStorage : std::uint8_t { full, quantised_16, quantised_8 };

/// An index needs 32 bits, and the largest one stays free.
inline constexpr std::uint64_t kMostMeshVertices = std::numeric_limits<std::uint32_t>::max();

/// Stands in place of a quad's fourth corner, which makes it a triangle.
inline constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// A type of numbers by its name in VTK: "Float32", "Int8", "UInt64", …
struct NumberType {
  std::string name;
  std::size_t bytes = 0;
};
template <typename V>
[[nodiscard]] NumberType number_type() {
  const std::string kind = std::is_floating_point_v<V> ? "Float"
                           : std::is_signed_v<V>       ? "Int"
                                                       : "UInt";
  return {kind + std::to_string(8 * sizeof(V)), sizeof(V)};
}

/// Numbers that every vertex has besides the usual ones. The name is printable, not empty, none of
/// the format's own, and no other array's.
struct PointData {
  std::string name;
  NumberType type;
  std::size_t components = 1;
};

/// All that has to be known of a mesh before its first vertex is written.
struct MeshContents {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  unsigned corners = 3;          ///< those that a face has: 3, or 4 in formats with quads
  std::uint64_t among_quads = 0; ///< faces of 4 corners that are triangles (kNoVertex)
  bool normals = false;
  bool uv = false;           ///< within 0 and 1
  std::uint64_t patches = 0; ///< every vertex has a patch number below this; 0: none has
  VertexStorage storage = VertexStorage::full;
  bool floats = false; ///< doubles are stored as floats in formats that have both
  /// The point that all positions, and the box, count from; files state it.
  std::optional<std::array<double, 3>> origin;
  /// A box around all positions, which may be larger than the smallest one. Formats that round
  /// positions need it: quantised ones, and doubles with a stated deviation that become floats.
  std::optional<MeshBox> box;
  /// How far positions may leave the box by rounding; quantised ones come to its border.
  double margin = 0;
  /// A bound on the mesh's distance from the surface. Files state it plus whatever the format's
  /// rounding adds.
  std::optional<double> deviation;
  std::string generator; ///< what wrote the file; empty: not stated
  std::vector<PointData> data = {};

  /// Returns how many values a vertex has: x y z, nx ny nz, u v, as far as there are such.
  [[nodiscard]] std::size_t stride() const noexcept {
    return 3 + (normals ? 3U : 0U) + (uv ? 2U : 0U);
  }
  /// Whether a bound is stated and known: formats of numbers state no other.
  [[nodiscard]] bool has_bound() const { return deviation && std::isfinite(*deviation); }
  /// Returns how many bytes `data` has for a vertex.
  [[nodiscard]] std::size_t data_bytes() const noexcept {
    std::size_t bytes = 0;
    for (const PointData& item : data) {
      bytes += item.type.bytes * item.components;
    }
    return bytes;
  }
};

/// A block of vertices, which follow those of the block before.
template <typename T>
struct VertexBlock {
  std::span<const T> values;                 ///< MeshContents::stride() of every vertex
  std::span<const std::uint32_t> patch = {}; ///< one of every vertex, if they have any
  std::span<const std::byte> data =
      {}; ///< MeshContents::data_bytes() of every vertex, little endian
};

/// Takes a mesh block by block: vertices in order, and faces when the vertices that they name have
/// been handed over, in blocks of any size. The memory that it takes does not grow with the mesh.
template <typename T>
class MeshWriter {
public:
  virtual ~MeshWriter() = default;
  MeshWriter(const MeshWriter&) = delete;
  MeshWriter& operator=(const MeshWriter&) = delete;

  /// Throws Failure where a number is not finite or the file cannot hold it.
  void vertices(const VertexBlock<T>& block);
  /// Takes corners of faces, MeshContents::corners each, numbered from 0.
  void faces(std::span<const std::uint32_t> corners);
  /// Brings the whole mesh to its disk or device. Only the file's name is missing then.
  void complete();
  /// Puts the file in its place, after complete() if that has not been called; without it, there
  /// is none.
  void finish();

  /// Whether faces may come before the last vertex.
  [[nodiscard]] virtual bool takes_faces_early() const noexcept { return false; }
  /// How many numbers behind those of its vertices faces may have, for vertices of another file.
  [[nodiscard]] virtual std::uint64_t foreign_vertices() const noexcept { return 0; }
  /// Whether people see what is written while it is.
  [[nodiscard]] virtual bool is_terminal() const { return false; }

protected:
  MeshWriter(std::string path, const MeshContents& contents)
      : path_(std::move(path)), contents_(contents) {}
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const MeshContents& contents() const noexcept { return contents_; }

private:
  virtual void take_vertices(const VertexBlock<T>& block) = 0;
  virtual void take_faces(std::span<const std::uint32_t> corners) = 0;
  virtual void put_on_disk() = 0;
  virtual void put_in_place() = 0;

  std::string path_;
  MeshContents contents_;
  std::uint64_t vertices_done_ = 0;
  std::uint64_t faces_done_ = 0;
  bool complete_ = false;
};

/// A writer for the format. Throws Failure, before anything is written, where the format cannot
/// hold such a mesh or the disk has no room for it.
///
/// A GLB file is below 4 GiB. A larger mesh becomes several files, NAME-0.glb, NAME-1.glb …, each a
/// mesh of its own that any viewer can load; vertices where they meet are in both, with equal bits.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_mesh_writer(const std::string& path, MeshFormat format, const MeshContents& contents);

/// Returns the contents as a file states them: with the deviation that storing adds to. Throws
/// Failure where the format cannot hold such a mesh.
template <typename T>
[[nodiscard]] MeshContents stated_contents(const std::string& path, MeshFormat format,
                                           const MeshContents& contents);

/// Returns a bound on the distance by which storing moves a vertex. Of the contents it needs the
/// box, the origin and the kind of numbers.
template <typename T>
[[nodiscard]] double storage_error(MeshFormat format, const MeshContents& contents);

/// Returns the deviation that a file states: what the contents have, and storage_error().
template <typename T>
[[nodiscard]] double stated_deviation(MeshFormat format, const MeshContents& contents);

} // namespace simdbezier::tools
