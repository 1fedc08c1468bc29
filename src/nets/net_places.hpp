// The places in memory that views of nets occupy, and whether they are all different.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

#include "src/output/memory_range.hpp"

namespace simdbezier::detail {

/// The places of a view: address + sum of index * stride, in bytes.
struct Lattice {
  struct Direction {
    std::ptrdiff_t stride;
    std::ptrdiff_t last; ///< highest index
  };
  std::uintptr_t begin = 0; ///< where all indices are 0
  Direction direction[4] = {};
  MemoryRange range; ///< from the lowest place to the highest one
};

/// The places of the values of nets whose degrees and components are sound; false where an offset
/// overflows.
template <typename S>
bool lattice_of(const ControlNets<S>& nets, Lattice& lattice) noexcept;

/// Whether all places are within the memory given; a null span stands for unknown memory.
template <typename S>
bool lies_in(const Lattice& lattice, std::size_t count, std::span<const S> memory) noexcept {
  return count == 0 || (memory.data() == nullptr && memory.empty()) ||
         MemoryRange(memory).contains(lattice.range);
}

/// Whether nets of any degrees can be read: ok | bad_components | null_input | bad_stride |
/// size_overflow | input_too_small. Nets of one row need no stride of rows.
template <typename S>
Status check_places(const ControlNets<S>& nets) noexcept;

/// Whether every stride exceeds what the smaller ones span, so that no two values share a place.
bool nests(Lattice lattice, std::ptrdiff_t value_bytes) noexcept;

/// Whether two views have a place in common. Exact where their strides are equal, as far as both
/// have more than one element there; otherwise views that lie between one another count as well.
bool collide(const Lattice& a, const Lattice& b, std::ptrdiff_t value_bytes) noexcept;

} // namespace simdbezier::detail
