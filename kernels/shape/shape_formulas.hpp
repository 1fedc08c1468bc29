// Formulas for patches of any degree, over V = one register of samples or one sample.
//
// The order of operations is that of bicubic.hpp: Horner's rule in X, then rows in Y, which take
// even and odd parts where poly/even_odd.hpp says so and Horner's rule elsewhere; derivatives by
// synthetic division. Where bicubic patches go through here, they get the same bits.
#pragma once

#include "kernels/poly/bicubic.hpp"
#include "kernels/simd/repeat.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A number of coefficients: fixed for the compiler, or (0) known at run time.
template <std::size_t kFixed>
struct Order {
  static constexpr std::size_t kMost = kFixed;
  explicit constexpr Order(std::size_t) {}
  SIMDBEZIER_INLINE constexpr std::size_t value() const { return kFixed; }
};
template <>
struct Order<0> {
  static constexpr std::size_t kMost = detail::kMostOrder;
  explicit constexpr Order(std::size_t order) : order_(order) {}
  SIMDBEZIER_INLINE constexpr std::size_t value() const { return order_; }

private:
  std::size_t order_;
};

/// repeat() for every coefficient, but a loop where the compiler does not know how many there are.
template <std::size_t kFixed, typename F>
SIMDBEZIER_INLINE void for_coefficients(Order<kFixed> order, const F& f) {
  if constexpr (kFixed != 0) {
    repeat<kFixed>(f);
  } else {
    for (std::size_t k = 0; k < order.value(); ++k) {
      f(k);
    }
  }
}

/// A polynomial's value, first and second derivative, the latter two as far as kDepth goes, while
/// Horner's rule runs through its coefficients: the last two, then one after the other.
template <typename V>
struct Series {
  V value;
  V first;
  V second; ///< half of it, until finish()

  template <std::size_t kDepth>
  SIMDBEZIER_INLINE void begin(V last, V before, V t) {
    value = madd(last, t, before);
    if constexpr (kDepth > 0) {
      first = last;
    }
  }
  template <std::size_t kDepth>
  SIMDBEZIER_INLINE void add_third(V c, V t) {
    if constexpr (kDepth > 1) {
      second = first;
    }
    if constexpr (kDepth > 0) {
      first = madd(first, t, value);
    }
    value = madd(value, t, c);
  }
  template <std::size_t kDepth>
  SIMDBEZIER_INLINE void add(V c, V t) {
    if constexpr (kDepth > 1) {
      second = madd(second, t, first);
    }
    if constexpr (kDepth > 0) {
      first = madd(first, t, value);
    }
    value = madd(value, t, c);
  }
  /// A derivative that does not depend on t is nan all the same where t is, or a coefficient:
  /// t - t is +0 elsewhere, which changes no constant, not even -0.
  template <std::size_t kDepth>
  SIMDBEZIER_INLINE void finish(std::size_t degree, V t) {
    if constexpr (kDepth > 0) {
      if (degree == 1) {
        first = first - (t - t);
      }
    }
    if constexpr (kDepth > 1) {
      if (degree == 1) {
        second = first - first;
      } else if (degree == 2) {
        second = (second + second) - (t - t);
      } else {
        second = second + second;
      }
    }
  }
};

/// sum_k c(k) t^k, and derivatives up to kDepth, for order >= 2: a column.
template <std::size_t kDepth, typename V, typename N, typename Coefficient>
SIMDBEZIER_INLINE void horner_into(N order, V t, const Coefficient& c, Series<V>& s) {
  const std::size_t degree = order.value() - 1;
  s.template begin<kDepth>(c(degree), c(degree - 1), t);
  if (degree > 1) {
    s.template add_third<kDepth>(c(degree - 2), t);
    for (std::size_t k = degree - 2; k-- > 0;) {
      s.template add<kDepth>(c(k), t);
    }
  }
  s.template finish<kDepth>(degree, t);
}
template <std::size_t kDepth, typename V, typename N, typename Coefficient>
SIMDBEZIER_INLINE Series<V> horner_series(N order, V t, const Coefficient& c) {
  Series<V> s;
  horner_into<kDepth>(order, t, c, s);
  return s;
}

/// The same of a row, an edge or a curve with kOrder coefficients, by even and odd parts; `second`
/// is half of it. Single values, where objects would end up in memory.
template <std::size_t kDepth, std::size_t kOrder, typename V, typename Coefficient>
SIMDBEZIER_INLINE void even_odd_series(V t, const Coefficient& c, Series<V>& s) {
  const V square = t * t;
  V even_first = c(2);
  if constexpr (kOrder > 4) {
    even_first = madd(c(4), square, even_first);
  }
  V odd_first = c(3);
  if constexpr (kOrder > 5) {
    odd_first = madd(c(5), square, odd_first);
  }
  const V odd = madd(odd_first, square, c(1));
  s.value = madd(even_first, square, c(0)) + t * odd;
  if constexpr (kDepth > 0) {
    if constexpr (kOrder > 4) {
      even_first = madd(c(4), square, even_first);
    }
    if constexpr (kOrder > 5) {
      odd_first = madd(c(5), square, odd_first);
    }
    s.first = madd(odd_first, square + square, odd) + (t + t) * even_first;
  }
  if constexpr (kDepth > 1) {
    const V twice = square + square;
    V half_odd = ((t + t) + t) * odd_first;
    if constexpr (kOrder > 5) {
      half_odd = madd(c(5), (twice + twice) * t, half_odd);
    }
    if constexpr (kOrder > 4) {
      even_first = madd(c(4), twice + twice, even_first);
    }
    s.second = even_first + half_odd;
  }
}

/// The same of an order that takes even and odd parts.
template <std::size_t kDepth, std::size_t kFixed, typename V, typename Coefficient>
SIMDBEZIER_INLINE void even_odd_series(Order<kFixed> order, V t, const Coefficient& c,
                                       Series<V>& s) {
  if constexpr (kFixed != 0) {
    even_odd_series<kDepth, kFixed>(t, c, s);
  } else if (order.value() == 4) {
    even_odd_series<kDepth, 4>(t, c, s);
  } else if (order.value() == 5) {
    even_odd_series<kDepth, 5>(t, c, s);
  } else {
    even_odd_series<kDepth, 6>(t, c, s);
  }
}

/// The same of any row, edge or curve.
template <std::size_t kDepth, std::size_t kFixed, typename V, typename Coefficient>
SIMDBEZIER_INLINE Series<V> row_series(Order<kFixed> order, V t, const Coefficient& c) {
  if constexpr (kFixed != 0 && !takes_even_odd(kFixed)) {
    return horner_series<kDepth>(order, t, c);
  } else {
    Series<V> s;
    if (kFixed != 0 || takes_even_odd(order.value())) {
      even_odd_series<kDepth>(order, t, c, s);
      if constexpr (kDepth > 1) {
        s.second = s.second + s.second;
      }
    } else {
      horner_into<kDepth>(order, t, c, s);
    }
    return s;
  }
}

/// horner_series() of kCount polynomials at once, from coefficients [power][polynomial]. Their sums
/// stay in registers while the loop runs, however long it is, and one address serves all of them.
template <std::size_t kDepth, std::size_t kCount, typename V, typename N>
SIMDBEZIER_INLINE void horner_series_abreast(N order, V t, const ScalarOf<V>* coefficients,
                                             Series<V> s[kCount]) {
  const std::size_t degree = order.value() - 1;
  const ScalarOf<V>* c = coefficients + (degree - 1) * kCount;
  repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    s[i].template begin<kDepth>(broadcast<V>(c[kCount + i]), broadcast<V>(c[i]), t);
  });
  if (degree > 1) {
    c -= kCount;
    repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      s[i].template add_third<kDepth>(broadcast<V>(c[i]), t);
    });
    for (std::size_t k = degree - 2; k-- > 0;) {
      c -= kCount;
      repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        s[i].template add<kDepth>(broadcast<V>(c[i]), t);
      });
    }
  }
  repeat<kCount>([&](std::size_t i)
                     SIMDBEZIER_INLINE_LAMBDA { s[i].template finish<kDepth>(degree, t); });
}

/// A half-centred parameter of a direction that is cut in two, half-centred in its cell. One
/// rounding, and odd: the cells of a reversed direction see mirrored parameters.
template <typename V>
SIMDBEZIER_INLINE V cell_parameter(V x) {
  using T = ScalarOf<V>;
  const V to_low = broadcast<V>(T(0.5));
  const V to_high = broadcast<V>(T(-0.5));
  return (x + x) + select_where<V>(x < broadcast<V>(T(0)), to_low, to_high);
}

/// One value and its derivatives by the two local parameters.
template <typename V>
struct Partials {
  V value;
  V x;
  V y;
  V xx;
  V xy;
  V yy;
};

/// What a sample consists of; derivatives by u and v as far as the kernel's depth goes.
template <typename V>
struct SampleJet {
  V position[3];
  V du[3];
  V dv[3];
  V duu[3];
  V duv[3];
  V dvv[3];
  V inverse_weight; ///< of rational patches, with derivatives: 1 / w
};

/// S = h / w and its derivatives, from those of h and w: w S = h, differentiated. Those of w come
/// negated, so that every product is added.
/// Source: L. Piegl and W. Tiller, The NURBS Book, 4.2 and 4.3.
template <typename V>
struct Quotient {
  V inverse; ///< 1 / w

  explicit SIMDBEZIER_INLINE Quotient(V w) : inverse(divide(broadcast<V>(ScalarOf<V>(1)), w)) {}
  SIMDBEZIER_INLINE V value(V h) const { return h * inverse; }
  SIMDBEZIER_INLINE V first(V h_x, V s, V minus_w_x) const {
    return madd(s, minus_w_x, h_x) * inverse;
  }
  /// s_x, s_y: first derivatives of S; twice the same where this is not a mixed one.
  SIMDBEZIER_INLINE V second(V h_xy, V s, V s_x, V s_y, V minus_w_x, V minus_w_y,
                             V minus_w_xy) const {
    return madd(s_y, minus_w_x, madd(s_x, minus_w_y, madd(s, minus_w_xy, h_xy))) * inverse;
  }
};

/// |du x dv|^2 or |C'|^2 of rational patches and curves below this takes a second look: products on
/// the way might have left the range of T.
template <typename T>
inline constexpr T kLeastSquare = static_cast<T>(sizeof(T) == sizeof(float) ? 0x1p-94 : 0x1p-940);

template <typename V>
SIMDBEZIER_INLINE V negated(V a) {
  return broadcast<V>(ScalarOf<V>(0)) - a;
}

template <typename V>
SIMDBEZIER_INLINE V dot(const V a[3], const V b[3]) {
  return madd(a[0], b[0], madd(a[1], b[1], a[2] * b[2]));
}

/// A vector over a power of two of about its size, so that products stay in range; `inverse` is one
/// over that power. Nothing is rounded.
template <typename V>
struct ScaledTangent {
  V inverse;
  V value[3];

  explicit SIMDBEZIER_INLINE ScaledTangent(const V tangent[3]) {
    V size = broadcast<V>(ScalarOf<V>(0));
    for (std::size_t c = 0; c < 3; ++c) {
      const V power = power_of_two_below(tangent[c]);
      size = select_where<V>(power > size, power, size);
    }
    inverse = divide(broadcast<V>(ScalarOf<V>(1)), size);
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = tangent[c] * inverse;
    }
  }
};

/// Gaussian, mean, smaller and larger principal curvature; see Curvatures.
template <typename V>
SIMDBEZIER_INLINE void curvatures(const SampleJet<V>& jet, V out[detail::kCurvatures]) {
  const ScaledTangent<V> du(jet.du);
  const ScaledTangent<V> dv(jet.dv);
  V n[3];
  const V area2 = cross_product(du.value, dv.value, n); // EG - F^2, without its cancellation
  normalise(n, area2);
  const V inverse_area2 = divide(broadcast<V>(ScalarOf<V>(1)), area2);
  const V l = dot(jet.duu, n) * du.inverse * du.inverse;
  const V m = dot(jet.duv, n) * du.inverse * dv.inverse;
  const V k = dot(jet.dvv, n) * dv.inverse * dv.inverse;
  const V e = dot(du.value, du.value);
  const V f = dot(du.value, dv.value);
  const V g = dot(dv.value, dv.value);
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  const V zero = broadcast<V>(ScalarOf<V>(0));
  // Adding zero makes a plane's curvatures +0 and changes nothing else.
  const V gaussian = madd(msub(l, k, m * m), inverse_area2, zero);
  const V twice_f_m = (f + f) * m;
  const V mean = madd(half * (madd(e, k, g * l) - twice_f_m), inverse_area2, zero);
  const V discriminant = msub(mean, mean, gaussian);
  // Rounding makes it negative at umbilics; nan stays nan.
  const V spread = square_root(select_where<V>(discriminant < zero, zero, discriminant));
  out[0] = gaussian;
  out[1] = mean;
  out[2] = mean - spread;
  out[3] = mean + spread;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
