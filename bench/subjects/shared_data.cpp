#include "bench/subjects/shared_data.hpp"

#include <cstdlib>
#include <cstring>
#include <map>
#include <tuple>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace simdbezier_bench {
namespace {

// Room for one patch more than kMemoryBytes holds, and for the gaps between planes.
constexpr std::size_t kBufferBytes = kMemoryBytes + (std::size_t{2} << 20);
constexpr std::size_t kHugePage = std::size_t{2} << 20;

template <typename T>
std::vector<T>& nets_at_least(std::size_t count) {
  static std::vector<T> nets;
  if (nets.size() < count * kValuesPerPatch) {
    nets = {}; // frees hundreds of megabytes before the larger one is made
    nets = random_nets<T>(count);
  }
  return nets;
}

} // namespace

HugeMemory::HugeMemory(std::size_t bytes) {
  const std::size_t pages = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  memory_.reset(static_cast<unsigned char*>(std::aligned_alloc(kHugePage, pages)));
  if (memory_ != nullptr) {
#if defined(__linux__)
    madvise(memory_.get(), pages, MADV_HUGEPAGE);
#endif
    std::memset(memory_.get(), 0, pages);
  }
}

unsigned char* output_buffer() {
  static const HugeMemory buffer(kBufferBytes);
  return buffer.get();
}

template <typename T>
const T* shared_nets(std::size_t count) {
  return nets_at_least<T>(count).data();
}

template <typename T>
const T* shared_power_basis(std::size_t count) {
  static std::vector<T> coefficients;
  if (coefficients.size() < count * kValuesPerPatch) {
    coefficients = {};
    coefficients = power_basis(nets_at_least<T>(count));
  }
  return coefficients.data();
}

template <typename T>
const simdbezier::PatchSet<T>& shared_patch_set(std::size_t count) {
  // Small sets are exactly as large as was asked for. Otherwise rows that follow a large set would
  // time what the library does for sets that leave the caches.
  constexpr std::size_t kSmall = 4096;
  static simdbezier::PatchSet<T> sets[2];
  simdbezier::PatchSet<T>& set = sets[count > kSmall ? 1 : 0];
  if (count > kSmall ? set.size() < count : set.size() != count) {
    set = {};
    simdbezier::ControlNets<T> nets;
    nets.points = shared_nets<T>(count);
    nets.count = count;
    (void)simdbezier::pack(nets, set); // on failure the set stays empty, which the row reports
  }
  return set;
}

template <typename T>
const ShapedPatches<T>& shaped_patches(std::size_t count, BatchShape shape) {
  static std::map<std::tuple<int, int, bool>, ShapedPatches<T>> kept;
  ShapedPatches<T>& patches = kept[{shape.degree_u, shape.degree_v, shape.rational}];
  if (patches.set.size() < count) {
    patches.nets = random_nets<T>(count, shape);
    (void)simdbezier::pack(simdbezier::ControlNets<T>::packed(patches.nets.data(), count,
                                                              shape.degree_u, shape.degree_v, 3,
                                                              weights_of(shape)),
                           patches.set);
  }
  return patches;
}

template const ShapedPatches<float>& shaped_patches<float>(std::size_t, BatchShape);
template const ShapedPatches<double>& shaped_patches<double>(std::size_t, BatchShape);
template const float* shared_nets<float>(std::size_t);
template const double* shared_nets<double>(std::size_t);
template const float* shared_power_basis<float>(std::size_t);
template const double* shared_power_basis<double>(std::size_t);
template const simdbezier::PatchSet<float>& shared_patch_set<float>(std::size_t);
template const simdbezier::PatchSet<double>& shared_patch_set<double>(std::size_t);

} // namespace simdbezier_bench
