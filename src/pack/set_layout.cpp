#include "src/pack/set_layout.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "src/nets/net_call.hpp"
#include "src/pack/pack_request.hpp"
#include "src/runtime/both_types.hpp"

namespace simdbezier::detail {
namespace {

/// Random samples of a large set would otherwise wait for address translations as well. Small sets
/// do without, since a processor's tables cover them.
void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  constexpr std::size_t kWorthwhile = std::size_t{4} << 20;
  constexpr std::size_t kPage = 4096;
  if (bytes >= kWorthwhile) {
    const std::size_t skipped = -reinterpret_cast<std::uintptr_t>(memory) % kPage;
    // This is advice: the memory is good even if it fails, and errno remains the caller's.
    const int before = errno;
    (void)madvise(static_cast<unsigned char*>(memory) + skipped, (bytes - skipped) / kPage * kPage,
                  MADV_HUGEPAGE);
    errno = before;
  }
#endif
}

/// The memory of a used bucket, if it has room for what is needed, but not for twice as much.
template <typename T>
bool take_memory(PatchStorage<T>* used, std::size_t bytes, PatchStorage<T>& storage) {
  if (used == nullptr || used->memory_bytes < bytes || used->memory_bytes / 2 > bytes) {
    return false;
  }
  storage.memory = std::move(used->memory);
  storage.memory_bytes = std::exchange(used->memory_bytes, 0);
  return true;
}

/// One block for all arrays of a bucket: given points behind those that start with cache lines.
template <typename T>
Status allocate(bool origins, PatchStorage<T>* used, PatchStorage<T>& storage) {
  const NetShape& shape = storage.shape;
  const std::size_t given_bytes = shape.control_values() * storage.given.value_bytes();
  const std::size_t per_patch = storage.bytes_of_patch(origins);
  constexpr std::size_t kLimit = std::numeric_limits<std::ptrdiff_t>::max();
  const std::size_t count = storage.count;
  if (count > (kLimit - sizeof(T)) / per_patch) {
    return Status::size_overflow;
  }
  const std::size_t bytes = count * per_patch + sizeof(T); // behind floats, doubles may need a gap
  if (!take_memory(used, bytes, storage)) {
    storage.memory.reset(::operator new (bytes, std::align_val_t{64}, std::nothrow));
    storage.memory_bytes = bytes;
    if (storage.memory == nullptr) {
      return Status::out_of_memory;
    }
    prefer_large_pages(storage.memory.get(), bytes);
  }
  storage.coefficients = static_cast<T*>(storage.memory.get());
  storage.edges = storage.coefficients + count * shape.coefficients();
  T* const behind_edges = storage.edges + count * shape.edges();
  storage.given.values = behind_edges;
  storage.normal_floor = behind_edges + (count * given_bytes + sizeof(T) - 1) / sizeof(T);
  storage.origins = origins ? storage.normal_floor + count * shape.floors() : nullptr;
  return Status::ok;
}

/// The bucket of nets like these, made where there is none.
template <typename T, typename S>
std::size_t bucket_of(const ControlNets<S>& nets, const PackOptions& options,
                      SetStorage<T>& storage) {
  std::vector<PatchStorage<T>>& buckets = storage.buckets;
  const NetShape shape = shape_of(nets);
  const auto found = std::find_if(buckets.begin(), buckets.end(), [&](const auto& bucket) {
    return bucket.shape == shape && bucket.given.weights == nets.weights;
  });
  if (found != buckets.end()) {
    return static_cast<std::size_t>(found - buckets.begin());
  }
  buckets.emplace_back();
  buckets.back().shape = shape;
  buckets.back().given = given_form<S>(nets.weights, options);
  return buckets.size() - 1;
}

/// Leads from a patch's number to its place; a set of one shape does not need it.
template <typename T>
void place_patches(std::span<const PackRun> runs, SetStorage<T>& storage) {
  storage.places = std::make_unique<PatchPlace[]>(storage.count);
  for (const PackRun& run : runs) {
    for (std::size_t i = 0; i < run.count; ++i) {
      storage.places[run.number + i] = {static_cast<std::uint32_t>(run.bucket), run.place + i};
    }
  }
}

} // namespace

template <typename S>
Report check_packable(std::span<const ControlNets<S>> nets) noexcept {
  std::size_t patch = 0;
  if (is_missing(nets)) {
    return {Status::null_input, 0};
  }
  for (const ControlNets<S>& entry : nets) {
    Status status = check_input(entry);
    if (status == Status::ok && entry.components != nets.front().components) {
      status = Status::bad_components;
    }
    if (status == Status::ok && __builtin_add_overflow(patch, entry.count, &patch)) {
      status = Status::size_overflow;
    }
    if (status != Status::ok) {
      return {status, status == Status::size_overflow ? 0 : patch};
    }
  }
  return {};
}

template <typename T, typename S>
Status lay_out(std::span<const ControlNets<S>> nets, const PackOptions& options,
               SetStorage<T>* used, SetStorage<T>& storage, std::vector<PackRun>& runs) {
  for (std::size_t entry = 0; entry < nets.size(); ++entry) {
    const std::size_t count = nets[entry].count;
    if (count == 0) {
      continue;
    }
    const std::size_t index = bucket_of(nets[entry], options, storage);
    PatchStorage<T>& bucket = storage.buckets[index];
    runs.push_back({entry, index, bucket.count, storage.count, count});
    bucket.count += count;
    storage.count += count;
  }
  if (storage.buckets.empty()) { // a set without patches has one empty bucket
    bucket_of(nets.empty() ? ControlNets<S>{} : nets.front(), options, storage);
  }
  for (std::size_t k = 0; k < storage.buckets.size(); ++k) {
    PatchStorage<T>* const same =
        used == nullptr || k >= used->buckets.size() ? nullptr : &used->buckets[k];
    if (const Status status = allocate(options.local_origin, same, storage.buckets[k]); !status) {
      return status;
    }
  }
  if (storage.buckets.size() > 1) {
    place_patches<T>(runs, storage);
  }
  return Status::ok;
}

SIMDBEZIER_OF_BOTH_TYPES(check_packable);
#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template Status lay_out(std::span<const ControlNets<S>>, const PackOptions&, SetStorage<T>*,     \
                          SetStorage<T>&, std::vector<PackRun>&);
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier::detail
