// Bytes of STL, whose places in a file follow from numbers of faces, so that several processes can
// write one file. tools/mesh_files/record_file.hpp has those of PLY and of raw arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

inline constexpr std::size_t kStlFacetBytes = 50;
using StlPosition = std::array<float, 3>;
/// Returns what stands before the facets: 84 bytes.
[[nodiscard]] std::string stl_head(const MeshContents& contents);
void append_stl_facet(const std::array<StlPosition, 3>& corners, std::vector<std::byte>& to);

} // namespace simdbezier::tools
