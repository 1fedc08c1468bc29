// Vectors of many numbers, in pages that the system clears faster than small ones.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace simdbezier::tools {

/// Asks for large pages where there are enough numbers to fill them: filling small ones for the
/// first time takes a third of the time for reading a file.
template <typename T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() noexcept = default;
  template <typename U>
  LargePageAllocator(const LargePageAllocator<U>&) noexcept {} // NOLINT: a conversion

  [[nodiscard]] T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) {
      throw std::bad_array_new_length();
    }
    const std::size_t bytes = count * sizeof(T);
    const bool large = bytes >= kLeast;
    void* const memory =
        large ? std::aligned_alloc(kPage, (bytes + kPage - 1) / kPage * kPage) : std::malloc(bytes);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
#ifdef MADV_HUGEPAGE
    if (large) {
      static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE)); // a wish only
    }
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }

  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) noexcept {
    return true;
  }

private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
  static constexpr std::size_t kLeast = 2 * kPage;
};

template <typename T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

} // namespace simdbezier::tools
