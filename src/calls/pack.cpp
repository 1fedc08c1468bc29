// Packing: threads and kernels; src/calls/set_layout.cpp has arguments and memory,
// src/storage/net_faults.hpp what is wrong with a patch, and the arithmetic is in
// pack/bicubic_pack_kernel.hpp and pack/shape_pack_kernel.hpp.
#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include <simdbezier/patch_set.hpp>

#include "src/calls/pack_request.hpp"
#include "src/calls/set_layout.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/net_faults.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Nets of one shape on their way to consecutive places of a bucket, whichever kernel packs them.
template <typename T, typename S>
class RunPacker {
public:
  RunPacker(const ControlNets<S>& nets, const PackRun& run, const PackOptions& options,
            const KernelTable<T>& table, const PatchStorage<T>& storage)
      : nets_(nets), run_(run), options_(options), table_(table), storage_(storage),
        streaming_(
            exceeds_caches(storage.count * storage.bytes_of_patch(storage.origins != nullptr))) {}

  /// Packs patches [begin, end) of the run up to the first fault.
  [[nodiscard]] PackReport pack(std::size_t begin, std::size_t end) const {
    const PackReport report = pack_and_inspect(
        begin, end, [&](std::size_t first, std::size_t last) { return call_kernel(first, last); },
        [&](std::size_t patch) {
          return inspect(nets_, patch, storage_, run_.place + patch, run_.number + patch);
        });
    if (streaming_) {
      table_.fence();
    }
    return report;
  }

private:
  [[nodiscard]] PackDoubt call_kernel(std::size_t begin, std::size_t end) const {
    const NetShape& shape = storage_.shape;
    const double* const shift = options_.relative_to;
    T* const coefficients = storage_.coefficients + run_.place * shape.coefficients();
    T* const edges = storage_.edges + run_.place * shape.edges();
    S* const points = writable_points<S>(storage_.given) + run_.place * shape.control_values();
    T* const origins =
        storage_.origins == nullptr ? nullptr : storage_.origins + run_.place * shape.origins();
    T* const floor = storage_.normal_floor + run_.place * shape.floors();
    const PackArrays<T, S> arrays{
        {shift[0], shift[1], shift[2]}, coefficients, edges, points, origins, floor};
    if (shape.is_bicubic() && !table_.compact) {
      const PackTask<T, S> task{arrays,           nets_.points,       nets_.patch_stride,
                                nets_.row_stride, nets_.point_stride, nets_.component_stride,
                                streaming_};
      return packing_kernel<S>(table_)(task, begin, end);
    }
    const NetPackTask<T, S> task{arrays, nets_, shape};
    return packing_kernel<S>(*table_.shapes)(task, begin, end);
  }

  const ControlNets<S>& nets_;
  const PackRun& run_;
  const PackOptions& options_;
  const KernelTable<T>& table_;
  const PatchStorage<T>& storage_;
  bool streaming_; ///< the set would not stay in the caches
};

/// Packs all patches; reports the fault of the lowest patch, whichever thread finds it.
template <typename T, typename S>
PackReport pack_runs(std::span<const ControlNets<S>> nets, std::span<const PackRun> runs,
                     const PackOptions& options, Isa isa, const SetStorage<T>& storage) {
  const KernelTable<T>& table = kernel_table<T>(isa);
  std::size_t groups = 0;
  for (const PackRun& run : runs) {
    groups += lane_groups(run.count);
  }
  LowestFault fault;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    std::size_t before = 0; // groups of the runs that came before
    PackReport report;
    for (const PackRun& run : runs) {
      const std::size_t own = lane_groups(run.count);
      const std::size_t from = std::max(begin, before) - before;
      const std::size_t to = std::min(end, before + own) - std::min(end, before);
      if (report && from < to) {
        const RunPacker<T, S> packer(nets[run.entry], run, options, table,
                                     storage.buckets[run.bucket]);
        report = packer.pack(from * kMaxLanes, std::min(to * kMaxLanes, run.count));
      }
      before += own;
    }
    fault.add(report);
  };
  divide_work(groups, 50 * kMaxLanes, options.threads, body);
  return fault.report();
}

/// The highest of `count` normal floors; infinity where the lowest is so much lower that most
/// normals of its patch would not pass. Lane by lane, so that none waits for the one before.
template <typename T>
T common_floor(const T* floors, std::size_t count) {
  constexpr T kRange = 256; // sizes of patches that differ by a factor of up to four
  T highest[kMaxLanes] = {};
  T lowest[kMaxLanes];
  std::fill_n(lowest, kMaxLanes, std::numeric_limits<T>::infinity());
  const auto take = [&](T floor, std::size_t lane) {
    highest[lane] = floor > highest[lane] ? floor : highest[lane];
    lowest[lane] = floor < lowest[lane] ? floor : lowest[lane];
  };
  const std::size_t whole = count - count % kMaxLanes;
  for (std::size_t k = 0; k < whole; k += kMaxLanes) {
    for (std::size_t lane = 0; lane < kMaxLanes; ++lane) {
      take(floors[k + lane], lane);
    }
  }
  for (std::size_t k = whole; k < count; ++k) {
    take(floors[k], 0);
  }
  const T most = *std::max_element(highest, highest + kMaxLanes);
  const T least = *std::min_element(lowest, lowest + kMaxLanes);
  return most / kRange <= least ? most : std::numeric_limits<T>::infinity();
}

} // namespace
} // namespace detail

template <typename T>
std::size_t PatchSet<T>::size() const noexcept {
  return storage_ == nullptr ? 0 : storage_->count;
}

template <typename T>
int PatchSet<T>::components() const noexcept {
  return empty() ? 3 : storage_->buckets[0].shape.components;
}

template <typename T>
PatchShape PatchSet<T>::shape(std::size_t patch) const noexcept {
  if (patch >= size()) {
    return {0, 0, 0, false};
  }
  const detail::NetShape& shape = storage_->buckets[storage_->place(patch).bucket].shape;
  return {shape.degree_u, shape.degree_v, shape.components, shape.rational};
}

template <typename T>
bool PatchSet<T>::has_local_origins() const noexcept {
  return storage_ != nullptr && storage_->buckets[0].origins != nullptr;
}

template <typename T, typename S>
PackReport pack(std::span<const ControlNets<S>> nets, PatchSet<T>& set,
                const PackOptions& options) noexcept try {
  PackReport report = detail::check_packable(nets);
  if (!report) {
    return report;
  }
  Isa isa = Isa::automatic;
  report = detail::resolve_packing(options, nets.empty() ? 3 : nets.front().components, isa);
  if (!report) {
    return report;
  }
  auto storage = std::make_shared<detail::SetStorage<T>>();
  std::vector<detail::PackRun> runs;
  const Status laid_out = detail::lay_out(nets, options, *storage, runs);
  if (laid_out != Status::ok) {
    return {laid_out};
  }
  report = detail::pack_runs<T, S>(nets, runs, options, isa, *storage);
  if (report) {
    const detail::DefaultFpEnvironment environment; // for denormal floors
    for (detail::PatchStorage<T>& bucket : storage->buckets) {
      if (bucket.shape.is_bicubic()) {
        bucket.common_floor = detail::common_floor(bucket.normal_floor, bucket.count);
      }
    }
    set = PatchSet<T>(std::move(storage));
  }
  return report;
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template <typename T, typename S>
PackReport pack(const ControlNets<S>& nets, PatchSet<T>& set, const PackOptions& options) noexcept {
  return pack(std::span<const ControlNets<S>>(&nets, 1), set, options);
}

template class PatchSet<float>;
template class PatchSet<double>;
#define SIMDBEZIER_INSTANTIATE_PACK(T, S)                                                          \
  template SIMDBEZIER_API PackReport pack(std::span<const ControlNets<S>>, PatchSet<T>&,           \
                                          const PackOptions&) noexcept;                            \
  template SIMDBEZIER_API PackReport pack(const ControlNets<S>&, PatchSet<T>&,                     \
                                          const PackOptions&) noexcept;
SIMDBEZIER_INSTANTIATE_PACK(float, float)
SIMDBEZIER_INSTANTIATE_PACK(float, double)
SIMDBEZIER_INSTANTIATE_PACK(double, float)
SIMDBEZIER_INSTANTIATE_PACK(double, double)
#undef SIMDBEZIER_INSTANTIATE_PACK

} // namespace simdbezier
