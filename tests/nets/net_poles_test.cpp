// Operations on rational nets leave sides that are one point as they are, whatever the weights
// there: what is copied, cut, raised or converted has a pole where the input has one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/long_form.hpp"
#include "tests/support/nets/pole_shapes.hpp"

namespace simdbezier::tests::net_poles_test {
namespace {

template <typename T>
class NetPoles : public testing::Test {
protected:
  /// Sides whose points are one: Cartesian ones exactly, homogeneous ones as near as
  /// src/storage/one_point.hpp says, by division in long double.
  static bool is_pole(const PoleNet<T>& net) {
    const bool divided = net.shape.form == Weights::homogeneous;
    const long double tolerance = divided ? 8 * std::numeric_limits<T>::epsilon() : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      long double low = HUGE_VALL;
      long double high = -HUGE_VALL;
      for (int k = 0; k <= net.shape.along(); ++k) {
        const long double x = net.point(net.shape.at(0, k))[c];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (high - low > tolerance * std::max(-low, high)) {
        return false;
      }
    }
    return true;
  }

  /// A result of other degrees with the pole on the same side.
  static PoleNet<T> room(const PoleNet<T>& net, int more = 0) {
    PoleNet<T> result{net.shape, {}};
    result.shape.degree_u += more;
    result.shape.degree_v += more;
    result.values.resize(
        static_cast<std::size_t>(4 * (result.shape.degree_u + 1) * (result.shape.degree_v + 1)));
    return result;
  }
  static MutableNets<T> out(PoleNet<T>& net) {
    return MutableNets<T>::packed(net.values.data(), 1, net.shape.degree_u, net.shape.degree_v, 3,
                                  net.shape.form);
  }

  /// The half that has the pole, cut along the side or across it.
  static PoleNet<T> half(const PoleNet<T>& net, bool along, T t, Random& random) {
    PoleNet<T> low = room(net);
    PoleNet<T> high = room(net);
    const bool in_u = net.shape.along_u() == along;
    const auto cut = in_u ? split_u<T>(net.nets(), t, out(low), out(high))
                          : split_v<T>(net.nets(), t, out(low), out(high));
    EXPECT_TRUE(cut);
    const bool upper = along ? random.below(2) != 0 : net.shape.at_end();
    return upper ? high : low;
  }

  static void test_all(const std::function<void(const PoleNet<T>&, Random&)>& test) {
    Random random(41);
    constexpr int kDegrees[][2] = {{1, 2}, {2, 2}, {3, 3}, {5, 3}, {4, 7}};
    for (const auto& degrees : kDegrees) {
      for (int side = 0; side < 4; ++side) {
        for (const Weights form : {Weights::cartesian, Weights::homogeneous}) {
          for (int k = 0; k < (long_form() ? 200 : 20); ++k) {
            SCOPED_TRACE(testing::Message()
                         << degrees[0] << " x " << degrees[1] << ", side " << side << ", form "
                         << static_cast<int>(form) << ", net " << k);
            const double scale = k % 3 == 0 ? 1 : 0.1;
            test(pole_net<T>({degrees[0], degrees[1], side, form}, k % 2 == 0 ? 3 : 0.1, scale,
                             random),
                 random);
          }
        }
      }
    }
  }
};
using Types = testing::Types<float, double>;
TYPED_TEST_SUITE(NetPoles, Types);

TYPED_TEST(NetPoles, are_raised) {
  this->test_all([&](const PoleNet<TypeParam>& net, Random&) {
    PoleNet<TypeParam> raised = this->room(net, 3);
    ASSERT_TRUE(elevate<TypeParam>(net.nets(), this->out(raised)));
    EXPECT_TRUE(this->is_pole(raised));
  });
}

TYPED_TEST(NetPoles, are_cut_again_and_again) {
  this->test_all([&](const PoleNet<TypeParam>& given, Random& random) {
    PoleNet<TypeParam> net = given;
    for (int level = 0; level < 12; ++level) {
      const auto t = static_cast<TypeParam>(level % 2 == 0 ? 0.5 : random.between(0.3, 0.7));
      net = this->half(net, level % 3 != 0, t, random);
      ASSERT_TRUE(this->is_pole(net)) << "level " << level;
    }
  });
}

TYPED_TEST(NetPoles, are_in_their_pieces) {
  this->test_all([&](const PoleNet<TypeParam>& net, Random&) {
    SubPatch<TypeParam> piece;
    (net.shape.along_u() ? piece.u0 : piece.v0) = TypeParam(0.3);
    (net.shape.along_u() ? piece.u1 : piece.v1) = TypeParam(0.9);
    if (net.shape.at_end()) {
      (net.shape.along_u() ? piece.v0 : piece.u0) = TypeParam(0.6);
    } else {
      (net.shape.along_u() ? piece.v1 : piece.u1) = TypeParam(0.6);
    }
    PoleNet<TypeParam> part = this->room(net);
    ASSERT_TRUE(segment<TypeParam>(net.nets(), piece, this->out(part)));
    EXPECT_TRUE(this->is_pole(part));
  });
}

// The side itself as a curve stands still, whatever is kept of its points.
TYPED_TEST(NetPoles, are_curves_that_are_points) {
  this->test_all([&](const PoleNet<TypeParam>& net, Random&) {
    const double at = net.shape.at_end() ? 1 : 0;
    CurveSet<TypeParam> set;
    ASSERT_TRUE(net.shape.along_u() ? iso_v(net.nets(), at, set) : iso_u(net.nets(), at, set));
    const TypeParam t[] = {TypeParam(0), TypeParam(0.3), TypeParam(1)};
    TypeParam slope[9];
    SampleStatus status[3];
    CurveOutputs<TypeParam> out;
    out.d1 = Vectors<TypeParam>::xyz(slope);
    out.status = status;
    ASSERT_EQ(evaluate(set, CurveGrid<TypeParam>::at(t), out), Status::ok);
    EXPECT_EQ(std::count(slope, slope + 9, TypeParam(0)), 9);
  });
}

// All lines of a uniform mesh but the last one in one point, whose weights differ: the surface ends
// there, and as many lines of its net are that point. Means of many points have many roundings.
TYPED_TEST(NetPoles, of_splines) {
  using T = TypeParam;
  Random random(42);
  for (int k = 0; k < (long_form() ? 4000 : 400); ++k) {
    const int degree = k % 4 < 3 ? 3 : 4 + k / 4 % 12;
    SCOPED_TRACE(testing::Message() << "mesh " << k << ", degree " << degree);
    const PoleShape shape{degree, degree, k / 4 % 4,
                          k / 16 % 2 == 0 ? Weights::cartesian : Weights::homogeneous};
    PoleNet<T> mesh = pole_net<T>(shape, 3, 1, random);
    const bool exact = k % 3 == 0; // products of points and weights
    const double pole[3] = {exact ? random.integer(-9, 9) : decimal(random, -99, 99),
                            exact ? random.integer(-9, 9) : decimal(random, -99, 99), 3};
    for (int line = 0; line < degree; ++line) {
      for (int i = 0; i <= degree; ++i) {
        T* const to = mesh.values.data() + 4 * shape.at(line, i);
        to[3] = static_cast<T>(random.integer(1, 30) / (exact ? 8.0 : 10.0));
        for (int c = 0; c < 3; ++c) {
          to[c] = static_cast<T>(
              shape.form == Weights::homogeneous ? pole[c] * static_cast<double>(to[3]) : pole[c]);
        }
      }
    }
    SplineSurface<T> view;
    view.points = mesh.values.data();
    view.degree_u = view.degree_v = degree;
    view.rows = view.columns = static_cast<std::size_t>(degree) + 1;
    view.row_stride = 4 * (degree + 1);
    view.point_stride = 4;
    view.weights = shape.form;
    PoleNet<T> net = this->room(mesh);
    ASSERT_TRUE(to_bezier<T>(view, this->out(net)));
    ASSERT_TRUE(this->is_pole(net));
    for (int n = 0; exact && n < degree * (degree + 1); ++n) {
      const T* const at = net.values.data() + 4 * shape.at(n / (degree + 1), n % (degree + 1));
      for (std::size_t c = 0; c < 3; ++c) { // rounded once
        const double right = shape.form == Weights::homogeneous ? pole[c] * double{at[3]} : pole[c];
        ASSERT_EQ(at[c], static_cast<T>(right));
      }
    }
    if (degree > 3) {
      continue; // the last line hardly counts beside the roundings of normals
    }
    PatchSet<T> set;
    ASSERT_TRUE(pack(net.nets(), set));
    const T at[] = {T(0.25), T(0.5), T(0.75)};
    const T end[] = {shape.at_end() ? T(1) : T(0)};
    T normal[9];
    SampleStatus status[3];
    Outputs<T> outputs;
    outputs.normal = Vectors<T>::xyz(normal);
    outputs.status = status;
    const std::span<const T> along(at);
    const std::span<const T> across(end);
    const Grid<T> grid = shape.along_u() ? Grid<T>::at(along, across) : Grid<T>::at(across, along);
    ASSERT_EQ(evaluate(set, grid, outputs), Status::ok);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3L right = net.normal(at[i], 3);
      EXPECT_LE(distance({normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]}, right),
                sizeof(T) == sizeof(float) ? 1.7e-5L : 1e-12L);
      EXPECT_EQ(status[i], SampleStatus::limit);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::net_poles_test
