// Bytes of the formats whose places in a file follow from numbers of vertices and faces, so that
// several processes can write one file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// Returns what stands before the vertices, the deviation of the contents being the one to be
/// stated.
template <typename T>
[[nodiscard]] std::string ply_head(const MeshContents& contents);
/// Returns how many bytes so many faces have, `among` of which are triangles among quads.
[[nodiscard]] constexpr std::uint64_t ply_face_bytes(unsigned corners, std::uint64_t faces,
                                                     std::uint64_t among) {
  return faces * (1 + corners * sizeof(std::uint32_t)) - among * sizeof(std::uint32_t);
}
void append_ply_faces(std::span<const std::uint32_t> corners, unsigned each,
                      std::vector<std::byte>& to);

inline constexpr std::size_t kStlFacetBytes = 50;
using StlPosition = std::array<float, 3>;
/// Returns what stands before the facets: 84 bytes.
[[nodiscard]] std::string stl_head(const MeshContents& contents);
void append_stl_facet(const std::array<StlPosition, 3>& corners, std::vector<std::byte>& to);

} // namespace simdbezier::tools
