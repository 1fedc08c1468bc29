// A mesh in several GLB files, each a mesh of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <tools/mesh_files/glb/glb_file.hpp>

namespace simdbezier::tools {

/// Cuts a mesh where the next triangle would make a file too large. A file has the vertices from
/// those that no file before it knew up to the largest that it names, and copies of earlier ones.
/// Vertices and the triangles of a file wait in temporary files until its size is known. Memory: 64
/// MiB each, and about 40 bytes a copied vertex.
class SplitGlb {
public:
  /// Throws Failure where the name is that of a pipe or device, or where there would be too many.
  SplitGlb(const std::string& path, const MeshContents& contents, std::uint64_t most_bytes);

  void vertices(std::span<const std::byte> records) {
    records_.append(records.data(), records.size());
  }
  void triangles(std::span<const std::uint32_t> corners);
  /// Brings all files to the disk. Only their names are missing then.
  void complete();
  /// Gives all of them their names, after complete().
  void commit();

private:
  struct Part {
    std::uint32_t first = 0;           // the first of the vertices that are new
    std::uint32_t end = 0;             // behind the largest one
    std::vector<std::uint32_t> copied; // in the order of their numbers
    std::unordered_map<std::uint32_t, std::uint32_t> place; // where the copied ones are in `copied`
    std::uint64_t triangles = 0;

    [[nodiscard]] std::uint64_t vertices() const noexcept {
      return std::uint64_t{end} - first + copied.size();
    }
  };

  [[nodiscard]] std::string name(std::size_t number) const;
  [[nodiscard]] bool has_room(std::span<const std::uint32_t, 3> triangle) const;
  void take(std::span<const std::uint32_t, 3> triangle);
  void complete_part();
  void write_vertices(GlbFile& file);
  void write_triangles(GlbFile& file);

  std::string path_;
  MeshContents contents_;
  RecordLayout layout_;
  std::uint64_t most_body_bytes_;
  SpillFile records_;
  std::optional<SpillFile> corners_; // the part's, numbered in the whole mesh
  Part part_;
  std::deque<GlbFile> files_;
};

} // namespace simdbezier::tools
