// Positions along shared edges are bit-equal from both sides, and grids agree with scattered calls.
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::bicubic_edges_test {
namespace {

/// Edge samples per type and instruction set.
[[nodiscard]] std::size_t edge_samples_wanted() {
  return by_form<std::size_t>(100'000, 10'000'000);
}

/// The grid of a set of an EdgeBatch: `along` samples on the shared edge, `across` the other way.
template <typename T>
[[nodiscard]] Grid<T> edge_grid(bool along_v, std::size_t along, std::size_t across) {
  return along_v ? Grid<T>::uniform(across, along) : Grid<T>::uniform(along, across);
}

/// Kernels differ by the outputs asked for; the two sides of an edge may ask for different ones.
[[nodiscard]] Wanted random_wanted(Random& random) {
  return {true, random.below(2) == 0, random.below(2) == 0, random.below(2) == 0};
}

/// How a batch is packed and evaluated.
struct EdgeSetup {
  PackOptions packing;
  Options options{.threads = 1};
};

struct Tally {
  std::size_t samples = 0;
  std::size_t different = 0;
  std::size_t wrong_corners = 0;
};

template <typename T>
struct EvaluatedBatch {
  std::array<Planes<T>, 2> planes;
  std::array<Grid<T>, 2> grids;

  [[nodiscard]] std::array<T, 3> position(const Placed& placed, std::size_t t) const {
    const Grid<T>& grid = grids[placed.along_v ? 1 : 0];
    const std::size_t first = placed.index * grid.nu * grid.nv;
    const std::size_t k = first + side_sample(placed.place, t, grid.nu, grid.nv);
    return planes[placed.along_v ? 1 : 0].vector(0, k);
  }
};

template <typename T>
[[nodiscard]] bool same_point(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

/// The control point at the start of an edge, as the library shall give it back: relative to one
/// origin, formed in double and rounded once, and -0 as +0.
template <typename T>
[[nodiscard]] std::array<T, 3> start_point(const EdgeBatch& batch, const Placed& placed,
                                           const PackOptions& packing) {
  Net net = batch.nets[placed.along_v ? 1 : 0][placed.index];
  const Vector3& point = side_point(net, placed.place.side, placed.place.reversed ? 3 : 0);
  std::array<T, 3> result;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto given = static_cast<double>(static_cast<T>(point[c]));
    result[c] = static_cast<T>(given - packing.relative_to[c]) + T(0);
  }
  return result;
}

template <typename T>
void compare_pairs(const EdgeBatch& batch, const EvaluatedBatch<T>& a, const EvaluatedBatch<T>& b,
                   std::size_t along, const PackOptions& packing, Tally& tally) {
  for (const auto& [first, second] : batch.pairs) {
    for (std::size_t t = 0; t < along; ++t) {
      tally.different += same_point(a.position(first, t), b.position(second, t)) ? 0 : 1;
    }
    const std::array<T, 3> corner = start_point<T>(batch, first, packing);
    tally.wrong_corners += same_point(a.position(first, 0), corner) ? 0 : 1;
    tally.samples += along;
  }
}

class WatertightTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] EvaluatedBatch<T> evaluate(const EdgeBatch& batch, std::size_t along,
                                           std::size_t across, Random& random,
                                           const EdgeSetup& setup) {
    const std::array grids{edge_grid<T>(false, along, across), edge_grid<T>(true, along, across)};
    const std::size_t samples = along * across;
    EvaluatedBatch<T> result{{Planes<T>(batch.nets[0].size() * samples, random_wanted(random)),
                              Planes<T>(batch.nets[1].size() * samples, random_wanted(random))},
                             grids};
    for (std::size_t s = 0; s < 2; ++s) {
      grid(packed<T>(batch.nets[s], setup.packing), grids[s], result.planes[s].outputs(),
           setup.options);
    }
    return result;
  }

  template <typename T>
  [[nodiscard]] Tally run(std::size_t wanted, const EdgeSetup& setup) {
    Random random(2026);
    Tally tally;
    for (std::size_t round = 0; tally.samples < wanted; ++round) {
      const EdgeBatch batch = make_edge_batch(kEdgeKinds[round % kEdgeKinds.size()], random);
      const auto along = static_cast<std::size_t>(random.integer(2, 101));
      // Square grids reach every strategy of the kernels; thin ones make for many edge samples.
      const bool square = along <= 40 && random.below(4) == 0;
      const auto across = square ? along : static_cast<std::size_t>(random.integer(2, 5));
      const auto once = evaluate<T>(batch, along, across, random, setup);
      const auto again = evaluate<T>(batch, along, across, random, setup);
      compare_pairs(batch, once, again, along, setup.packing, tally);
    }
    return tally;
  }

  template <typename T>
  void expect_watertight(std::size_t wanted, const PackOptions& packing = {}) {
    const Tally tally = run<T>(wanted, {packing});
    RecordProperty("edge_samples", std::to_string(tally.samples));
    EXPECT_EQ(tally.different, 0u) << "of " << tally.samples << " samples on shared edges";
    EXPECT_EQ(tally.wrong_corners, 0u) << "corners that are not the control point";
  }
};

TEST_P(WatertightTest, SharedEdgesFloat) { expect_watertight<float>(edge_samples_wanted()); }
TEST_P(WatertightTest, SharedEdgesDouble) { expect_watertight<double>(edge_samples_wanted()); }

// Positions formed around origins of each edge's own, and positions relative to one origin.
TEST_P(WatertightTest, LocalOriginsFloat) {
  expect_watertight<float>(edge_samples_wanted() / 2, {.local_origin = true});
}
TEST_P(WatertightTest, LocalOriginsDouble) {
  expect_watertight<double>(edge_samples_wanted() / 2, {.local_origin = true});
}
TEST_P(WatertightTest, RelativeFloat) {
  expect_watertight<float>(edge_samples_wanted() / 4, {.relative_to = {0.1, -1e6, 3}});
}
TEST_P(WatertightTest, RelativeWithLocalOriginsDouble) {
  expect_watertight<double>(edge_samples_wanted() / 4,
                            {.local_origin = true, .relative_to = {-1e6, 0.3, 17}});
}

// The counterproof: with watertight edges off this very comparison finds more than a third of the
// samples different and corners wrong (61 % in a study).
TEST_P(WatertightTest, ComparisonSeesOpenEdges) {
  const Tally tally = run<float>(20'000, {{}, {.threads = 1, .watertight = false}});
  EXPECT_GT(tally.different, tally.samples / 3);
  EXPECT_GT(tally.wrong_corners, 0u);
}

INSTANTIATE_FOR_EVERY_ISA(WatertightTest);

} // namespace
} // namespace simdbezier::tests::bicubic_edges_test
