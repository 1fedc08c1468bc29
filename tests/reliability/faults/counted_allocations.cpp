#include "tests/reliability/faults/counted_allocations.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<int> g_left{-1};
std::atomic<bool> g_one_fails{false};
std::atomic<long> g_live{0};

constexpr std::size_t kAlignment = alignof(std::max_align_t);

void* allocate_or_null(std::size_t bytes, std::size_t alignment) noexcept {
  if (g_left == 0) {
    g_left = g_one_fails ? -1 : 0;
    return nullptr;
  }
  if (g_left > 0) {
    --g_left;
  }
  const std::size_t rounded = (bytes / alignment + 1) * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded);
  g_live += memory != nullptr ? 1 : 0;
  return memory;
}

void* allocate(std::size_t bytes, std::size_t alignment) {
  void* const memory = allocate_or_null(bytes, alignment);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void release(void* memory) {
  g_live -= memory != nullptr ? 1 : 0;
  std::free(memory);
}

} // namespace

namespace simdbezier::tests {

void allow_allocations(int number, bool one_fails) {
  g_left = number;
  g_one_fails = one_fails;
}
long live_allocations() { return g_live; }

} // namespace simdbezier::tests

// All forms: the standard library's own ones would call the first of them, but not a sanitizer's.
void* operator new(std::size_t bytes) { return allocate(bytes, kAlignment); }
void* operator new[](std::size_t bytes) { return allocate(bytes, kAlignment); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return allocate_or_null(bytes, kAlignment);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return allocate_or_null(bytes, kAlignment);
}
void* operator new(std::size_t bytes, std::align_val_t alignment,
                   const std::nothrow_t& /*tag*/) noexcept {
  return allocate_or_null(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment,
                     const std::nothrow_t& /*tag*/) noexcept {
  return allocate_or_null(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { release(memory); }
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t /*bytes*/,
                       std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
