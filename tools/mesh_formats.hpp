// The writers behind make_mesh_writer(), and what they share. Contents have been checked, and their
// deviation is the one to be stated.
#pragma once

#include <memory>
#include <span>
#include <string>

#include <tools/counts.hpp>
#include <tools/mesh_file.hpp>

namespace simdbezier::tools {

/// Wavefront OBJ, without patch numbers: of each block all v, then all vt, then all vn lines.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_obj_writer(const std::string& path,
                                                             const MeshContents& contents);

/// Binary PLY, little endian, in T's precision.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_ply_writer(const std::string& path,
                                                             const MeshContents& contents);

/// Binary STL: positions of the corners as float, and the facets' own normals.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_stl_writer(const std::string& path,
                                                             const MeshContents& contents);

inline constexpr std::uint64_t kMostGlbBytes = std::numeric_limits<std::uint32_t>::max();

/// glTF 2.0 in binary form, in files of at most `most_bytes`.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_glb_writer(const std::string& path, const MeshContents& contents,
                std::uint64_t most_bytes = kMostGlbBytes);

/// Throws Failure where a file of that size cannot be.
std::uintmax_t checked_file_size(const std::string& path, Count bytes);

/// The value as float. Throws Failure where it is too large for one.
template <typename T>
[[nodiscard]] float as_float(const std::string& path, T value);

} // namespace simdbezier::tools
