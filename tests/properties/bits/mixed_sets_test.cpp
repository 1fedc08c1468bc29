// Sets of many shapes: equal bits whatever is packed beside a patch, however many threads, through
// whichever call and layout, and on every instruction set of a class.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/properties/bits/call_fixture.hpp"
#include "tests/properties/bits/shape_workload.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::mixed_sets_test {
namespace {

constexpr std::size_t kPatches = 45;
constexpr int kThreadCounts[] = {1, 2, 7};
constexpr std::pair<std::size_t, std::size_t> kShapeGrids[] = {{2, 2},  {4, 5},   {8, 3},  {9, 9},
                                                               {16, 2}, {17, 17}, {33, 4}, {40, 3}};

class ShapesTest : public CallTest {
protected:
  ShapesTest() : CallTest(kAllOutputs) {}

  template <typename T>
  void expect_independent_of_neighbours(const PackOptions& packing);
  template <typename T>
  void expect_equal_batches();
  template <typename T>
  void expect_equal_calls(const PackOptions& packing);
  template <typename T>
  void expect_equal_scattered();
  template <typename T>
  void expect_equal_layouts();
};

// A mixed set gives, in input order, what each patch gives when it is packed alone.
template <typename T>
void ShapesTest::expect_independent_of_neighbours(const PackOptions& packing) {
  const std::vector<Net> nets = mixed_shape_nets(kPatches);
  const PatchSet<T> mixed = packed_mixed<T>(nets, packing);
  ASSERT_EQ(mixed.size(), nets.size());
  std::vector<PatchSet<T>> single;
  for (std::size_t p = 0; p < nets.size(); ++p) {
    single.push_back(packed<T>(std::span(nets).subspan(p, 1), packing));
  }
  for (const auto& [nu, nv] : kShapeGrids) {
    const Grid<T> samples = Grid<T>::uniform(nu, nv);
    const Planes<T> together = by_grid(mixed, samples, {.threads = 1});
    Planes<T> alone(together.count(), kAllOutputs);
    for (std::size_t p = 0; p < nets.size(); ++p) {
      grid(single[p], samples, advanced(alone.outputs(), p * nu * nv), {.threads = 1});
    }
    EXPECT_EQ(differing_values(together, alone), 0U) << "grid " << nu << " x " << nv;
    Planes<T> ranges(together.count(), kAllOutputs);
    for (std::size_t first = 0, count = 1; first < kPatches; first += count++) {
      grid(mixed, samples, advanced(ranges.outputs(), first * nu * nv),
           {.threads = 1, .first_patch = first, .patch_count = std::min(count, kPatches - first)});
    }
    EXPECT_EQ(differing_values(together, ranges), 0U) << "ranges, grid " << nu << " x " << nv;
  }
}

// One shape, packed in pieces of every size around the lane counts.
template <typename T>
void ShapesTest::expect_equal_batches() {
  for (const WorkShape& shape : kWorkShapes) {
    const std::vector<Net> nets = shape_nets(shape, 35);
    const std::size_t nu = 9;
    const std::size_t nv = 5;
    const auto in_pieces = [&](std::size_t size) {
      Planes<T> planes(nets.size() * nu * nv, kAllOutputs);
      for (std::size_t first = 0; first < nets.size(); first += size) {
        const auto piece = std::span(nets).subspan(first, std::min(size, nets.size() - first));
        grid(packed<T>(piece), Grid<T>::uniform(nu, nv),
             advanced(planes.outputs(), first * nu * nv), {.threads = 1});
      }
      return planes;
    };
    const Planes<T> reference = in_pieces(1);
    for (const std::size_t size : {2U, 3U, 7U, 8U, 9U, 15U, 16U, 17U, 35U}) {
      EXPECT_EQ(differing_values(in_pieces(size), reference), 0U)
          << "pieces of " << size << ", " << shape.degrees.u << " x " << shape.degrees.v;
    }
  }
}

template <typename T>
void ShapesTest::expect_equal_calls(const PackOptions& packing) {
  const PatchSet<T> set = packed_mixed<T>(mixed_shape_nets(kPatches), packing);
  std::size_t number = 0;
  for (const auto& [nu, nv] : kShapeGrids) {
    std::size_t place = ++number;
    const Grid<T> samples = Grid<T>::uniform(nu, nv);
    const Planes<T> reference = by_grid(set, samples, {.threads = 1});
    const auto expect = [&](const char* call, int threads, const Planes<T>& planes) {
      EXPECT_EQ(differing_values(planes, reference), 0U)
          << call << ", " << threads << " threads, grid " << nu << " x " << nv;
    };
    for (const int threads : kThreadCounts) {
      const std::size_t sum = ++place;
      for (const Destination destination : {Destination::cache, Destination::memory}) {
        const CallOptions options{.threads = threads, .destination = destination};
        const std::size_t streamed = destination == Destination::memory ? 1 : 0;
        if (in_form(sum + streamed, 2)) {
          expect("grid", threads, by_grid(set, samples, options));
        }
        if (in_form(sum + streamed + 1, 2)) {
          expect("patch grids", threads, by_patch_grids(set, samples, kPatches, options));
        }
      }
      if (in_form(sum, 2)) {
        expect("scattered", threads, by_scattered(set, samples, {.threads = threads}));
      }
      TileFormat format{everything()};
      for (const TileLayout layout :
           {TileLayout::planes, TileLayout::xyz, TileLayout::interleaved}) {
        std::size_t choice = sum + static_cast<std::size_t>(layout);
        for (const std::size_t most : {0U, 1U, 300U}) {
          if (!in_form(++choice, 3)) {
            continue;
          }
          format.layout = layout;
          format.samples = most;
          expect("tiles", threads, by_tiles(set, samples, format, {.threads = threads}));
        }
      }
    }
  }
}

// Scattered samples in random order, in batches of any size and by any number of threads.
template <typename T>
void ShapesTest::expect_equal_scattered() {
  const PatchSet<T> set = packed_mixed<T>(mixed_shape_nets(kPatches));
  const SampleArrays<T> samples = random_samples<T>(kPatches, 3000);
  Planes<T> reference(samples.patch.size(), kAllOutputs);
  for (std::size_t k = 0; k < reference.count(); ++k) {
    scattered(set, part_of(samples, k, 1), advanced(reference.outputs(), k), {.threads = 1});
  }
  for (const int threads : kThreadCounts) {
    for (const std::size_t size : {7U, 16U, 33U, 3000U}) {
      Planes<T> planes(reference.count(), kAllOutputs);
      for (std::size_t first = 0; first < planes.count(); first += size) {
        scattered(set, part_of(samples, first, std::min(size, planes.count() - first)),
                  advanced(planes.outputs(), first), {.threads = threads});
      }
      EXPECT_EQ(differing_values(planes, reference), 0U)
          << threads << " threads, batches of " << size;
    }
  }
}

// Vertices of all groups, and of position and normal with a gap, against planes.
template <typename T>
void ShapesTest::expect_equal_layouts() {
  const PatchSet<T> set = packed_mixed<T>(mixed_shape_nets(kPatches));
  constexpr std::size_t kGroups[] = {0, 1, 2, 4, 5, 6, 3}; // of Planes, in the order of Outputs
  for (const auto& [nu, nv] : kShapeGrids) {
    const Grid<T> samples = Grid<T>::uniform(nu, nv);
    const Planes<T> reference = by_grid(set, samples, {.threads = 1});
    for (const std::size_t stride : {21U, 24U}) {
      std::vector<T> vertices(reference.count() * stride, T(-5));
      Outputs<T> out;
      Vectors<T>* const members[] = {&out.position, &out.du,  &out.dv,    &out.duu,
                                     &out.duv,      &out.dvv, &out.normal};
      for (std::size_t g = 0; g < std::size(members); ++g) {
        *members[g] = Vectors<T>::xyz(vertices.data() + 3 * g, static_cast<std::ptrdiff_t>(stride));
      }
      grid(set, samples, out, {.threads = 2});
      std::size_t different = 0;
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::size_t member = k % stride;
        const T expected =
            member < 21 ? reference.at(kGroups[member / 3], member % 3, k / stride) : T(-5);
        different += same_bits(vertices[k], expected) ? 0 : 1;
      }
      EXPECT_EQ(different, 0U) << "stride " << stride << ", grid " << nu << " x " << nv;
    }
  }
}

TEST_P(ShapesTest, NeighboursFloat) { expect_independent_of_neighbours<float>({}); }
TEST_P(ShapesTest, NeighboursDouble) { expect_independent_of_neighbours<double>({}); }
TEST_P(ShapesTest, NeighboursLocalOrigins) {
  expect_independent_of_neighbours<float>({.local_origin = true});
}
TEST_P(ShapesTest, BatchesFloat) { expect_equal_batches<float>(); }
TEST_P(ShapesTest, BatchesDouble) { expect_equal_batches<double>(); }
TEST_P(ShapesTest, CallsFloat) { expect_equal_calls<float>({}); }
TEST_P(ShapesTest, CallsDouble) { expect_equal_calls<double>({}); }
TEST_P(ShapesTest, CallsLocalOriginsFloat) { expect_equal_calls<float>({.local_origin = true}); }
TEST_P(ShapesTest, ScatteredFloat) { expect_equal_scattered<float>(); }
TEST_P(ShapesTest, ScatteredDouble) { expect_equal_scattered<double>(); }
TEST_P(ShapesTest, LayoutsFloat) { expect_equal_layouts<float>(); }
TEST_P(ShapesTest, LayoutsDouble) { expect_equal_layouts<double>(); }

/// Each instruction set against the first of its class.
template <typename T>
void expect_equal_class(Isa isa, Isa reference) {
  for (const bool local_origin : {false, true}) {
    const PatchSet<T> set =
        packed_mixed<T>(mixed_shape_nets(kPatches), {.local_origin = local_origin});
    for (const auto& [nu, nv] : kShapeGrids) {
      Planes<T> here(kPatches * nu * nv, kAllOutputs);
      Planes<T> there(kPatches * nu * nv, kAllOutputs);
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      ASSERT_EQ(evaluate(set, samples, here.outputs(), {.isa = isa}), Status::ok);
      ASSERT_EQ(evaluate(set, samples, there.outputs(), {.isa = reference}), Status::ok);
      EXPECT_EQ(differing_values(here, there), 0U)
          << to_string(isa) << " against " << to_string(reference) << ", grid " << nu << " x "
          << nv;
    }
  }
}

TEST_P(ShapesTest, ClassOfInstructionSets) {
  for (const Isa other : available_isas()) {
    if (fuses_multiply_add(other) == fuses_multiply_add(isa())) {
      expect_equal_class<float>(isa(), other);
      expect_equal_class<double>(isa(), other);
      break;
    }
  }
  EXPECT_GT(
      by_grid(packed_mixed<float>(mixed_shape_nets(3)), Grid<float>::uniform(4, 4), {}).count(),
      0U);
}

INSTANTIATE_FOR_EVERY_ISA(ShapesTest);

} // namespace
} // namespace simdbezier::tests::mixed_sets_test
