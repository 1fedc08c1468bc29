// The caller's memory: layouts, destinations, gaps, fewer and more components than three.
#include <numeric>

#include "tests/curves/curve_results.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::curve_layouts_test {
namespace {

constexpr std::size_t kCurves = 37;

class CurveLayouts : public CurveTest {
protected:
  /// Positions, d1, tangents as vertices of `stride` values that begin `shift` values late.
  template <typename T>
  void records(const CurveSet<T>& set, std::size_t n, std::ptrdiff_t stride, std::size_t shift,
               Destination destination, const CurveResults<T>& expected) {
    const std::size_t samples = kCurves * n;
    std::vector<T> memory(shift + samples * static_cast<std::size_t>(stride) + 32, T(-1));
    const int planes = expected.planes;
    CurveOutputs<T> out;
    const auto group = [&](int member) {
      T* const first = memory.data() + shift + member * planes;
      return Vectors<T>{first, planes > 1 ? first + 1 : nullptr, planes > 2 ? first + 2 : nullptr,
                        stride};
    };
    const int groups = static_cast<int>(stride) / planes;
    out.position = group(0);
    if (groups > 1) {
      out.d1 = group(1);
    }
    if (groups > 2) {
      out.tangent = group(2);
    }
    std::vector<T> curvature(samples + 1, T(-1));
    out.curvature = expected.bent ? curvature.data() : nullptr;
    CallOptions options;
    options.destination = destination;
    options.threads = 2;
    evaluate(set, CurveGrid<T>::uniform(n), out, options);
    const std::size_t outputs[] = {0, 1, 3};
    for (std::size_t k = 0; k < samples; ++k) {
      for (int member = 0; member < std::min(groups, 3); ++member) {
        for (int c = 0; c < planes; ++c) {
          const T value = memory[shift + k * static_cast<std::size_t>(stride) +
                                 static_cast<std::size_t>(member * planes + c)];
          ASSERT_TRUE(
              same_bits(value, expected.at(outputs[member], static_cast<std::size_t>(c), k)))
              << "stride " << stride << " sample " << k << " member " << member;
        }
      }
      ASSERT_TRUE(!expected.bent || same_bits(curvature[k], expected.curvature(k)));
    }
    EXPECT_EQ(curvature[samples], T(-1));
    for (std::size_t k = shift + samples * static_cast<std::size_t>(stride); k < memory.size();
         ++k) {
      ASSERT_EQ(memory[k], T(-1)) << "behind the outputs";
    }
  }

  template <typename T>
  void all_layouts(int components, double ratio) {
    const CurveSet<T> set = packed<T>(random_curves<T>(kCurves, 3, components, ratio, 6));
    const int planes = std::min(components, 3);
    for (const std::size_t n : {3, 16, 21, 64}) {
      CurveResults<T> expected(kCurves * n, components);
      evaluate(set, CurveGrid<T>::uniform(n), expected.outputs());
      for (const Destination destination : {Destination::cache, Destination::memory}) {
        records<T>(set, n, planes, 0, destination, expected);
        records<T>(set, n, planes, 1, destination, expected);
        records<T>(set, n, 2 * planes, 16, destination, expected);
        if (expected.bent) {
          records<T>(set, n, 3 * planes, 5, destination, expected);
          records<T>(set, n, 3 * planes + 2, 0, destination, expected);
        }
        planes_apart<T>(set, n, destination, expected);
      }
    }
  }

  /// Positions alone, in planes that begin at lines and elsewhere.
  template <typename T>
  void planes_apart(const CurveSet<T>& set, std::size_t n, Destination destination,
                    const CurveResults<T>& expected) {
    for (const std::size_t shift : {0, 3}) {
      const std::size_t samples = kCurves * n;
      const std::size_t step = (samples + 63) / 64 * 64 + 64;
      std::vector<T> memory(4 * step, T(-1));
      const std::size_t misaligned = reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
      T* const first = memory.data() + (64 - misaligned) % 64 / sizeof(T) + shift;
      CurveOutputs<T> out;
      out.position = {first, expected.planes > 1 ? first + step : nullptr,
                      expected.planes > 2 ? first + 2 * step : nullptr, 1};
      CallOptions options;
      options.destination = destination;
      evaluate(set, CurveGrid<T>::uniform(n), out, options);
      for (int c = 0; c < expected.planes; ++c) {
        const T* const plane = first + static_cast<std::size_t>(c) * step;
        for (std::size_t k = 0; k < samples; ++k) {
          ASSERT_TRUE(same_bits(plane[k], expected.at(0, static_cast<std::size_t>(c), k)))
              << "n " << n << " shift " << shift << " sample " << k;
        }
        ASSERT_EQ(plane[samples], T(-1)) << "behind the outputs";
      }
    }
  }
};

TEST_P(CurveLayouts, HoldTheSameValues) {
  for (const int components : {1, 2, 3}) {
    for (const double ratio : {0.0, 5.0}) {
      all_layouts<float>(components, ratio);
      all_layouts<double>(components, ratio);
    }
  }
}

TEST_P(CurveLayouts, FirstComponentChoosesThree) {
  const auto batch = random_curves<float>(5, 4, 7, 0, 6);
  const CurveSet<float> set = packed<float>(batch);
  for (int first = 0; first < 7; ++first) {
    const int planes = std::min(3, 7 - first);
    CurveResults<float> results(5 * 8, 1);
    results.planes = planes;
    CallOptions options;
    options.first_component = first;
    evaluate(set, CurveGrid<float>::uniform(8), results.outputs(), options);
    for (std::size_t k = 0; k < 5; ++k) {
      for (int c = 0; c < planes; ++c) {
        EXPECT_EQ(results.at(0, static_cast<std::size_t>(c), 8 * k),
                  batch.at(k, 0, static_cast<std::size_t>(first + c)));
      }
    }
  }
}

TEST_P(CurveLayouts, CountsLeaveGapsUntouched) {
  const CurveSet<double> set = packed<double>(random_curves<double>(kCurves, 3, 3, 0, 6));
  for (const bool equal : {false, true}) {
    std::vector<std::uint32_t> counts;
    std::vector<std::size_t> offsets;
    std::size_t extent = 0;
    for (std::size_t k = 0; k < kCurves; ++k) {
      counts.push_back(equal ? 17 : static_cast<std::uint32_t>(2 + k * k % 23));
      offsets.push_back(extent + (equal ? 0 : k % 3));
      extent = offsets.back() + counts.back();
    }
    const CurveGrids grids{counts, equal ? std::span<const std::size_t>() : offsets};
    for (const auto& [destination, threads] : {std::pair{Destination::cache, 1},
                                               {Destination::cache, 2},
                                               {Destination::cache, 3},
                                               {Destination::memory, 1},
                                               {Destination::memory, 2},
                                               {Destination::memory, 3}}) {
      CurveResults<double> results(extent, 3);
      CallOptions options;
      options.threads = threads;
      options.destination = destination;
      evaluate(set, grids, results.outputs(), options);
      results.expect_guards();
      std::size_t written = 0;
      for (std::size_t k = 0; k < kCurves; ++k) {
        for (; written < offsets[k]; ++written) {
          ASSERT_EQ(results.at(0, 0, written), CurveResults<double>::kUntouched);
        }
        CurveResults<double> alone(counts[k], 3);
        CallOptions one;
        one.first_patch = k;
        one.patch_count = 1;
        evaluate(set, CurveGrid<double>::uniform(counts[k]), alone.outputs(), one);
        for (std::size_t i = 0; i < counts[k]; ++i, ++written) {
          for (std::size_t d = 0; d < 4; ++d) {
            ASSERT_TRUE(same_bits(alone.at(d, 2, i), results.at(d, 2, written)));
          }
          ASSERT_TRUE(same_bits(alone.curvature(i), results.curvature(written)));
        }
      }
    }
  }
}

/// Runs of one curve of every length, and samples of different curves in between.
TEST_P(CurveLayouts, ScatteredSamplesInAnyCompany) {
  const CurveSet<float> set = packed<float>(random_curves<float>(kCurves, 6, 3, 3, 6));
  Random random(1);
  std::vector<std::uint32_t> curve;
  std::vector<float> t;
  for (std::size_t run = 1; run < 60; ++run) {
    const auto k = static_cast<std::uint32_t>(random.below(kCurves));
    for (std::size_t i = 0; i < (run % 3 == 0 ? 1 : run); ++i) {
      curve.push_back(k);
      t.push_back(static_cast<float>(random.unit()));
    }
  }
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    CurveResults<float> together(curve.size(), 3);
    CallOptions options;
    options.destination = destination;
    evaluate(set, CurveSamples<float>{curve, t}, together.outputs(), options);
    together.expect_guards();
    for (std::size_t k = 0; k < curve.size(); ++k) {
      CurveResults<float> alone(1, 3);
      evaluate(set, CurveSamples<float>{{&curve[k], 1}, {&t[k], 1}}, alone.outputs());
      for (std::size_t d = 0; d < 4; ++d) {
        ASSERT_TRUE(same_bits(alone.at(d, 1, 0), together.at(d, 1, k))) << "sample " << k;
      }
      ASSERT_TRUE(same_bits(alone.curvature(0), together.curvature(k))) << "sample " << k;
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(CurveLayouts);

} // namespace
} // namespace simdbezier::tests::curve_layouts_test
