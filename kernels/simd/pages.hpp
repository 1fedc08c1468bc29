// Pages of memory that are written soon, and past the caches.
//
// A store that is the first one to a page waits until the processor has found where the page lies,
// and so do all stores behind it. In a virtual machine that takes a tenth of a microsecond or more
// once tables of pages have left the caches, which is what a page of streaming stores takes.
// Nothing looks ahead for stores that go past the caches; a line that is asked for in time does.
#pragma once

#include <cstdint>

#include "kernels/simd/operands.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The smallest page of all processors that we know.
constexpr std::size_t kPage = 4096;

/// Returns the place a page behind `to`.
template <typename T>
SIMDBEZIER_INLINE std::uintptr_t page_behind(const T* to) {
  return reinterpret_cast<std::uintptr_t>(to) + kPage;
}

/// Asks for the pages that begin within `bytes` bytes from `to` on, which need not be memory. One
/// line of each is read for that.
SIMDBEZIER_INLINE void ask_for_pages(std::uintptr_t to, std::size_t bytes) {
  const std::uintptr_t end = to + bytes;
  for (std::uintptr_t page = (to + kPage - 1) / kPage * kPage; page < end; page += kPage) {
    prefetch_line(reinterpret_cast<const void*>(page));
  }
}

/// Streams of values that are written in steps of kStep ask where this holds: about once in as many
/// values as fill a page, counted from the stream's first value.
template <typename T, std::size_t kStep>
constexpr bool is_turn_to_ask(std::size_t at) {
  return at % (kPage / sizeof(T)) < kStep;
}
/// Asks for the pages behind `to`, as far as the next turn: that may come a step later than a page,
/// since kStep need not divide it.
template <std::size_t kStep, typename T>
SIMDBEZIER_INLINE void ask_until_next_turn(const T* to) {
  ask_for_pages(page_behind(to), kPage + kStep * sizeof(T));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
