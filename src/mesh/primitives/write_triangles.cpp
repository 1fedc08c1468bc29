#include <simdbezier/mesh_layout.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

#include "src/choice/measured_call.hpp"
#include "src/mesh/primitives/plain_patch.hpp"
#include "src/mesh/primitives/primitive_call.hpp"
#include "src/mesh/primitives/primitive_sinks.hpp"
#include "src/mesh/primitives/regular_patch.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// One thread's triangles, patch after patch: usual ones by PlainPatch and RegularPatch, all others
/// by CellCutter.
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

/// Whether numbers go past the caches.
bool streams_to(Destination destination, std::size_t bytes) noexcept {
  return resolve_destination(destination, bytes) != Destination::cache;
}

/// Threads share triangles, not patches, whose rates may differ much.
template <typename Index>
Status write_all_triangles(const MeshData& mesh, const KernelTable<float>& table,
                           const SetRange& range, Index* to, int threads, bool streaming) noexcept {
  const auto first = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(range.first);
  const auto last = first + static_cast<std::ptrdiff_t>(range.count);
  const std::size_t before = *first;
  const std::size_t triangles = *last - before;
  std::atomic<bool> failed = false;
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    try {
      const auto patch_of = [&](std::size_t triangle) {
        return static_cast<std::size_t>(std::lower_bound(first, last, before + triangle) -
                                        mesh.triangles.begin());
      };
      const std::size_t patch = patch_of(begin);
      std::make_unique<TriangleWriter<Index>>(mesh, table,
                                              to + 3 * (mesh.triangles[patch] - before), streaming)
          ->write(patch, patch_of(end));
    } catch (const std::bad_alloc&) {
      failed = true;
    }
  };
  divide_work(triangles, 3, threads, body);
  return failed ? Status::out_of_memory : Status::ok;
}

} // namespace
} // namespace detail

template <typename Index>
Status write_triangles(const MeshLayout& layout, std::span<Index> triangles, const Options& options,
                       SetRange patches) noexcept {
  if (!detail::has_range(layout.data(), patches)) {
    return Status::bad_patch_range;
  }
  const std::size_t before = layout.first_triangle(patches.first);
  const std::size_t needed = 3 * (layout.first_triangle(patches.first + patches.count) - before);
  const Status status = detail::check_indices<Index>(layout, triangles, needed);
  if (status != Status::ok || needed == 0) {
    return status;
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(options.isa, isa); !runs) {
    return runs;
  }
  const bool streaming = detail::streams_to(options.destination, needed * sizeof(Index));
  const Status written =
      detail::write_all_triangles(*layout.data(), detail::kernel_table<float>(isa), patches,
                                  triangles.data(), options.threads, streaming);
  if (written) {
    detail::note_executed(isa);
  }
  return written;
}

template SIMDBEZIER_API Status write_triangles(const MeshLayout&, std::span<std::uint32_t>,
                                               const Options&, SetRange) noexcept;
template SIMDBEZIER_API Status write_triangles(const MeshLayout&, std::span<std::uint16_t>,
                                               const Options&, SetRange) noexcept;

} // namespace simdbezier
