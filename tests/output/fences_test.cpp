// Inputs and outputs that end (or begin) at pages nobody may touch: a register read or written
// beyond an array stops the program, sanitizer or not, intrinsics or not.
#include <cstddef>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/output/layouts.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::fences_test {
namespace {

enum class Fence : std::uint8_t { before, behind };

/// An array whose first (last) element is the first (last) of readable memory.
template <typename T>
class Fenced {
public:
  Fenced(std::size_t count, Fence side)
      : bytes_((count * sizeof(T) + page() - 1) / page() * page()) {
    void* const base =
        mmap(nullptr, bytes_ + 2 * page(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base == MAP_FAILED) {
      throw std::bad_alloc();
    }
    base_ = static_cast<unsigned char*>(base);
    if (bytes_ > 0 && mprotect(base_ + page(), bytes_, PROT_READ | PROT_WRITE) != 0) {
      throw std::bad_alloc();
    }
    const std::size_t room = side == Fence::before ? 0 : bytes_ - count * sizeof(T);
    first_ = reinterpret_cast<T*>(base_ + page() + room);
  }
  ~Fenced() { munmap(base_, bytes_ + 2 * page()); }
  Fenced(const Fenced&) = delete;
  Fenced& operator=(const Fenced&) = delete;

  [[nodiscard]] T* data() const { return first_; }
  T* copy(const std::vector<T>& values) const {
    std::memcpy(first_, values.data(), values.size() * sizeof(T));
    return first_;
  }

private:
  [[nodiscard]] static std::size_t page() {
    static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return size;
  }

  std::size_t bytes_;
  unsigned char* base_ = nullptr;
  T* first_ = nullptr;
};

constexpr std::size_t kPatches = 3;

class FenceTest : public IsaTest {
protected:
  /// Every plane of every group and the status between fences of its own.
  template <typename T, typename Call>
  void planes(std::size_t count, const Planes<T>& reference, const Call& call) {
    for (const Fence side : {Fence::before, Fence::behind}) {
      std::vector<std::unique_ptr<Fenced<T>>> memory;
      const auto plane = [&] {
        memory.push_back(std::make_unique<Fenced<T>>(count, side));
        return memory.back()->data();
      };
      Outputs<T> out;
      for (Vectors<T>* const group : groups_of(out)) {
        T* const x = plane();
        T* const y = plane();
        *group = Vectors<T>::planes(x, y, plane());
      }
      const Fenced<SampleStatus> status(count, side);
      out.status = status.data();
      call(out);
      expect_equal(out, reference, count);
    }
  }

  template <typename T, typename Call>
  void vertices(std::size_t count, const Planes<T>& reference, const Call& call) {
    for (const VertexCase& layout : vertex_cases()) {
      const std::size_t gap =
          static_cast<std::size_t>(layout.stride < 0 ? -layout.stride : layout.stride) -
          layout.order.size() * 3;
      // The last vertex needs no room for a gap at its end.
      const bool ends_in_gap = layout.first == 0 && layout.pitch == 3 && layout.stride > 0;
      const std::size_t elements = vertex_elements(layout, count) - (ends_in_gap ? gap : 0);
      for (const Fence side : {Fence::before, Fence::behind}) {
        const Fenced<T> memory(elements, side);
        const Outputs<T> out = vertex_outputs(layout, count, memory.data());
        call(out);
        expect_equal(out, reference, count);
      }
    }
  }

  template <typename T>
  static void expect_equal(Outputs<T> out, const Planes<T>& reference, std::size_t count) {
    std::size_t different = 0;
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      const Vectors<T>& group = *groups_of(out)[g];
      for (std::size_t k = 0; group.wanted() && k < count; ++k) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) * group.stride;
        different += same_bits(group.x[at], reference.at(plane_group(g), 0, k)) ? 0 : 1;
        different += same_bits(group.y[at], reference.at(plane_group(g), 1, k)) ? 0 : 1;
        different += same_bits(group.z[at], reference.at(plane_group(g), 2, k)) ? 0 : 1;
      }
    }
    EXPECT_EQ(different, 0U);
  }

  template <typename T>
  void grids() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (const auto& [nu, nv] : {std::pair<std::size_t, std::size_t>{1, 1},
                                 {2, 2},
                                 {3, 3},
                                 {4, 2},
                                 {5, 5},
                                 {7, 3},
                                 {8, 8},
                                 {9, 9},
                                 {13, 2},
                                 {16, 16},
                                 {17, 17},
                                 {33, 5},
                                 {100, 7}}) {
      SCOPED_TRACE(testing::Message() << nu << "x" << nv);
      Random random(nu);
      std::vector<T> x(nu);
      std::vector<T> y(nv);
      for (T& value : x) {
        value = boundary_centred<T>(random);
      }
      for (T& value : y) {
        value = boundary_centred<T>(random);
      }
      const Fenced<T> u(nu, Fence::behind);
      const Fenced<T> v(nv, Fence::behind);
      const Grid<T> samples{nu, nv, u.copy(x), v.copy(y), Parameters::centred};
      const std::size_t count = kPatches * nu * nv;
      Planes<T> reference(count, {.second = true});
      grid(set, samples, reference.outputs(), {.threads = 1, .destination = Destination::cache});
      for (const Destination destination : {Destination::memory, Destination::cache}) {
        const auto call = [&](const Outputs<T>& out) {
          grid(set, samples, out, {.threads = 1, .destination = destination});
        };
        planes(count, reference, call);
        vertices(count, reference, call);
      }
    }
  }

  /// Outputs that have kernels of their own, up to where memory ends, for every rest of columns.
  template <typename T>
  void usual_outputs() {
    using Out = Outputs<T>;
    const std::vector<Vectors<T> Out::*> outputs[] = {
        {&Out::position}, {&Out::position, &Out::normal}, {&Out::position, &Out::du, &Out::dv}};
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (std::size_t nu = 2; nu < 52; ++nu) {
      for (const std::size_t nv : {2U, 8U, 11U}) {
        SCOPED_TRACE(testing::Message() << nu << "x" << nv);
        const std::size_t count = kPatches * nu * nv;
        const Grid<T> samples = Grid<T>::uniform(nu, nv);
        Planes<T> reference(count);
        grid(set, samples, reference.outputs(), {.threads = 1, .destination = Destination::cache});
        for (const auto& groups : outputs) {
          std::vector<std::unique_ptr<Fenced<T>>> memory;
          const auto room = [&](std::size_t values) {
            memory.push_back(std::make_unique<Fenced<T>>(values, Fence::behind));
            return memory.back()->data();
          };
          Out planes;
          Out triples;
          for (const auto group : groups) {
            T* const x = room(count);
            T* const y = room(count);
            planes.*group = Vectors<T>::planes(x, y, room(count));
            triples.*group = Vectors<T>::xyz(room(3 * count), 3);
          }
          for (const Out& out : {planes, triples}) {
            grid(set, samples, out, {.threads = 1, .destination = Destination::cache});
            expect_equal(out, reference, count);
          }
        }
      }
    }
  }

  template <typename T>
  void samples() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    const SampleArrays<T> all = random_samples<T>(kPatches, 300);
    Planes<T> reference(300, {.second = true});
    scattered(set, all.view(Parameters::centred), reference.outputs(), {.threads = 1});
    for (const std::size_t count : {1U, 2U, 3U, 5U, 8U, 15U, 16U, 17U, 33U, 300U}) {
      SCOPED_TRACE(testing::Message() << count << " samples");
      const auto part = [&](const auto& values) {
        return std::vector(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
      };
      const Fenced<std::uint32_t> patch(count, Fence::behind);
      const Fenced<T> u(count, Fence::behind);
      const Fenced<T> v(count, Fence::behind);
      const Samples<T> given{{patch.copy(part(all.patch)), count},
                             {u.copy(part(all.u)), count},
                             {v.copy(part(all.v)), count},
                             Parameters::centred};
      for (const Destination destination : {Destination::memory, Destination::cache}) {
        const auto call = [&](const Outputs<T>& out) {
          scattered(set, given, out, {.threads = 1, .destination = destination});
        };
        planes(count, reference, call);
        vertices(count, reference, call);
      }
    }
  }
};

TEST_P(FenceTest, GridsF32) { grids<float>(); }
TEST_P(FenceTest, GridsF64) { grids<double>(); }
TEST_P(FenceTest, UsualOutputsF32) { usual_outputs<float>(); }
TEST_P(FenceTest, UsualOutputsF64) { usual_outputs<double>(); }
TEST_P(FenceTest, SamplesF32) { samples<float>(); }
TEST_P(FenceTest, SamplesF64) { samples<double>(); }

// The gaps of vertices belong to the caller, who may write them while the library writes the rest:
// no element may be read and written back. (The thread sanitizer sees it for certain.)
TEST_P(FenceTest, GapsMayBeWrittenMeanwhile) {
  constexpr std::size_t n = 33;
  constexpr std::ptrdiff_t kStride = 8;
  const PatchSet<float> set = packed<float>(mixed_nets(kPatches));
  std::vector<float> vertices(kPatches * n * n * kStride);
  Outputs<float> out;
  out.position = Vectors<float>::xyz(vertices.data(), kStride);
  out.normal = Vectors<float>::xyz(vertices.data() + 3, kStride);
  std::thread writer([&] {
    for (std::size_t k = 0; k < vertices.size(); k += kStride) {
      vertices[k + 6] = static_cast<float>(k);
      vertices[k + 7] = -1;
    }
  });
  for (const Destination destination : {Destination::memory, Destination::cache}) {
    grid(set, Grid<float>::uniform(n, n), out, {.threads = 1, .destination = destination});
  }
  writer.join();
  std::size_t lost = 0;
  for (std::size_t k = 0; k < vertices.size(); k += kStride) {
    lost += vertices[k + 6] == static_cast<float>(k) && vertices[k + 7] == -1 ? 0 : 1;
  }
  EXPECT_EQ(lost, 0U);
}

INSTANTIATE_FOR_EVERY_ISA(FenceTest);

} // namespace
} // namespace simdbezier::tests::fences_test
