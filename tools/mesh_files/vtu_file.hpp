// .vtu files: VTK's XML form of unstructured grids, version 1.0. The text describes the arrays,
// whose bytes follow it, little endian and not compressed, each behind its size in 64 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/little_endian.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

inline constexpr std::uint8_t kVtkTriangle = 5; ///< VTK's numbers for cells
inline constexpr std::uint8_t kVtkQuad = 9;

struct VtuArray {
  std::string name;
  NumberType type;
  std::size_t components = 1;
  std::uint64_t count = 0; ///< of points or cells
};

/// An element that holds arrays: "Points", "PointData", "Cells" or "CellData".
struct VtuSection {
  std::string name;
  std::string attributes; ///< " Normals=\"Normals\""
  std::vector<VtuArray> arrays;
};

/// Returns the arrays of a mesh of triangles or quads. T: the type of its numbers.
template <typename T>
[[nodiscard]] std::vector<VtuSection> vtu_sections(const MeshContents& mesh);

/// The arrays are written in the order of the sections, which are the four above.
class VtuFile {
public:
  /// Of the contents it takes the generator, the deviation and the origin; `cells` has to be known
  /// because no array might tell. Throws Failure where the disk has no room for the file.
  VtuFile(const std::string& path, const MeshContents& contents, std::uint64_t cells,
          std::vector<VtuSection> sections);

  /// Begins the next array, when the one before is complete.
  void begin_array();
  void bytes(const void* data, std::size_t size);
  template <typename V>
  void number(V value) {
    std::array<std::byte, sizeof(V)> little;
    store_little(little.data(), value);
    bytes(little.data(), little.size());
  }

  [[nodiscard]] bool is_terminal() const { return file_.is_terminal(); }
  void complete();
  void commit() { file_.commit(); }

private:
  std::vector<std::uint64_t> sizes_; // of the arrays
  std::size_t begun_ = 0;            // how many arrays have been begun
  std::uint64_t missing_ = 0;        // bytes of the last one
  OutputFile file_;
};

} // namespace simdbezier::tools
