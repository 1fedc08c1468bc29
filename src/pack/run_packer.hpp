// Packing of patches of one shape, and what is known of a set when all are packed.
#pragma once

#include <algorithm>
#include <limits>

#include "src/pack/pack_request.hpp"
#include "src/pack/set_layout.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/net_faults.hpp"

namespace simdbezier::detail {

/// Nets of one shape on their way to consecutive places of a bucket, whichever kernel packs them.
template <typename T, typename S>
class RunPacker {
public:
  /// Nets, run and storage have to outlive it.
  RunPacker(const ControlNets<S>& nets, const PackRun& run, const PackOptions& options,
            const KernelTable<T>& table, const PatchStorage<T>& storage)
      : nets_(nets), run_(run), options_(options), table_(table), storage_(storage),
        bytes_(storage.count * storage.bytes_of_patch(storage.origins != nullptr)),
        streaming_(exceeds_caches(bytes_)) {}

  /// Packs patches [begin, end) of the run up to the first fault.
  [[nodiscard]] Report pack(std::size_t begin, std::size_t end) const {
    const Report report = pack_and_inspect(
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
    const PackTask<T, S> task{
        nets_,
        shape,
        {shift[0], shift[1], shift[2]},
        storage_.coefficients + run_.place * shape.coefficients(),
        storage_.edges + run_.place * shape.edges(),
        writable_points<S>(storage_.given) + run_.place * shape.control_values(),
        storage_.origins == nullptr ? nullptr : storage_.origins + run_.place * shape.origins(),
        storage_.normal_floor + run_.place * shape.floors(),
        streaming_,
        bytes_ > second_level_cache()};
    return shape.is_bicubic() && !table_.compact
               ? packing_kernel<S>(table_)(task, begin, end)
               : packing_kernel<S>(*table_.shapes)(task, begin, end);
  }

  const ControlNets<S>& nets_;
  const PackRun& run_;
  const PackOptions& options_;
  const KernelTable<T>& table_;
  const PatchStorage<T>& storage_;
  std::size_t bytes_; ///< of the set's patches of this shape
  bool streaming_;    ///< the set would not stay in the caches
};

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

/// Finds the common floors of a set whose patches are all packed.
template <typename T>
void find_common_floors(SetStorage<T>& storage) noexcept {
  const DefaultFpEnvironment environment; // for denormal floors
  for (PatchStorage<T>& bucket : storage.buckets) {
    bucket.common_floor = common_floor(bucket.normal_floor, bucket.count * bucket.shape.floors());
  }
}

} // namespace simdbezier::detail
