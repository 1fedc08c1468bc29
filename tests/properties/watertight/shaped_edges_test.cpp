// Positions along shared edges are bit-equal from both sides whatever the patches' degrees and
// weights, corners are control points, and cells of a patch that was cut meet without a gap.
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/watertight/shaped_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::shaped_edges_test {
namespace {

/// Edge samples per type and instruction set.
[[nodiscard]] std::size_t edge_samples_wanted() { return by_form<std::size_t>(25'000, 10'000'000); }

/// How a batch is packed and evaluated.
struct EdgeSetup {
  PackOptions packing;
  Options options{.threads = 1};
};

struct Tally {
  std::size_t samples = 0;
  std::size_t different = 0;
  std::size_t different_slopes = 0; ///< of derivatives along the edge
  std::size_t wrong_corners = 0;
};

/// All patches of a batch on their own grids: `along` samples on the shared edge.
template <typename T>
struct EvaluatedEdges {
  Planes<T> planes;
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::size_t> offset;

  EvaluatedEdges(const ShapedEdgeBatch& batch, std::size_t along, std::size_t across, Wanted wanted)
      : planes(batch.nets.size() * along * across, wanted), nu(batch.nets.size()),
        nv(batch.nets.size()), offset(batch.nets.size()) {
    const auto place = [&](const ShapedPlaced& placed) {
      const bool along_u = placed.place.side < 2;
      nu[placed.index] = static_cast<std::uint32_t>(along_u ? along : across);
      nv[placed.index] = static_cast<std::uint32_t>(along_u ? across : along);
      offset[placed.index] = placed.index * along * across;
    };
    for (const auto& [first, second] : batch.pairs) {
      place(first);
      place(second);
    }
  }

  [[nodiscard]] std::array<T, 3> at(std::size_t group, const ShapedPlaced& placed,
                                    std::size_t t) const {
    const std::size_t k = side_sample(placed.place, t, nu[placed.index], nv[placed.index]);
    return planes.vector(group, offset[placed.index] + k);
  }
  /// Derivatives along the edge: du and duu where it runs in u, dv and dvv where in v.
  [[nodiscard]] std::array<T, 3> slope(const ShapedPlaced& placed, std::size_t t) const {
    return at(placed.place.side < 2 ? 1 : 2, placed, t);
  }
  [[nodiscard]] std::array<T, 3> bend(const ShapedPlaced& placed, std::size_t t) const {
    return at(placed.place.side < 2 ? 4 : 6, placed, t);
  }
};

template <typename T>
[[nodiscard]] bool same_point(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

/// The control point at the start of an edge as the library shall give it back: divided by its
/// weight where it is homogeneous, rounded once, -0 as +0.
template <typename T>
[[nodiscard]] std::array<T, 3> start_point(const ShapedEdgeBatch& batch,
                                           const ShapedPlaced& placed) {
  Net net = batch.nets[placed.index];
  const int side = placed.place.side;
  const bool at_end = placed.place.reversed;
  const int i = side == 3 || (side < 2 && at_end) ? net.degree_u : 0;
  const int j = side == 1 || (side >= 2 && at_end) ? net.degree_v : 0;
  net = rounded_to<T>(net); // the quotient of two floats, in double, rounds to float as if exact
  const Vector3 point = control_polygon(net).at(j, i);
  return {static_cast<T>(point[0]) + T(0), static_cast<T>(point[1]) + T(0),
          static_cast<T>(point[2]) + T(0)};
}

template <typename T>
void compare_pairs(const ShapedEdgeBatch& batch, int degree, const EvaluatedEdges<T>& a,
                   const EvaluatedEdges<T>& b, std::size_t along, Tally& tally) {
  for (const auto& [first, second] : batch.pairs) {
    const T sign = first.place.reversed == second.place.reversed ? T(1) : T(-1);
    for (std::size_t t = 0; t < along; ++t) {
      tally.different += same_point(a.at(0, first, t), b.at(0, second, t)) ? 0 : 1;
      // Where an edge is cut, its middle belongs to one of two cells, each with slopes of its own.
      if (!a.planes.wanted().second || (degree > 5 && 2 * t == along - 1)) {
        continue;
      }
      const auto slope = b.slope(second, t);
      const bool same = a.slope(first, t) ==
                            std::array<T, 3>{sign * slope[0], sign * slope[1], sign * slope[2]} &&
                        a.bend(first, t) == b.bend(second, t);
      tally.different_slopes += same ? 0 : 1;
    }
    tally.wrong_corners += same_point(a.at(0, first, 0), start_point<T>(batch, first)) ? 0 : 1;
    tally.samples += along;
  }
}

class ShapedEdgesTest : public IsaTest {
protected:
  template <typename T>
  void evaluate(const PatchSet<T>& set, EvaluatedEdges<T>& result, const Options& options) {
    patch_grids(set, {result.nu, result.nv, result.offset}, result.planes.outputs(), options);
  }

  template <typename T>
  [[nodiscard]] Tally run(std::size_t wanted, EdgeForm form, const EdgeSetup& setup) {
    Random random(2027);
    Tally tally;
    for (int round = 0; tally.samples < wanted || round < 15; ++round) {
      const ShapedEdgeRule rule{1 + round % 15, kEdgeKinds[random.below(kEdgeKinds.size())], form};
      const ShapedEdgeBatch batch = make_shaped_edge_batch(rule, random);
      const auto along = static_cast<std::size_t>(random.integer(2, 49));
      const auto across = static_cast<std::size_t>(random.integer(2, 5));
      const Wanted some{true, random.below(2) == 0, random.below(8) == 0, true};
      EvaluatedEdges<T> all(batch, along, across, {true, true, false, false, true});
      EvaluatedEdges<T> fewer(batch, along, across, some);
      const PatchSet<T> set = packed_mixed<T>(batch.nets, setup.packing);
      evaluate(set, all, setup.options);
      evaluate(set, fewer, setup.options);
      compare_pairs(batch, rule.degree, all, all, along, tally);
      compare_pairs(batch, rule.degree, fewer, all, along, tally);
    }
    return tally;
  }

  template <typename T>
  void expect_watertight(const PackOptions& packing = {}) {
    for (const EdgeForm form : kEdgeForms) {
      const Tally tally = run<T>(edge_samples_wanted() / std::size(kEdgeForms), form, {packing});
      const std::string name = "form " + std::to_string(static_cast<int>(form));
      EXPECT_EQ(tally.different, 0U) << name << ", of " << tally.samples << " samples";
      EXPECT_EQ(tally.different_slopes, 0U) << name << ", of " << tally.samples << " samples";
      const bool elsewhere = packing.relative_to[0] != 0;
      EXPECT_EQ(elsewhere ? 0 : tally.wrong_corners, 0U)
          << name << ": corners that are not the control point";
    }
  }

  template <typename T>
  void expect_closed_seams(const PackOptions& packing);
};

TEST_P(ShapedEdgesTest, SharedEdgesFloat) { expect_watertight<float>(); }
TEST_P(ShapedEdgesTest, SharedEdgesDouble) { expect_watertight<double>(); }
TEST_P(ShapedEdgesTest, LocalOriginsFloat) { expect_watertight<float>({.local_origin = true}); }
TEST_P(ShapedEdgesTest, LocalOriginsDouble) { expect_watertight<double>({.local_origin = true}); }
TEST_P(ShapedEdgesTest, RelativeToFloat) {
  expect_watertight<float>({.relative_to = {0.3, -1e3, 7}});
}
TEST_P(ShapedEdgesTest, RelativeToDouble) {
  expect_watertight<double>({.relative_to = {0.3, -1e3, 7}});
}

// The counterproof: with watertight edges off this very comparison finds the gaps.
TEST_P(ShapedEdgesTest, ComparisonSeesOpenEdges) {
  for (const EdgeForm form : kEdgeForms) {
    const Tally tally = run<float>(5'000, form, {{}, {.threads = 1, .watertight = false}});
    EXPECT_GT(tally.different, tally.samples / 4);
    EXPECT_GT(tally.different_slopes, tally.samples / 4);
    EXPECT_GT(tally.wrong_corners, 0U);
  }
}

/// v -> 1-v.
[[nodiscard]] Net reversed_v(const Net& net) { return transposed(reversed_u(transposed(net))); }

/// Samples of patch `p` on the lines where patches are cut, at mirrored places as the signs say.
template <typename T>
void add_seam_samples(SampleArrays<T>& samples, std::size_t p, T sign_x, T sign_y) {
  Random random(31);
  for (int k = 0; k < 40; ++k) {
    const T along = boundary_centred<T>(random);
    samples.add(p, T(0), sign_y * along);
    samples.add(p, sign_x * along, T(0));
  }
}

// A patch and its mirror images give the same positions where cells meet: whichever of the cells
// evaluates the seam, it must come from what both know.
template <typename T>
void ShapedEdgesTest::expect_closed_seams(const PackOptions& packing) {
  Random random(32);
  for (const Degrees degrees : {Degrees{6, 6}, {7, 3}, {2, 8}, {9, 15}, {15, 6}}) {
    for (const EdgeForm form : kEdgeForms) {
      Net net = shaped_wave_net(degrees, random);
      if (form != EdgeForm::polynomial) {
        net = weighted(std::move(net), 100, random);
        net.homogeneous = form == EdgeForm::homogeneous;
      }
      const std::vector<Net> images{net, reversed_u(net), reversed_v(net),
                                    reversed_u(reversed_v(net))};
      SampleArrays<T> samples;
      add_seam_samples<T>(samples, 0, 1, 1);
      add_seam_samples<T>(samples, 1, -1, 1);
      add_seam_samples<T>(samples, 2, 1, -1);
      add_seam_samples<T>(samples, 3, -1, -1);
      Planes<T> planes(samples.patch.size(), {true, false, false, false});
      scattered(packed<T>(images, packing), samples.view(Parameters::centred), planes.outputs());
      const std::size_t count = samples.patch.size() / images.size();
      std::size_t different = 0;
      for (std::size_t k = 0; k < samples.patch.size(); ++k) {
        // A direction that is not cut has no seam; its middle is like any other place.
        const bool on_seam = k % 2 == 0 ? degrees.u >= 6 : degrees.v >= 6;
        different +=
            !on_seam || same_point(planes.vector(0, k), planes.vector(0, k % count)) ? 0 : 1;
      }
      EXPECT_EQ(different, 0U) << degrees.u << " x " << degrees.v << ", form "
                               << static_cast<int>(form);
    }
  }
}

TEST_P(ShapedEdgesTest, SeamsFloat) { expect_closed_seams<float>({}); }
TEST_P(ShapedEdgesTest, SeamsDouble) { expect_closed_seams<double>({}); }
TEST_P(ShapedEdgesTest, SeamsLocalOriginsFloat) {
  expect_closed_seams<float>({.local_origin = true});
}
TEST_P(ShapedEdgesTest, SeamsLocalOriginsDouble) {
  expect_closed_seams<double>({.local_origin = true});
}

INSTANTIATE_FOR_EVERY_ISA(ShapedEdgesTest);

} // namespace
} // namespace simdbezier::tests::shaped_edges_test
