// One file of glTF 2.0 in binary form: a description in JSON, then the vertices, then the indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/mesh_files/vertex_records.hpp>
#include <tools/process/output_file.hpp>
#include <tools/process/spill_file.hpp>

namespace simdbezier::tools {

/// Where the parts of a mesh are in the file's binary chunk.
struct GlbParts {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  RecordLayout layout;

  [[nodiscard]] bool is_empty() const noexcept { return vertices == 0 || triangles == 0; }
  /// An index has 16 bits where there are few vertices; 65535 is no index of 16 bits.
  [[nodiscard]] std::size_t index_bytes() const noexcept { return vertices <= 65535 ? 2 : 4; }
  [[nodiscard]] std::uint64_t vertex_bytes() const noexcept { return vertices * layout.size; }
  [[nodiscard]] std::uint64_t all_index_bytes() const noexcept {
    return triangles * 3 * index_bytes();
  }
  /// Returns a multiple of 4.
  [[nodiscard]] std::uint64_t bytes() const noexcept {
    return is_empty() ? 0 : (vertex_bytes() + all_index_bytes() + 3) / 4 * 4;
  }
};

/// Returns the description. Bounds are those of the vertices as they are stored.
[[nodiscard]] std::string glb_description(const MeshContents& contents, const GlbParts& parts,
                                          const StoredBounds& bounds);

/// All of a file but its binary chunk.
[[nodiscard]] std::uint64_t glb_frame_bytes(const MeshContents& contents);

/// The format wants the smallest box around the vertices before the vertices themselves; it is
/// filled in at the end. What goes to a pipe or device waits in a temporary file until then.
class GlbFile {
public:
  /// Throws Failure where the file cannot be begun.
  GlbFile(const std::string& path, const MeshContents& contents, const GlbParts& parts);

  void vertices(std::span<const std::byte> records);
  /// Takes indices, after all vertices.
  void indices(std::span<const std::uint32_t> corners);
  /// Brings the file to its disk or device, after all indices; only its name is missing then.
  void complete();
  void commit() { file_.commit(); }

private:
  void body(const void* data, std::size_t size);
  void write_waiting();
  [[nodiscard]] std::string frame() const;

  MeshContents contents_;
  GlbParts parts_;
  StoredBounds bounds_;
  OutputFile file_;
  std::optional<SpillFile> waiting_; // the binary chunk, where the file cannot be rewritten
};

} // namespace simdbezier::tools
