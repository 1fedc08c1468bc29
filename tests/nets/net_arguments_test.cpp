// Bad input of the operations on control nets: the status says what, the report where, and nothing
// has been written.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/nets/net_operations_list.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::net_arguments_test {
namespace {

constexpr Shape kPlain{3, 2, 3, Weights::none};
constexpr Shape kRational{3, 2, 3, Weights::cartesian};
constexpr std::size_t kCount = 20;

struct ArgumentCase {
  const char* name;
  Status status;
  void (*change)(ControlNets<float>& nets, MutableNets<float>& out);
};
void PrintTo(const ArgumentCase& item, std::ostream* out) { *out << item.name; }

const ArgumentCase kCases[] = {
    {"Sound", Status::ok, [](auto&, auto&) {}},
    {"NoNets", Status::ok,
     [](auto& nets, auto& out) {
       nets.points = nullptr;
       out.points = nullptr;
       nets.count = out.count = 0;
     }},
    {"NullInput", Status::null_input, [](auto& nets, auto&) { nets.points = nullptr; }},
    {"NullOutput", Status::null_output, [](auto&, auto& out) { out.points = nullptr; }},
    {"DegreeZero", Status::bad_degree, [](auto& nets, auto&) { nets.degree_u = 0; }},
    {"DegreeSixteen", Status::bad_degree, [](auto& nets, auto&) { nets.degree_v = 16; }},
    {"OtherDegree", Status::bad_degree, [](auto&, auto& out) { out.degree_v = 3; }},
    {"NoComponents", Status::bad_components, [](auto& nets, auto&) { nets.components = 0; }},
    {"ManyComponents", Status::bad_components, [](auto& nets, auto&) { nets.components = 17; }},
    {"OtherComponents", Status::bad_components, [](auto&, auto& out) { out.components = 2; }},
    {"OtherWeights", Status::bad_components,
     [](auto&, auto& out) { out.weights = Weights::cartesian; }},
    {"OtherCount", Status::bad_patch_range, [](auto&, auto& out) { out.count -= 1; }},
    {"InputRowsInOnePlace", Status::bad_stride, [](auto& nets, auto&) { nets.row_stride = 0; }},
    {"OutputNetsOverlap", Status::bad_stride, [](auto&, auto& out) { out.patch_stride = 35; }},
    {"OutputPointsOverlap", Status::bad_stride, [](auto&, auto& out) { out.point_stride = 2; }},
    {"OutputNetsInOnePlace", Status::bad_stride, [](auto&, auto& out) { out.patch_stride = 0; }},
    {"HugeInputStride", Status::size_overflow,
     [](auto& nets, auto&) { nets.patch_stride = std::numeric_limits<std::ptrdiff_t>::max() / 8; }},
    {"HugeOutputStride", Status::size_overflow,
     [](auto&, auto& out) { out.patch_stride = std::numeric_limits<std::ptrdiff_t>::min() / 8; }},
    {"HugeCount", Status::size_overflow,
     [](auto& nets, auto& out) { nets.count = out.count = SIZE_MAX / 2; }},
    {"InPlace", Status::overlapping_outputs,
     [](auto& nets, auto& out) { out.points = const_cast<float*>(nets.points); }},
    {"OneNetOn", Status::overlapping_outputs,
     [](auto& nets, auto& out) {
       out.points = const_cast<float*>(nets.points) + 36 * (kCount - 1);
     }},
    {"LastValue", Status::overlapping_outputs,
     [](auto& nets, auto& out) { out.points = const_cast<float*>(nets.points) + 36 * kCount - 1; }},
};

class NetArgumentsTest : public ::testing::TestWithParam<ArgumentCase> {};

/// split_u, whose second result is sound; every other call shares its checks.
TEST_P(NetArgumentsTest, OfSplitting) {
  Batch<float> batch = random_batch<float>(kPlain, 2 * kCount, 61); // room behind the nets
  const std::vector<float> before = batch.values;
  Batch<float> low(kPlain, kCount);
  Batch<float> high(kPlain, kCount);
  const std::vector<float> untouched = low.values;
  ControlNets<float> nets = batch.nets();
  nets.count = kCount;
  MutableNets<float> out = low.out();
  GetParam().change(nets, out);
  MutableNets<float> other = high.out();
  other.count = nets.count;
  const Report report = split_u(nets, 0.5F, out, other, {.threads = 2});
  EXPECT_EQ(to_string(report.status), to_string(GetParam().status));
  if (GetParam().status != Status::ok) {
    EXPECT_EQ(differing(low.values, untouched) + differing(high.values, untouched), 0U);
    EXPECT_EQ(differing(batch.values, before), 0U);
  }
}

TEST_P(NetArgumentsTest, OfElevation) {
  Batch<float> batch = random_batch<float>(kPlain, 2 * kCount, 61);
  Batch<float> result(kPlain, kCount);
  ControlNets<float> nets = batch.nets();
  nets.count = kCount;
  MutableNets<float> out = result.out();
  GetParam().change(nets, out);
  if (std::string(GetParam().name) != "OtherDegree") { // a higher one is what this call is for
    EXPECT_EQ(to_string(elevate(nets, out).status), to_string(GetParam().status));
  }
}

INSTANTIATE_TEST_SUITE_P(All, NetArgumentsTest, ::testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(NetArguments, OutputsThatShareMemory) {
  const Batch<float> batch = random_batch<float>(kPlain, kCount, 62);
  Batch<float> out(kPlain, 2 * kCount);
  MutableNets<float> low = out.out();
  low.count = kCount;
  MutableNets<float> high = low;
  EXPECT_EQ(split_u(batch.nets(), 0.5F, low, high).status, Status::overlapping_outputs);
  low.patch_stride = high.patch_stride = 72;
  high.points += 35;
  EXPECT_EQ(split_u(batch.nets(), 0.5F, low, high).status, Status::overlapping_outputs);
  high.points += 1;
  EXPECT_EQ(split_u(batch.nets(), 0.5F, low, high).status, Status::ok);
  high.patch_stride = -72;
  EXPECT_EQ(split_u(batch.nets(), 0.5F, low, high).status, Status::overlapping_outputs);
  high.points += 19 * 72;
  EXPECT_EQ(split_u(batch.nets(), 0.5F, low, high).status, Status::overlapping_outputs)
      << "opposite steps are not looked into";
}

TEST(NetArguments, Degrees) {
  const Batch<float> batch = random_batch<float>(kPlain, kCount, 63);
  Batch<float> lower({2, 2, 3, Weights::none}, kCount);
  Batch<float> higher({16, 2, 3, Weights::none}, kCount);
  Batch<float> turned({2, 3, 3, Weights::none}, kCount);
  EXPECT_EQ(elevate(batch.nets(), lower.out()).status, Status::bad_degree);
  EXPECT_EQ(elevate(batch.nets(), higher.out()).status, Status::bad_degree);
  EXPECT_EQ(transpose(batch.nets(), lower.out()).status, Status::bad_degree);
  EXPECT_EQ(transpose(batch.nets(), turned.out()).status, Status::ok);
  EXPECT_EQ(hodograph_v(batch.nets(), lower.out()).status, Status::bad_degree);
  EXPECT_EQ(hodograph_u(batch.nets(), lower.out()).status, Status::ok);
  Batch<float> same(kPlain, kCount);
  EXPECT_EQ(to_bezier(Basis::hermite, batch.nets(), same.out()).status, Status::bad_degree);
  EXPECT_EQ(from_bezier(Basis::b_spline, batch.nets(), same.out()).status, Status::bad_degree);
  EXPECT_EQ(to_bezier(Basis::power, batch.nets(), same.out()).status, Status::ok);
}

/// Refused for what the call is given besides values: no control point is named.
void expect_argument_fault(const Report& report, Status status) {
  EXPECT_EQ(to_string(report.status), to_string(status));
  EXPECT_EQ(report.point, -1);
}

TEST(NetArguments, Weights) {
  const Batch<float> batch = random_batch<float>({3, 3, 3, Weights::cartesian}, kCount, 64);
  Batch<float> out(batch.shape, kCount);
  Batch<float> lower({2, 3, 3, Weights::cartesian}, kCount);
  expect_argument_fault(hodograph_u(batch.nets(), lower.out()), Status::bad_weight);
  expect_argument_fault(to_bezier(Basis::power, batch.nets(), out.out()), Status::bad_weight);
  expect_argument_fault(to_bezier(Basis::hermite, batch.nets(), out.out()), Status::bad_weight);
  expect_argument_fault(from_bezier(Basis::b_spline, batch.nets(), out.out()), Status::bad_weight);
  EXPECT_EQ(to_bezier(Basis::b_spline, batch.nets(), out.out()).status, Status::ok);
}

TEST(NetArguments, Parameters) {
  const Batch<float> plain = random_batch<float>(kPlain, kCount, 65);
  const Batch<float> rational = random_batch<float>(kRational, kCount, 65);
  Batch<float> a(kPlain, kCount);
  Batch<float> b(kPlain, kCount);
  Batch<float> c(kRational, kCount);
  Batch<float> d(kRational, kCount);
  for (const float t : {NAN, INFINITY, -INFINITY}) {
    const Status refused = Status::non_finite_input;
    expect_argument_fault(split_u(plain.nets(), t, a.out(), b.out()), refused);
    expect_argument_fault(split_v(rational.nets(), t, c.out(), d.out()), refused);
    expect_argument_fault(segment(plain.nets(), {0.0F, t, 0.0F, 1.0F}, a.out()), refused);
  }
  for (const float t : {-0.25F, 1.5F}) {
    EXPECT_EQ(split_v(plain.nets(), t, a.out(), b.out()).status, Status::ok);
    expect_argument_fault(split_v(rational.nets(), t, c.out(), d.out()), Status::bad_weight);
    expect_argument_fault(segment(rational.nets(), {0.0F, 1.0F, t, 1.0F}, c.out()),
                          Status::bad_weight);
  }
  EXPECT_EQ(split_v(rational.nets(), 1.0F, c.out(), d.out()).status, Status::ok);
}

// The lowest patch at fault is named whichever thread meets it, in every layout.
TEST(NetArguments, FaultsAreNamed) {
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name());
    for (const bool packed : {true, false}) {
      Batch<float> batch = random_batch<float>(shape, 100, 66);
      batch.at(90, 0, 0, 0) = INFINITY;
      batch.at(70, shape.degree_v, shape.degree_u, 0) = NAN;
      const int last = (shape.degree_u + 1) * (shape.degree_v + 1) - 1;
      const auto expect_fault = [&](Status status, std::size_t patch, int point, int component) {
        ControlNets<float> nets = batch.nets();
        std::vector<float> spread(2 * batch.values.size());
        if (!packed) {
          for (std::size_t k = 0; k < batch.values.size(); ++k) {
            spread[2 * k] = batch.values[k];
          }
          nets.points = spread.data();
          nets.patch_stride *= 2;
          nets.row_stride *= 2;
          nets.point_stride *= 2;
          nets.component_stride *= 2;
        }
        for (const Operation<float>& operation : all_operations<float>()) {
          if (!operation.takes(shape)) {
            continue;
          }
          std::vector<std::vector<float>> values;
          const Report report = operation.run(nets, shape, values, {.threads = 4});
          EXPECT_EQ(to_string(report.status), to_string(status)) << operation.name;
          EXPECT_EQ(report.item, patch) << operation.name;
          EXPECT_EQ(report.component, component) << operation.name;
          EXPECT_EQ(report.point, point) << operation.name;
          for (const std::vector<float>& result : values) {
            EXPECT_TRUE(std::all_of(result.begin(), result.end(), [](float x) { return x == -77; }))
                << operation.name;
          }
        }
      };
      expect_fault(Status::non_finite_input, 70, last, 0);
      if (shape.weights != Weights::none) {
        batch.at(33, 0, 1, batch.channels() - 1) = 0;
        expect_fault(Status::bad_weight, 33, 1, shape.components);
        batch.at(32, 1, 0, batch.channels() - 1) = -1;
        expect_fault(Status::bad_weight, 32, shape.degree_u + 1, shape.components);
        batch.at(31, 1, 0, batch.channels() - 1) = INFINITY;
        expect_fault(Status::bad_weight, 31, shape.degree_u + 1, shape.components);
      }
    }
  }
}

TEST(NetArguments, InstructionSets) {
  const Batch<float> batch = random_batch<float>(kPlain, kCount, 67);
  for (const Operation<float>& operation : all_operations<float>()) {
    std::vector<std::vector<float>> values;
    if (operation.takes(kPlain)) {
      EXPECT_EQ(operation.run(batch.nets(), kPlain, values, {.isa = absent_isa()}).status,
                Status::unsupported_isa)
          << operation.name;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::net_arguments_test
