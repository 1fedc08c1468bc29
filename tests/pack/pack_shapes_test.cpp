// Patches of any shape, packed: coefficients, edges and corners of every cell against exact
// polynomials in rational numbers, which are expanded straight from the Bernstein basis.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"
#include "tests/support/oracle/exact_polynomials.hpp"

namespace simdbezier::tests::pack_shapes_test {
namespace {

/// How many times the size of its values each coefficient can be: of a cell, it is formed from the
/// cell's own control values.
std::vector<double> reach_of(int degree) {
  std::vector<double> reach(static_cast<std::size_t>(degree) + 1);
  for (const Polynomial& b : bernstein(degree, 1, 0)) {
    for (std::size_t k = 0; k < reach.size(); ++k) {
      reach[k] += std::abs(b[k].get_d());
    }
  }
  return reach;
}

template <typename T>
double half_ulp(T x) {
  const T size = std::max(std::abs(x), std::numeric_limits<T>::min());
  return static_cast<double>(std::nextafter(size, std::numeric_limits<T>::infinity()) - size) / 2;
}

/// One channel of one patch, exact.
struct ExactChannel {
  std::vector<Rational> values; ///< [j][i], homogeneous
  double size = 0;              ///< of the largest
};

template <typename T, typename S>
class Checker {
public:
  /// kCarried: relative error of what coefficients are formed in, with some room for many terms.
  static constexpr double kCarried = sizeof(T) == 4 && sizeof(S) == 4 ? 0x1p-49 : 0x1p-98;

  Checker(const ShapeCase& c, const RandomNets<S>& nets, const PatchSet<T>& set, std::size_t patch,
          const PackOptions& options)
      : case_(c), storage_(set.storage()->buckets[0]), patch_(patch), options_(options),
        from_(nets.values.data() + patch * c.values()) {
    channels_.resize(c.channels());
    for (std::size_t channel = c.channels(); channel-- > 0;) { // weights first
      for (std::size_t k = 0; k < c.points(); ++k) {
        channels_[channel].values.push_back(homogeneous(k, channel));
        channels_[channel].size =
            std::max(channels_[channel].size, std::abs(channels_[channel].values[k].get_d()));
      }
    }
  }

  void check() {
    const detail::NetShape& s = storage_.shape;
    for (std::size_t cell = 0; cell < s.cells(); ++cell) {
      const int cell_u = static_cast<int>(cell % s.cells_u());
      const int cell_v = static_cast<int>(cell / s.cells_u());
      basis_u_ = bernstein(case_.degree_u, static_cast<int>(s.cells_u()), cell_u);
      basis_v_ = bernstein(case_.degree_v, static_cast<int>(s.cells_v()), cell_v);
      for (std::size_t c = case_.channels(); c-- > 0;) {
        check_matrix(cell, c);
        check_edges(cell, c, cell_u, cell_v);
      }
    }
    check_control_points();
  }
  [[nodiscard]] double worst() const { return worst_; }

private:
  [[nodiscard]] bool is_weight(std::size_t channel) const {
    return channel == static_cast<std::size_t>(case_.components);
  }
  [[nodiscard]] Rational input(std::size_t k, std::size_t channel) const {
    return exact(static_cast<double>(from_[k * case_.channels() + channel]));
  }
  [[nodiscard]] Rational homogeneous(std::size_t k, std::size_t channel) const {
    const Rational value = input(k, channel);
    if (is_weight(channel)) {
      return value;
    }
    const Rational shift = channel < 3 ? exact(options_.relative_to[channel]) : Rational(0);
    if (case_.weights == Weights::none) {
      return value - shift;
    }
    const Rational weight = input(k, case_.channels() - 1);
    if (case_.weights == Weights::cartesian) {
      return weight * (value - shift);
    }
    return value - weight * shift;
  }

  /// found = value - origin * weight, rounded once; `reach` times the channel's size is what the
  /// carried sums consist of.
  void expect(T found, const Rational& value, const Rational& weight, T origin, double reach,
              std::size_t channel) {
    const Rational split = exact(static_cast<double>(origin)) * weight;
    const Rational error = abs(value - split - exact(static_cast<double>(found)));
    const double size = channels_[channel].size + std::abs(static_cast<double>(origin)) * 2;
    const double allowed = half_ulp(found) * (1 + 0x1p-20) + kCarried * reach * size;
    worst_ = std::max(worst_, error.get_d() / allowed);
  }

  [[nodiscard]] T origin(std::size_t cell, std::size_t c, std::size_t at) const {
    const detail::NetShape& s = storage_.shape;
    return storage_.origins == nullptr
               ? T(0)
               : storage_.origins[patch_ * s.origins() + cell * s.cell_origins() + c * 8 + at];
  }

  [[nodiscard]] Table matrix_of(std::size_t channel) const {
    const detail::NetShape& s = storage_.shape;
    std::vector<Rational> rows(s.matrix()); // [k][j]
    for (std::size_t j = 0; j < s.order_v(); ++j) {
      const Polynomial row = expansion(basis_u_, &channels_[channel].values[j * s.order_u()], 1);
      for (std::size_t k = 0; k < s.order_u(); ++k) {
        rows[k * s.order_v() + j] = row[k];
      }
    }
    Table result;
    for (std::size_t k = 0; k < s.order_u(); ++k) {
      result.push_back(expansion(basis_v_, &rows[k * s.order_v()], 1));
    }
    return result;
  }

  void check_matrix(std::size_t cell, std::size_t c) {
    const detail::NetShape& s = storage_.shape;
    const Table weights = s.rational ? matrix_of(case_.channels() - 1) : Table();
    const Table exact_matrix = matrix_of(c);
    const T* const found = storage_.coefficients + patch_ * s.coefficients() +
                           cell * s.cell_coefficients() + c * s.matrix();
    for (std::size_t k = 0; k < s.order_u(); ++k) {
      for (std::size_t l = 0; l < s.order_v(); ++l) {
        const Rational weight = s.rational ? weights[k][l] : Rational(k + l == 0 ? 1 : 0);
        expect(found[k * s.order_v() + l], exact_matrix[k][l], weight, origin(cell, c, 0),
               reach_u_[k] * reach_v_[l], c);
      }
    }
  }

  /// The four edges of a cell, from the curves that they are: the net's own where the cell is
  /// outermost, else its middle.
  void check_edges(std::size_t cell, std::size_t c, int cell_u, int cell_v) {
    const detail::NetShape& s = storage_.shape;
    const T* const block = storage_.edges + patch_ * s.edges() + cell * s.cell_edges();
    for (std::size_t e = 0; e < 4; ++e) {
      const bool along_u = e < 2;
      const int side = static_cast<int>(e % 2);
      const std::size_t order = along_u ? s.order_u() : s.order_v();
      const int line = along_u ? cell_v + side : cell_u + side;
      const Polynomial edge = edge_curve(c, along_u, line);
      const Polynomial weight =
          s.rational ? edge_curve(case_.channels() - 1, along_u, line) : Polynomial(order);
      const Table& basis = along_u ? basis_u_ : basis_v_;
      const std::vector<double>& reach = along_u ? reach_u_ : reach_v_;
      const Polynomial values = expansion(basis, edge.data(), 1);
      const Polynomial weights = expansion(basis, weight.data(), 1);
      const T* const found = block + c * s.edge_powers() * 4 + e;
      for (std::size_t k = 0; k < s.edge_powers(); ++k) {
        if (k >= order) {
          EXPECT_EQ(found[k * 4], T(0)) << name_of(case_);
          continue;
        }
        const Rational w = s.rational ? weights[k] : Rational(k == 0 ? 1 : 0);
        expect(found[k * 4], values[k], w, origin(cell, c, 4 + e), reach[k], c);
      }
      for (std::size_t end = 0; end < 2; ++end) { // corners: twice each, from both of its edges
        const std::size_t u = along_u ? end : e % 2;
        const std::size_t v = along_u ? e % 2 : end;
        const T corner = block[s.corners_at() + c * 4 + v * 2 + u];
        if (s.rational && is_weight(c)) {
          EXPECT_EQ(corner, T(0)) << name_of(case_) << ": marked as a point";
        } else {
          check_corner(corner, edge, weight, along_u,
                       (along_u ? cell_u : cell_v) + static_cast<int>(end), c);
        }
      }
    }
  }

  /// Control values of the curve u or v = line / cells, exact.
  [[nodiscard]] Polynomial edge_curve(std::size_t c, bool along_u, int line) const {
    const detail::NetShape& s = storage_.shape;
    const std::size_t cells = along_u ? s.cells_v() : s.cells_u();
    const Rational at(line, static_cast<int>(cells));
    Polynomial result;
    for (std::size_t k = 0; k < (along_u ? s.order_u() : s.order_v()); ++k) {
      std::vector<Rational> across;
      for (std::size_t i = 0; i < (along_u ? s.order_v() : s.order_u()); ++i) {
        across.push_back(channels_[c].values[along_u ? i * s.order_u() + k : k * s.order_u() + i]);
      }
      result.push_back(exact_curve(across, at).value);
    }
    return result;
  }

  void check_corner(T found, const Polynomial& edge, const Polynomial& weight, bool along_u,
                    int line, std::size_t c) {
    const detail::NetShape& s = storage_.shape;
    const Rational at(line, static_cast<int>(along_u ? s.cells_u() : s.cells_v()));
    Rational point = exact_curve(edge, at).value;
    if (s.rational) {
      point /= exact_curve(weight, at).value;
    }
    const Rational error = abs(point - exact(static_cast<double>(found)));
    const double carried = sizeof(T) == 4 || !storage_.shape.rational ? kCarried : 0x1p-52; // h/w
    worst_ = std::max(worst_, error.get_d() / (half_ulp(found) + carried * channels_[c].size));
  }

  /// Control points are kept as they were given: whatever T, the form of weights and the set's
  /// origin are.
  void check_control_points() {
    EXPECT_EQ(storage_.given.in_double, sizeof(S) == sizeof(double));
    EXPECT_EQ(storage_.given.weights, case_.weights);
    const detail::GivenNet net = storage_.given.net(patch_ * case_.values());
    for (std::size_t e = 0; e < case_.values(); ++e) {
      EXPECT_EQ(net.value(e), static_cast<double>(from_[e])) << name_of(case_) << ", value " << e;
    }
    for (std::size_t c = 0; c + 1 < case_.channels(); ++c) {
      EXPECT_EQ(storage_.given.relative_to[std::min<std::size_t>(c, 2)],
                options_.relative_to[std::min<std::size_t>(c, 2)]);
    }
  }

  const ShapeCase& case_;
  const detail::PatchStorage<T>& storage_;
  std::size_t patch_;
  const PackOptions& options_;
  const S* from_;
  std::vector<ExactChannel> channels_;
  std::vector<double> reach_u_ = reach_of(case_.degree_u);
  std::vector<double> reach_v_ = reach_of(case_.degree_v);
  Table basis_u_;
  Table basis_v_;
  double worst_ = 0; ///< of |error| / what is allowed
};

template <typename T, typename S>
void expect_exact(bool origins, double shift) {
  PackOptions options;
  options.local_origin = origins;
  options.relative_to[0] = options.relative_to[1] = options.relative_to[2] = shift;
  for (const ShapeCase& c : all_shapes()) {
    const RandomNets<S> nets(c, 2, 5, 3);
    PatchSet<T> set;
    ASSERT_TRUE(pack(nets.view, set, options)) << c;
    Checker<T, S> checker(c, nets, set, 1, options);
    checker.check();
    EXPECT_LE(checker.worst(), 1) << c;
    EXPECT_GT(checker.worst(), 0.5) << c << ": implausibly exact";
  }
}

TEST(PackShapes, all_values_are_rounded_once) {
  expect_exact<float, float>(false, 0);
  expect_exact<double, double>(false, 0);
}
TEST(PackShapes, all_values_around_local_origins_are_rounded_once) {
  expect_exact<float, float>(true, 0);
  expect_exact<double, double>(true, 0);
}
TEST(PackShapes, all_values_relative_to_a_point_are_rounded_once) {
  expect_exact<float, double>(false, 0.1);
  expect_exact<double, float>(true, 0.1);
}

} // namespace
} // namespace simdbezier::tests::pack_shapes_test
