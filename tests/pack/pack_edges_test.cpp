// The packed edges of patches of any shape: equal bits wherever the same control points are, in
// whatever patch and orientation.
#include <cstddef>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::pack_edges_test {
namespace {

/// Where edge `e` of `cell` stands in a patch that was turned, and how.
struct EdgeView {
  std::size_t cell;
  std::size_t edge;
  bool reversed;
};

/// A patch and the same one with u, v or both reversed, or with u and v exchanged: every edge of
/// every cell has the same bits, odd powers up to their sign where it runs the other way. (With u
/// and v exchanged only the patch's own edges do: those inside are halved in another order.)
template <typename T>
class Turned {
public:
  Turned(const ShapeCase& c, bool reverse_u, bool reverse_v, bool exchange, bool origins)
      : case_(c), reverse_u_(reverse_u), reverse_v_(reverse_v), exchange_(exchange) {
    const RandomNets<T> nets(c, 1, 23);
    ShapeCase other = c;
    if (exchange) {
      std::swap(other.degree_u, other.degree_v);
    }
    RandomNets<T> turned(other, 1, 0);
    for (int j = 0; j <= c.degree_v; ++j) {
      for (int i = 0; i <= c.degree_u; ++i) {
        const int ti = reverse_u ? c.degree_u - i : i;
        const int tj = reverse_v ? c.degree_v - j : j;
        const int at = exchange ? ti * (c.degree_v + 1) + tj : tj * (c.degree_u + 1) + ti;
        for (std::size_t k = 0; k < c.channels(); ++k) {
          turned.values[static_cast<std::size_t>(at) * c.channels() + k] =
              nets.values[static_cast<std::size_t>(j * (c.degree_u + 1) + i) * c.channels() + k];
        }
      }
    }
    PackOptions options;
    options.local_origin = origins;
    EXPECT_TRUE(pack(nets.view, a_, options));
    EXPECT_TRUE(pack(turned.view, b_, options));
  }

  [[nodiscard]] std::size_t differences() const {
    const detail::PatchStorage<T>& a = a_.storage()->buckets[0];
    const detail::PatchStorage<T>& b = b_.storage()->buckets[0];
    const detail::NetShape& s = a.shape;
    std::size_t different = 0;
    for (std::size_t cell = 0; cell < s.cells(); ++cell) {
      for (std::size_t e = 0; e < 4; ++e) {
        const EdgeView to = view(cell, e);
        if (exchange_ && !is_outer(cell, e)) {
          continue;
        }
        for (std::size_t c = 0; c < s.channels(); ++c) {
          for (std::size_t k = 0; k < s.edge_powers(); ++k) {
            const std::size_t at = (c * s.edge_powers() + k) * 4;
            const T x = a.edges[cell * s.cell_edges() + at + e];
            const T y = b.edges[to.cell * s.cell_edges() + at + to.edge];
            different += x == (to.reversed && k % 2 == 1 ? -y : y) ? 0 : 1;
          }
          if (a.origins != nullptr) {
            const T x = a.origins[cell * s.cell_origins() + c * 8 + 4 + e];
            const T y = b.origins[to.cell * s.cell_origins() + c * 8 + 4 + to.edge];
            different += x == y ? 0 : 1;
          }
        }
      }
    }
    return different + corner_differences(a, b);
  }

private:
  [[nodiscard]] std::size_t corner_differences(const detail::PatchStorage<T>& a,
                                               const detail::PatchStorage<T>& b) const {
    const detail::NetShape& s = a.shape;
    std::size_t different = 0;
    for (std::size_t cell = 0; cell < s.cells(); ++cell) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const std::size_t u = reverse_u_ ? 1 - corner % 2 : corner % 2;
        const std::size_t v = reverse_v_ ? 1 - corner / 2 : corner / 2;
        const std::size_t to = exchange_ ? u * 2 + v : v * 2 + u;
        if (exchange_ && !is_outer(cell, corner / 2) && !is_outer(cell, 2 + corner % 2)) {
          continue;
        }
        for (std::size_t c = 0; c < s.channels(); ++c) {
          const T x = a.edges[cell * s.cell_edges() + s.corners_at() + c * 4 + corner];
          const T y = b.edges[view(cell, 0).cell * s.cell_edges() + s.corners_at() + c * 4 + to];
          different += x == y ? 0 : 1;
        }
      }
    }
    return different;
  }

  /// Whether an edge of a cell is one of the patch.
  [[nodiscard]] bool is_outer(std::size_t cell, std::size_t e) const {
    const detail::NetShape& s = a_.storage()->buckets[0].shape;
    const std::size_t at = e < 2 ? cell / s.cells_u() : cell % s.cells_u();
    return at == (e % 2 == 0 ? 0 : (e < 2 ? s.cells_v() : s.cells_u()) - 1);
  }

  [[nodiscard]] EdgeView view(std::size_t cell, std::size_t e) const {
    const detail::NetShape& s = a_.storage()->buckets[0].shape;
    std::size_t u = cell % s.cells_u();
    std::size_t v = cell / s.cells_u();
    u = reverse_u_ ? s.cells_u() - 1 - u : u;
    v = reverse_v_ ? s.cells_v() - 1 - v : v;
    const bool along_u = e < 2;
    const bool across_reversed = along_u ? reverse_v_ : reverse_u_;
    std::size_t edge = across_reversed ? e ^ 1 : e;
    edge = exchange_ ? (edge + 2) % 4 : edge;
    const bool reversed = along_u ? reverse_u_ : reverse_v_;
    return {exchange_ ? u * s.cells_v() + v : v * s.cells_u() + u, edge, reversed};
  }

  ShapeCase case_;
  bool reverse_u_;
  bool reverse_v_;
  bool exchange_;
  PatchSet<T> a_;
  PatchSet<T> b_;
};

TEST(PackEdges, edges_and_corners_do_not_depend_on_orientation) {
  for (const ShapeCase& c : all_shapes()) {
    for (unsigned turn = 0; turn < 8; ++turn) {
      for (const bool origins : {false, true}) {
        const bool u = (turn & 1) != 0;
        const bool v = (turn & 2) != 0;
        const bool exchange = (turn & 4) != 0;
        EXPECT_EQ((Turned<float>(c, u, v, exchange, origins).differences()), 0U) << c << turn;
        EXPECT_EQ((Turned<double>(c, u, v, exchange, origins).differences()), 0U) << c << turn;
      }
    }
  }
}

/// The edges of patches of different shapes over the same first row of control points.
template <typename T>
void expect_same_first_edge(int degree_u, bool origins) {
  const RandomNets<T> plain({degree_u, 1}, 1, 31);
  PackOptions options;
  options.local_origin = origins;
  PatchSet<T> expected;
  ASSERT_TRUE(pack(plain.view, expected, options));
  const detail::PatchStorage<T>& a = expected.storage()->buckets[0];
  const auto order = static_cast<std::size_t>(degree_u) + 1;
  for (int degree_v = 1; degree_v <= kMostDegree; ++degree_v) {
    for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
      const ShapeCase c{degree_u, degree_v, 3, weights};
      RandomNets<T> nets(c, 1, 32);
      for (std::size_t i = 0; i < order; ++i) { // a rational edge with weights of 1 is a plain one
        for (std::size_t k = 0; k < c.channels(); ++k) {
          nets.values[i * c.channels() + k] = k < 3 ? plain.values[i * 3 + k] : T(1);
        }
      }
      PatchSet<T> set;
      ASSERT_TRUE(pack(nets.view, set, options));
      const detail::PatchStorage<T>& b = set.storage()->buckets[0];
      for (std::size_t cell = 0; cell < a.shape.cells_u(); ++cell) {
        for (std::size_t k = 0; k < order * 3; ++k) {
          const std::size_t power = k / 3;
          const std::size_t channel = k % 3;
          const T x =
              a.edges[cell * a.shape.cell_edges() + (channel * a.shape.edge_powers() + power) * 4];
          const T y =
              b.edges[cell * b.shape.cell_edges() + (channel * b.shape.edge_powers() + power) * 4];
          EXPECT_EQ(x, y) << c << " power " << power;
        }
      }
    }
  }
}

TEST(PackEdges, an_edge_depends_on_its_own_control_points_only) {
  for (const int degree : {1, 2, 3, 4, 5, 6, 7, 11, 15}) {
    for (const bool origins : {false, true}) {
      expect_same_first_edge<float>(degree, origins);
      expect_same_first_edge<double>(degree, origins);
    }
  }
}

TEST(PackEdges, cells_share_their_edges) {
  const ShapeCase c{9, 7, 2, Weights::cartesian};
  const RandomNets<float> nets(c, 1, 41);
  PatchSet<float> set;
  ASSERT_TRUE(pack(nets.view, set));
  const detail::PatchStorage<float>& s = set.storage()->buckets[0];
  const auto edge = [&](std::size_t cell, std::size_t e, std::size_t k) {
    return s.edges[cell * s.shape.cell_edges() + k * 4 + e];
  };
  for (std::size_t k = 0; k < s.shape.channels() * s.shape.edge_powers(); ++k) {
    EXPECT_EQ(edge(0, detail::kEdgeU1, k), edge(1, detail::kEdgeU0, k));
    EXPECT_EQ(edge(2, detail::kEdgeU1, k), edge(3, detail::kEdgeU0, k));
    EXPECT_EQ(edge(0, detail::kEdgeV1, k), edge(2, detail::kEdgeV0, k));
    EXPECT_EQ(edge(1, detail::kEdgeV1, k), edge(3, detail::kEdgeV0, k));
  }
}

} // namespace
} // namespace simdbezier::tests::pack_edges_test
