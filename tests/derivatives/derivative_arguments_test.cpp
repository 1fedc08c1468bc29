// Bad arguments of evaluate_derivatives, after which nothing has been written.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/derivatives/derivative_calls.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::derivative_arguments_test {
namespace {

constexpr float kUntouched = -777;

class DerivativeArguments : public ::testing::Test {
protected:
  using List = std::vector<PartialDerivative<float>>;
  static constexpr std::size_t kCount = 4;

  /// The k-th output of all samples, packed triples.
  Vectors<float> output(std::size_t k) { return Vectors<float>::xyz(&values_[k * 3 * kCount]); }

  void refuse(Status expected, const List& list, const Samples<float>& samples,
              const CallOptions& options = {}) {
    const std::span<const PartialDerivative<float>> wanted(list);
    EXPECT_EQ(to_string(evaluate_derivatives(set_, samples, wanted, options)), to_string(expected));
    expect_untouched();
  }
  /// Expects both calls to refuse the list.
  void refuse(Status expected, const List& list, const CallOptions& options = {}) {
    refuse(expected, list, samples_.view(), options);
    refuse_grid(expected, list, Grid<float>::uniform(2, 2), options);
  }
  void refuse_grid(Status expected, const List& list, const Grid<float>& grid,
                   CallOptions options = {}) {
    const std::span<const PartialDerivative<float>> wanted(list);
    options.patch_count = options.patch_count == ~std::size_t(0) ? 1 : options.patch_count;
    EXPECT_EQ(to_string(evaluate_derivatives(set_, grid, wanted, options)), to_string(expected));
    expect_untouched();
  }
  void expect_untouched() const {
    for (const float value : values_) {
      ASSERT_EQ(value, kUntouched);
    }
  }

  PatchSet<float> set_ = mixed_set<float>();
  SampleList<float> samples_{{0, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  std::vector<float> values_ = std::vector<float>(9 * kCount, kUntouched);
};

TEST_F(DerivativeArguments, orders) {
  for (const auto& [a, b] : {OrderPair{-1, 0}, {0, -1}, {16, 0}, {0, 16}, {INT32_MIN, INT32_MAX}}) {
    refuse(Status::bad_degree, {{0, 0, output(0)}, {a, b, output(1)}});
  }
}

TEST_F(DerivativeArguments, outputs) {
  refuse(Status::null_output, {});
  refuse(Status::null_output, {{1, 0, {}}});
  refuse(Status::null_output, {{0, 0, output(0)}, {1, 0, {}}});
  refuse(Status::missing_z, {{1, 0, Vectors<float>::planes(&values_[0], &values_[4])}});
  refuse(Status::bad_stride, {{1, 0, Vectors<float>::xyz(values_.data(), 0)}});
  refuse(Status::bad_stride, {{1, 0, Vectors<float>::xyz(values_.data(), 2)}});
  constexpr std::ptrdiff_t kHuge = std::numeric_limits<std::ptrdiff_t>::max() / 4;
  refuse(Status::size_overflow, {{1, 0, Vectors<float>::xyz(values_.data(), kHuge)}});
}

TEST_F(DerivativeArguments, overlaps) {
  refuse(Status::overlapping_outputs, {{0, 3, output(0)}, {0, 3, output(0)}});
  refuse(Status::overlapping_outputs,
         {{0, 3, output(0)}, {3, 0, output(1)}, {1, 1, Vectors<float>::xyz(&values_[3])}});
  refuse(Status::overlapping_outputs, {{0, 3, Vectors<float>::xyz(samples_.u.data(), -3)}},
         samples_.view());
  List list = {{0, 3, {}}};
  list[0].out = Vectors<float>::xyz(reinterpret_cast<float*>(list.data()));
  refuse(Status::overlapping_outputs, list);
}

TEST_F(DerivativeArguments, samples) {
  const List list = {{2, 1, output(0)}};
  Samples<float> samples = samples_.view();
  constexpr const float* kNull = nullptr;
  samples.u = {kNull, kCount};
  refuse(Status::null_input, list, samples);
  samples = samples_.view();
  samples.v = {kNull, kCount};
  refuse(Status::null_input, list, samples);
  samples = samples_.view();
  samples.patch = {static_cast<std::uint32_t*>(nullptr), kCount};
  refuse(Status::null_input, list, samples);
  samples_.patch[2] = static_cast<std::uint32_t>(set_.size());
  refuse(Status::bad_patch_index, list, samples_.view());
  refuse(Status::ok, list, Samples<float>{});
}

TEST_F(DerivativeArguments, grids) {
  const List list = {{2, 1, output(0)}};
  refuse_grid(Status::bad_grid, list, Grid<float>::uniform(1, 4));
  refuse_grid(Status::bad_grid, list, Grid<float>::uniform(4, 0));
  refuse_grid(Status::size_overflow, list, Grid<float>::uniform(~std::size_t(0), 2));
  refuse_grid(Status::bad_patch_range, list, Grid<float>::uniform(2, 2),
              {.first_patch = set_.size() + 1});
  refuse_grid(Status::bad_patch_range, list, Grid<float>::uniform(2, 2),
              {.first_patch = 1, .patch_count = set_.size()});
  refuse_grid(Status::ok, list, Grid<float>::uniform(2, 2), {.patch_count = 0});
}

TEST_F(DerivativeArguments, components_and_instruction_sets) {
  refuse(Status::bad_components, {{2, 1, output(0)}}, {.first_component = 3});
  refuse(Status::bad_components, {{2, 1, output(0)}}, {.first_component = -1});
  refuse(Status::extra_z, {{2, 1, output(0)}}, {.first_component = 1});
#if defined(__x86_64__)
  refuse(Status::unsupported_isa, {{2, 1, output(0)}}, {.isa = absent_isa()});
#endif
}

TEST_F(DerivativeArguments, a_set_without_patches) {
  set_ = {};
  refuse(Status::bad_patch_index, {{2, 1, output(0)}}, samples_.view());
  refuse_grid(Status::ok, {{2, 1, output(0)}}, Grid<float>::uniform(2, 2), {.patch_count = 0});
}

} // namespace
} // namespace simdbezier::tests::derivative_arguments_test
