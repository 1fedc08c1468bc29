// Memory whose blocks begin where cache lines do.
#pragma once

#include <new>

namespace simdbezier::detail {

/// Frees what operator new gave for an alignment of 64.
struct FreeAligned {
  void operator()(void* memory) const noexcept { ::operator delete (memory, std::align_val_t{64}); }
};

} // namespace simdbezier::detail
