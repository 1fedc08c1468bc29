// Equal bits: reversed curves, other calls, other places in a batch, threads, instruction sets.
#include <map>
#include <numeric>

#include "tests/curves/curve_results.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::curve_bits_test {
namespace {

struct Kind {
  int degree;
  int components;
  double ratio;
  bool origins = false;
};

/// Every way through the kernels: compile-time degrees and the general one, halves, weights.
const Kind kKinds[] = {{1, 3, 0},  {2, 3, 0},  {3, 3, 0},       {3, 2, 0},      {4, 3, 0},
                       {5, 3, 0},  {6, 3, 0},  {7, 2, 0},       {11, 3, 0},     {15, 3, 0},
                       {1, 3, 10}, {3, 3, 10}, {3, 2, 3},       {6, 3, 10},     {15, 3, 10},
                       {3, 1, 0},  {8, 1, 4},  {3, 3, 0, true}, {9, 3, 3, true}};

std::string name_of(const Kind& kind) {
  return "degree " + std::to_string(kind.degree) + " components " +
         std::to_string(kind.components) + " ratio " + std::to_string(kind.ratio) +
         (kind.origins ? " origins" : "");
}

class CurveBits : public CurveTest {
protected:
  template <typename T>
  static CurveSet<T> set_of(const Kind& kind, std::size_t count) {
    PackOptions options;
    options.local_origin = kind.origins;
    return packed<T>(random_curves<T>(count, kind.degree, kind.components, kind.ratio, 3), options);
  }

  template <typename T>
  void reversal(const Kind& kind, std::size_t n) {
    constexpr std::size_t kCurves = 11;
    PackOptions options;
    options.local_origin = kind.origins;
    const auto batch = random_curves<T>(kCurves, kind.degree, kind.components, kind.ratio, 9);
    CurveResults<T> forward(kCurves * n, kind.components);
    CurveResults<T> backward(kCurves * n, kind.components);
    evaluate(packed<T>(batch, options), CurveGrid<T>::uniform(n), forward.outputs());
    evaluate(packed<T>(batch.reversed(), options), CurveGrid<T>::uniform(n), backward.outputs());
    for (std::size_t k = 0; k < kCurves; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        for (int c = 0; c < forward.planes; ++c) {
          const auto component = static_cast<std::size_t>(c);
          ASSERT_TRUE(same_bits(forward.at(0, component, k * n + i),
                                backward.at(0, component, k * n + n - 1 - i)))
              << name_of(kind) << " n " << n << " curve " << k << " sample " << i;
        }
      }
    }
  }

  template <typename T>
  void calls(const Kind& kind) {
    constexpr std::size_t kCurves = 9;
    const CurveSet<T> set = set_of<T>(kind, kCurves);
    for (const std::size_t n : {2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 33}) {
      CurveResults<T> grid(kCurves * n, kind.components);
      evaluate(set, CurveGrid<T>::uniform(n), grid.outputs());
      grid.expect_guards();

      const std::vector<std::uint32_t> counts(kCurves, static_cast<std::uint32_t>(n));
      CurveResults<T> counted(kCurves * n, kind.components);
      evaluate(set, CurveGrids{counts}, counted.outputs());
      ASSERT_EQ(grid.hash(), counted.hash()) << name_of(kind) << " n " << n;

      std::vector<std::uint32_t> curve;
      std::vector<T> x;
      for (std::size_t k = 0; k < kCurves * n; ++k) {
        curve.push_back(static_cast<std::uint32_t>(k / n));
        x.push_back(static_cast<T>(2 * uniform_x<T>(k % n, n)));
      }
      CurveResults<T> scattered(kCurves * n, kind.components);
      const CurveSamples<T> samples{curve, x, Parameters::centred};
      evaluate(set, samples, scattered.outputs());
      ASSERT_EQ(grid.hash(), scattered.hash()) << name_of(kind) << " n " << n;

      CurveResults<T> given(kCurves * n, kind.components);
      evaluate(set, CurveGrid<T>{n, x.data(), Parameters::centred}, given.outputs());
      ASSERT_EQ(grid.hash(), given.hash()) << name_of(kind) << " n " << n;
    }
  }

  template <typename T>
  void alone(const Kind& kind, std::size_t samples) {
    constexpr std::size_t kCurves = 40;
    const CurveSet<T> set = set_of<T>(kind, kCurves);
    CurveResults<T> together(kCurves * samples, kind.components);
    evaluate(set, CurveGrid<T>::uniform(samples), together.outputs());
    for (const int threads : {2, 5}) {
      CurveResults<T> shared(kCurves * samples, kind.components);
      CallOptions options;
      options.threads = threads;
      evaluate(set, CurveGrid<T>::uniform(samples), shared.outputs(), options);
      ASSERT_EQ(together.hash(), shared.hash()) << name_of(kind);
    }
    // A call for one group of outputs takes other kernels than one for all of them.
    for (std::size_t d = 0; d < 3; ++d) {
      CurveResults<T> one(kCurves * samples, kind.components);
      const CurveOutputs<T> all = one.outputs();
      CurveOutputs<T> out;
      (d == 0   ? out.position
       : d == 1 ? out.d1
                : out.d2) = d == 0   ? all.position
                            : d == 1 ? all.d1
                                     : all.d2;
      CallOptions options;
      options.first_patch = 3;
      options.patch_count = kCurves - 5;
      evaluate(set, CurveGrid<T>::uniform(samples), out, options);
      for (std::size_t k = 0; k < (kCurves - 5) * samples; ++k) {
        for (int c = 0; c < one.planes; ++c) {
          const auto component = static_cast<std::size_t>(c);
          ASSERT_TRUE(
              same_bits(one.at(d, component, k), together.at(d, component, k + 3 * samples)))
              << name_of(kind) << " output " << d << " sample " << k;
        }
      }
    }
  }
};

TEST_P(CurveBits, ReversedCurvesMirrorTheirPositions) {
  for (const Kind& kind : kKinds) {
    for (const std::size_t n : {2, 3, 8, 9, 33}) {
      reversal<float>(kind, n);
      reversal<double>(kind, n);
    }
  }
}

TEST_P(CurveBits, AllCallsAgree) {
  for (const Kind& kind : kKinds) {
    calls<float>(kind);
    calls<double>(kind);
  }
}

TEST_P(CurveBits, CompanyAndThreadsDoNotMatter) {
  for (const Kind& kind : kKinds) {
    for (const std::size_t samples : {13, 33}) {
      alone<float>(kind, samples);
      alone<double>(kind, samples);
    }
  }
}

TEST_P(CurveBits, PackingDoesNotDependOnTheInstructionSet) {
  for (const Kind& kind : kKinds) {
    const auto batch = random_curves<double>(21, kind.degree, kind.components, kind.ratio, 31);
    std::map<Isa, std::uint64_t> hashes;
    for (const Isa packer : available_isas()) {
      PackOptions options;
      options.isa = packer;
      options.local_origin = kind.origins;
      options.threads = 2;
      CurveResults<double> results(21 * 9, kind.components);
      CurveResults<float> singles(21 * 9, kind.components);
      evaluate(packed<double>(batch, options), CurveGrid<double>::uniform(9), results.outputs());
      evaluate(packed<float>(batch, options), CurveGrid<float>::uniform(9), singles.outputs());
      hashes[packer] = results.hash() ^ singles.hash();
      EXPECT_EQ(hashes[packer], hashes.begin()->second) << name_of(kind) << to_string(packer);
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(CurveBits);

/// The bits of all instruction sets that fuse agree, and those of all that do not.
TEST(CurveClasses, InstructionSetsOfAClassAgree) {
  for (const Kind& kind : kKinds) {
    PackOptions options;
    options.local_origin = kind.origins;
    CurveSet<float> set;
    ASSERT_TRUE(pack(random_curves<float>(33, kind.degree, kind.components, kind.ratio, 8).view(),
                     set, options));
    std::map<bool, std::uint64_t> hashes;
    for (const Isa isa : available_isas()) {
      CurveResults<float> results(33 * 12, kind.components);
      CallOptions how;
      how.isa = isa;
      ASSERT_EQ(evaluate(set, CurveGrid<float>::uniform(12), results.outputs(), how), Status::ok);
      const auto [known, first] = hashes.emplace(fuses_multiply_add(isa), results.hash());
      EXPECT_EQ(known->second, results.hash()) << name_of(kind) << " " << to_string(isa);
    }
  }
}

/// More samples than a chunk holds, in one curve and in many.
TEST(CurveStrips, LongCurvesAreCutWithoutATrace) {
  CurveSet<float> set;
  ASSERT_TRUE(pack(random_curves<float>(3, 3, 3, 0, 4).view(), set));
  constexpr std::size_t kSamples = 150001;
  std::vector<float> t(kSamples);
  std::vector<std::uint32_t> curve(3 * kSamples);
  std::vector<float> all(3 * kSamples);
  for (std::size_t k = 0; k < 3 * kSamples; ++k) {
    curve[k] = static_cast<std::uint32_t>(k / kSamples);
    all[k] = static_cast<float>(2 * uniform_x<float>(k % kSamples, kSamples));
  }
  CurveResults<float> scattered(3 * kSamples, 3);
  ASSERT_EQ(
      evaluate(set, CurveSamples<float>{curve, all, Parameters::centred}, scattered.outputs()),
      Status::ok);
  const std::vector<std::uint32_t> counts(3, static_cast<std::uint32_t>(kSamples));
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    for (const int threads : {1, 2, 7}) {
      CallOptions options;
      options.destination = destination;
      options.threads = threads;
      CurveResults<float> grid(3 * kSamples, 3);
      ASSERT_EQ(evaluate(set, CurveGrid<float>::uniform(kSamples), grid.outputs(), options),
                Status::ok);
      EXPECT_EQ(grid.hash(), scattered.hash()) << threads;
      CurveResults<float> counted(3 * kSamples, 3);
      ASSERT_EQ(evaluate(set, CurveGrids{counts}, counted.outputs(), options), Status::ok);
      EXPECT_EQ(counted.hash(), scattered.hash()) << threads;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::curve_bits_test
