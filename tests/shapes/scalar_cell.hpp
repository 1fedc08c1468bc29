// Samples of packed patches, one at a time and in T: the order of operations that the library
// promises, without its kernels.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "src/storage/patch_storage.hpp"
#include "tests/support/even_odd_model.hpp"

namespace simdbezier::tests {

/// A value and its derivative.
template <typename T>
struct Slope {
  T value;
  T first;
};

/// Evaluates sum c(k) t^k and its slope by Horner's rule and its synthetic division. Columns take
/// it at every degree.
template <typename T, typename Coefficient>
Slope<T> horner(bool fma, std::size_t order, T t, const Coefficient& c) {
  const auto madd = [&](T a, T b) { return fma ? std::fma(a, t, b) : a * t + b; };
  Slope<T> s{c(order - 1), T(0)};
  for (std::size_t k = order - 1; k-- > 0;) {
    s.first = k + 2 == order ? s.value : madd(s.first, s.value);
    s.value = madd(s.value, c(k));
  }
  return s;
}

/// Rows and edges: the same sum in the order of operations of its degree.
template <typename T, typename Coefficient>
Slope<T> row_or_edge(bool fma, std::size_t order, T t, const Coefficient& c) {
  if (!by_even_and_odd_parts(order - 1)) {
    return horner(fma, order, t, c);
  }
  std::vector<T> all;
  for (std::size_t k = 0; k < order; ++k) {
    all.push_back(c(k));
  }
  const EvenOddJet<T> jet = even_odd(Rounded<T>{fma}, std::span<const T>(all), t);
  return {jet.value, jet.slope};
}

template <typename T>
struct Sample {
  T position;
  T du;
  T dv;
};

/// One cell of one packed patch.
template <typename T>
class ScalarCell {
public:
  ScalarCell(const detail::PatchStorage<T>& storage, std::size_t cell, bool fma)
      : storage_(storage), shape_(storage.shape), cell_(cell), fma_(fma) {}

  [[nodiscard]] Sample<T> inside(std::size_t c, T x, T y) const {
    Sample<T> s = channel(c, x, y);
    if (shape_.rational) {
      const Sample<T> w = channel(shape_.channels() - 1, x, y);
      s = {divided(s.position, w.position), quotient(s.position, w.position, s.du, w.du),
           quotient(s.position, w.position, s.dv, w.dv)};
    }
    s.du *= static_cast<T>(shape_.cells_u());
    s.dv *= static_cast<T>(shape_.cells_v());
    s.position += origin(c, 0);
    return s;
  }
  /// Position and derivative along an edge.
  [[nodiscard]] Slope<T> on_edge(std::size_t c, std::size_t e, T t) const {
    Slope<T> s = edge(c, e, t);
    if (shape_.rational) {
      const Slope<T> w = edge(shape_.channels() - 1, e, t);
      s = {divided(s.value, w.value), quotient(s.value, w.value, s.first, w.first)};
    }
    s.first *= static_cast<T>(e < 2 ? shape_.cells_u() : shape_.cells_v());
    s.value += storage_.origins == nullptr ? point(c, e) : origin(c, 4 + e);
    return s;
  }

private:
  /// What an edge u = const that is packed around its point is relative to, in sets without
  /// origins.
  [[nodiscard]] T point(std::size_t c, std::size_t e) const {
    if (!shape_.rational || e < detail::kEdgeU0) {
      return T(0);
    }
    const T* const corners = storage_.edges + cell_ * shape_.cell_edges() + shape_.corners_at();
    const std::size_t at = e - detail::kEdgeU0;
    return corners[(shape_.channels() - 1) * 4 + at] == T(0) ? T(0) : corners[c * 4 + at];
  }
  [[nodiscard]] T divided(T h, T w) const { return h * (T(1) / w); }
  [[nodiscard]] T quotient(T h, T w, T h_slope, T w_slope) const {
    const T s = divided(h, w);
    const T numerator = fma_ ? std::fma(s, -w_slope, h_slope) : s * -w_slope + h_slope;
    return divided(numerator, w);
  }
  [[nodiscard]] Sample<T> channel(std::size_t c, T x, T y) const {
    const T* const matrix =
        storage_.coefficients + cell_ * shape_.cell_coefficients() + c * shape_.matrix();
    std::vector<Slope<T>> q(shape_.order_v());
    for (std::size_t l = 0; l < q.size(); ++l) {
      q[l] = horner(fma_, shape_.order_u(), x,
                    [&](std::size_t k) { return matrix[k * shape_.order_v() + l]; });
    }
    const Slope<T> s = row_or_edge(fma_, q.size(), y, [&](std::size_t l) { return q[l].value; });
    const Slope<T> u = row_or_edge(fma_, q.size(), y, [&](std::size_t l) { return q[l].first; });
    return {s.value, u.value, s.first};
  }
  [[nodiscard]] Slope<T> edge(std::size_t c, std::size_t e, T t) const {
    const T* const from =
        storage_.edges + cell_ * shape_.cell_edges() + c * shape_.edge_powers() * 4 + e;
    return row_or_edge(fma_, e < 2 ? shape_.order_u() : shape_.order_v(), t,
                       [&](std::size_t k) { return from[k * 4]; });
  }
  [[nodiscard]] T origin(std::size_t c, std::size_t at) const {
    return storage_.origins == nullptr
               ? T(0)
               : storage_.origins[cell_ * shape_.cell_origins() + c * 8 + at];
  }

  const detail::PatchStorage<T>& storage_;
  const detail::NetShape& shape_;
  std::size_t cell_;
  bool fma_;
};

/// The local parameter of a half-centred one, and the cell it is in.
template <typename T>
struct Local {
  std::size_t cell;
  T x;

  Local(T half_centred, std::size_t cells) : cell(0), x(half_centred) {
    if (cells == 2) {
      cell = half_centred < 0 ? 0 : 1;
      x = (half_centred + half_centred) + (half_centred < 0 ? T(0.5) : T(-0.5));
    }
  }
};

} // namespace simdbezier::tests
