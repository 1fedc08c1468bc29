// The triangles of patches, one after the other: usual ones by PlainPatch and RegularPatch, all
// others by CellCutter.
#pragma once

#include "src/mesh/primitives/plain_patch.hpp"
#include "src/mesh/primitives/primitive_sinks.hpp"
#include "src/mesh/primitives/regular_patch.hpp"

namespace simdbezier::detail {

/// One thread's triangles.
template <typename Index>
class TriangleWriter {
public:
  /// to: where the first patch's triangles begin.
  TriangleWriter(const MeshData& mesh, const KernelTable<float>& table, Index* to, bool streaming)
      : mesh_(mesh), sides_(mesh), boundary_(mesh), stream_(table, to, streaming) {}

  void write(std::size_t first, std::size_t last) {
    Index* to = stream_.cursor();
    for (std::size_t patch = first; patch < last; ++patch) {
      const bool turned = mesh_.topology.is_turned(patch);
      to = stream_.make_room(to);
      to = is_cell(patch)           ? write_cell(patch, turned, to)
           : !sides_.move_to(patch) ? write_any(patch, turned)
           : turned                 ? write_regular<true>(patch, to)
                                    : write_regular<false>(patch, to);
    }
    stream_.finish(to);
  }

private:
  /// Whether a patch is one cell of two triangles: no side is a point, and none has vertices
  /// between its ends.
  [[nodiscard]] bool is_cell(std::size_t patch) const {
    const std::uint32_t* const at = &mesh_.corners[kPatchCorners * patch];
    return mesh_.nu[patch] == 1 && mesh_.nv[patch] == 1 &&
           mesh_.triangles[patch + 1] - mesh_.triangles[patch] == 2 && at[0] != at[1] &&
           at[0] != at[2] && at[0] != at[3] && at[1] != at[2] && at[1] != at[3] && at[2] != at[3];
  }
  Index* write_cell(std::size_t patch, bool turned, Index* to) const {
    CellCorners corners;
    std::copy_n(&mesh_.corners[kPatchCorners * patch], kPatchCorners, corners.at);
    put_halves(corners, CellZones(mesh_, patch).falling(0, 0),
               [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                 to[0] = static_cast<Index>(a);
                 to[1] = static_cast<Index>(turned ? c : b);
                 to[2] = static_cast<Index>(turned ? b : c);
                 to += 3;
               });
    return to;
  }
  template <bool kTurned>
  Index* write_regular(std::size_t patch, Index* to) {
    RowPatterns<Index>& patterns = patterns_[kTurned ? 1 : 0];
    // Asked a mesh: some patches of others are plain as well, but which ones is hard to predict.
    if (!mesh_.has_unions) {
      return PlainPatch<Index, kTurned>(mesh_, patch, sides_, patterns).write(stream_, to);
    }
    return RegularPatch<Index, kTurned>(mesh_, patch, sides_, patterns).write(stream_, to);
  }
  Index* write_any(std::size_t patch, bool turned) {
    boundary_.move_to(patch);
    TriangleSink<Index> sink(stream_, turned);
    CellCutter(mesh_, boundary_, patch).cut(sink);
    return sink.end();
  }

  const MeshData& mesh_;
  LinearSides sides_;
  RowPatterns<Index> patterns_[2]{RowPatterns<Index>(false), RowPatterns<Index>(true)};
  PatchBoundary boundary_;
  IndexStream<Index> stream_;
};

} // namespace simdbezier::detail
