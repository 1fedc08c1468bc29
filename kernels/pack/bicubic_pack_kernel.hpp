// Turns control points into centred coefficients, edge cubics and corners: a group of patches at a
// time, one patch a lane.
//
// Input and output are turned in registers. In between, a group's control points lie in memory as
// [point][component][lane], since three components of them are more than the registers hold.
#pragma once

#include <type_traits>

#include "kernels/pack/pack_formulas.hpp"
#include "kernels/pack/zero_signs.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

inline constexpr detail::NetShape kBicubic;
inline constexpr std::size_t kNet = detail::kCoefficients; ///< values of a net, [j][i][component]

/// What coefficients are formed in: wide enough that only the rounding to T counts.
template <typename T, typename S>
using CarriedIn =
    std::conditional_t<std::is_same_v<T, float> && std::is_same_v<S, float>, Wide, DoubleDouble>;

/// A sum of squares up to which no coefficient can overflow: they are at most 64 max|P|.
template <typename T>
inline constexpr double kSafeSquares = sizeof(T) == sizeof(float) ? 0x1p236 : 0x1p1000;

/// Reads a whole group at `from`. Returns the sum of squares, which only says where to look again,
/// so that it may round differently from one instruction set to the other.
template <typename T, typename S, bool kMoved, typename Lanes>
SIMDBEZIER_INLINE Wide read_group(const detail::PackTask<T, S>& task, const S* from,
                                  std::ptrdiff_t stride, Lanes& lanes) {
  using W = CarriedIn<T, S>;
  Wide squares(0.0);
  // Values go by threes, blocks by eights: in between, nothing is divided at run time.
  for (std::size_t first = 0; first < kNet; first += detail::kComponents * kTransposed) {
#pragma GCC unroll 3
    for (std::size_t block = 0; block < detail::kComponents; ++block) {
      Wide values[kTransposed];
      load_transposed(from + first + block * kTransposed, stride, values);
      for (std::size_t i = 0; i < kTransposed; ++i) {
        const std::size_t c = (block * kTransposed + i) % detail::kComponents;
        const std::size_t k =
            first / detail::kComponents + (block * kTransposed + i) / detail::kComponents;
        if constexpr (kMoved) {
          const W moved = difference_of<W>(values[i], Wide(task.relative_to[c]));
          lanes.net[c][k] = moved;
          values[i] = to_wide(moved);
          lanes.points[c][k] = values[i];
        } else {
          lanes.net[c][k] = values[i];
        }
        squares = madd(values[i], values[i], squares);
      }
    }
  }
  return squares;
}

/// Where the arrays of a group begin.
template <typename T, typename S>
struct PackedPlaces {
  T* coefficients;
  T* edges;
  S* control_points;
  T* origins; ///< or null
  T* normal_floor;
  bool streams; ///< whole lines go past the caches
};

/// Stores 16 values of each patch, from registers that may carry more than doubles.
template <typename W, typename T>
SIMDBEZIER_INLINE void store_block(const W values[16], T* to, std::size_t stride, bool streams) {
  Wide out[16];
  for (std::size_t k = 0; k < 16; ++k) {
    out[k] = to_wide(values[k]);
  }
  store_transposed_16(out, to, static_cast<std::ptrdiff_t>(stride), streams);
}

/// Takes the origins from component c of a group, and stores them.
template <typename T, typename W>
SIMDBEZIER_INLINE void split_origins(PackedComponent<W>& formed, std::size_t c, T* to) {
  Wide origins[detail::kOriginsPerComponent];
  for (Wide& origin : origins) {
    origin = Wide(0.0);
  }
  origins[0] = take_origin<T>(formed.matrix[0]);
  for (std::size_t e = 0; e < detail::kEdges; ++e) {
    origins[detail::kEdgeOriginsAt + e] = take_origin<T>(formed.edges[e]);
  }
  store_transposed(origins, to + c * detail::kOriginsPerComponent,
                   static_cast<std::ptrdiff_t>(detail::kOriginBlock));
}

/// Keeps the control points as given, with +0 for -0.
template <typename S>
SIMDBEZIER_INLINE void keep_points(const S* from, std::ptrdiff_t stride, S* to, bool streams) {
  for (std::size_t p = 0; p < kWideLanes; ++p) {
    for (std::size_t e = 0; e < kNet; e += kLanes<vec<S>>) {
      const vec<S> values = load_vector<vec<S>>(from + static_cast<std::ptrdiff_t>(p) * stride + e);
      store_line<vec<S>>(to + p * kNet + e, values + vec<S>(S(0)), streams);
    }
  }
}

/// Packs kWideLanes nets, the first at `from`, each packed, `stride` elements apart. Returns false
/// where a coefficient may have become infinite or nan.
template <typename T, typename S, bool kMoved>
bool pack_group(const detail::PackTask<T, S>& task, const S* from, std::ptrdiff_t stride,
                const PackedPlaces<T, S>& to) {
  using W = CarriedIn<T, S>;
  using In = std::conditional_t<kMoved, W, Wide>;
  // The normal floor takes doubles, which points that move may not be.
  struct MovedLanes {
    In net[detail::kComponents][16];
    Wide points[detail::kComponents][16];
  };
  struct PlainLanes {
    In net[detail::kComponents][16];
  };
  std::conditional_t<kMoved, MovedLanes, PlainLanes> lanes;
  const Wide squares = read_group<T, S, kMoved>(task, from, stride, lanes);
  NormalFloor<T> normal_floor;
  TinyEvenCoefficients<T> tiny;
  Wide corners[16];
  for (std::size_t c = 0; c < detail::kComponents; ++c) {
    PackedComponent<W> formed;
    form_component<W>(lanes.net[c], formed);
    if (to.origins != nullptr) {
      split_origins(formed, c, to.origins);
    }
    tiny.look_at_edges(kBicubic, formed.edges);
    store_block(formed.matrix, to.coefficients + 16 * c, kNet, to.streams);
    store_block(formed.edges, to.edges + 16 * c, detail::kEdgeBlock, to.streams);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      corners[4 * c + corner] = to_wide(lanes.net[c][corner / 2 * 12 + corner % 2 * 3]);
    }
    if constexpr (kMoved) {
      normal_floor.add(lanes.points[c]);
    } else {
      normal_floor.add(lanes.net[c]);
    }
  }
  for (std::size_t k = 12; k < 16; ++k) {
    corners[k] = Wide(0.0);
  }
  store_block(corners, to.edges + detail::kCornersAt, detail::kEdgeBlock, to.streams);
  if (tiny.any()) [[unlikely]] {
    keep_edges_from_zero(kBicubic, to.edges, kWideLanes);
  }
  alignas(64) double floors[kWideLanes];
  store_vector<Wide>(floors, normal_floor.value());
  for (std::size_t p = 0; p < kWideLanes; ++p) {
    to.normal_floor[p] = static_cast<T>(floors[p]);
  }
  keep_points(from, stride, to.control_points, to.streams);
  return all_of<Wide>(squares <= Wide(kSafeSquares<T>));
}

/// Copies nets of any layout, `count` of them, to kWideLanes packed ones; the last is repeated.
template <typename T, typename S>
void gather_nets(const detail::PackTask<T, S>& task, std::size_t first, std::size_t count,
                 S* packed) {
  for (std::size_t p = 0; p < kWideLanes; ++p) {
    const auto patch = static_cast<std::ptrdiff_t>(first + (p < count ? p : count - 1));
    const S* const net = task.points + patch * task.patch_stride;
    for (int k = 0; k < 16; ++k) {
      const S* const point = net + k / 4 * task.row_stride + k % 4 * task.point_stride;
      for (int c = 0; c < 3; ++c) {
        packed[c] = point[c * task.component_stride];
      }
      packed += 3;
    }
  }
}

template <typename T>
void copy_values(const T* from, std::size_t count, T* to) {
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = from[i];
  }
}

/// Packs the last, incomplete group of a range: it is computed whole, and copied in part.
template <typename T, typename S, bool kMoved>
bool pack_rest(const detail::PackTask<T, S>& task, const S* packed, std::size_t count,
               const PackedPlaces<T, S>& to) {
  alignas(64) T coefficients[kWideLanes * kNet];
  alignas(64) T edges[kWideLanes * detail::kEdgeBlock];
  alignas(64) S control_points[kWideLanes * kNet];
  alignas(64) T origins[kWideLanes * detail::kOriginBlock];
  T floors[kWideLanes];
  const PackedPlaces<T, S> scratch{coefficients,   edges,
                                   control_points, to.origins == nullptr ? nullptr : origins,
                                   floors,         false};
  const bool safe = pack_group<T, S, kMoved>(task, packed, kNet, scratch);
  copy_values(coefficients, count * kNet, to.coefficients);
  copy_values(edges, count * detail::kEdgeBlock, to.edges);
  copy_values(control_points, count * kNet, to.control_points);
  if (to.origins != nullptr) {
    copy_values(origins, count * detail::kOriginBlock, to.origins);
  }
  copy_values(floors, count, to.normal_floor);
  return safe;
}

template <typename T, typename S, bool kMoved>
detail::PackDoubt pack_range(const detail::PackTask<T, S>& task, std::size_t begin,
                             std::size_t end) {
  const bool triples =
      task.row_stride == 12 && task.point_stride == 3 && task.component_stride == 1;
  alignas(64) S packed[kWideLanes * kNet];
  for (std::size_t at = begin; at < end; at += kWideLanes) {
    const std::size_t count = end - at < kWideLanes ? end - at : kWideLanes;
    const PackedPlaces<T, S> to{task.coefficients + at * kNet,
                                task.edges + at * detail::kEdgeBlock,
                                task.control_points + at * kNet,
                                task.origins == nullptr ? nullptr
                                                        : task.origins + at * detail::kOriginBlock,
                                task.normal_floor + at,
                                task.streaming};
    const S* from = task.points + static_cast<std::ptrdiff_t>(at) * task.patch_stride;
    std::ptrdiff_t stride = task.patch_stride;
    if (!triples || count < kWideLanes) {
      gather_nets(task, at, count, packed);
      from = packed;
      stride = kNet;
    }
    const bool safe = count < kWideLanes ? pack_rest<T, S, kMoved>(task, from, count, to)
                                         : pack_group<T, S, kMoved>(task, from, stride, to);
    if (!safe) {
      return {at, at + count};
    }
  }
  return {end, end};
}

/// Packs patches [begin, end) up to the first group that may hold a fault; see PackDoubt.
template <typename T, typename S>
detail::PackDoubt pack_kernel(const detail::PackTask<T, S>& task, std::size_t begin,
                              std::size_t end) {
  if constexpr (std::is_same_v<T, S>) {
    if (task.relative_to[0] == 0 && task.relative_to[1] == 0 && task.relative_to[2] == 0) {
      return pack_range<T, S, false>(task, begin, end);
    }
  }
  return pack_range<T, S, true>(task, begin, end);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
