#include <simdbezier/mesh_layout.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <new>
#include <vector>

#include "src/calls/call.hpp"
#include "src/mesh/primitives/primitive_call.hpp"
#include "src/mesh/primitives/primitive_sinks.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Calls visit(patch, cutter, turned) for some patches, in parallel.
template <typename Visit>
Status for_cells(const MeshLayout& layout, const SetRange& patches, int threads,
                 const Visit& visit) noexcept {
  if (patches.count == 0) {
    return Status::ok;
  }
  const MeshData& mesh = *layout.data();
  std::atomic<bool> failed = false;
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    try {
      PatchBoundary boundary(mesh);
      for (std::size_t patch = patches.first + begin; patch < patches.first + end; ++patch) {
        boundary.move_to(patch);
        visit(patch, CellCutter(mesh, boundary, patch), mesh.topology.is_turned(patch));
      }
    } catch (const std::bad_alloc&) {
      failed = true;
    }
  };
  divide_work(patches.count, 1000, threads, body);
  return failed ? Status::out_of_memory : Status::ok;
}

void add(const PolygonSize& before, PolygonSize& sum) {
  sum.polygons += before.polygons;
  sum.indices += before.indices;
}
void add(std::size_t before, std::size_t& sum) { sum += before; }
void add(const ClusterSize& before, ClusterSize& sum) {
  sum.clusters += before.clusters;
  sum.vertices += before.vertices;
  sum.triangles += before.triangles;
}

// What cells can become. sink() begins behind what the patches before have filled, and counts where
// there is no memory; kBand is the number of columns that are cut one below the other.
template <typename Index>
struct Polygons {
  using Size = PolygonSize;
  static constexpr std::uint32_t kBand = kMostSegments;
  Index* indices = nullptr;
  std::uint8_t* sizes = nullptr;

  [[nodiscard]] PolygonSink<Index> sink(const Size& before, std::size_t, bool turned) const {
    return {indices + before.indices, sizes + before.polygons, turned};
  }
};
template <typename Index>
struct Strips {
  using Size = std::size_t;
  static constexpr std::uint32_t kBand = kMostSegments;
  Index* indices = nullptr;

  [[nodiscard]] StripSink<Index> sink(Size before, std::size_t, bool turned) const {
    return {indices + before, turned};
  }
};
struct Clusters {
  using Size = ClusterSize;
  static constexpr std::uint32_t kBand = 8;
  const ClusterOutputs* out = nullptr;

  [[nodiscard]] ClusterSink sink(const Size& before, std::size_t patch, bool turned) const {
    return {out, before, static_cast<std::uint32_t>(patch), turned};
  }
};

/// Puts the cells of a patch behind those before; returns the size of all.
template <typename Kind>
typename Kind::Size put(const Kind& kind, const typename Kind::Size& before, std::size_t patch,
                        const CellCutter& cells, bool turned) {
  auto sink = kind.sink(before, patch, turned);
  cells.cut(Kind::kBand, sink);
  return sink.finish();
}

/// Counts what some patches become: sizes[k] is what stands before the k-th, the last one all.
template <typename Kind>
Status count(const MeshLayout& layout, SetRange& patches, int threads,
             std::vector<typename Kind::Size>& sizes) {
  if (!has_range(layout.data(), patches)) {
    return Status::bad_patch_range;
  }
  sizes.assign(patches.count + 1, {});
  const Status status = for_cells(
      layout, patches, threads, [&](std::size_t patch, const CellCutter& cells, bool turned) {
        sizes[patch - patches.first + 1] = put(Kind(), {}, patch, cells, turned);
      });
  for (std::size_t k = 1; k < sizes.size(); ++k) {
    add(sizes[k - 1], sizes[k]);
  }
  return status;
}

/// Hands the size of all to the caller.
template <typename Kind>
Status find_size(const MeshLayout& layout, SetRange patches, int threads,
                 typename Kind::Size& size) noexcept try {
  std::vector<typename Kind::Size> sizes;
  const Status status = count<Kind>(layout, patches, threads, sizes);
  size = status ? sizes.back() : size;
  return status;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

/// Writes them if check(size of all) says that there is room.
template <typename Kind, typename Check>
Status write(const MeshLayout& layout, SetRange patches, int threads, const Kind& kind,
             const Check& check) noexcept try {
  std::vector<typename Kind::Size> before;
  if (const Status status = count<Kind>(layout, patches, threads, before); !status) {
    return status;
  }
  if (const Status status = check(before.back()); !status) {
    return status;
  }
  return for_cells(layout, patches, threads,
                   [&](std::size_t patch, const CellCutter& cells, bool turned) {
                     put(kind, before[patch - patches.first], patch, cells, turned);
                   });
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

} // namespace
} // namespace detail

Status polygon_size(const MeshLayout& layout, PolygonSize& size, const RunOptions& options,
                    SetRange patches) noexcept {
  return detail::find_size<detail::Polygons<std::uint32_t>>(layout, patches, options.threads, size);
}

template <typename Index>
Status write_polygons(const MeshLayout& layout, std::span<Index> indices,
                      std::span<std::uint8_t> sizes, const RunOptions& options,
                      SetRange patches) noexcept {
  const detail::Polygons<Index> polygons{indices.data(), sizes.data()};
  return detail::write(layout, patches, options.threads, polygons, [&](const PolygonSize& all) {
    const Status status = detail::check_indices<Index>(layout, indices, all.indices);
    if (status && sizes.size() < all.polygons) {
      return Status(sizes.data() == nullptr ? Status::null_output : Status::output_too_small);
    }
    return status;
  });
}

Status strip_size(const MeshLayout& layout, std::size_t& indices, const RunOptions& options,
                  SetRange patches) noexcept {
  return detail::find_size<detail::Strips<std::uint32_t>>(layout, patches, options.threads,
                                                          indices);
}

template <typename Index>
Status write_strips(const MeshLayout& layout, std::span<Index> indices, const RunOptions& options,
                    SetRange patches) noexcept {
  return detail::write(
      layout, patches, options.threads, detail::Strips<Index>{indices.data()},
      [&](std::size_t all) { return detail::check_indices<Index>(layout, indices, all); });
}

Status cluster_size(const MeshLayout& layout, ClusterSize& size, const RunOptions& options,
                    SetRange patches) noexcept {
  return detail::find_size<detail::Clusters>(layout, patches, options.threads, size);
}

Status write_clusters(const MeshLayout& layout, const ClusterOutputs& out,
                      const RunOptions& options, SetRange patches) noexcept {
  const auto check = [&](const ClusterSize& all) {
    if (all.clusters == 0) {
      return Status::ok;
    }
    if (out.clusters.data() == nullptr || out.vertices.data() == nullptr ||
        out.corners.data() == nullptr) {
      return Status::null_output;
    }
    if (out.clusters.size() < all.clusters || out.vertices.size() < all.vertices ||
        out.corners.size() / 3 < all.triangles) {
      return Status::output_too_small;
    }
    constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
    return std::max(all.vertices, all.triangles) > kMost ? Status::size_overflow : Status::ok;
  };
  return detail::write(layout, patches, options.threads, detail::Clusters{&out}, check);
}

template SIMDBEZIER_API Status write_polygons(const MeshLayout&, std::span<std::uint32_t>,
                                              std::span<std::uint8_t>, const RunOptions&,
                                              SetRange) noexcept;
template SIMDBEZIER_API Status write_polygons(const MeshLayout&, std::span<std::uint16_t>,
                                              std::span<std::uint8_t>, const RunOptions&,
                                              SetRange) noexcept;
template SIMDBEZIER_API Status write_strips(const MeshLayout&, std::span<std::uint32_t>,
                                            const RunOptions&, SetRange) noexcept;
template SIMDBEZIER_API Status write_strips(const MeshLayout&, std::span<std::uint16_t>,
                                            const RunOptions&, SetRange) noexcept;

} // namespace simdbezier
