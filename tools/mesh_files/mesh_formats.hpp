// The writers behind make_mesh_writer(), and what they share. Contents have been checked, and their
// deviation is the one to be stated.
#pragma once

#include <memory>
#include <span>
#include <string>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/counts.hpp>

namespace simdbezier::tools {

#define SIMDBEZIER_DECLARE_MESH_WRITER(NAME, ...)                                                  \
  template <typename T>                                                                            \
  [[nodiscard]] std::unique_ptr<MeshWriter<T>> make_##NAME##_writer(const std::string& path,       \
                                                                    const MeshContents& contents);
SIMDBEZIER_EACH_MESH_FORMAT(SIMDBEZIER_DECLARE_MESH_WRITER)
#undef SIMDBEZIER_DECLARE_MESH_WRITER

/// Throws Failure where the format cannot hold such a mesh.
template <typename T>
void check_contents(const std::string& path, MeshFormat format, const MeshContents& contents);

/// Writes glTF 2.0 in binary form, in files of at most `most_bytes`.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_split_glb_writer(const std::string& path,
                                                                   const MeshContents& contents,
                                                                   std::uint64_t most_bytes);

/// Returns the size as the system counts it. Throws Failure where a file of that size cannot be.
std::uintmax_t checked_file_size(const std::string& path, Count bytes);

/// Returns "x y z", in the shortest decimals that read back to the same bits.
[[nodiscard]] std::string spaced(const std::array<double, 3>& point);

/// Returns a line of text about the deviation. Who looks for a number finds none where no bound is
/// known, as in formats that cannot say so.
[[nodiscard]] std::string worded_deviation(double deviation);

/// Returns the value as float. Throws Failure where it is too large for one.
template <typename T>
[[nodiscard]] float as_float(const std::string& path, T value);

} // namespace simdbezier::tools
