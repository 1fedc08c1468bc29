// The gates of the suite on patches of every degree and with weights: a small sample of each
// family, on every instruction set.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/gates.hpp"
#include "tests/properties/accuracy/judge/library_evaluator.hpp"
#include "tests/properties/accuracy/judge/prepared.hpp"
#include "tests/properties/accuracy/judge/scalar_evaluators.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/shape_families.hpp"

namespace simdbezier::tests::shape_gates_test {
namespace {

constexpr std::size_t kNets = 8;
constexpr std::size_t kSamplesPerNet = 24;

template <typename T>
[[nodiscard]] const Prepared<T>& prepared() {
  static const Prepared<T> instance(
      shape_families<T>(kNets, kSamplesPerNet),
      []<bool kFused>(const Family<T>& family, const Reference& at_unit) {
        ScalarEvaluator<T, DeCasteljau<T, WeightedLerp<T, kFused>>> evaluator;
        return measure(evaluator, family, at_unit)[Quantity::position].rms();
      });
  return instance;
}

class ShapesTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] Measurement run(std::size_t f, const PackOptions& packing) {
    LibraryEvaluator<T> evaluator(isa(), packing);
    const Measurement measured =
        measure(evaluator, prepared<T>().families[f], prepared<T>().references[f]);
    expect_ran(Status::ok, evaluator.executed());
    return measured;
  }

  /// G1, G6 and the patches' own certificates, on every family.
  template <typename T>
  void expect_gates(const PackOptions& packing) {
    double tightest = 0;
    for (std::size_t f = 0; f < prepared<T>().families.size(); ++f) {
      const std::string& name = prepared<T>().families[f].name;
      const Measurement measured = run<T>(f, packing);
      expect_bounds(name, measured);
      tightest = std::max(tightest, expect_certificates(name, measured));
    }
    EXPECT_GT(tightest, 0.1) << "certificates this wide say nothing";
  }

  /// G5 wherever sums in powers can compare: weights in ratios up to 4.
  template <typename T>
  void expect_small_errors() {
    const std::size_t fused = fuses_multiply_add(isa()) ? 1 : 0;
    for (std::size_t f = 0; f < prepared<T>().families.size(); ++f) {
      const std::string& name = prepared<T>().families[f].name;
      if (!name.starts_with("weights100_") && !name.starts_with("weights1e4_")) {
        // Few samples: single ones weigh more than in the suite, so the higher factor for all.
        EXPECT_LE(run<T>(f, {})[Quantity::position].rms(),
                  kRmsAgainstDeCasteljauHigh * prepared<T>().de_casteljau[f][fused])
            << name << ": G5, RMS against de Casteljau";
      }
    }
  }
};

TEST_P(ShapesTest, EveryFamilyFloat) { expect_gates<float>({}); }
TEST_P(ShapesTest, EveryFamilyDouble) { expect_gates<double>({}); }
TEST_P(ShapesTest, LocalOriginsFloat) { expect_gates<float>({.local_origin = true}); }
TEST_P(ShapesTest, LocalOriginsDouble) { expect_gates<double>({.local_origin = true}); }
TEST_P(ShapesTest, SmallErrorsFloat) { expect_small_errors<float>(); }
TEST_P(ShapesTest, SmallErrorsDouble) { expect_small_errors<double>(); }
INSTANTIATE_FOR_EVERY_ISA(ShapesTest);

} // namespace
} // namespace simdbezier::tests::shape_gates_test
