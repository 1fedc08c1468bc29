// The leading coefficient of du x dv (src/exact/normal_series.hpp) for samples of one polynomial
// patch, in plain doubles and a register at once: nearly all samples that need a second look are
// decided so. Nothing is fused, so that the bits are the same on every instruction set. The values
// are those of NormalSeries, operation by operation: what is left out adds zeros there.
//
// docs/accuracy.md, "Normals", says which coefficient leads, and has the proof of the bound, which
// is never below that of NormalSeries: what is certain here is certain there.
//
// Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, chapter 3.
#pragma once

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/transpose.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A polynomial patch; kKnown: the number of its columns and of its rows, or 0.
template <std::size_t kKnown>
class NormalStart {
  static constexpr std::size_t kMost = kKnown == 0 ? detail::kMostOrder : kKnown;

public:
  SIMDBEZIER_PART NormalStart(const detail::GivenNet& net, std::size_t columns, std::size_t rows,
                              double tolerance)
      : columns_(columns), rows_(rows), tolerance_(tolerance),
        bound_(kTwiceUnit * static_cast<double>(4 * roundings(columns, rows) + 8)) {
    double points[3 * kMost * (kMost + 1) + kWideLanes];
    const double size = read(net, points);
    const Wide scale(1 / size);
    along_u_.find(points, 3, count(), scale);
    along_v_.find(points, 3 * this->columns(), count(), scale);
  }

  /// Writes the unit normals of a register of samples, and the numbers of their coefficients, or -1
  /// where nothing is certain. A function of its own reads each difference into all lanes, where
  /// g++ would take them out of registers. Samples come from memory: g++ 12 does not clear the
  /// upper halves of registers where vectors are arguments, and code without AVX, which is called
  /// next, would be slow.
  SIMDBEZIER_KERNEL void find(const double* at_x, const double* at_y, double* normal,
                              std::size_t step, double* order) const {
    const Wide x = load_vector<Wide>(at_x);
    const Wide y = load_vector<Wide>(at_y);
    const Basis u(columns() - 1, x);
    const Basis v(rows() - 1, y);
    const MaskOf<Wide> inside_u = magnitude(x) < Wide(0.5);
    const MaskOf<Wide> inside_v = magnitude(y) < Wide(0.5);
    Answer answer;
    if (any_of<Wide>(inside_u & inside_v)) {
      take(inside_u & inside_v, sum_up(along_u_, {u.lower, 0, columns() - 1}, {v.upper, 0, rows()}),
           sum_up(along_v_, {u.upper, 0, columns()}, {v.lower, 0, rows() - 1}), answer);
    }
    for (const bool last : {false, true}) {
      const MaskOf<Wide> on_u = x == Wide(last ? 0.5 : -0.5);
      const MaskOf<Wide> on_v = y == Wide(last ? 0.5 : -0.5);
      if (any_of<Wide>(on_v & inside_u)) {
        take(on_v & inside_u, on_side(along_u_, true, last, u.lower, columns() - 1, rows()),
             on_side(along_v_, true, last, u.upper, columns(), rows() - 1), answer);
      }
      if (any_of<Wide>(on_u & inside_v)) {
        take(on_u & inside_v, on_side(along_u_, false, last, v.upper, columns() - 1, rows()),
             on_side(along_v_, false, last, v.lower, columns(), rows() - 1), answer);
      }
      for (const bool last_v : {false, true}) {
        const MaskOf<Wide> at_corner = on_u & (y == Wide(last_v ? 0.5 : -0.5));
        if (any_of<Wide>(at_corner)) {
          take(at_corner, in_corner(along_u_, columns() - 1, rows(), last, last_v),
               in_corner(along_v_, columns(), rows() - 1, last, last_v), answer);
        }
      }
    }
    const Wide* const n = answer.vector;
    const Wide inverse = divide(Wide(1.0), square_root(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    for (std::size_t c = 0; c < 3; ++c) {
      store_vector(normal + c * step, n[c] * inverse);
    }
    store_vector(order, answer.order);
  }

private:
  /// A factor of 2 covers the roundings of the bound itself.
  static constexpr double kTwiceUnit = 0x1p-52;
  /// Roundings of each term of a tangent's sum, at most.
  static SIMDBEZIER_PART std::size_t roundings(std::size_t columns, std::size_t rows) {
    return 4 * (columns + rows) + columns * rows;
  }
  /// Products of what is smaller could underflow.
  static constexpr double kSmallest = 0x1p-400;

  /// Differences of control points, from each point to the next one in a direction; those behind
  /// the last ones mean nothing.
  struct Differences {
    double vector[3 * kMost * kMost + kWideLanes];
    double largest; ///< not below the magnitude of any component

    SIMDBEZIER_PART void find(const double* points, std::size_t step, std::size_t count,
                              Wide scale) {
      Wide most(0.0);
      for (std::size_t k = 0; k < count; k += kWideLanes) {
        const Wide d =
            load_vector<Wide>(points + k + step) * scale - load_vector<Wide>(points + k) * scale;
        store_vector(vector + k, d);
        most = larger_of<Wide>(magnitude(d), most);
      }
      largest = largest_lane(most);
    }
  };

  /// All Bernstein polynomials of degree n and of degree n - 1, as LineBasis has them.
  struct Basis {
    Wide upper[kMost];
    Wide lower[kMost];

    SIMDBEZIER_PART Basis(std::size_t degree, Wide x) {
      const Wide low = Wide(0.5) - x;
      const Wide high = Wide(0.5) + x;
      lower[0] = Wide(1.0);
      for (std::size_t n = 1; n < degree; ++n) {
        next(lower, n, low, high, lower);
      }
      next(lower, degree, low, high, upper);
    }
    /// Those of degree n from those of degree n - 1, last to first, so that both can be one array.
    static SIMDBEZIER_PART void next(const Wide* from, std::size_t n, Wide low, Wide high,
                                     Wide* to) {
      to[n] = from[n - 1] * high;
      for (std::size_t i = n; i-- > 1;) { // to 1
        to[i] = from[i] * low + from[i - 1] * high;
      }
      to[0] = from[0] * low;
    }
  };

  /// Values of polynomials `first` to first + count - 1.
  struct Range {
    const Wide* value;
    std::size_t first;
    std::size_t count;
  };

  /// The first coefficient of a tangent that is not zero.
  struct Tangent {
    Wide vector[3];
    double size; ///< not below the sum of its terms' sizes
    int order;   ///< which one it is
  };

  struct Answer {
    Wide vector[3] = {Wide(0.0), Wide(0.0), Wide(0.0)};
    Wide order = Wide(-1.0);
  };

  static SIMDBEZIER_PART double largest_lane(Wide value) {
    alignas(64) double lanes[kWideLanes];
    store_vector(lanes, value);
    double largest = lanes[0];
    for (std::size_t i = 1; i < kWideLanes; ++i) {
      largest = larger_of(lanes[i], largest);
    }
    return largest;
  }

  /// Reads points. Returns a power of two over which their sizes are about 1, as BoundedField does
  /// (src/exact/bounded.hpp), and makes sure that this changes no digit.
  SIMDBEZIER_PART double read(const detail::GivenNet& net, double* points) {
    if (net.all->in_double) {
      for (std::size_t k = 0; k < count(); ++k) {
        points[k] = static_cast<const double*>(net.values)[k];
      }
    } else {
      for (std::size_t k = 0; k < count(); ++k) {
        points[k] = static_cast<double>(static_cast<const float*>(net.values)[k]);
      }
    }
    // The last row once more, so that no difference with what is behind the last point is large.
    for (std::size_t k = count(); k < count() + 3 * columns() + kWideLanes; ++k) {
      points[k] = points[k - 3 * columns()];
    }
    Wide largest(0.0);
    for (std::size_t k = 0; k < count(); k += kWideLanes) {
      largest = larger_of<Wide>(magnitude(load_vector<Wide>(points + k)), largest);
    }
    const double size = power_of_two_below(largest_lane(largest));
    const Wide least(size * kSmallest);
    MaskOf<Wide> usual = Wide(size) >= Wide(0x1p-1000);
    for (std::size_t k = 0; k < count(); k += kWideLanes) {
      const Wide p = load_vector<Wide>(points + k);
      usual = usual & ((magnitude(p) >= least) | (p == Wide(0.0)));
    }
    if (!all_of<Wide>(usual) || size > 0x1p1000) {
      bound_ = __builtin_inf(); // nothing is certain
    }
    return size;
  }

  /// Differences times polynomials in u and in v, which add up to 1.
  SIMDBEZIER_PART Tangent sum_up(const Differences& d, Range u, Range v) const {
    Wide x(0.0); // by name, so that they stay in registers
    Wide y(0.0);
    Wide z(0.0);
    for (std::size_t j = 0; j < v.count; ++j) {
      const double* at = d.vector + 3 * ((v.first + j) * columns() + u.first);
      for (std::size_t i = 0; i < u.count; ++i, at += 3) {
        const Wide factor = u.value[i] * v.value[j];
        x = x + factor * Wide(at[0]);
        y = y + factor * Wide(at[1]);
        z = z + factor * Wide(at[2]);
      }
    }
    return {{x, y, z}, d.largest, 0};
  }

  /// Takes du x dv where `open` says so and its direction is certain.
  SIMDBEZIER_PART void take(MaskOf<Wide> open, const Tangent& du, const Tangent& dv,
                            Answer& answer) const {
    Wide n[3];
    Wide size(0.0);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      const std::size_t e = (c + 2) % 3;
      n[c] = du.vector[d] * dv.vector[e] - du.vector[e] * dv.vector[d];
      size = larger_of<Wide>(magnitude(n[c]), size);
    }
    const int order = du.order + dv.order;
    const double allowed =
        order == 0 ? larger_of(tolerance_, detail::kRegularTolerance) : tolerance_;
    const double error = bound_ * du.size * dv.size + kSmallest;
    const MaskOf<Wide> found = open & (Wide(error) < size * Wide(allowed));
    for (std::size_t c = 0; c < 3; ++c) {
      answer.vector[c] = select_where<Wide>(found, n[c], answer.vector[c]);
    }
    answer.order = select_where<Wide>(found, Wide(static_cast<double>(order)), answer.order);
  }

  /// The tangent on a side along which the polynomials `along` run: the first line of differences
  /// from there on that is not zero.
  SIMDBEZIER_PART Tangent on_side(const Differences& d, bool is_row, bool last, const Wide* along,
                                  std::size_t count_u, std::size_t count_v) const {
    const std::size_t lines = is_row ? count_v : count_u;
    const std::size_t count = is_row ? count_u : count_v;
    const std::size_t line_step = 3 * (is_row ? columns() : 1);
    const std::size_t step = 3 * (is_row ? 1 : columns());
    double weight = 1;
    double size = 0;
    std::size_t line = 0;
    std::size_t order = 0;
    for (; size == 0 && order < lines; ++order) {
      weight = order == 0 ? 1 : next_factor(weight, lines - 1, order - 1);
      line = last ? lines - 1 - order : order;
      for (std::size_t i = 0; i < count; ++i) {
        size = larger_of(size_of(d.vector + line * line_step + i * step), size);
      }
    }
    const Wide factor(weight);
    Tangent sum = is_row ? sum_up(d, {along, 0, count_u}, {&factor, line, 1})
                         : sum_up(d, {&factor, line, 1}, {along, 0, count_v});
    sum.size = weight * size;
    sum.order = static_cast<int>(order) - 1;
    return sum;
  }
  /// The tangent in a corner: the first diagonal of differences that is not zero.
  SIMDBEZIER_PART Tangent in_corner(const Differences& d, std::size_t count_u, std::size_t count_v,
                                    bool last_u, bool last_v) const {
    double sum[3] = {0, 0, 0};
    double size = 0;
    std::size_t order = 0;
    for (; size == 0 && order + 1 < count_u + count_v; ++order) {
      for (std::size_t row = 0; row < count_v; ++row) { // in the order of the whole series
        const std::size_t j = last_v ? count_v - 1 - row : row;
        const std::size_t i = order - j;
        if (j > order || i >= count_u) {
          continue;
        }
        double factor = 1;
        for (std::size_t k = 0; k < i; ++k) {
          factor = next_factor(factor, count_u - 1, k);
        }
        for (std::size_t k = 0; k < j; ++k) {
          factor = next_factor(factor, count_v - 1, k);
        }
        const double* const at = d.vector + 3 * (row * columns() + (last_u ? count_u - 1 - i : i));
        for (std::size_t c = 0; c < 3; ++c) {
          sum[c] += factor * at[c];
        }
        size += factor * size_of(at);
      }
    }
    return {{Wide(sum[0]), Wide(sum[1]), Wide(sum[2])}, size, static_cast<int>(order) - 1};
  }

  /// From binomial(n,k) / 2^k to the next one, without rounding.
  static SIMDBEZIER_PART double next_factor(double factor, std::size_t n, std::size_t k) {
    return factor * static_cast<double>(n - k) / static_cast<double>(2 * (k + 1));
  }
  static SIMDBEZIER_PART double size_of(const double vector[3]) {
    return larger_of(larger_of(__builtin_fabs(vector[0]), __builtin_fabs(vector[1])),
                     __builtin_fabs(vector[2]));
  }

  [[nodiscard]] SIMDBEZIER_PART std::size_t columns() const {
    return kKnown == 0 ? columns_ : kKnown;
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t rows() const { return kKnown == 0 ? rows_ : kKnown; }
  [[nodiscard]] SIMDBEZIER_PART std::size_t count() const { return 3 * columns() * rows(); }

  std::size_t columns_;
  std::size_t rows_;
  double tolerance_;
  double bound_;
  Differences along_u_;
  Differences along_v_;
};

/// As start_normals().
template <std::size_t kKnown>
SIMDBEZIER_KERNEL void start_on(const detail::NetShape& shape, const detail::GivenNet& net,
                                double tolerance, const double* x, const double* y,
                                std::size_t count, double* normals, std::size_t step,
                                double* orders) {
  const NormalStart<kKnown> patch(net, static_cast<std::size_t>(shape.degree_u + 1),
                                  static_cast<std::size_t>(shape.degree_v + 1), tolerance);
  for (std::size_t k = 0; k < count; k += kWideLanes) {
    patch.find(x + k, y + k, normals + k, step, orders + k);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
