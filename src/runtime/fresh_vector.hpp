// Vectors of values that threads fill.
#pragma once

#include <memory>
#include <new>
#include <vector>

namespace simdbezier::detail {

/// Leaves the values that resize() adds as the memory has them. The system hands out pages when
/// they are first touched, which takes as long as to fill them: so the threads that fill a vector
/// share this as well.
template <typename T>
struct FreshAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = FreshAllocator<U>;
  };

  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
};

template <typename T>
using FreshVector = std::vector<T, FreshAllocator<T>>;

} // namespace simdbezier::detail
