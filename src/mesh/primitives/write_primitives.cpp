// See mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <atomic>
#include <limits>
#include <new>
#include <vector>

#include "src/calls/call.hpp"
#include "src/mesh/primitives/cluster_sink.hpp"
#include "src/mesh/primitives/primitive_call.hpp"
#include "src/mesh/primitives/primitive_sinks.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Calls visit(patch, cutter, turned) for some patches, in parallel.
template <typename Visit>
Status for_cells(const MeshLayout& layout, const PatchRange& patches, int threads,
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

/// The running sums of patches' sizes, count(patch, cutter, turned): sizes[k] is what stands before
/// the k-th, the last one all.
template <typename Size, typename Count>
Status sum_sizes(const MeshLayout& layout, const PatchRange& patches, int threads,
                 std::vector<Size>& sizes, const Count& count) {
  sizes.assign(patches.count + 1, Size{});
  const Status status = for_cells(layout, patches, threads,
                                  [&](std::size_t patch, const CellCutter& cells, bool turned) {
                                    sizes[patch - patches.first + 1] = count(patch, cells, turned);
                                  });
  for (std::size_t k = 1; k < sizes.size(); ++k) {
    add(sizes[k - 1], sizes[k]);
  }
  return status;
}

Status polygon_sizes(const MeshLayout& layout, const PatchRange& patches, int threads,
                     std::vector<PolygonSize>& sizes) {
  return sum_sizes(layout, patches, threads, sizes, [](auto, const CellCutter& cells, bool turned) {
    PolygonSink<std::uint32_t> sink(nullptr, nullptr, turned);
    cells.cut(sink);
    return PolygonSize{sink.polygons(), sink.indices()};
  });
}

Status strip_sizes(const MeshLayout& layout, const PatchRange& patches, int threads,
                   std::vector<std::size_t>& sizes) {
  return sum_sizes(layout, patches, threads, sizes, [](auto, const CellCutter& cells, bool turned) {
    StripSink<std::uint32_t> sink(nullptr, turned);
    cells.cut(sink);
    sink.end_strip();
    return sink.indices();
  });
}

constexpr std::uint32_t kClusterWidth = 8;

Status cluster_sizes(const MeshLayout& layout, const PatchRange& patches, int threads,
                     std::vector<ClusterSize>& sizes) {
  return sum_sizes(layout, patches, threads, sizes,
                   [](std::size_t patch, const CellCutter& cells, bool turned) {
                     ClusterSink sink(nullptr, {}, static_cast<std::uint32_t>(patch), turned);
                     cells.cut_in_bands(kClusterWidth, sink);
                     sink.end_cluster();
                     return sink.size();
                   });
}

/// use(range, sizes) with what sizes_of() counts in some patches, unless these are refused.
template <typename Size, typename Use>
Status with_sizes(const MeshLayout& layout, SetRange patches, int threads,
                  Status (*sizes_of)(const MeshLayout&, const PatchRange&, int, std::vector<Size>&),
                  const Use& use) noexcept {
  try {
    PatchRange range;
    if (!range.resolve(layout, patches)) {
      return Status::bad_patch_range;
    }
    std::vector<Size> sizes;
    const Status status = sizes_of(layout, range, threads, sizes);
    return status ? use(range, sizes) : status;
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory;
  }
}

/// Hands the size of all of them to the caller.
template <typename Size>
auto total_to(Size& size) {
  return [&size](const PatchRange&, const std::vector<Size>& sizes) {
    size = sizes.back();
    return Status(Status::ok);
  };
}

} // namespace
} // namespace detail

Status polygon_size(const MeshLayout& layout, PolygonSize& size, const RunOptions& options,
                    SetRange patches) noexcept {
  return detail::with_sizes(layout, patches, options.threads, detail::polygon_sizes,
                            detail::total_to(size));
}

template <typename Index>
Status write_polygons(const MeshLayout& layout, std::span<Index> indices,
                      std::span<std::uint8_t> sizes, const RunOptions& options,
                      SetRange patches) noexcept {
  const auto write = [&](const detail::PatchRange& range, const std::vector<PolygonSize>& before) {
    Status status = detail::check_indices<Index>(layout, indices, before.back().indices);
    if (status && sizes.size() < before.back().polygons) {
      status = sizes.data() == nullptr ? Status::null_output : Status::output_too_small;
    }
    if (!status || before.back().polygons == 0) {
      return status;
    }
    return detail::for_cells(layout, range, options.threads,
                             [&](std::size_t patch, const detail::CellCutter& cells, bool turned) {
                               const PolygonSize& place = before[patch - range.first];
                               detail::PolygonSink<Index> sink(indices.data() + place.indices,
                                                               sizes.data() + place.polygons,
                                                               turned);
                               cells.cut(sink);
                             });
  };
  return detail::with_sizes(layout, patches, options.threads, detail::polygon_sizes, write);
}

Status strip_size(const MeshLayout& layout, std::size_t& indices, const RunOptions& options,
                  SetRange patches) noexcept {
  return detail::with_sizes(layout, patches, options.threads, detail::strip_sizes,
                            detail::total_to(indices));
}

template <typename Index>
Status write_strips(const MeshLayout& layout, std::span<Index> indices, const RunOptions& options,
                    SetRange patches) noexcept {
  const auto write = [&](const detail::PatchRange& range, const std::vector<std::size_t>& before) {
    const Status status = detail::check_indices<Index>(layout, indices, before.back());
    if (!status || before.back() == 0) {
      return status;
    }
    return detail::for_cells(layout, range, options.threads,
                             [&](std::size_t patch, const detail::CellCutter& cells, bool turned) {
                               detail::StripSink<Index> sink(
                                   indices.data() + before[patch - range.first], turned);
                               cells.cut(sink);
                               sink.end_strip();
                             });
  };
  return detail::with_sizes(layout, patches, options.threads, detail::strip_sizes, write);
}

Status cluster_size(const MeshLayout& layout, ClusterSize& size, const RunOptions& options,
                    SetRange patches) noexcept {
  return detail::with_sizes(layout, patches, options.threads, detail::cluster_sizes,
                            detail::total_to(size));
}

Status write_clusters(const MeshLayout& layout, const ClusterOutputs& out,
                      const RunOptions& options, SetRange patches) noexcept {
  const auto write = [&](const detail::PatchRange& range,
                         const std::vector<ClusterSize>& before) -> Status {
    const ClusterSize& all = before.back();
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
    if (all.vertices > std::numeric_limits<std::uint32_t>::max() ||
        all.triangles > std::numeric_limits<std::uint32_t>::max()) {
      return Status::size_overflow;
    }
    return detail::for_cells(layout, range, options.threads,
                             [&](std::size_t patch, const detail::CellCutter& cells, bool turned) {
                               detail::ClusterSink sink(&out, before[patch - range.first],
                                                        static_cast<std::uint32_t>(patch), turned);
                               cells.cut_in_bands(detail::kClusterWidth, sink);
                               sink.end_cluster();
                             });
  };
  return detail::with_sizes(layout, patches, options.threads, detail::cluster_sizes, write);
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
