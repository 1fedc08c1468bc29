// Bad arguments: the status, and that nothing was written.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/call_options.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier {
namespace {

constexpr float kUntouched = -777;
constexpr std::size_t kPatches = 3;

/// A small set and outputs large enough for 4x4 samples of each patch.
class Arguments : public ::testing::Test {
protected:
  Arguments() {
    std::vector<float> points(kPatches * 48);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = static_cast<float>(i * i % 17);
    }
    EXPECT_TRUE(pack(ControlNets<float>{points.data(), kPatches}, set_));
  }

  Vectors<float> position() {
    return Vectors<float>::planes(values_.data(), values_.data() + kSamples,
                                  values_.data() + 2 * kSamples);
  }
  Outputs<float> outputs() {
    Outputs<float> out;
    out.position = position();
    return out;
  }
  void expect_untouched() const {
    for (const float value : values_) {
      ASSERT_EQ(value, kUntouched);
    }
  }
  void refuse_grid(Status expected, const Grid<float>& grid, const Outputs<float>& out,
                   const tests::CallOptions& options = {}) {
    EXPECT_EQ(to_string(evaluate(set_, grid, out, options)), to_string(expected));
    expect_untouched();
  }
  void refuse_samples(Status expected, const Samples<float>& samples, const Outputs<float>& out) {
    EXPECT_EQ(to_string(evaluate(set_, samples, out)), to_string(expected));
    expect_untouched();
  }

  static constexpr std::size_t kSamples = kPatches * 16;
  PatchSet<float> set_;
  std::vector<float> values_ = std::vector<float>(3 * kSamples, kUntouched);
};

TEST_F(Arguments, grids_too_small) {
  for (const auto& [nu, nv] : {std::pair<std::size_t, std::size_t>{0, 4}, {4, 0}, {1, 4}, {4, 1}}) {
    refuse_grid(Status::bad_grid, Grid<float>::uniform(nu, nv), outputs());
  }
  const float u[] = {0.5F};
  refuse_grid(Status::bad_grid, Grid<float>{0, 1, u, u}, outputs());
}

TEST_F(Arguments, grids_too_large) {
  constexpr auto kHuge = std::numeric_limits<std::size_t>::max();
  for (const auto& [nu, nv] : {std::pair<std::size_t, std::size_t>{kHuge, 2},
                               {2, kHuge},
                               {kHuge / 2, 4},
                               {std::size_t{1} << 32, std::size_t{1} << 32},
                               {std::size_t{1} << 30, std::size_t{1} << 30}}) {
    refuse_grid(Status::size_overflow, Grid<float>::uniform(nu, nv), outputs());
  }
}

TEST_F(Arguments, outputs_missing) {
  const auto grid = Grid<float>::uniform(4, 4);
  refuse_grid(Status::null_output, grid, Outputs<float>{});
  const Status statuses[] = {Status::null_output, Status::missing_y, Status::missing_z};
  for (int missing = 0; missing < 3; ++missing) {
    Outputs<float> out = outputs();
    (missing == 0 ? out.position.x : missing == 1 ? out.position.y : out.position.z) = nullptr;
    refuse_grid(statuses[missing], grid, out);
  }
  Outputs<float> only_status;
  SampleStatus status[kSamples];
  only_status.status = status;
  refuse_grid(Status::null_output, grid, only_status);
}

TEST_F(Arguments, strides) {
  const auto grid = Grid<float>::uniform(4, 4);
  Outputs<float> out = outputs();
  out.position.stride = 0;
  refuse_grid(Status::bad_stride, grid, out);
  for (const std::ptrdiff_t stride : {1, 2, -1, -2}) {
    out.position = Vectors<float>::xyz(values_.data() + 3, stride);
    refuse_grid(Status::bad_stride, grid, out);
  }
  out.position = Vectors<float>::xyz(values_.data(), std::numeric_limits<std::ptrdiff_t>::max());
  refuse_grid(Status::size_overflow, grid, out);
}

TEST_F(Arguments, patch_ranges) {
  const auto grid = Grid<float>::uniform(4, 4);
  tests::CallOptions options;
  options.first_patch = kPatches + 1;
  refuse_grid(Status::bad_patch_range, grid, outputs(), options);
  options.first_patch = 2;
  options.patch_count = 2;
  refuse_grid(Status::bad_patch_range, grid, outputs(), options);
  options.patch_count = std::numeric_limits<std::size_t>::max() - 1;
  refuse_grid(Status::bad_patch_range, grid, outputs(), options);
  options.patch_count = 0;
  refuse_grid(Status::ok, grid, outputs(), options);
}

TEST_F(Arguments, a_range_is_the_same_patches_of_the_whole) {
  const auto grid = Grid<float>::uniform(4, 4);
  ASSERT_EQ(evaluate(set_, grid, outputs()), Status::ok);
  std::vector<float> part(3 * 16);
  Outputs<float> out;
  out.position = Vectors<float>::planes(part.data(), part.data() + 16, part.data() + 32);
  tests::CallOptions options;
  options.first_patch = 1;
  options.patch_count = 1;
  ASSERT_EQ(evaluate(set_, grid, out, options), Status::ok);
  for (std::size_t k = 0; k < 16; ++k) {
    EXPECT_EQ(part[k], values_[16 + k]);
    EXPECT_EQ(part[32 + k], values_[2 * kSamples + 16 + k]);
  }
}

TEST_F(Arguments, scattered) {
  const std::uint32_t good[] = {0, 1, 2};
  const std::uint32_t bad[] = {0, 1, kPatches};
  const float u[] = {0, 0.5F, 1};
  const std::span<const float> null(static_cast<float*>(nullptr), 3);
  refuse_samples(Status::bad_patch_index, {bad, u, u}, outputs());
  refuse_samples(Status::null_input, {{static_cast<std::uint32_t*>(nullptr), 3}, u, u}, outputs());
  refuse_samples(Status::null_input, {good, null, u}, outputs());
  refuse_samples(Status::null_input, {good, u, null}, outputs());
  refuse_samples(Status::null_output, {good, u, u}, Outputs<float>{});
  refuse_samples(Status::ok, {}, outputs());
  EXPECT_EQ(evaluate(PatchSet<float>{}, Samples<float>{good, u, u}, outputs()),
            Status::bad_patch_index);
  expect_untouched();
}

TEST_F(Arguments, spans_of_nothing_with_a_length) {
  const std::uint32_t rates[] = {4, 4, 4};
  const std::span<const std::size_t> offsets(static_cast<std::size_t*>(nullptr), kPatches);
  EXPECT_EQ(evaluate(set_, PatchGrids{rates, rates, offsets}, outputs()), Status::null_input);
  const std::span<const PartialDerivative<float>> wanted(
      static_cast<PartialDerivative<float>*>(nullptr), 2);
  EXPECT_EQ(evaluate_derivatives(set_, Grid<float>::uniform(4, 4), {wanted}), Status::null_output);
  const std::span<const ControlNets<float>> nets(static_cast<ControlNets<float>*>(nullptr), 2);
  PatchSet<float> packed;
  EXPECT_EQ(pack(nets, packed).status, Status::null_input);
  expect_untouched();
}

TEST_F(Arguments, instruction_sets_of_other_builds_and_machines) {
  refuse_grid(Status::unsupported_isa, Grid<float>::uniform(4, 4), outputs(),
              {.isa = tests::absent_isa()});
}

TEST_F(Arguments, empty_sets_evaluate_to_nothing) {
  EXPECT_EQ(evaluate(PatchSet<float>{}, Grid<float>::uniform(4, 4), outputs()), Status::ok);
  expect_untouched();
}

struct PackCase {
  const char* name;
  Status status;
  ControlNets<float> nets;
};

TEST(Pack, refuses_what_it_cannot_pack_and_keeps_the_old_set) {
  std::vector<float> points(96, 1.0F);
  const auto nets = [&] { return ControlNets<float>{points.data(), 2}; };
  std::vector<PackCase> cases;
  const auto add = [&](const char* name, Status status, auto change) {
    cases.push_back({name, status, nets()});
    change(cases.back().nets);
  };
  using Nets = ControlNets<float>;
  add("null points", Status::null_input, [](Nets& n) { n.points = nullptr; });
  add("degree u", Status::bad_degree, [](Nets& n) { n.degree_u = 16; });
  add("degree v", Status::bad_degree, [](Nets& n) { n.degree_v = 0; });
  add("negative degree", Status::bad_degree, [](Nets& n) { n.degree_v = -3; });
  add("row stride", Status::bad_stride, [](Nets& n) { n.row_stride = 0; });
  add("point stride", Status::bad_stride, [](Nets& n) { n.point_stride = 0; });
  add("component stride", Status::bad_stride, [](Nets& n) { n.component_stride = 0; });
  add("absurd count", Status::size_overflow,
      [](Nets& n) { n.count = std::numeric_limits<std::size_t>::max(); });
  for (const PackCase& c : cases) {
    PatchSet<float> set;
    ASSERT_TRUE(pack(nets(), set));
    const Report report = pack(c.nets, set);
    EXPECT_EQ(to_string(report.status), to_string(c.status)) << c.name;
    EXPECT_EQ(set.size(), 2U) << c.name;
  }
}

template <typename T>
void expect_report(T value, std::size_t at, Status status) {
  std::vector<T> points(5 * 48, T(1));
  points[at] = value;
  PatchSet<T> set;
  const Report report = pack(ControlNets<T>{points.data(), 5}, set);
  EXPECT_EQ(to_string(report.status), to_string(status));
  EXPECT_EQ(report.item, at / 48);
  EXPECT_EQ(report.component, static_cast<int>(at % 3));
  if (status == Status::non_finite_input) {
    EXPECT_EQ(report.point, static_cast<int>(at % 48 / 3));
  }
  EXPECT_TRUE(set.empty());
}

TEST(Pack, names_the_first_bad_control_point) {
  for (const std::size_t at : {0U, 47U, 48U, 100U, 239U}) {
    expect_report(std::numeric_limits<float>::quiet_NaN(), at, Status::non_finite_input);
    expect_report(-std::numeric_limits<float>::infinity(), at, Status::non_finite_input);
    expect_report(std::numeric_limits<double>::infinity(), at, Status::non_finite_input);
    expect_report(std::numeric_limits<float>::max(), at, Status::coefficient_overflow);
    expect_report(std::numeric_limits<double>::max(), at, Status::coefficient_overflow);
  }
}

TEST(Pack, doubles_that_exceed_float_are_an_overflow) {
  std::vector<double> points(48, 1.0);
  points[7] = 1e300;
  PatchSet<float> set;
  const Report report = pack(ControlNets<double>{points.data(), 1}, set);
  EXPECT_EQ(to_string(report.status), to_string(Status::coefficient_overflow));
  EXPECT_EQ(report.component, 1);
}

TEST(Pack, strides_describe_other_layouts) {
  std::vector<double> plain(48);
  std::vector<double> planar(3 * 16); // component planes, v fastest
  for (std::size_t k = 0; k < 48; ++k) {
    plain[k] = static_cast<double>(k * k % 23);
    planar[k % 3 * 16 + k / 3 % 4 * 4 + k / 12] = plain[k];
  }
  ControlNets<double> other{planar.data(), 1};
  other.row_stride = 1;
  other.point_stride = 4;
  other.component_stride = 16;
  PatchSet<double> a;
  PatchSet<double> b;
  ASSERT_TRUE(pack(ControlNets<double>{plain.data(), 1}, a));
  ASSERT_TRUE(pack(other, b));
  double xyz[2][75];
  for (int i = 0; i < 2; ++i) {
    Outputs<double> out;
    out.position = Vectors<double>::xyz(xyz[i]);
    ASSERT_EQ(evaluate(i == 0 ? a : b, Grid<double>::uniform(5, 5), out), Status::ok);
  }
  for (int k = 0; k < 75; ++k) {
    EXPECT_EQ(xyz[0][k], xyz[1][k]);
  }
}

} // namespace
} // namespace simdbezier
