// The formulas of one curve, over V = one register of its samples or a single one.
//
// The order of operations is that of a patch's edges (bicubic.hpp, poly/series.hpp):
// row_series(), h * (1 / w), the origin added last, ends replaced.
#pragma once

#include "kernels/poly/series.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::CurveShape;

/// Makes the degree a constant for the compiler, unless kKnownOrder is 0.
template <std::size_t kKnownOrder>
SIMDBEZIER_INLINE void assume_order(CurveShape& shape) {
  if constexpr (kKnownOrder > 0) {
    shape.degree = static_cast<int>(kKnownOrder) - 1;
  }
}

/// A register of parameters: in which cell they are, where in there, and which are its ends.
/// kHalves: curves may have two cells.
template <typename V, bool kHalves>
struct CurvePoints {
  using T = ScalarOf<V>;
  V x;     ///< half-centred, of the whole curve
  V local; ///< and of the cell
  MaskOf<V> low;
  bool halves; ///< there are two cells
  bool any_low;
  bool mixed; ///< some are in either cell
  EndSelector<V> ends;

  SIMDBEZIER_INLINE CurvePoints(V half_centred, const CurveShape& shape)
      : x(half_centred), local(in_cell(half_centred, shape)),
        low(half_centred < broadcast<V>(T(0))), halves(kHalves && shape.cells() == 2),
        any_low(!halves || any_of<V>(low)), mixed(halves && any_low && !all_of<V>(low)),
        ends(local == broadcast<V>(T(-0.5)), local == broadcast<V>(T(0.5))) {}

private:
  static SIMDBEZIER_INLINE V in_cell(V x, const CurveShape& shape) {
    return kHalves && shape.cells() == 2 ? cell_parameter(x) : x;
  }
};

/// The packed values of one channel of a curve. kMixed: lanes are in different halves.
template <typename V, bool kMixed>
class CurveChannel {
  using T = ScalarOf<V>;

public:
  /// values are those of the channel in the first cell.
  template <bool kHalves>
  SIMDBEZIER_INLINE CurveChannel(const CurveShape& shape, const T* values,
                                 const CurvePoints<V, kHalves>& at)
      : low_(values + (kMixed || at.any_low ? 0 : shape.cell_values())),
        high_(low_ + (kMixed ? shape.cell_values() : 0)), x_(at.local), in_low_(at.low),
        ends_(at.ends) {}

  template <std::size_t kDepth, typename N>
  SIMDBEZIER_INLINE Series<V> series(N order) const {
    return row_series<kDepth>(order, x_,
                              [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return chosen(k); });
  }

  /// Makes a position of what the polynomials gave.
  SIMDBEZIER_INLINE V finished(const CurveShape& shape, V value) const {
    if (shape.origins) {
      value = value + chosen(shape.origin_at());
    }
    return with_ends(value, shape.ends_at());
  }

private:
  /// Gives each lane value k of its own cell; both cells' are loaded only where lanes are mixed.
  SIMDBEZIER_INLINE V chosen(std::size_t k) const {
    if constexpr (!kMixed) {
      return broadcast<V>(low_[k]);
    } else {
      return select_where<V>(in_low_, broadcast<V>(low_[k]), broadcast<V>(high_[k]));
    }
  }
  SIMDBEZIER_INLINE V with_ends(V value, std::size_t k) const {
    if constexpr (!kMixed) {
      return ends_.replace(value, low_ + k);
    } else {
      return select_where<V>(in_low_, ends_.replace(value, low_ + k),
                             ends_.replace(value, high_ + k));
    }
  }

  const T* low_;
  const T* high_;
  const V& x_;
  const MaskOf<V>& in_low_;
  const EndSelector<V>& ends_;
};

/// Up to three components of a register of samples have their positions in here, with derivatives
/// by t.
template <typename V>
struct CurveJet {
  V position[3];
  V d1[3];
  V d2[3];
};

/// Calls body.template operator()<kMixed>(). Positions of lanes that are all in one half take half
/// the loads; with derivatives (kDepth > 0), all curves of two cells count as mixed, so that kMixed
/// says as well how derivatives are scaled.
template <std::size_t kDepth, typename V, bool kHalves, typename Body>
SIMDBEZIER_INLINE void by_cells(const CurvePoints<V, kHalves>& points, Body body) {
  if constexpr (kHalves) {
    if (kDepth == 0 ? points.mixed : points.halves) {
      return body.template operator()<true>();
    }
  }
  body.template operator()<false>();
}

/// These two turn derivatives by the parameter of a cell into those by t. Nothing rounds here.
template <bool kMixed, typename V>
SIMDBEZIER_INLINE V scaled_first(V d1) {
  return kMixed ? d1 + d1 : d1;
}
template <bool kMixed, typename V>
SIMDBEZIER_INLINE V scaled_second(V d2) {
  return scaled_first<kMixed>(scaled_first<kMixed>(d2));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
