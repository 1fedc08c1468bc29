// Equal bits of every operation whatever runs it: instruction sets, threads, places in the batch,
// layouts.
#include <gtest/gtest.h>

#include "tests/nets/net_operations_list.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::net_sameness_test {
namespace {

constexpr std::size_t kCount = 37; // two groups of the widest register and five patches

class NetSamenessTest : public IsaTest {
protected:
  template <typename T>
  std::vector<std::vector<T>> run(const Operation<T>& operation, const ControlNets<T>& nets,
                                  const Shape& shape, const Options& options) {
    std::vector<std::vector<T>> values;
    IsaTest::run(options, [&](const Options& forced) {
      return operation.run(nets, shape, values, forced).status;
    });
    return values;
  }

  /// What everything is compared with: the plainest instruction set, one thread, packed.
  template <typename T>
  static std::vector<std::vector<T>> reference(const Operation<T>& operation,
                                               const Batch<T>& batch) {
    std::vector<std::vector<T>> values;
    const Report report = operation.run(batch.nets(), batch.shape, values,
                                        {.threads = 1, .isa = available_isas().front()});
    EXPECT_EQ(to_string(report.status), to_string(Status::ok)) << operation.name;
    return values;
  }

  template <typename T, typename Body>
  void for_all(Body body) {
    for (const Shape& shape : all_shapes()) {
      const Batch<T> batch = random_batch<T>(shape, kCount, 11);
      for (const Operation<T>& operation : all_operations<T>()) {
        if (operation.takes(shape)) {
          SCOPED_TRACE(operation.name + " of " + shape.name());
          body(operation, batch, reference(operation, batch));
        }
      }
    }
  }

  template <typename T>
  void same_bits_everywhere() {
    for_all<T>([&](const Operation<T>& operation, const Batch<T>& batch, const auto& expected) {
      for (const int threads : {1, 3}) {
        const auto values = run(operation, batch.nets(), batch.shape, {.threads = threads});
        for (std::size_t k = 0; k < expected.size(); ++k) {
          ASSERT_EQ(differing(values[k], expected[k]), 0U) << threads << " threads";
        }
      }
    });
  }

  /// Nets [3, 20) alone, so that groups begin elsewhere.
  template <typename T>
  void same_bits_in_any_place() {
    for_all<T>([&](const Operation<T>& operation, const Batch<T>& batch, const auto& expected) {
      ControlNets<T> part = batch.nets();
      part.points += 3 * part.patch_stride;
      part.count = 17;
      const auto values = run(operation, part, batch.shape, {.threads = 1});
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const auto row = static_cast<std::ptrdiff_t>(expected[k].size() / kCount);
        const std::vector<T> there(expected[k].begin() + 3 * row, expected[k].begin() + 20 * row);
        ASSERT_EQ(differing(values[k], there), 0U);
      }
    });
  }

  /// Planes of one value each, patches closest together, in descending order.
  template <typename T>
  void same_bits_in_any_layout() {
    for_all<T>([&](const Operation<T>& operation, const Batch<T>& batch, const auto& expected) {
      const std::size_t values_a_net = batch.net_values();
      std::vector<T> planes(batch.values.size());
      for (std::size_t p = 0; p < kCount; ++p) {
        for (std::size_t k = 0; k < values_a_net; ++k) {
          planes[k * kCount + (kCount - 1 - p)] = batch.values[p * values_a_net + k];
        }
      }
      ControlNets<T> nets = batch.nets();
      nets.points = planes.data() + kCount - 1;
      nets.patch_stride = -1;
      nets.row_stride *= kCount;
      nets.point_stride *= kCount;
      nets.component_stride = kCount;
      const auto values = run(operation, nets, batch.shape, {.threads = 1});
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(differing(values[k], expected[k]), 0U);
      }
    });
  }

  template <typename T>
  void same_bits_in_any_environment() {
    for_all<T>([&](const Operation<T>& operation, const Batch<T>& batch, const auto& expected) {
      const ScopedEnvironment environment(FE_UPWARD, true);
      const auto values = run(operation, batch.nets(), batch.shape, {.threads = 2});
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(differing(values[k], expected[k]), 0U);
      }
    });
  }
};

TEST_P(NetSamenessTest, InstructionSetsAndThreadsFloat) { same_bits_everywhere<float>(); }
TEST_P(NetSamenessTest, InstructionSetsAndThreadsDouble) { same_bits_everywhere<double>(); }
TEST_P(NetSamenessTest, PlacesFloat) { same_bits_in_any_place<float>(); }
TEST_P(NetSamenessTest, PlacesDouble) { same_bits_in_any_place<double>(); }
TEST_P(NetSamenessTest, LayoutsFloat) { same_bits_in_any_layout<float>(); }
TEST_P(NetSamenessTest, LayoutsDouble) { same_bits_in_any_layout<double>(); }
TEST_P(NetSamenessTest, EnvironmentsFloat) { same_bits_in_any_environment<float>(); }
INSTANTIATE_FOR_EVERY_ISA(NetSamenessTest);

// Children of a patch side by side: outputs that lie between each other.
TEST(NetLayouts, InterleavedOutputs) {
  for (const Shape& shape : all_shapes()) {
    const Batch<float> batch = random_batch<float>(shape, kCount, 5);
    std::vector<Batch<float>> apart(4, Batch<float>(shape, kCount));
    ASSERT_TRUE(split(batch.nets(), 0.5F, 0.5F,
                      {apart[0].out(), apart[1].out(), apart[2].out(), apart[3].out()}));
    Batch<float> together(shape, 4 * kCount);
    std::array<MutableNets<float>, 4> out;
    for (std::size_t k = 0; k < 4; ++k) {
      out[k] = together.out();
      out[k].count = kCount;
      out[k].points += static_cast<std::ptrdiff_t>(k) * out[k].patch_stride;
      out[k].patch_stride *= 4;
    }
    ASSERT_EQ(split(batch.nets(), 0.5F, 0.5F, out).status, Status::ok) << shape.name();
    const std::size_t row = batch.net_values();
    for (std::size_t k = 0; k < together.values.size(); ++k) {
      const std::size_t net = k / row;
      ASSERT_EQ(together.values[k], apart[net % 4].values[net / 4 * row + k % row]);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::net_sameness_test
