// Curves on patches: boundaries have the patch's own bits, iso-parametric curves its points.
#include "tests/curves/curve_results.hpp"
#include "tests/curves/iso_batch.hpp"

namespace simdbezier::tests::curve_patches_test {
namespace {

constexpr PatchEdge kBoundaries[] = {PatchEdge::v0, PatchEdge::v1, PatchEdge::u0, PatchEdge::u1};

class CurvesOnPatches : public CurveTest {
protected:
  /// Every boundary curve at n samples, against the patch's own grid.
  template <typename T, typename S>
  void boundaries(const NetBatch<S>& nets, const PackOptions& options) {
    constexpr std::size_t kSamples = 19;
    PatchSet<T> patches;
    const Report report = pack(nets.view(), patches, options);
    ASSERT_TRUE(report);
    const std::size_t plane = nets.count * kSamples * kSamples;
    std::vector<T> values(3 * plane);
    Outputs<T> out;
    out.position = Vectors<T>::planes(&values[0], &values[plane], &values[2 * plane]);
    grid(patches, Grid<T>::uniform(kSamples, kSamples), out);
    for (const PatchEdge boundary : kBoundaries) {
      CurveSet<T> curves;
      ASSERT_TRUE(pack(boundary_curves(nets.view(), boundary), curves, options));
      CurveResults<T> results(nets.count * kSamples, 3);
      evaluate(curves, CurveGrid<T>::uniform(kSamples), results.outputs());
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        for (std::size_t i = 0; i < kSamples; ++i) {
          const bool along_u = boundary == PatchEdge::v0 || boundary == PatchEdge::v1;
          const bool far = boundary == PatchEdge::v1 || boundary == PatchEdge::u1;
          const std::size_t fixed = far ? kSamples - 1 : 0;
          const std::size_t at =
              (patch * kSamples + (along_u ? fixed : i)) * kSamples + (along_u ? i : fixed);
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_TRUE(same_bits(values[c * plane + at], results.at(0, c, patch * kSamples + i)))
                << "boundary " << static_cast<int>(boundary) << " patch " << patch << " sample "
                << i;
          }
        }
      }
    }
  }

  template <typename T, typename S>
  void iso_curves(const NetBatch<S>& nets) {
    PatchSet<T> patches;
    const Report report = pack(nets.view(), patches);
    ASSERT_TRUE(report);
    constexpr std::size_t kSamples = 7;
    const T t[kSamples] = {T(0), T(0.125), T(0.375), T(0.5), T(0.6875), T(0.9375), T(1)};
    const std::size_t plane = nets.count * kSamples * kSamples;
    std::vector<T> values(3 * plane);
    Outputs<T> out;
    out.position = Vectors<T>::planes(&values[0], &values[plane], &values[2 * plane]);
    grid(patches, Grid<T>{kSamples, kSamples, t, t}, out);
    for (std::size_t fixed = 0; fixed < kSamples; ++fixed) {
      CurveSet<T> u_curves;
      CurveSet<T> v_curves;
      ASSERT_TRUE(iso_u(nets.view(), static_cast<double>(t[fixed]), u_curves));
      ASSERT_TRUE(iso_v(nets.view(), static_cast<double>(t[fixed]), v_curves));
      EXPECT_EQ(u_curves.degree(), nets.degree_v);
      EXPECT_EQ(v_curves.degree(), nets.degree_u);
      CurveResults<T> along_v(nets.count * kSamples, 3);
      CurveResults<T> along_u(nets.count * kSamples, 3);
      evaluate(u_curves, CurveGrid<T>{kSamples, t}, along_v.outputs());
      evaluate(v_curves, CurveGrid<T>{kSamples, t}, along_u.outputs());
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        const ErrorBounds patch_bounds = error_bounds(patches, patch, isa());
        const CurveErrorBounds u_bounds = error_bounds(u_curves, patch, isa());
        const CurveErrorBounds v_bounds = error_bounds(v_curves, patch, isa());
        for (std::size_t i = 0; i < kSamples; ++i) {
          for (std::size_t c = 0; c < 3; ++c) {
            const double own_u =
                static_cast<double>(values[c * plane + (patch * kSamples + i) * kSamples + fixed]);
            const double own_v =
                static_cast<double>(values[c * plane + (patch * kSamples + fixed) * kSamples + i]);
            const std::size_t k = patch * kSamples + i;
            const double iso = 32 * 0x1p-53;
            ASSERT_LE(std::fabs(static_cast<double>(along_v.at(0, c, k)) - own_u),
                      patch_bounds.position[c] + u_bounds.position[c] + iso);
            ASSERT_LE(std::fabs(static_cast<double>(along_u.at(0, c, k)) - own_v),
                      patch_bounds.position[c] + v_bounds.position[c] + iso);
          }
        }
      }
    }
  }
};

TEST_P(CurvesOnPatches, BicubicBoundariesHaveTheBitsOfThePatch) {
  PackOptions options;
  PackOptions origins;
  origins.local_origin = true;
  PackOptions moved;
  moved.relative_to[0] = 0.3;
  moved.relative_to[2] = -100;
  for (const PackOptions& how : {options, origins, moved}) {
    boundaries<float>(NetBatch<float>(23, 3, 3, 0, 1), how);
    boundaries<double>(NetBatch<double>(23, 3, 3, 0, 1), how);
    boundaries<float>(NetBatch<double>(23, 3, 3, 0, 1), how);
    boundaries<double>(NetBatch<float>(23, 3, 3, 0, 1), how);
  }
}

TEST_P(CurvesOnPatches, BicubicIsoCurvesHaveItsPoints) {
  iso_curves<float>(NetBatch<float>(9, 3, 3, 0, 2));
  iso_curves<double>(NetBatch<double>(9, 3, 3, 0, 2));
}

TEST_P(CurvesOnPatches, BoundariesOfAllShapes) {
  for (int m = 1; m <= kMostDegree; ++m) {
    for (const double ratio : {0.0, 4.0}) {
      for (const bool origins : {false, true}) {
        PackOptions options;
        options.local_origin = origins;
        boundaries<float>(NetBatch<float>(3, m, 16 - m, ratio, 3), options);
        boundaries<double>(NetBatch<double>(3, m, 16 - m, ratio, 3), options);
      }
    }
  }
}

TEST_P(CurvesOnPatches, IsoCurvesOfAllShapes) {
  const int degrees[][2] = {{1, 1}, {2, 3}, {5, 4}, {6, 3}, {3, 7}, {9, 15}};
  for (const auto& [m, n] : degrees) {
    for (const double ratio : {0.0, 4.0}) {
      iso_curves<float>(NetBatch<float>(5, m, n, ratio, 3));
      iso_curves<double>(NetBatch<double>(5, m, n, ratio, 3));
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(CurvesOnPatches);

} // namespace
} // namespace simdbezier::tests::curve_patches_test
