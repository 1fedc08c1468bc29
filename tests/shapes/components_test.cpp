// The evaluate calls on sets of other shapes: any number of components, and what is refused.
#include <algorithm>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/component_nets.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::components_test {
namespace {

constexpr std::size_t kPatches = 5;
constexpr std::size_t kNu = 9;
constexpr std::size_t kNv = 4;
constexpr std::size_t kSamples = kPatches * kNu * kNv;
constexpr Wanted kVectors{true, true, false, false, true}; ///< all that any components have

struct ComponentCase {
  Degrees degrees;
  bool rational;
};
constexpr ComponentCase kComponentCases[] = {{{3, 3}, false}, {{3, 3}, true},  {{1, 2}, false},
                                             {{2, 5}, true},  {{7, 3}, false}, {{6, 9}, true}};

class ComponentsTest : public IsaTest {
protected:
  /// Components `first` to `first + 2` of each call against the same planes as points in space.
  template <typename T>
  void expect_independent(const ComponentNets& nets, int first, const PackOptions& packing) {
    const PatchSet<T> set = nets.packed<T>(packing);
    const PatchSet<T> space = packed<T>(nets.triple(first), packing);
    EXPECT_EQ(set.components(), nets.components());
    const int present = std::min(3, nets.components() - first);
    const CallOptions options{.threads = 1, .first_component = first};
    const auto expect = [&](const char* call, const Planes<T>& here, const Planes<T>& reference) {
      EXPECT_EQ(differing(here, reference, static_cast<std::size_t>(present)), 0U)
          << call << ", components " << first << " of " << nets.components();
    };
    Planes<T> reference(kSamples, kVectors);
    Planes<T> by_grid(kSamples, kVectors);
    grid(space, Grid<T>::uniform(kNu, kNv), reference.outputs());
    grid(set, Grid<T>::uniform(kNu, kNv), without_missing(by_grid.outputs(), present), options);
    expect("grid", by_grid, reference);

    const std::vector<std::uint32_t> nu(kPatches, kNu);
    const std::vector<std::uint32_t> nv(kPatches, kNv);
    Planes<T> by_patch(kSamples, kVectors);
    patch_grids(set, {nu, nv}, without_missing(by_patch.outputs(), present), options);
    expect("patch grids", by_patch, reference);

    SampleArrays<T> samples;
    for (std::size_t p = 0; p < kPatches; ++p) {
      for (const Parameters2<T>& at : grid_parameters<T>(kNu, kNv)) {
        samples.add(p, at.x, at.y);
      }
    }
    Planes<T> by_scattered(kSamples, kVectors);
    scattered(set, samples.view(Parameters::centred),
              without_missing(by_scattered.outputs(), present), options);
    expect("scattered", by_scattered, reference);
  }

  /// The number of values that differ in the first `present` components, and of places beyond that
  /// were written.
  template <typename T>
  [[nodiscard]] static std::size_t differing(const Planes<T>& here, const Planes<T>& reference,
                                             std::size_t present) {
    std::size_t different = 0;
    for (const std::size_t group : {0U, 1U, 2U, 4U, 5U, 6U}) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < here.count(); ++k) {
          const T expected = c < present ? reference.at(group, c, k) : T(-777);
          different += same_bits(here.at(group, c, k), expected) ? 0 : 1;
        }
      }
    }
    return different;
  }

  template <typename T>
  void expect_all_independent(const PackOptions& packing) {
    Random random(61);
    for (const ComponentCase& shape : kComponentCases) {
      for (const int components : {1, 2, 3, 4, 7, 16}) {
        const ComponentNets nets(shape.degrees, components, shape.rational, kPatches, random);
        for (int first = 0; first<components; first += components> 7 ? 5 : 1) {
          expect_independent<T>(nets, first, packing);
        }
      }
    }
  }
};

TEST_P(ComponentsTest, ArePlanesOfTheirOwnFloat) { expect_all_independent<float>({}); }
TEST_P(ComponentsTest, ArePlanesOfTheirOwnDouble) { expect_all_independent<double>({}); }
TEST_P(ComponentsTest, ArePlanesOfTheirOwnLocalOrigins) {
  expect_all_independent<float>({.local_origin = true});
}

// A derivative of higher order than the degree is zero, to the bit.
TEST_P(ComponentsTest, DerivativesBeyondTheDegreeAreZero) {
  Random random(62);
  const Net net = rounded_to<float>(shaped_random_net({1, 4}, random));
  Planes<float> planes(kNu * kNv, kVectors);
  grid(packed<float>(std::span(&net, 1)), Grid<float>::uniform(kNu, kNv), planes.outputs());
  for (std::size_t k = 0; k < planes.count(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(same_bits(planes.at(4, c, k), 0.0F)) << planes.at(4, c, k);
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(ComponentsTest);

/// What a refused call is given: a set, outputs of its own, and the status that it must end with.
class RefusalTest : public ::testing::Test {
protected:
  template <typename Change>
  void expect_refused(int components, Status expected, Change change) {
    Random random(66);
    const ComponentNets nets({2, 3}, components, false, kPatches, random);
    const PatchSet<float> set = nets.packed<float>();
    Planes<float> planes(kSamples, {.second = true, .curvature = true});
    CallOptions options{.threads = 1};
    Outputs<float> out = without_missing(planes.outputs(), components);
    out.normal = {};
    out.curvature = {};
    change(planes, out, options);
    const std::vector<std::uint32_t> nu(kPatches, kNu);
    const std::vector<std::uint32_t> nv(kPatches, kNv);
    const std::vector<std::uint32_t> patch{0, 1};
    const std::vector<float> u{0, 1};
    const auto expect = [&](const char* call, Status status) {
      EXPECT_EQ(to_string(status), to_string(expected)) << call << ", " << components;
    };
    expect("grid", evaluate(set, Grid<float>::uniform(kNu, kNv), out, options));
    expect("patch grids", evaluate(set, PatchGrids{nu, nv}, out, options));
    expect("scattered", evaluate(set, Samples<float>{patch, u, u}, out, options));
    for (const float value : planes.values()) {
      ASSERT_EQ(value, -777) << "something was written";
    }
  }

  void expect_tiles_refused(int components, Status expected, const TileFormat& format,
                            int first_component = 0) {
    Random random(67);
    const ComponentNets nets({2, 3}, components, false, kPatches, random);
    int calls = 0;
    const auto count = [&](const Tile<float>&) { ++calls; };
    const Status status = evaluate_tiles(
        nets.packed<float>(), Grid<float>::uniform(kNu, kNv), format, TileFunction<float>(count),
        CallOptions{.threads = 1, .first_component = first_component});
    EXPECT_EQ(to_string(status), to_string(expected)) << components;
    EXPECT_EQ(calls, 0);
  }
};

TEST_F(RefusalTest, ComponentsThatDoNotExist) {
  for (const int components : {1, 2, 3, 4, 7}) {
    for (const int first : {-1, components, components + 1, std::numeric_limits<int>::max()}) {
      expect_refused(
          components, Status::bad_components,
          [&](Planes<float>&, Outputs<float>&, CallOptions& o) { o.first_component = first; });
      expect_tiles_refused(components, Status::bad_components, {}, first);
    }
  }
}

TEST_F(RefusalTest, NormalsAndCurvaturesOutsideOfSpace) {
  for (const int components : {1, 2, 4, 7}) {
    expect_refused(components, Status::bad_components,
                   [&](Planes<float>& p, Outputs<float>& out, CallOptions&) {
                     out.normal = without_missing(p.outputs(), components).normal;
                   });
    expect_refused(components, Status::bad_components,
                   [&](Planes<float>& p, Outputs<float>& out, CallOptions&) {
                     out.curvature.mean = p.outputs().curvature.mean;
                   });
    expect_tiles_refused(components, Status::bad_components, {.outputs = {Output::normal}});
    expect_tiles_refused(components, Status::bad_components, {.outputs = {Output::curvature}});
  }
  // A part of a point in space is not a point in space.
  expect_refused(3, Status::bad_components,
                 [](Planes<float>& p, Outputs<float>& out, CallOptions& options) {
                   options.first_component = 1;
                   out = without_missing(out, 2);
                   out.curvature.gaussian = p.outputs().curvature.gaussian;
                 });
}

// An output has as many planes as there are components, no more and no less.
TEST_F(RefusalTest, PlanesThatDoNotMatchTheComponents) {
  const auto three_planes = [](Planes<float>& p, Outputs<float>& out, CallOptions&) {
    out.du = p.outputs().du;
  };
  expect_refused(1, Status::extra_y, three_planes);
  expect_refused(2, Status::extra_z, three_planes);
  expect_refused(7, Status::missing_z, [](Planes<float>&, Outputs<float>& out, CallOptions&) {
    out.position.z = nullptr;
  });
  expect_refused(2, Status::missing_y, [](Planes<float>&, Outputs<float>& out, CallOptions&) {
    out.position.y = nullptr;
  });
  expect_refused(7, Status::extra_z, [](Planes<float>&, Outputs<float>&, CallOptions& options) {
    options.first_component = 5; // two are left
  });
  expect_refused(2, Status::null_output,
                 [](Planes<float>&, Outputs<float>& out, CallOptions&) { out.dv.x = nullptr; });
}

TEST_F(RefusalTest, CurvaturesThatOverlap) {
  expect_refused(3, Status::overlapping_outputs,
                 [](Planes<float>& p, Outputs<float>& out, CallOptions&) {
                   out.curvature = p.outputs().curvature;
                   out.curvature.mean = out.curvature.gaussian;
                 });
  expect_refused(3, Status::overlapping_outputs,
                 [](Planes<float>&, Outputs<float>& out, CallOptions&) {
                   out.curvature.maximum = out.position.y + 1;
                 });
}

TEST_F(RefusalTest, PatchesOutsideOfAMixedSet) {
  Random random(68);
  std::vector<Net> nets{shaped_wave_net({3, 3}, random), shaped_wave_net({1, 7}, random),
                        weighted(shaped_wave_net({2, 2}, random), 4, random)};
  const PatchSet<double> set = packed_mixed<double>(nets);
  Planes<double> planes(3 * kNu * kNv);
  const Grid<double> samples = Grid<double>::uniform(kNu, kNv);
  EXPECT_EQ(
      evaluate(set, samples, planes.outputs(), CallOptions{.first_patch = 2, .patch_count = 2}),
      Status::bad_patch_range);
  const std::uint32_t patch[] = {0, 2, 3};
  const double u[] = {0, 0.5, 1};
  EXPECT_EQ(evaluate(set, Samples<double>{patch, u, u}, planes.outputs()), Status::bad_patch_index);
  for (const double value : planes.values()) {
    ASSERT_EQ(value, -777);
  }
  EXPECT_EQ(set.shape(1), (PatchShape{1, 7, 3, false}));
  EXPECT_EQ(set.shape(2), (PatchShape{2, 2, 3, true}));
  EXPECT_EQ(set.shape(3), (PatchShape{0, 0, 0, false}));
}

} // namespace
} // namespace simdbezier::tests::components_test
