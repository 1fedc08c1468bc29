// Bits that have to be equal: at knots, along edges that two splines share, of reversed and
// exchanged splines, and whatever the instruction set, the threads and the rest of the call.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/splines/spline_models.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {
namespace {

/// Knots that are multiples of 2^-46, so that mirrored ones are exact.
AxisModel dyadic_axis(Random& random, KnotKind kind, int degree, bool cut) {
  AxisModel axis = random_axis(random, kind, degree, cut);
  const auto round = [](double knot) { return std::nearbyint(knot * 0x1p46) * 0x1p-46; };
  for (double& knot : axis.knots) {
    knot = round(knot);
  }
  axis.range = {round(axis.range.begin), round(axis.range.end)};
  return axis;
}

AxisModel reversed(const AxisModel& axis) {
  AxisModel other = axis;
  std::reverse(other.knots.begin(), other.knots.end());
  for (double& knot : other.knots) {
    knot = 3 - knot;
  }
  const auto points = static_cast<double>(axis.points);
  const double end = !axis.knots.empty() ? 3 : axis.periodic ? points : points - axis.degree;
  if (!axis.range.empty()) {
    other.range = {end - axis.range.end, end - axis.range.begin};
  }
  return other;
}

/// Where a parameter lies on the reversed direction, without a rounding.
double reversed_parameter(const AxisModel& axis, double t) {
  const auto points = static_cast<double>(axis.points);
  return (!axis.knots.empty() ? 3 : axis.periodic ? points : points - axis.degree) - t;
}

/// Periodic pieces begin with points 0 to degree; those of the reversed spline with the last ones.
template <typename T>
SurfaceModel<T> reversed_u(const SurfaceModel<T>& model) {
  SurfaceModel<T> other = model;
  other.u = reversed(model.u);
  const std::size_t n = model.u.points;
  for (std::size_t row = 0; row < model.v.points; ++row) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t shift = model.u.periodic ? static_cast<std::size_t>(model.u.degree) : 0;
      const std::size_t from = (2 * n - 1 - k + shift) % n;
      for (std::size_t c = 0; c < model.channels(); ++c) {
        other.at(row, k, c) = model.at(row, from, c);
      }
    }
  }
  return other;
}

template <typename T>
SurfaceModel<T> transposed(const SurfaceModel<T>& model) {
  SurfaceModel<T> other = model;
  std::swap(other.u, other.v);
  for (std::size_t row = 0; row < model.v.points; ++row) {
    for (std::size_t column = 0; column < model.u.points; ++column) {
      for (std::size_t c = 0; c < model.channels(); ++c) {
        other.at(column, row, c) = model.at(row, column, c);
      }
    }
  }
  return other;
}

class JunctionTest : public IsaTest {
protected:
  template <typename T>
  CutSurface<T> cut(const SplineSurface<T>& surface) {
    CutSurface<T> result(surface, {.threads = 1, .isa = isa()});
    expect_ran(result.report.status, take_executed_isa());
    return result;
  }

  /// The last component of positions, as a grid's and as single samples'.
  template <typename T>
  std::vector<T> positions(const SplineSurface<double>& surface, const std::vector<double>& U,
                           double V) {
    PatchSet<T> set;
    EXPECT_TRUE(pack(surface, set));
    std::vector<T> all(2 * U.size());
    for (const bool on_grid : {true, false}) {
      Outputs<T> out;
      out.first_component = surface.components - 1;
      out.position = {all.data() + (on_grid ? 0 : U.size()), nullptr, nullptr};
      const std::vector<double> Vs(on_grid ? 1 : U.size(), V);
      run(Options{}, [&](const Options& how) {
        return on_grid ? evaluate_grid(set, surface, U, Vs, out, how).status
                       : evaluate_samples(set, surface, U, Vs, out, how).status;
      });
    }
    return all;
  }

  /// Calls test(model, name) for surfaces of every kind of knots in both directions.
  template <typename T, typename Test>
  void for_models(std::uint64_t seed, const Test& test) {
    Random random(seed);
    int number = 0;
    for (const KnotKind kind_u : kKnotKinds) {
      for (const KnotKind kind_v : kKnotKinds) {
        for (int turn = 0; turn < 3; ++turn, ++number) {
          const int degree = turn == 2 ? random.integer(6, 15) : random.integer(1, 5);
          const AxisModel u = dyadic_axis(random, kind_u, degree, number % 4 == 1);
          const AxisModel v = dyadic_axis(random, kind_v, random.integer(1, 4), number % 5 == 1);
          const auto weights = static_cast<Weights>(number % 3);
          const auto model = random_surface<T>(random, u, v, random.integer(1, 4), weights);
          if (span_count(model.view()).patches() == 0) {
            continue; // rounding has made knots equal
          }
          SCOPED_TRACE(name_of(kind_u) + " x " + name_of(kind_v) + ", degree " +
                       std::to_string(degree));
          test(model);
          if (HasFatalFailure()) {
            return;
          }
        }
      }
    }
  }
};

template <typename T>
bool are_same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// How often a knot of one direction occurs.
std::size_t times(const AxisModel& axis, double knot) {
  return static_cast<std::size_t>(std::count(axis.knots.begin(), axis.knots.end(), knot));
}

TEST_P(JunctionTest, PiecesMeetBitForBit) {
  for_models<double>(11, [&](const SurfaceModel<double>& model) {
    const CutSurface<double> pieces = cut(model.view());
    const SpanCounts spans = pieces.spans;
    std::size_t junctions = 0;
    for (std::size_t v = 0; v < spans.v; ++v) {
      for (std::size_t u = 0; u < spans.u; ++u) {
        const std::size_t here = v * spans.u + u;
        const bool seam = u + 1 == spans.u;
        if (seam && (!model.u.periodic || !model.u.range.empty() || spans.u == 1)) {
          continue;
        }
        const double knot = pieces.intervals[here].u.end;
        const std::size_t both =
            times(model.u, knot) +
            (seam && !model.u.knots.empty() ? times(model.u, model.u.knots[0]) : 0);
        if (both > static_cast<std::size_t>(model.u.degree) + (seam ? 1U : 0U)) {
          continue; // a gap, which the knots ask for
        }
        const std::size_t next = v * spans.u + (u + 1) % spans.u;
        for (std::size_t j = 0; j < model.v.order(); ++j) {
          for (std::size_t c = 0; c < model.channels(); ++c) {
            ASSERT_TRUE(
                are_same_bits(pieces.at(here, j, model.u.order() - 1, c), pieces.at(next, j, 0, c)))
                << "patch " << here;
            ++junctions;
          }
        }
      }
    }
    EXPECT_TRUE(junctions > 0 || spans.u == 1 || model.u.points < 9);
  });
}

TEST_P(JunctionTest, ReversedSplinesGiveReversedBits) {
  for_models<float>(12, [&](const SurfaceModel<float>& model) {
    const SurfaceModel<float> other = reversed_u(model);
    const CutSurface<float> a = cut(model.view());
    const CutSurface<float> b = cut(other.view());
    ASSERT_EQ(a.spans.u, b.spans.u);
    for (std::size_t patch = 0; patch < a.spans.patches(); ++patch) {
      const std::size_t mirrored =
          patch / a.spans.u * a.spans.u + a.spans.u - 1 - patch % a.spans.u;
      for (std::size_t j = 0; j < model.v.order(); ++j) {
        for (std::size_t i = 0; i < model.u.order(); ++i) {
          for (std::size_t c = 0; c < model.channels(); ++c) {
            ASSERT_TRUE(
                are_same_bits(a.at(patch, j, i, c), b.at(mirrored, j, model.u.order() - 1 - i, c)))
                << "patch " << patch << ", point " << j << " " << i;
          }
        }
      }
    }
  });
}

/// Some parameters in every interval, multiples of 2^-46.
std::vector<double> parameters_in(Random& random, std::span<const PatchInterval> intervals) {
  std::vector<double> all;
  for (const PatchInterval& interval : intervals) {
    for (int k = 0; k < 3; ++k) {
      const double t = interval.u.begin + random.between(0.01, 0.99) * interval.u.length();
      const double rounded = std::nearbyint(t * 0x1p46) * 0x1p-46;
      if (interval.u.begin < rounded && rounded < interval.u.end) {
        all.push_back(rounded);
      }
    }
  }
  return all;
}

TEST_P(JunctionTest, ReversedSplinesHaveTheSamePositionsAtMirroredParameters) {
  Random random(16);
  std::size_t compared = 0;
  for_models<double>(15, [&](const SurfaceModel<double>& model) {
    const SurfaceModel<double> other = reversed_u(model);
    std::vector<PatchInterval> intervals(span_count(model.view()).patches());
    PatchSet<float> set;
    ASSERT_TRUE(pack(model.view(), set, intervals));
    const std::vector<double> U =
        parameters_in(random, std::span(intervals).first(span_count(model.view()).u));
    std::vector<double> mirrored;
    for (const double t : U) {
      mirrored.push_back(reversed_parameter(model.u, t));
    }
    const double V = intervals.front().v.begin;
    EXPECT_EQ(positions<float>(model.view(), U, V), positions<float>(other.view(), mirrored, V));
    EXPECT_EQ(positions<double>(model.view(), U, V), positions<double>(other.view(), mirrored, V));
    compared += U.size();
  });
  EXPECT_GT(compared, 1000U);
}

/// An edge v = begin that is clamped is one spline curve, whichever direction the other surface has
/// it in.
TEST_P(JunctionTest, ClampedEdgesAreTheSameFromBothSides) {
  Random random(13);
  for (const KnotKind kind : kKnotKinds) {
    for (int turn = 0; turn < 12; ++turn) {
      const AxisModel along = dyadic_axis(random, kind, random.integer(1, 7), turn % 3 == 1);
      const AxisModel across = dyadic_axis(random, KnotKind::clamped, 3, false);
      const AxisModel other_across = dyadic_axis(random, KnotKind::clamped, 2, false);
      const auto weights = static_cast<Weights>(turn % 3);
      const auto model = random_surface<double>(random, along, across, 3, weights);
      auto beside = random_surface<double>(random, along, other_across, 3, weights);
      for (std::size_t k = 0; k < along.points; ++k) {
        for (std::size_t c = 0; c < model.channels(); ++c) {
          beside.at(0, k, c) = model.at(0, k, c);
        }
      }
      const CutSurface<double> a = cut(model.view());
      const SurfaceModel<double> turned = transposed(reversed_u(beside));
      const CutSurface<double> b = cut(turned.view());
      for (std::size_t span = 0; span < a.spans.u; ++span) {
        const std::size_t other = (a.spans.u - 1 - span) * b.spans.u;
        for (std::size_t i = 0; i < along.order(); ++i) {
          for (std::size_t c = 0; c < model.channels(); ++c) {
            ASSERT_TRUE(
                are_same_bits(a.at(span, 0, i, c), b.at(other, along.order() - 1 - i, 0, c)))
                << name_of(kind) << ", span " << span;
          }
        }
      }
      for (const std::size_t corner : {std::size_t{0}, along.points - 1}) {
        const bool clamped = kind == KnotKind::clamped && along.range.empty();
        const std::size_t span = corner == 0 ? 0 : a.spans.u - 1;
        for (std::size_t c = 0; clamped && weights != Weights::cartesian && c < model.channels();
             ++c) { // clamped corners are control points
          EXPECT_TRUE(are_same_bits(a.at(span, 0, corner == 0 ? 0 : along.order() - 1, c),
                                    model.at(0, corner, c)));
        }
      }
    }
  }
}

TEST_P(JunctionTest, ThreadsBatchesAndInstructionSetsDoNotMatter) {
  for_models<double>(14, [&](const SurfaceModel<double>& model) {
    const CutSurface<double> alone = cut(model.view());
    const CutSurface<double> scalar(model.view(), {.threads = 3, .isa = available_isas().front()});
    ASSERT_EQ(alone.values, scalar.values);
    // Between two others, to memory with gaps, backwards.
    const SplineSurface<double> three[] = {model.view(), model.view(), model.view()};
    const std::size_t each = alone.values.size();
    const std::size_t patches = 3 * alone.spans.patches();
    std::vector<double> memory(3 * each + patches, -77);
    MutableNets<double> out = alone.nets;
    out.memory = memory;
    out.count = patches;
    out.patch_stride = -(alone.nets.patch_stride + 1);
    out.points = memory.data() - static_cast<std::ptrdiff_t>(patches - 1) * out.patch_stride;
    std::vector<PatchInterval> intervals(patches);
    ASSERT_TRUE(to_bezier(std::span<const SplineSurface<double>>(three), out, intervals,
                          {.threads = 2, .isa = isa()}));
    const auto net = static_cast<std::size_t>(alone.nets.patch_stride);
    for (std::size_t patch = 0; patch < patches; ++patch) {
      const double* const there =
          out.points + static_cast<std::ptrdiff_t>(patch) * out.patch_stride;
      const std::size_t same = patch % alone.spans.patches();
      ASSERT_TRUE(std::equal(there, there + net, alone.values.data() + same * net));
      EXPECT_EQ(there[net], -77);
      EXPECT_EQ(intervals[patch].u, alone.intervals[same].u);
      EXPECT_EQ(intervals[patch].v, alone.intervals[same].v);
    }
  });
}

INSTANTIATE_FOR_EVERY_ISA(JunctionTest);

} // namespace
} // namespace simdbezier::tests
