// One mesh without gaps of all patches of a file.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>
#include <tools/commands/mesh_rates.hpp>
#include <tools/commands/mesh_source.hpp>
#include <tools/commands/vertex_places.hpp>
#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Joins, chooses and numbers when it is made; vertices are computed when they are written. Takes
/// the file, because its points are freed as soon as they are packed.
template <typename T>
class WeldedMesh final : public MeshSource<T> {
public:
  /// Throws Failure that names the place in the file or the argument at fault.
  WeldedMesh(PatchFile file, const Arguments& arguments, MeshStats& stats);

  [[nodiscard]] MeshContents contents() const override;
  void write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) override;

private:
  struct Block {
    std::size_t first;
    std::size_t count;
  };

  void take_points(PatchFile file);
  void join();
  void split();
  void find_edges(bool orient);
  void leave_out_repeated();
  void choose_cells();
  void lay_out();
  void pack_all();
  void count_faces();

  [[nodiscard]] Block block_from(std::size_t patch) const;
  void write_vertices(const Block& block, MeshWriter<T>& writer, StageSeconds& seconds);
  void write_faces(const Block& block, MeshWriter<T>& writer, StageSeconds& seconds);
  /// Returns the corners of the block's faces, as MeshWriter takes them; they are valid until the
  /// next call.
  [[nodiscard]] std::span<const std::uint32_t> faces(const Block& block);
  [[nodiscard]] std::span<const std::uint32_t> quads(const Block& block);

  const Arguments& arguments_;
  MeshStats& stats_;
  std::size_t patches_ = 0;
  std::string name_; // the file's, for messages
  MeshBox box_;
  double deviation_ = 0;            // certified
  std::unique_ptr<PatchFile> file_; // whose memory nets_ may refer to
  PatchNets<T> nets_;
  std::vector<double> errors_;         // what rounding adds, for each patch
  std::vector<std::uint32_t> numbers_; // of patches in the file, where some are left out or cut
  SplitNets<T> pieces_;                // of patches that are cut, in whose memory nets_ are then
  std::size_t numbered_ = 0;           // patches in the file
  MeshRates rates_;
  Topology topology_;
  MeshLayout layout_;
  PatchSet<T> set_;
  std::uint64_t faces_ = 0;
  std::uint64_t among_quads_ = 0;
  std::vector<T> values_;
  VertexPlaces<T> places_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygons_;
  std::vector<std::uint8_t> sizes_;
};

} // namespace simdbezier::tools
