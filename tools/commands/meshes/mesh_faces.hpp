// Faces of a mesh without gaps, in the numbers that its file has.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>

namespace simdbezier::tools {

class MeshFaces {
public:
  explicit MeshFaces(const Arguments& arguments)
      : quads_(arguments.mesh.quads), threads_(arguments.threads) {}

  /// Counts the faces of these patches.
  void count(const MeshLayout& layout, SetRange patches);
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Faces of four corners that are triangles.
  [[nodiscard]] std::uint64_t among_quads() const noexcept { return among_quads_; }

  /// Says the numbers of the layout's first vertices (MeshLinks::before), behind which the others
  /// count from 0. Otherwise vertices have the layout's numbers.
  void name_before(std::vector<std::uint32_t> before);
  [[nodiscard]] const std::vector<std::uint32_t>& before() const noexcept { return before_; }
  /// Lets these others count from first_vertex, and gives those before them that have numbers the
  /// ones of `foreign`, one after the other.
  void place(std::uint32_t first_vertex, std::span<const std::uint32_t> foreign);

  /// Returns the corners of some patches' faces, as MeshWriter takes them. They are valid until the
  /// next call.
  [[nodiscard]] std::span<const std::uint32_t> corners(const MeshLayout& layout, SetRange patches);

private:
  void find_triangles(const MeshLayout& layout, SetRange patches);
  void find_quads(const MeshLayout& layout, SetRange patches);

  bool quads_;
  int threads_;
  std::uint64_t count_ = 0;
  std::uint64_t among_quads_ = 0;
  std::vector<std::uint32_t> before_;
  std::uint32_t shift_ = 0; // from the layout's numbers to those of faces
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygons_;
  std::vector<std::uint8_t> sizes_;
};

} // namespace simdbezier::tools
