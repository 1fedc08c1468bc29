// The scheme itself, in scalar code, against the bounds of every degree: what the bounds say can
// be met, and they are not so wide that a worse scheme would meet them, too.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/measure.hpp"
#include "tests/properties/accuracy/judge/scalar_evaluators.hpp"
#include "tests/properties/accuracy/judge/shape_model.hpp"
#include "tests/support/nets/shape_families.hpp"

namespace simdbezier::tests::shape_model_test {
namespace {

constexpr std::size_t kNets = 10;
constexpr std::size_t kSamplesPerNet = 20;

class ShapeModelTest : public ::testing::TestWithParam<ShapeFamilyRow> {};

template <typename T, bool kFused>
void expect_bounds(const ShapeFamilyRow& row) {
  const Family<T> family = shape_family<T>(row, 1, kNets, kSamplesPerNet);
  const Reference reference = make_reference(family, true);
  ShapeModelEvaluator<T, kFused> evaluator;
  const Measurement measured = measure(evaluator, family, reference);
  for (const Quantity quantity : {Quantity::position, Quantity::du, Quantity::dv, Quantity::duu,
                                  Quantity::duv, Quantity::dvv}) {
    const Metric& metric = measured[quantity];
    EXPECT_LE(metric.max_ratio, 1)
        << kQuantityNames[static_cast<std::size_t>(quantity)] << ", net " << metric.worst.net
        << ", x " << metric.worst.x << ", y " << metric.worst.y << ", " << metric.max << " u";
    EXPECT_GT(metric.count, 0U);
  }
}

TEST_P(ShapeModelTest, KeepsTheBounds) {
  expect_bounds<float, true>(GetParam());
  expect_bounds<float, false>(GetParam());
  expect_bounds<double, true>(GetParam());
  expect_bounds<double, false>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, ShapeModelTest, ::testing::ValuesIn(shape_family_rows()),
                         [](const auto& row) { return shape_family_name(row.param); });

/// Nets of 1 and -1, and the scheme with or without the cut.
[[nodiscard]] double worst_ratio(int degree, bool cut) {
  const ShapeFamilyRow row{"signs", shaped_signs_net, SampleRule::boundary, {degree, degree}};
  const Family<float> family = shape_family<float>(row, 2, 40, 30);
  const Reference reference = make_reference(family, true);
  ShapeModelEvaluator<float, true> evaluator(cut);
  return measure(evaluator, family, reference)[Quantity::position].max_ratio;
}

TEST(ShapeModelFault, BoundsSeeAMissingCut) {
  EXPECT_LE(worst_ratio(15, true), 1);
  EXPECT_GT(worst_ratio(15, false), 1) << "one expansion of degree 15 must not pass";
}

} // namespace
} // namespace simdbezier::tests::shape_model_test
