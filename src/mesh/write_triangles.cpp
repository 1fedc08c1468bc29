// See mesh_layout.hpp.
#include <atomic>
#include <limits>
#include <new>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/cells.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {

template <typename Index>
Status write_triangles(const MeshLayout& layout, std::span<Index> triangles, int threads) noexcept {
  const detail::MeshData* const mesh = layout.data();
  const MeshSize size = layout.size();
  if (size.triangles == 0) {
    return Status::ok;
  }
  if (triangles.data() == nullptr) {
    return Status::null_output;
  }
  if (size.vertices > std::numeric_limits<Index>::max()) {
    return Status::size_overflow;
  }
  if (triangles.size() / 3 < size.triangles) {
    return Status::output_too_small;
  }
  std::atomic<bool> failed = false;
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    try {
      detail::PatchBoundary boundary(*mesh);
      for (std::size_t patch = begin; patch < end; ++patch) {
        boundary.move_to(patch);
        const bool turned = layout.data()->topology.is_turned(patch);
        detail::TriangleWriter<Index> writer(&triangles[3 * mesh->triangles[patch]], turned);
        detail::CellCutter<Index>(*mesh, boundary, patch).write(writer);
      }
    } catch (const std::bad_alloc&) {
      failed = true;
    }
  };
  const std::size_t patches = mesh->nu.size();
  detail::for_blocks(patches, detail::thread_count(threads, patches), detail::BlockBody(body));
  return failed ? Status::out_of_memory : Status::ok;
}

template SIMDBEZIER_API Status write_triangles(const MeshLayout&, std::span<std::uint32_t>,
                                               int) noexcept;
template SIMDBEZIER_API Status write_triangles(const MeshLayout&, std::span<std::uint16_t>,
                                               int) noexcept;

} // namespace simdbezier
