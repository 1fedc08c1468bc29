// When memory is short a call says so, before anything is written, wherever it was short; when the
// system does not take advice about memory, nobody hears of it.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/topology.hpp>

#include "tests/reliability/faults/counted_allocations.hpp"
#include "tests/support/canvas.hpp"
#include "tests/support/nets/generators.hpp"

#if defined(__linux__)
namespace {
std::atomic<int> g_advice{0};
}
/// This stands before the C library's function, and answers as a kernel without large pages does.
extern "C" __attribute__((visibility("default"))) int
madvise(void* /*memory*/, std::size_t /*bytes*/, int /*advice*/) noexcept {
  ++g_advice;
  errno = EINVAL;
  return -1;
}
#endif

namespace simdbezier::tests::allocation_test {
namespace {

constexpr std::size_t kPatches = 3;

class Allocation : public ::testing::Test {
protected:
  /// Fails the first allocation of `call`, then the second, … until it succeeds. `call` gets
  /// vertices without gaps in memory that must stay as it is.
  template <typename Call>
  void run(std::size_t samples, const Call& call) {
    Canvas<float> canvas(6 * samples);
    Outputs<float> out;
    out.position = Vectors<float>::xyz(canvas.at(0), 6);
    out.duv = Vectors<float>::xyz(canvas.at(3), 6);
    int failed = 0;
    for (Status status = Status::out_of_memory; status == Status::out_of_memory; ++failed) {
      ASSERT_LT(failed, 100);
      allow_allocations(failed);
      status = call(out);
      allow_allocations(-1);
      ASSERT_EQ(canvas.untouched(), status == Status::out_of_memory);
      ASSERT_TRUE(status == Status::ok || status == Status::out_of_memory) << to_string(status);
    }
    EXPECT_GT(failed, 1) << "the call allocates nothing: the test tests nothing";
  }

  PatchSet<float> set_ = packed<float>(mixed_nets(kPatches));
};

TEST_F(Allocation, Grids) {
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    for (const std::size_t n : {9U, 300U}) {
      run(kPatches * n * n, [&](const Outputs<float>& out) {
        return evaluate(set_, Grid<float>::uniform(n, n), out,
                        {.threads = 2, .destination = destination});
      });
    }
  }
}

/// Records that kernels put together by themselves need no staging: proof of which ones they do.
template <typename T>
void records_without_staging(Isa isa, std::size_t lanes) {
  const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
  for (const std::size_t nu : {2U, 3U, 4U, 7U, 8U, 9U, 13U, 15U, 16U, 17U, 20U, 33U}) {
    for (const std::ptrdiff_t stride : {3, 6, 7}) {
      Canvas<T> canvas(7 * kPatches * nu * 5);
      Outputs<T> out;
      out.position = Vectors<T>::xyz(canvas.at(0), stride);
      if (stride == 6) {
        out.normal = Vectors<T>::xyz(canvas.at(3), stride);
      }
      allow_allocations(0);
      const Status status = evaluate(set, Grid<T>::uniform(nu, 5), out, {.threads = 1, .isa = isa});
      allow_allocations(-1);
      const bool direct = lanes > 0 && nu >= lanes && stride != 7;
      EXPECT_EQ(status, direct ? Status::ok : Status::out_of_memory)
          << to_string(isa) << ", " << nu << " samples a row, " << stride << " values a record";
    }
  }
}

TEST_F(Allocation, RecordsWithoutStaging) {
  for (const Isa isa : available_isas()) {
    const std::size_t bytes = isa == Isa::avx512 ? 64 : isa == Isa::avx2 ? 32 : 0;
    records_without_staging<float>(isa, bytes / sizeof(float));
    records_without_staging<double>(isa, bytes / sizeof(double));
  }
}

TEST_F(Allocation, PatchGrids) {
  const std::uint32_t nu[kPatches] = {3, 700, 500};
  const std::uint32_t nv[kPatches] = {400, 4, 500};
  for (const int threads : {1, 2}) {
    run(400 * 3 + 700 * 4 + 500 * 500, [&](const Outputs<float>& out) {
      return evaluate(set_, PatchGrids{nu, nv}, out, {.threads = threads});
    });
  }
}

TEST_F(Allocation, Samples) {
  std::vector<std::uint32_t> patch(5000);
  const std::vector<float> u(5000, 0.25F);
  run(5000, [&](const Outputs<float>& out) {
    return evaluate(set_, Samples<float>{patch, u, u}, out, {.threads = 2});
  });
}

TEST_F(Allocation, TilesComeAllOrNot) {
  for (const std::size_t n : {9U, 300U}) {
    int failed = 0;
    for (Status status = Status::out_of_memory; status == Status::out_of_memory; ++failed) {
      ASSERT_LT(failed, 100);
      std::size_t samples = 0;
      const auto count = [&](const Tile<float>& tile) { samples += tile.samples; };
      allow_allocations(failed);
      status = evaluate_tiles(set_, Grid<float>::uniform(n, n), {}, count, {.threads = 1});
      allow_allocations(-1);
      ASSERT_EQ(samples, status == Status::ok ? kPatches * n * n : 0) << to_string(status);
    }
    EXPECT_GT(failed, 1);
  }
}

/// A call that has its result, or says that memory was short, whichever of its allocations fails,
/// and whether those behind it fail as well. Status call(result).
template <typename Call>
void expect_result_or_status(const Call& call) {
  std::vector<double> expected;
  ASSERT_EQ(call(expected), Status::ok);
  int allocations = 0;
  for (Status status = Status::out_of_memory; status == Status::out_of_memory; ++allocations) {
    ASSERT_LT(allocations, 1000);
    std::vector<double> result = expected;
    allow_allocations(allocations);
    status = call(result);
    allow_allocations(-1);
    ASSERT_TRUE(status == Status::out_of_memory || (status == Status::ok && result == expected))
        << to_string(status) << ", " << allocations;
  }
  EXPECT_GT(allocations, 1) << "the call allocates nothing: the test tests nothing";
  for (int k = 0; k < allocations; ++k) {
    std::vector<double> result = expected;
    allow_allocations(k, true);
    const Status status = call(result);
    allow_allocations(-1);
    ASSERT_TRUE(status == Status::out_of_memory || (status == Status::ok && result == expected))
        << to_string(status) << ", only " << k;
  }
}

/// Two bicubic patches that are joined by snapping, a side of the second of which is a point.
std::vector<double> snapped_values() {
  std::vector<double> values;
  for (std::size_t k = 0; k < 32; ++k) {
    const auto i = static_cast<double>(k % 4);
    const auto j = static_cast<double>(k / 4 % 4);
    const bool second = k >= 16;
    const double z = (i == 1 || i == 2) && (j == 1 || j == 2) ? 0.5 : 0;
    values.insert(values.end(),
                  {second ? 1.0001 + i / 3 : i / 3, second && i == 3 ? 0.5 : j / 3, z});
  }
  return values;
}

TEST(AllocationOfMeshes, is_short_in_rates_and_in_fits) {
  const std::vector<double> values = snapped_values();
  const auto nets = ControlNets<double>::packed(values.data(), 2, 3, 3);
  Topology topology;
  TopologyOptions how;
  how.snap = 0.01;
  ASSERT_EQ(find_topology(nets, topology, how), Status::ok);
  ASSERT_EQ(topology.counts().snapped_sides, 2U);
  ASSERT_EQ(topology.counts().collapsed_sides, 1U);
  for (const int threads : {1, 2}) {
    expect_result_or_status([&](std::vector<double>& /*result*/) {
      return Status(fits(topology, nets, {.threads = threads}) ? Status::ok
                                                               : Status::out_of_memory);
    });
    for (const bool thorough : {false, true}) {
      SCOPED_TRACE(thorough);
      RateOptions options;
      options.tolerance = 0.01;
      options.thorough = thorough;
      expect_result_or_status([&](std::vector<double>& result) {
        std::uint32_t nu[2] = {};
        std::uint32_t nv[2] = {};
        std::uint16_t diagonals[2] = {};
        double deviations[2] = {};
        const Report report = choose_rates(nets, topology, options, {nu, nv, diagonals, deviations},
                                           {.threads = threads});
        if (report) {
          result = {deviations[0], deviations[1]};
          result.insert(result.end(), nu, nu + 2);
          result.insert(result.end(), nv, nv + 2);
        }
        return report.status;
      });
    }
  }
}

TEST(AllocationOfPolylines, is_short_for_weights_that_are_far_apart) {
  std::vector<double> values;
  for (int k = 0; k < 5; ++k) {
    values.insert(values.end(), {0, 0, 0, 1, 1, 1, 0, 1000, 2, 0, 0, 1});
  }
  const auto curves = ControlCurves<double>::packed(values.data(), 5, 2, 3, Weights::cartesian);
  FlattenOptions options;
  options.tolerance = 1e-3;
  for (const int threads : {1, 2}) {
    expect_result_or_status([&](std::vector<double>& result) {
      std::uint32_t points[5] = {};
      const Report report = choose_polylines(curves, options, points, {}, {.threads = threads});
      if (report) {
        result.assign(points, points + 5);
      }
      return report.status;
    });
  }
}

#if defined(__linux__)
TEST(Advice, LeavesErrnoAlone) {
  constexpr std::size_t kMany = 10000; // 4 MiB and more in float
  const std::vector<float> points(48 * kMany, 0.5F);
  PatchSet<float> set;
  g_advice = 0;
  errno = EDOM;
  const Report report = pack(ControlNets<float>{points.data(), kMany}, set, {.threads = 1});
  const int after = errno;
  EXPECT_TRUE(report);
  EXPECT_EQ(after, EDOM);
  EXPECT_GT(g_advice, 0);
}
#endif

} // namespace
} // namespace simdbezier::tests::allocation_test
