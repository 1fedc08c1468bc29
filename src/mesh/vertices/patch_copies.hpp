// Copies of bicubic patches side by side, since kernels take consecutive ones.
#pragma once

#include <cstddef>
#include <cstring>

#include "src/runtime/batch.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

/// One thread's copies, numbered from 0 on. The memory begins on a line of the cache.
template <typename T>
class PatchCopies {
public:
  [[nodiscard]] static std::size_t bytes(std::size_t most) noexcept {
    return whole_lines(most * kValues * sizeof(T)) + most * kCoefficients * sizeof(double);
  }
  PatchCopies(std::size_t most, unsigned char* memory) noexcept
      : coefficients_(reinterpret_cast<T*>(memory)), edges_(coefficients_ + most * kCoefficients),
        floors_(edges_ + most * kEdgeBlock),
        given_(memory + whole_lines(most * kValues * sizeof(T))) {}

  /// Makes a copy of patch `from` of a bucket without origins. normals: with what normals that need
  /// a second look are decided by.
  void put(const PatchStorage<T>& bucket, std::size_t from, std::size_t copy,
           bool normals) noexcept {
    copy_lines(bucket.coefficients + from * kCoefficients, kCoefficients * sizeof(T),
               coefficients_ + copy * kCoefficients);
    copy_lines(bucket.edges + from * kEdgeBlock, kEdgeBlock * sizeof(T),
               edges_ + copy * kEdgeBlock);
    if (normals) {
      const std::size_t bytes = kCoefficients * bucket.given.value_bytes();
      copy_lines(bucket.given.net(from * kCoefficients).values, bytes, given_ + copy * bytes);
      floors_[copy] = bucket.normal_floor[from];
    }
  }
  /// The copies from one on, all of them of this bucket.
  [[nodiscard]] PatchArrays<T> arrays(const PatchStorage<T>& bucket,
                                      std::size_t first) const noexcept {
    PatchArrays<T> arrays = bucket.arrays(0);
    arrays.coefficients = coefficients_ + first * kCoefficients;
    arrays.edges = edges_ + first * kEdgeBlock;
    arrays.given.values = given_;
    arrays.given = arrays.given.from(first * kCoefficients);
    arrays.normal_floor = floors_ + first;
    return arrays;
  }

private:
  /// Copies a multiple of 64 bytes. Of copies whose length it knows g++ makes an instruction for
  /// strings, which takes longer to start than these lines to be copied. Lines of the patches that
  /// the next block has are asked for, since members of groups come in no order.
  static void copy_lines(const void* from, std::size_t bytes, void* to) noexcept {
    const auto* const source = static_cast<const unsigned char*>(from);
    auto* const target = static_cast<unsigned char*>(to);
    for (std::size_t at = 0; at < bytes; at += 64) {
      __builtin_prefetch(source + kAhead * bytes + at, 0, 2);
      std::memcpy(target + at, source + at, 64);
    }
  }

  static constexpr std::size_t kAhead = 64; ///< patches: a block
  static constexpr std::size_t kValues = kCoefficients + kEdgeBlock + 1;

  T* coefficients_;
  T* edges_;
  T* floors_;
  unsigned char* given_;
};

} // namespace simdbezier::detail
