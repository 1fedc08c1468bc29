// See cache_sizes.hpp.
#include "src/runtime/cache_sizes.hpp"

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
    // The C library adds up all caches of a machine; these leaves describe one (Intel, AMD).
    for (const unsigned leaf : {0x4U, 0x8000001dU}) {
      read(leaf);
    }
#endif
  }

#if defined(__x86_64__)
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
