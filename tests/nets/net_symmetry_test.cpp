// Reversed nets give reversed results, shared edges stay shared, corners and untouched edges stay
// what they are: bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/nets/net_batches.hpp"

namespace simdbezier::tests::net_symmetry_test {
namespace {

constexpr std::size_t kCount = 21;
constexpr Options kOneThread{.threads = 1};

template <typename T>
Batch<T> turned(const Batch<T>& batch, bool in_u, bool in_v) {
  Batch<T> result = batch;
  for (std::size_t p = 0; p < batch.count; ++p) {
    for (int j = 0; j <= batch.shape.degree_v; ++j) {
      for (int i = 0; i <= batch.shape.degree_u; ++i) {
        for (std::size_t c = 0; c < batch.channels(); ++c) {
          result.at(p, j, i, c) = batch.at(p, in_v ? batch.shape.degree_v - j : j,
                                           in_u ? batch.shape.degree_u - i : i, c);
        }
      }
    }
  }
  return result;
}

template <typename T>
std::array<Batch<T>, 4> split_all(const Batch<T>& batch, UnitParameter<T> u, UnitParameter<T> v) {
  std::array<Batch<T>, 4> parts;
  parts.fill(Batch<T>(batch.shape, batch.count));
  EXPECT_TRUE(split(batch.nets(), u, v,
                    {parts[0].out(), parts[1].out(), parts[2].out(), parts[3].out()}, kOneThread));
  return parts;
}

template <typename T>
Batch<T> piece_of(const Batch<T>& batch, const SubPatch<T>& piece) {
  Batch<T> result(batch.shape, batch.count);
  EXPECT_TRUE(segment(batch.nets(), piece, result.out(), kOneThread));
  return result;
}

template <typename T>
Batch<T> elevated(const Batch<T>& batch, int by_u, int by_v) {
  Shape shape = batch.shape;
  shape.degree_u = std::min(shape.degree_u + by_u, kMostDegree);
  shape.degree_v = std::min(shape.degree_v + by_v, kMostDegree);
  Batch<T> result(shape, batch.count);
  EXPECT_TRUE(elevate(batch.nets(), result.out(), kOneThread));
  return result;
}

template <typename T>
class NetSymmetry : public ::testing::Test {};
using Types = ::testing::Types<float, double>;
TYPED_TEST_SUITE(NetSymmetry, Types);

TYPED_TEST(NetSymmetry, FractionsMirrorThemselves) {
  using T = TypeParam;
  constexpr int kLeast = std::numeric_limits<int>::min();
  constexpr int kMost = std::numeric_limits<int>::max();
  for (const auto& [i, n] : {std::pair(0, 1),
                             {1, 3},
                             {-2, 5},
                             {9, 4},
                             {kLeast, 1},
                             {kMost, kMost},
                             {kLeast, kMost},
                             {-1, kMost}}) {
    const UnitParameter<T> at = UnitParameter<T>::fraction(i, n);
    const long double exact = static_cast<long double>(i) / n;
    const long double unit = std::numeric_limits<T>::epsilon();
    EXPECT_LE(std::fabs(at.t() - exact), unit * std::fabs(exact)) << i << "/" << n;
    EXPECT_LE(std::fabs(at.complement() - (1 - exact)), unit * std::fabs(1 - exact))
        << i << "/" << n;
    EXPECT_EQ(at.mirrored().t(), at.complement());
  }
}

TYPED_TEST(NetSymmetry, ReversedNetsGiveReversedResults) {
  using T = TypeParam;
  const UnitParameter<T> u = UnitParameter<T>::fraction(1, 3);
  const UnitParameter<T> v(T(0.9));
  const SubPatch<T> piece{T(0.1), T(0.7), UnitParameter<T>::fraction(1, 7), T(0.5)};
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    const Batch<T> batch = random_batch<T>(shape, kCount, 3);
    const std::array<Batch<T>, 4> parts = split_all(batch, u, v);
    for (int turn = 1; turn < 4; ++turn) {
      const bool in_u = turn % 2 == 1;
      const bool in_v = turn >= 2;
      const Batch<T> back = turned(batch, in_u, in_v);
      const std::array<Batch<T>, 4> back_parts =
          split_all(back, in_u ? u.mirrored() : u, in_v ? v.mirrored() : v);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t mirrored = k ^ static_cast<std::size_t>(turn);
        EXPECT_EQ(differing(turned(back_parts[k], in_u, in_v).values, parts[mirrored].values), 0U);
      }
      SubPatch<T> back_piece = piece;
      if (in_u) {
        back_piece.u0 = piece.u1.mirrored();
        back_piece.u1 = piece.u0.mirrored();
      }
      if (in_v) {
        back_piece.v0 = piece.v1.mirrored();
        back_piece.v1 = piece.v0.mirrored();
      }
      EXPECT_EQ(differing(turned(piece_of(back, back_piece), in_u, in_v).values,
                          piece_of(batch, piece).values),
                0U);
      EXPECT_EQ(
          differing(turned(elevated(back, 3, 2), in_u, in_v).values, elevated(batch, 3, 2).values),
          0U);
    }
    for (const Basis basis : {Basis::catmull_rom, Basis::b_spline}) {
      if (shape.degree_u == 3 && shape.degree_v == 3 && shape.weights == Weights::none) {
        Batch<T> forward = batch;
        Batch<T> backward = batch;
        const Batch<T> back = turned(batch, true, true);
        ASSERT_TRUE(to_bezier(basis, batch.nets(), forward.out()));
        ASSERT_TRUE(to_bezier(basis, back.nets(), backward.out()));
        EXPECT_EQ(differing(turned(backward, true, true).values, forward.values), 0U);
      }
    }
  }
}

TYPED_TEST(NetSymmetry, CallsThatTurnAgreeWithPlainLoops) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    const Batch<T> batch = random_batch<T>(shape, kCount, 4);
    Batch<T> u(shape, kCount);
    Batch<T> v(shape, kCount);
    Batch<T> back({shape.degree_v, shape.degree_u, shape.components, shape.weights}, kCount);
    ASSERT_TRUE(reverse_u(batch.nets(), u.out()));
    ASSERT_TRUE(reverse_v(batch.nets(), v.out()));
    ASSERT_TRUE(transpose(batch.nets(), back.out()));
    EXPECT_EQ(differing(u.values, turned(batch, true, false).values), 0U);
    EXPECT_EQ(differing(v.values, turned(batch, false, true).values), 0U);
    for (int j = 0; j <= shape.degree_v; ++j) {
      for (int i = 0; i <= shape.degree_u; ++i) {
        for (std::size_t c = 0; c < batch.channels(); ++c) {
          EXPECT_EQ(back.at(kCount - 1, i, j, c), batch.at(kCount - 1, j, i, c));
        }
      }
    }
  }
}

// A second patch that shares the first one's edge u = 0 as its own v = 1, the other way round, and
// nothing else. All parameters along the edge are mirrored.
TYPED_TEST(NetSymmetry, SharedEdgesStayShared) {
  using T = TypeParam;
  const UnitParameter<T> along = UnitParameter<T>::fraction(2, 7);
  const UnitParameter<T> across(T(0.3));
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    const Batch<T> a = random_batch<T>(shape, kCount, 5);
    Shape other = shape;
    other.degree_u = shape.degree_v;
    other.degree_v = 4;
    Batch<T> b = random_batch<T>(other, kCount, 6);
    const auto each = [&](const Batch<T>& in_a, auto& in_b, auto visit) {
      const int degree = in_a.shape.degree_v;
      for (std::size_t p = 0; p < kCount; ++p) {
        for (int k = 0; k <= degree; ++k) {
          for (std::size_t c = 0; c < in_a.channels(); ++c) {
            visit(in_a.at(p, k, 0, c), in_b.at(p, in_b.shape.degree_v, degree - k, c));
          }
        }
      }
    };
    const auto expect_shared = [&](const Batch<T>& in_a, const Batch<T>& in_b, const char* what) {
      std::size_t differences = 0;
      each(in_a, in_b, [&](T x, T y) { differences += same_bits(x, y) ? 0U : 1U; });
      EXPECT_EQ(differences, 0U) << what;
    };
    each(a, b, [](T x, T& y) { y = x; });
    expect_shared(a, b, "before");

    const auto parts_a = split_all(a, across, along);
    const auto parts_b = split_all(b, along.mirrored(), UnitParameter<T>(T(0.5)));
    expect_shared(parts_a[0], parts_b[3], "split, first half");
    expect_shared(parts_a[2], parts_b[2], "split, second half");

    const UnitParameter<T> from(T(0.2));
    expect_shared(piece_of<T>(a, {T(0), across, from, along}),
                  piece_of<T>(b, {along.mirrored(), from.mirrored(), across, T(1)}), "piece");
    if (shape.degree_v < kMostDegree) {
      expect_shared(elevated(a, 2, 1), elevated(b, 1, 0), "elevation");
    }
  }
}

// Neighbouring pieces of one patch meet in bit-equal points, and [0, u] is the half that a cut
// gives.
TYPED_TEST(NetSymmetry, PiecesMeet) {
  using T = TypeParam;
  const UnitParameter<T> at(T(0.3));
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    const Batch<T> batch = random_batch<T>(shape, kCount, 7);
    const Batch<T> left = piece_of<T>(batch, {T(0.1), at, T(0), T(1)});
    const Batch<T> right = piece_of<T>(batch, {at, T(0.8), T(0), T(1)});
    Batch<T> low(shape, kCount);
    Batch<T> high(shape, kCount);
    ASSERT_TRUE(split_u(batch.nets(), at, low.out(), high.out()));
    for (std::size_t p = 0; p < kCount; ++p) {
      for (int j = 0; j <= shape.degree_v; ++j) {
        for (std::size_t c = 0; c < batch.channels(); ++c) {
          EXPECT_EQ(left.at(p, j, shape.degree_u, c), right.at(p, j, 0, c));
          EXPECT_EQ(low.at(p, j, shape.degree_u, c), right.at(p, j, 0, c));
          // What the cut does not touch stays, weights and all.
          EXPECT_EQ(low.at(p, j, 0, c), batch.at(p, j, 0, c));
          EXPECT_EQ(high.at(p, j, shape.degree_u, c), batch.at(p, j, shape.degree_u, c));
        }
      }
    }
    EXPECT_EQ(differing(piece_of<T>(batch, {T(0), at, T(0), T(1)}).values, low.values), 0U);
    EXPECT_EQ(differing(piece_of<T>(batch, {at, T(1), T(0), T(1)}).values, high.values), 0U);
    EXPECT_EQ(differing(piece_of<T>(batch, {}).values, batch.values), 0U);
  }
}

TYPED_TEST(NetSymmetry, CornersStayExact) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    const Batch<T> batch = random_batch<T>(shape, kCount, 8, 10, 100);
    const auto parts = split_all(batch, UnitParameter<T>(T(0.7)), UnitParameter<T>(T(0.6)));
    const Batch<T> higher = elevated(batch, 2, 3);
    for (std::size_t p = 0; p < kCount; ++p) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto end = [&](const Shape& s, bool v) {
          return corner / (v ? 2 : 1) % 2 == 0 ? 0 : v ? s.degree_v : s.degree_u;
        };
        for (std::size_t c = 0; c < batch.channels(); ++c) {
          const T exact = batch.at(p, end(shape, true), end(shape, false), c);
          EXPECT_EQ(parts[corner].at(p, end(shape, true), end(shape, false), c), exact);
          EXPECT_EQ(higher.at(p, end(higher.shape, true), end(higher.shape, false), c), exact);
        }
      }
    }
  }
}

// An edge that is one point stays one, also with parameters at which (1-t) a + t a is not a, and
// with different weights where these do not move it.
TYPED_TEST(NetSymmetry, CollapsedEdgesStayCollapsed) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    Batch<T> batch = random_batch<T>(shape, kCount, 9);
    const auto compared = [&](const Batch<T>& of) {
      return shape.weights == Weights::cartesian ? of.channels() - 1 : of.channels();
    };
    for (std::size_t p = 0; p < kCount; ++p) {
      for (int i = 1; i <= shape.degree_u; ++i) {
        for (std::size_t c = 0; c < compared(batch); ++c) {
          batch.at(p, 0, i, c) = batch.at(p, 0, 0, c);
        }
      }
    }
    const auto expect_collapsed = [&](const Batch<T>& result, const char* what) {
      for (std::size_t p = 0; p < kCount; ++p) {
        for (int i = 1; i <= result.shape.degree_u; ++i) {
          for (std::size_t c = 0; c < compared(result); ++c) {
            ASSERT_EQ(result.at(p, 0, i, c), result.at(p, 0, 0, c)) << what;
          }
        }
      }
    };
    for (const T t : {T(0.1), T(0.3), T(0.9)}) {
      const auto parts = split_all(batch, UnitParameter<T>(t), UnitParameter<T>(t));
      expect_collapsed(parts[0], "split");
      expect_collapsed(parts[1], "split");
      expect_collapsed(piece_of<T>(batch, {t, T(0.95), T(0), T(1)}), "piece");
      expect_collapsed(elevated(batch, 3, 1), "elevation");
    }
  }
}

} // namespace
} // namespace simdbezier::tests::net_symmetry_test
