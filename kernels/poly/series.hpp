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
  static constexpr bool kKnown = true;
  static constexpr std::size_t kMost = kFixed;
  explicit constexpr Order(std::size_t) {}
  SIMDBEZIER_INLINE constexpr std::size_t value() const { return kFixed; }
};
template <>
struct Order<0> {
  static constexpr bool kKnown = false;
  static constexpr std::size_t kMost = detail::kMostOrder;
  explicit constexpr Order(std::size_t order) : order_(order) {}
  SIMDBEZIER_INLINE constexpr std::size_t value() const { return order_; }

private:
  std::size_t order_;
};

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

/// Finds sum_k c(k) t^k, and derivatives up to kDepth, for order >= 2, at kCount parameters at
/// once, which share the loads of coefficients and hide each other's latency.
template <std::size_t kDepth, std::size_t kCount, typename V, typename N, typename Coefficient>
SIMDBEZIER_INLINE void horner_rows(N order, const V* t, const Coefficient& c, Series<V>* s) {
  const std::size_t degree = order.value() - 1;
  const auto each = [](const auto& step) SIMDBEZIER_INLINE_LAMBDA { repeat<kCount>(step); };
  each([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    s[i].template begin<kDepth>(c(degree), c(degree - 1), t[i]);
  });
  if (degree > 1) {
    each([&](std::size_t i)
             SIMDBEZIER_INLINE_LAMBDA { s[i].template add_third<kDepth>(c(degree - 2), t[i]); });
    for (std::size_t k = degree - 2; k-- > 0;) {
      const V next = c(k);
      each([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { s[i].template add<kDepth>(next, t[i]); });
    }
  }
  each([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { s[i].template finish<kDepth>(degree, t[i]); });
}

/// The upper ends of the even and the odd part of a polynomial of kTerms coefficients, as Horner's
/// rule in t^2 begins with them. Here and below results are single values, since objects would end
/// up in memory.
template <std::size_t kTerms, typename V, typename Coefficient>
SIMDBEZIER_INLINE void begin_even_odd(V square, const Coefficient& c, V& even_first, V& odd_first) {
  even_first = c(2);
  if constexpr (kTerms > 4) {
    even_first = madd(c(4), square, even_first);
  }
  odd_first = c(3);
  if constexpr (kTerms > 5) {
    odd_first = madd(c(5), square, odd_first);
  }
}

/// The series of a row, an edge or a curve with kTerms coefficients, by even and odd parts;
/// `second` is half of the second derivative.
template <std::size_t kDepth, std::size_t kTerms, typename V, typename Coefficient>
SIMDBEZIER_INLINE void even_odd_series(V t, const Coefficient& c, Series<V>& s) {
  const V square = t * t;
  V even_first;
  V odd_first;
  begin_even_odd<kTerms>(square, c, even_first, odd_first);
  const V odd = madd(odd_first, square, c(1));
  s.value = madd(even_first, square, c(0)) + t * odd;
  if constexpr (kDepth > 0) {
    if constexpr (kTerms > 4) {
      even_first = madd(c(4), square, even_first);
    }
    if constexpr (kTerms > 5) {
      odd_first = madd(c(5), square, odd_first);
    }
    s.first = madd(odd_first, square + square, odd) + (t + t) * even_first;
  }
  if constexpr (kDepth > 1) {
    const V twice = square + square;
    V half_odd = ((t + t) + t) * odd_first;
    if constexpr (kTerms > 5) {
      half_odd = madd(c(5), (twice + twice) * t, half_odd);
    }
    if constexpr (kTerms > 4) {
      even_first = madd(c(4), twice + twice, even_first);
    }
    s.second = even_first + half_odd;
  }
}

/// The even and the odd part of the value: their sum is the value at t, their difference that at
/// -t.
template <std::size_t kTerms, typename V, typename Coefficient>
SIMDBEZIER_INLINE void even_odd_parts(V t, const Coefficient& c, V& even, V& odd) {
  const V square = t * t;
  V even_first;
  V odd_first;
  begin_even_odd<kTerms>(square, c, even_first, odd_first);
  even = madd(even_first, square, c(0));
  odd = t * madd(odd_first, square, c(1));
}

/// The even and the odd part of the slope, as even_odd_parts() has those of the value.
template <std::size_t kTerms, typename V, typename Coefficient>
SIMDBEZIER_INLINE void even_odd_slope_parts(V t, const Coefficient& c, V& even, V& odd) {
  const V square = t * t;
  V even_first;
  V odd_first;
  begin_even_odd<kTerms>(square, c, even_first, odd_first);
  if constexpr (kTerms > 4) {
    even_first = madd(c(4), square, even_first);
  }
  const V value_odd = madd(odd_first, square, c(1));
  if constexpr (kTerms > 5) {
    odd_first = madd(c(5), square, odd_first);
  }
  even = madd(odd_first, square + square, value_odd);
  odd = (t + t) * even_first;
}

/// This is even_odd_series() of an order that takes even and odd parts, at kCount parameters at
/// once.
template <std::size_t kDepth, std::size_t kCount, std::size_t kFixed, typename V,
          typename Coefficient>
SIMDBEZIER_INLINE void even_odd_rows(Order<kFixed> order, const V* t, const Coefficient& c,
                                     Series<V>* s) {
  const auto each = [&]<std::size_t kTerms>() SIMDBEZIER_INLINE_LAMBDA {
    repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      even_odd_series<kDepth, kTerms>(t[i], c, s[i]);
    });
  };
  if constexpr (kFixed != 0) {
    each.template operator()<kFixed>();
  } else if (order.value() == 4) {
    each.template operator()<4>();
  } else if (order.value() == 5) {
    each.template operator()<5>();
  } else {
    each.template operator()<6>();
  }
}

/// Finds the series of any row, edge or curve, at kCount parameters at once.
template <std::size_t kDepth, std::size_t kCount, std::size_t kFixed, typename V,
          typename Coefficient>
SIMDBEZIER_INLINE void rows_series(Order<kFixed> order, const V* t, const Coefficient& c,
                                   Series<V>* s) {
  if constexpr (kFixed != 0 && !takes_even_odd(kFixed)) {
    horner_rows<kDepth, kCount>(order, t, c, s);
  } else if (kFixed != 0 || takes_even_odd(order.value())) {
    even_odd_rows<kDepth, kCount>(order, t, c, s);
    if constexpr (kDepth > 1) {
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { s[i].second = s[i].second + s[i].second; });
    }
  } else {
    horner_rows<kDepth, kCount>(order, t, c, s);
  }
}
template <std::size_t kDepth, std::size_t kFixed, typename V, typename Coefficient>
SIMDBEZIER_INLINE Series<V> row_series(Order<kFixed> order, V t, const Coefficient& c) {
  Series<V> s;
  rows_series<kDepth, 1>(order, &t, c, &s);
  return s;
}

/// Finds the values alone of horner_rows(), of coefficients that stand side by side in memory: an
/// address goes from one to the next, where an index would have to be made an address each time.
template <std::size_t kCount, typename V>
SIMDBEZIER_INLINE void horner_values(std::size_t order, const V* t, const V* coefficients,
                                     V* values) {
  const V* c = coefficients + (order - 1);
  const V last = *c;
  repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { values[i] = last; });
  do {
    const V next = *--c;
    repeat<kCount>([&](std::size_t i)
                       SIMDBEZIER_INLINE_LAMBDA { values[i] = madd(values[i], t[i], next); });
  } while (c != coefficients);
}

/// This is horner_rows() of kCount polynomials at one parameter: columns, whose coefficients stand
/// in memory as [power][polynomial], with `step` from one power to the next. load turns an address
/// and the polynomial's number into a register. The sums stay in registers while the loop runs,
/// however long it is, and one address serves all of them.
template <std::size_t kDepth, std::size_t kCount, typename V, typename N, typename Load>
SIMDBEZIER_INLINE void horner_series_abreast(N order, V t, const ScalarOf<V>* coefficients,
                                             std::size_t step, const Load& load, Series<V>* s) {
  const std::size_t degree = order.value() - 1;
  const ScalarOf<V>* c = coefficients + degree * step;
  V last[kCount];
  repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { last[i] = load(c, i); });
  c -= step;
  if constexpr (!N::kKnown) { // else the last coefficients' addresses would serve these as well
    c = own_address(c);
  }
  repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    s[i].template begin<kDepth>(last[i], load(c, i), t);
  });
  if (degree > 1) {
    c -= step;
    repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      s[i].template add_third<kDepth>(load(c, i), t);
    });
    while (c != coefficients) {
      c -= step;
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { s[i].template add<kDepth>(load(c, i), t); });
    }
  }
  repeat<kCount>([&](std::size_t i)
                     SIMDBEZIER_INLINE_LAMBDA { s[i].template finish<kDepth>(degree, t); });
}

/// Returns a half-centred parameter of a direction that is cut in two, half-centred in its cell.
/// There is one rounding, and it is odd: the cells of a reversed direction see mirrored parameters.
template <typename V>
SIMDBEZIER_INLINE V cell_parameter(V x) {
  using T = ScalarOf<V>;
  const V to_low = broadcast<V>(T(0.5));
  const V to_high = broadcast<V>(T(-0.5));
  return (x + x) + select_where<V>(x < broadcast<V>(T(0)), to_low, to_high);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
