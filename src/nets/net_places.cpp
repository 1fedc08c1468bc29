#include "src/nets/net_places.hpp"

#include <algorithm>
#include <limits>

#include "src/runtime/both_types.hpp"
#include "src/runtime/sort.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {
namespace {

std::ptrdiff_t size_of(std::ptrdiff_t stride) noexcept { return stride < 0 ? -stride : stride; }

void sort_by_stride(Lattice::Direction (&direction)[4]) noexcept {
  sort_range(direction, direction + 4,
             [](const Lattice::Direction& a, const Lattice::Direction& b) {
               return size_of(a.stride) < size_of(b.stride);
             });
}

/// Whether distance = sum of k * stride with -low[d] <= k <= high[d] has a solution, directions
/// [0, count) ascending by stride. Few values of each k are in question where strides nest.
bool reaches(const Lattice::Direction* stride_and_low, const std::ptrdiff_t* high,
             std::ptrdiff_t distance, int count) noexcept {
  if (count == 0) {
    return distance == 0;
  }
  const Lattice::Direction& top = stride_and_low[count - 1];
  std::ptrdiff_t rest = 0;
  for (int d = 0; d + 1 < count; ++d) {
    rest += size_of(stride_and_low[d].stride) * std::max(stride_and_low[d].last, high[d]);
  }
  if (top.stride == 0 || (top.last == 0 && high[count - 1] == 0)) {
    return reaches(stride_and_low, high, distance, count - 1);
  }
  const std::ptrdiff_t middle = distance / top.stride;
  const std::ptrdiff_t around = rest / size_of(top.stride) + 1;
  const std::ptrdiff_t first = std::max(middle - around, -top.last);
  const std::ptrdiff_t last = std::min(middle + around, high[count - 1]);
  for (std::ptrdiff_t k = first; k <= last; ++k) {
    if (reaches(stride_and_low, high, distance - k * top.stride, count - 1)) {
      return true;
    }
  }
  return false;
}

} // namespace

template <typename S>
bool lattice_of(const ControlNets<S>& nets, Lattice& lattice) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / 256;
  if (nets.count > kMost) {
    return false;
  }
  const std::ptrdiff_t strides[4] = {nets.patch_stride, nets.row_stride, nets.point_stride,
                                     nets.component_stride};
  const std::ptrdiff_t last[4] = {static_cast<std::ptrdiff_t>(nets.count) - 1, nets.degree_v,
                                  nets.degree_u,
                                  static_cast<std::ptrdiff_t>(shape_of(nets).channels()) - 1};
  lattice.begin = reinterpret_cast<std::uintptr_t>(nets.points);
  std::ptrdiff_t lowest = 0;
  std::ptrdiff_t highest = sizeof(S);
  for (int k = 0; k < 4; ++k) {
    Lattice::Direction& direction = lattice.direction[k];
    direction.last = std::max<std::ptrdiff_t>(last[k], 0);
    std::ptrdiff_t reach = 0;
    const std::ptrdiff_t stride = direction.last == 0 ? 0 : strides[k]; // or not taken at all
    if (__builtin_mul_overflow(stride, static_cast<std::ptrdiff_t>(sizeof(S)), &direction.stride) ||
        __builtin_mul_overflow(direction.stride, direction.last, &reach) ||
        __builtin_add_overflow(reach < 0 ? lowest : highest, reach,
                               reach < 0 ? &lowest : &highest)) {
      return false;
    }
  }
  // Room for what reaches() adds up of two of them: six such numbers, if a range has two.
  constexpr std::ptrdiff_t kMostSpan = std::numeric_limits<std::ptrdiff_t>::max() / 8;
  lattice.range = {nets.points, lowest, highest};
  return lowest > -kMostSpan && highest < kMostSpan;
}

template <typename S>
Status check_places(const ControlNets<S>& nets) noexcept {
  if (nets.components < 1 || nets.components > kMostComponents ||
      nets.weights > Weights::homogeneous) {
    return Status::bad_components;
  }
  if (nets.points == nullptr && nets.count > 0) {
    return Status::null_input;
  }
  const bool single = nets.components == 1 && nets.weights == Weights::none;
  if ((nets.row_stride == 0 && nets.degree_v > 0) || nets.point_stride == 0 ||
      (nets.component_stride == 0 && !single)) {
    return Status::bad_stride;
  }
  Lattice lattice;
  if (!lattice_of(nets, lattice)) {
    return Status::size_overflow;
  }
  return lies_in(lattice, nets.count, nets.memory) ? Status::ok : Status::input_too_small;
}

bool nests(Lattice lattice, std::ptrdiff_t value_bytes) noexcept {
  sort_by_stride(lattice.direction);
  std::ptrdiff_t span = value_bytes;
  for (const Lattice::Direction& direction : lattice.direction) {
    if (direction.last > 0) {
      if (size_of(direction.stride) < span) {
        return false;
      }
      span += size_of(direction.stride) * direction.last;
    }
  }
  return true;
}

bool collide(const Lattice& a, const Lattice& b, std::ptrdiff_t value_bytes) noexcept {
  if (!a.range.meets(b.range)) {
    return false;
  }
  const auto distance = static_cast<std::ptrdiff_t>(b.begin - a.begin);
  if (distance % value_bytes != 0) {
    return true;
  }
  // a + i s = b + j s where i - j runs from -b.last to a.last: only if both step alike.
  std::size_t order[4] = {0, 1, 2, 3};
  sort_range(order, order + 4, [&a](std::size_t p, std::size_t q) {
    return size_of(a.direction[p].stride) < size_of(a.direction[q].stride);
  });
  Lattice::Direction low[4];
  std::ptrdiff_t high[4];
  for (std::size_t k = 0; k < 4; ++k) {
    const Lattice::Direction& mine = a.direction[order[k]];
    const Lattice::Direction& other = b.direction[order[k]];
    if (mine.stride != other.stride && mine.last > 0 && other.last > 0) {
      return true;
    }
    low[k] = {mine.last > 0 ? mine.stride : other.stride, other.last};
    high[k] = mine.last;
  }
  return reaches(low, high, distance, 4);
}

SIMDBEZIER_OF_BOTH_TYPES(lattice_of);
SIMDBEZIER_OF_BOTH_TYPES(check_places);

} // namespace simdbezier::detail
