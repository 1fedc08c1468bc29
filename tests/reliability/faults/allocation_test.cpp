// When memory is short a call says so, before anything is written, wherever it was short; when the
// system does not take advice about memory, nobody hears of it.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

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
