// Turns control points into centred coefficients, edge cubics and corners: a group of patches at a
// time, one patch a lane.
//
// Input and output are turned in registers. In between, a group's control points lie in memory as
// [point][component][lane], since three components of them are more than the registers hold.
#pragma once

#include <type_traits>

#include "kernels/pack/pack_formulas.hpp"
#include "kernels/pack/pack_groups.hpp"
#include "kernels/pack/zero_signs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

inline constexpr detail::NetShape kBicubic;
inline constexpr std::size_t kNet = detail::kCoefficients; ///< values of a net, [j][i][component]

/// A sum of squares up to which no coefficient can overflow: they are at most 64 max|P|.
template <typename T>
inline constexpr double kSafeSquares = sizeof(T) == sizeof(float) ? 0x1p236 : 0x1p1000;

/// One group of nets while it is packed. kMoved: whether points may move, or have another type.
template <typename T, typename S, bool kMoved>
class BicubicGroup {
  using W = CarriedIn<T, S>;
  using In = std::conditional_t<kMoved, W, Wide>;

public:
  explicit BicubicGroup(const detail::PackTask<T, S>& task)
      : task_(task), triples_(task.nets.row_stride == 12 && task.nets.point_stride == 3 &&
                              task.nets.component_stride == 1) {}

  /// Packs `count` nets from the first on, 1 <= count <= kWideLanes. Returns false where a
  /// coefficient may have become infinite or nan.
  bool pack(std::size_t first, std::size_t count) {
    if (count < kWideLanes) {
      return pack_rest(first, count);
    }
    first_ = first;
    const S* from =
        task_.nets.points + static_cast<std::ptrdiff_t>(first) * task_.nets.patch_stride;
    std::ptrdiff_t stride = task_.nets.patch_stride;
    alignas(64) S packed[kWideLanes * kNet];
    if (!triples_) {
      gather(first, count, packed);
      from = packed;
      stride = kNet;
    }
    if (task_.far && !(task_.streaming && kLineWide<vec<T>>)) {
      ask_ahead(from, kNet);
      ask_ahead(task_.coefficients + first * kNet, kNet);
      ask_ahead(task_.edges + first * detail::kEdgeBlock, detail::kEdgeBlock);
      ask_ahead(task_.control_points + first * kNet, kNet);
    }
    Lanes lanes;
    const Wide squares = read(from, stride, lanes);
    form(lanes);
    keep_points(from, stride);
    return all_of<Wide>(squares <= Wide(kSafeSquares<T>));
  }

private:
  /// Control points, and as doubles for the normal floor, which points that move may not be.
  struct MovedLanes {
    In net[detail::kComponents][16];
    Wide points[detail::kComponents][16];
  };
  struct PlainLanes {
    In net[detail::kComponents][16];
  };
  using Lanes = std::conditional_t<kMoved, MovedLanes, PlainLanes>;

  /// Copies nets of any layout to kWideLanes packed ones; the last is repeated.
  void gather(std::size_t first, std::size_t count, S* packed) const {
    const ControlNets<S>& nets = task_.nets;
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      const std::size_t patch = first + (p < count ? p : count - 1);
      const S* const net = nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
      if (triples_) {
        __builtin_memcpy(packed, net, sizeof(S) * kNet);
        packed += kNet;
        continue;
      }
      for (std::ptrdiff_t k = 0; k < 16; ++k) {
        const S* const point = net + k / 4 * nets.row_stride + k % 4 * nets.point_stride;
        for (std::ptrdiff_t c = 0; c < 3; ++c) {
          *packed++ = point[c * nets.component_stride];
        }
      }
    }
  }

  /// Packs the last, incomplete group of a range: it is computed whole, and copied in part. Stores
  /// that ask how many lanes there are take two to six percent longer for doubles.
  bool pack_rest(std::size_t first, std::size_t count) const {
    alignas(64) S packed[kWideLanes * kNet];
    alignas(64) T coefficients[kWideLanes * kNet];
    alignas(64) T edges[kWideLanes * detail::kEdgeBlock];
    alignas(64) S control_points[kWideLanes * kNet];
    alignas(64) T origins[kWideLanes * detail::kOriginBlock];
    T floors[kWideLanes];
    gather(first, count, packed);
    detail::PackTask<T, S> whole = task_;
    whole.nets = ControlNets<S>::packed(packed, kWideLanes, 3, 3);
    whole.coefficients = coefficients;
    whole.edges = edges;
    whole.control_points = control_points;
    whole.origins = task_.origins == nullptr ? nullptr : origins;
    whole.normal_floor = floors;
    whole.streaming = false;
    whole.far = false;
    const bool safe = BicubicGroup(whole).pack(0, kWideLanes);
    put_rest(coefficients, kNet, first, count, task_.coefficients);
    put_rest(edges, detail::kEdgeBlock, first, count, task_.edges);
    put_rest(control_points, kNet, first, count, task_.control_points);
    put_rest(origins, task_.origins == nullptr ? 0 : detail::kOriginBlock, first, count,
             task_.origins);
    put_rest(floors, 1, first, count, task_.normal_floor);
    return safe;
  }
  /// Copies `values` values of each patch to the places of patches from the first on.
  template <typename Value>
  static void put_rest(const Value* from, std::size_t values, std::size_t first, std::size_t count,
                       Value* to) {
    for (std::size_t k = 0; k < count * values; ++k) {
      to[first * values + k] = from[k];
    }
  }

  /// Asks for the lines of patches two groups on, which loads and stores would wait for.
  template <typename Value>
  SIMDBEZIER_INLINE void ask_ahead(const Value* patch, std::size_t values) const {
    for (std::size_t k = 0; k < kWideLanes * values; k += 64 / sizeof(Value)) {
      __builtin_prefetch(patch + 2 * kWideLanes * values + k);
    }
  }

  /// Reads a whole group at `from`. Returns the sum of squares, which only says where to look
  /// again, so that it may round differently from one instruction set to the other.
  SIMDBEZIER_INLINE Wide read(const S* from, std::ptrdiff_t stride, Lanes& lanes) const {
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
            const W moved = difference_of<W>(values[i], Wide(task_.relative_to[c]));
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

  /// Forms and stores all but the control points.
  SIMDBEZIER_INLINE void form(const Lanes& lanes) const {
    T* const coefficients = task_.coefficients + first_ * kNet;
    T* const edges = task_.edges + first_ * detail::kEdgeBlock;
    NormalFloor<T, W> normal_floor;
    TinyEvenCoefficients<T> tiny;
    Wide corners[16];
    for (std::size_t c = 0; c < detail::kComponents; ++c) {
      PackedComponent<W> formed;
      form_component<W>(lanes.net[c], formed);
      if (task_.origins != nullptr) {
        split_origins(formed, c);
      }
      tiny.look_at_edges(kBicubic, formed.edges);
      store_block(formed.matrix, coefficients + 16 * c, kNet);
      store_block(formed.edges, edges + 16 * c, detail::kEdgeBlock);
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
    store_block(corners, edges + detail::kCornersAt, detail::kEdgeBlock);
    if (tiny.any()) [[unlikely]] {
      keep_edges_from_zero(kBicubic, edges, kWideLanes);
    }
    store_value(normal_floor.value(), task_.normal_floor + first_, 1, kWideLanes);
  }

  /// Stores 16 values of each patch, from registers that may carry more than doubles.
  template <typename Carried>
  SIMDBEZIER_INLINE void store_block(const Carried values[16], T* to, std::size_t stride) const {
    Wide out[16];
    for (std::size_t k = 0; k < 16; ++k) {
      out[k] = to_wide(values[k]);
    }
    store_transposed_16(out, to, static_cast<std::ptrdiff_t>(stride), task_.streaming);
  }

  /// Takes the origins from component c, and stores them.
  SIMDBEZIER_INLINE void split_origins(PackedComponent<W>& formed, std::size_t c) const {
    Wide origins[detail::kOriginsPerComponent];
    for (Wide& origin : origins) {
      origin = Wide(0.0);
    }
    origins[0] = take_origin<T>(formed.matrix[0]);
    for (std::size_t e = 0; e < detail::kEdges; ++e) {
      origins[detail::kEdgeOriginsAt + e] = take_origin<T>(formed.edges[e]);
    }
    store_transposed(
        origins, task_.origins + first_ * detail::kOriginBlock + c * detail::kOriginsPerComponent,
        static_cast<std::ptrdiff_t>(detail::kOriginBlock));
  }

  /// Keeps the control points as given, with +0 for -0.
  SIMDBEZIER_INLINE void keep_points(const S* from, std::ptrdiff_t stride) const {
    S* to = task_.control_points + first_ * kNet;
    for (std::size_t p = 0; p < kWideLanes; ++p, from += stride, to += kNet) {
      for (std::size_t e = 0; e < kNet; e += kLanes<vec<S>>) {
        store_line<vec<S>>(to + e, load_vector<vec<S>>(from + e) + vec<S>(S(0)), task_.streaming);
      }
    }
  }

  const detail::PackTask<T, S>& task_;
  bool triples_;
  std::size_t first_ = 0;
};

/// Packs patches [begin, end) up to the first group that may hold a fault; see PackDoubt.
template <typename T, typename S>
detail::PackDoubt pack_kernel(const detail::PackTask<T, S>& task, std::size_t begin,
                              std::size_t end) {
  if constexpr (std::is_same_v<T, S>) {
    if (task.relative_to[0] == 0 && task.relative_to[1] == 0 && task.relative_to[2] == 0) {
      return pack_groups<BicubicGroup<T, S, false>>(task, begin, end);
    }
  }
  return pack_groups<BicubicGroup<T, S, true>>(task, begin, end);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
