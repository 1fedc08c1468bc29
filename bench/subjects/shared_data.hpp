// What rows share: inputs that are made once and kept, and the one output buffer.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/subjects/patches.hpp"

namespace simdbezier_bench {

constexpr std::size_t kCacheBytes = std::size_t{256} << 10;
constexpr std::size_t kMemoryBytes = std::size_t{256} << 20;
constexpr std::size_t kLineBytes = 64;

/// Memory in huge pages where the system has them, all of which have been touched. Rows that are
/// compared with each other, and with the limits, write to such memory: small pages would cost some
/// of them a third of their speed.
class HugeMemory {
public:
  HugeMemory() = default;
  explicit HugeMemory(std::size_t bytes);

  /// Returns null where the memory cannot be had.
  [[nodiscard]] unsigned char* get() const { return memory_.get(); }

private:
  struct Free {
    void operator()(unsigned char* memory) const { std::free(memory); }
  };
  std::unique_ptr<unsigned char, Free> memory_;
};

/// The output buffer: somewhat more than kMemoryBytes, in huge pages where the system has them, all
/// of which have been touched. Null where the memory cannot be had.
unsigned char* output_buffer();

/// The first `count` or more patches, in each of the three forms. Grows on demand; a larger count
/// keeps the earlier patches as they are. An empty result means that packing failed. Small packed
/// sets have exactly as many patches as were asked for last.
template <typename T>
const T* shared_nets(std::size_t count);
template <typename T>
const T* shared_power_basis(std::size_t count);
template <typename T>
const simdbezier::PatchSet<T>& shared_patch_set(std::size_t count);

/// What the library calls the weights of a shape's points.
constexpr simdbezier::Weights weights_of(BatchShape shape) {
  return shape.rational ? simdbezier::Weights::cartesian : simdbezier::Weights::none;
}

/// The first `count` or more patches of any shape, which are kept for each shape. They are meant
/// for rows of few patches.
template <typename T>
struct ShapedPatches {
  std::vector<T> nets;
  simdbezier::PatchSet<T> set; ///< empty where packing failed
};
template <typename T>
const ShapedPatches<T>& shaped_patches(std::size_t count, BatchShape shape);

} // namespace simdbezier_bench
