#include "src/runtime/cache_sizes.hpp"

#include <algorithm>
#include <initializer_list>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace simdbezier::detail {

namespace {

struct CacheSizes {
  std::size_t first = std::size_t{32} << 10;
  std::size_t second = std::size_t{512} << 10;
  std::size_t last = std::size_t{8} << 20;

  CacheSizes() noexcept {
#if defined(__x86_64__)
    read_totals();
    // The C library adds up all caches of a machine; these leaves describe one (Intel, AMD).
    // Virtual machines may leave them empty.
    for (const unsigned leaf : {0x4U, 0x8000001dU}) {
      read(leaf);
    }
#endif
  }

#if defined(__x86_64__)
  /// What processors of AMD said before they had leaves for single caches: the sizes of a core's
  /// caches, and of all third-level ones together. Of these a core reaches 8 to 96 MiB, mostly
  /// kShare.
  void read_totals() noexcept {
    constexpr std::size_t kShare = std::size_t{32} << 20;
    unsigned a = 0;
    unsigned b = 0;
    unsigned c = 0;
    unsigned d = 0;
    if (__get_cpuid(0x80000005U, &a, &b, &c, &d) != 0 && c >> 24U != 0) {
      first = static_cast<std::size_t>(c >> 24U) << 10U;
    }
    if (__get_cpuid(0x80000006U, &a, &b, &c, &d) != 0) {
      if (c >> 16U != 0) {
        second = static_cast<std::size_t>(c >> 16U) << 10U;
      }
      if (d >> 18U != 0) {
        last = std::min(static_cast<std::size_t>(d >> 18U) << 19U, kShare);
      }
    }
  }
  void read(unsigned leaf) noexcept {
    for (unsigned index = 0; index < 8; ++index) {
      unsigned a = 0;
      unsigned b = 0;
      unsigned c = 0;
      unsigned d = 0;
      if (__get_cpuid_count(leaf, index, &a, &b, &c, &d) == 0 || (a & 0x1fU) == 0) {
        return;
      }
      const std::size_t bytes =
          ((b >> 22U) + 1UL) * (((b >> 12U) & 0x3ffU) + 1UL) * ((b & 0xfffU) + 1UL) * (c + 1UL);
      const unsigned level = (a >> 5U) & 7U;
      constexpr unsigned kData = 1;
      if (level == 1 && (a & 0x1fU) == kData) {
        first = bytes;
      }
      if (level == 2) {
        second = bytes;
      }
      if (level >= 2) {
        last = bytes;
      }
    }
  }
#endif
};

const CacheSizes& cache_sizes() noexcept {
  static const CacheSizes sizes;
  return sizes;
}

} // namespace

std::size_t last_level_cache() noexcept { return cache_sizes().last; }
bool exceeds_caches(std::size_t bytes) noexcept { return bytes > last_level_cache() / 2; }
std::size_t first_level_cache() noexcept { return cache_sizes().first; }
std::size_t second_level_cache() noexcept { return cache_sizes().second; }

} // namespace simdbezier::detail
