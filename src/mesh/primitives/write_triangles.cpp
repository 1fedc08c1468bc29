// See mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

#include "src/choice/measured_call.hpp"
#include "src/mesh/primitives/primitive_call.hpp"
#include "src/mesh/primitives/triangle_writer.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Whether numbers go past the caches.
bool streams_to(Destination destination, std::size_t bytes) noexcept {
  return resolve_destination(destination, bytes) != Destination::cache;
}

/// Threads share triangles, not patches, whose rates may differ much.
template <typename Index>
Status write_all_triangles(const MeshData& mesh, const KernelTable<float>& table,
                           const PatchRange& range, Index* to, int threads,
                           bool streaming) noexcept {
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
  detail::PatchRange range;
  if (!range.resolve(layout, patches)) {
    return Status::bad_patch_range;
  }
  const std::size_t before = layout.first_triangle(range.first);
  const std::size_t needed = 3 * (layout.first_triangle(range.first + range.count) - before);
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
      detail::write_all_triangles(*layout.data(), detail::kernel_table<float>(isa), range,
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
