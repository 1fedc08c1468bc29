// The gates of the accuracy suite on a small sample of every family: short enough for every run.
#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/gates.hpp"
#include "tests/properties/accuracy/judge/library_evaluator.hpp"
#include "tests/properties/accuracy/judge/prepared.hpp"
#include "tests/properties/accuracy/judge/scalar_evaluators.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::bicubic_gates_test {
namespace {

constexpr std::size_t kNets = 76; // all scales of "scaled" in steps, all grades of "graded"
constexpr std::size_t kSamplesPerNet = 24;

template <typename T>
[[nodiscard]] const Prepared<T>& prepared() {
  static const Prepared<T> instance(
      all_families<T>(kNets, kSamplesPerNet),
      []<bool kFused>(const Family<T>& family, const Reference& at_unit) {
        ScalarEvaluator<T, DeCasteljau<T, WeightedLerp<T, kFused>>> weighted;
        ScalarEvaluator<T, DeCasteljau<T, DifferenceLerp<T, kFused>>> difference;
        return std::min(measure(weighted, family, at_unit)[Quantity::position].rms(),
                        measure(difference, family, at_unit)[Quantity::position].rms());
      });
  return instance;
}

class AccuracyTest : public IsaTest {
protected:
  template <typename T>
  void expect_gates() {
    const bool fma = fuses_multiply_add(isa());
    for (std::size_t f = 0; f < prepared<T>().families.size(); ++f) {
      const Family<T>& family = prepared<T>().families[f];
      LibraryEvaluator<T> evaluator(isa());
      const Measurement measured = measure(evaluator, family, prepared<T>().references[f]);
      expect_ran(Status::ok, evaluator.executed());
      expect_bounds(family.name, measured);
      // The hill-climbed nets are worst for this scheme, and harmless for de Casteljau.
      if (family.name == "worst") {
        EXPECT_GT(measured[Quantity::position].max, fma ? 9 : 3) << "the nets have lost their bite";
      } else {
        EXPECT_LE(measured[Quantity::position].rms(),
                  kRmsAgainstDeCasteljau * prepared<T>().de_casteljau[f][fma ? 1 : 0])
            << family.name << ": G5, RMS against the best de Casteljau";
      }
    }
  }

  template <typename T>
  void expect_certificates(const PackOptions& packing);
};

// Certificates come with the set; both ways of packing are held to them.
template <typename T>
void AccuracyTest::expect_certificates(const PackOptions& packing) {
  double tightest = 0;
  for (std::size_t f = 0; f < prepared<T>().families.size(); ++f) {
    const Family<T>& family = prepared<T>().families[f];
    LibraryEvaluator<T> evaluator(isa(), packing);
    const Measurement measured = measure(evaluator, family, prepared<T>().references[f]);
    expect_ran(Status::ok, evaluator.executed());
    expect_bounds(family.name, measured);
    tightest = std::max(tightest, tests::expect_certificates(family.name, measured));
  }
  EXPECT_GT(tightest, 0.1) << "certificates this wide say nothing";
}

TEST_P(AccuracyTest, CertificatesFloat) { expect_certificates<float>({}); }
TEST_P(AccuracyTest, CertificatesDouble) { expect_certificates<double>({}); }
TEST_P(AccuracyTest, LocalOriginsFloat) { expect_certificates<float>({.local_origin = true}); }
TEST_P(AccuracyTest, LocalOriginsDouble) { expect_certificates<double>({.local_origin = true}); }

// Far from the origin the last addition is all that is left: 0.75 u were measured.
TEST_P(AccuracyTest, LocalOriginsRoundOnceFarAway) {
  for (std::size_t f = 0; f < prepared<float>().families.size(); ++f) {
    const Family<float>& family = prepared<float>().families[f];
    if (family.name == "off1e3" || family.name == "off1e6") {
      LibraryEvaluator<float> evaluator(isa(), {.local_origin = true});
      const Measurement measured = measure(evaluator, family, prepared<float>().references[f]);
      expect_ran(Status::ok, evaluator.executed());
      EXPECT_LE(measured[Quantity::position].max, 0.8) << family.name;
    }
  }
}

TEST_P(AccuracyTest, EveryFamilyFloat) { expect_gates<float>(); }
TEST_P(AccuracyTest, EveryFamilyDouble) { expect_gates<double>(); }
INSTANTIATE_FOR_EVERY_ISA(AccuracyTest);

} // namespace
} // namespace simdbezier::tests::bicubic_gates_test
