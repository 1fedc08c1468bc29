// Files of a head, of vertices as records and of faces, one after the other: PLY and raw arrays.
// The places in them follow from numbers of vertices and faces, so that several processes can write
// one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/mesh_files/vertex_records.hpp>

namespace simdbezier::tools {

/// What two such formats differ in.
struct RecordFile {
  std::string head;
  RecordLayout records;
  /// Whether a face has the number of its corners as a byte before them, and only as many corners.
  /// Otherwise triangles among quads have kNoVertex as their last corner.
  bool counts_corners = false;

  /// Returns how many bytes so many faces have, `among` of which are triangles among quads. Number:
  /// Count or std::uint64_t.
  template <typename Number>
  [[nodiscard]] Number face_bytes(const MeshContents& mesh, std::uint64_t faces,
                                  std::uint64_t among) const {
    const std::size_t usual = mesh.corners * sizeof(std::uint32_t);
    return counts_corners ? Number(faces - among) * Number(1 + usual) +
                                Number(among) * Number(1 + 3 * sizeof(std::uint32_t))
                          : Number(faces) * Number(usual);
  }
  /// Appends the bytes of faces of `each` corners.
  void append_faces(std::span<const std::uint32_t> corners, unsigned each,
                    std::vector<std::byte>& to) const;
};

/// Returns what a format makes of contents whose deviation is the one to be stated.
template <typename T>
[[nodiscard]] RecordFile ply_file(const MeshContents& contents);
template <typename T>
[[nodiscard]] RecordFile raw_file(const MeshContents& contents);

/// A writer of such a file.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_record_writer(const std::string& path, const MeshContents& contents, RecordFile file);

} // namespace simdbezier::tools
