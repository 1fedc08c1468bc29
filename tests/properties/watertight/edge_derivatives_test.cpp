// Derivatives along a shared edge come from the edge's own control points, so both sides agree: the
// second derivative bit for bit, the first up to the direction in which the edge is run through.
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::edge_derivatives_test {
namespace {

constexpr std::size_t kRounds = 24;

/// Groups of Planes: the derivatives along an edge that runs in u, and in v.
constexpr std::size_t kFirst[] = {1, 2};
constexpr std::size_t kSecond[] = {4, 6};
constexpr std::size_t kTwist = 5;

template <typename T>
struct Sides {
  std::array<Planes<T>, 2> planes;
  std::array<Grid<T>, 2> grids;

  [[nodiscard]] std::array<T, 3> at(const std::size_t groups[2], const Placed& placed,
                                    std::size_t t) const {
    const std::size_t s = placed.along_v ? 1 : 0;
    const std::size_t first = placed.index * grids[s].nu * grids[s].nv;
    return planes[s].vector(groups[s],
                            first + side_sample(placed.place, t, grids[s].nu, grids[s].nv));
  }
};

struct Differences {
  std::size_t samples = 0;
  std::size_t first = 0;
  std::size_t second = 0;
  std::size_t twist = 0;
};

class EdgeDerivativeTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] Sides<T> evaluate(const EdgeBatch& batch, std::size_t along, std::size_t across,
                                  const PackOptions& packing, const Options& options) {
    Sides<T> sides{{Planes<T>(batch.nets[0].size() * along * across, {.second = true}),
                    Planes<T>(batch.nets[1].size() * along * across, {.second = true})},
                   {Grid<T>::uniform(along, across), Grid<T>::uniform(across, along)}};
    for (std::size_t s = 0; s < 2; ++s) {
      grid(packed<T>(batch.nets[s], packing), sides.grids[s], sides.planes[s].outputs(), options);
    }
    return sides;
  }

  template <typename T>
  [[nodiscard]] Differences run(const PackOptions& packing, const Options& options) {
    Random random(77);
    Differences found;
    for (std::size_t round = 0; round < kRounds; ++round) {
      const EdgeBatch batch = make_edge_batch(kEdgeKinds[round % kEdgeKinds.size()], random);
      const auto along = static_cast<std::size_t>(random.integer(2, 40));
      const auto across = static_cast<std::size_t>(random.integer(2, 9));
      const Sides<T> sides = evaluate<T>(batch, along, across, packing, options);
      for (const auto& [a, b] : batch.pairs) {
        const T sign = a.place.reversed == b.place.reversed ? T(1) : T(-1);
        for (std::size_t t = 0; t < along; ++t) {
          for (std::size_t c = 0; c < 3; ++c) {
            found.first += sides.at(kFirst, a, t)[c] == sign * sides.at(kFirst, b, t)[c] ? 0 : 1;
            found.second +=
                same_bits(sides.at(kSecond, a, t)[c], sides.at(kSecond, b, t)[c]) ? 0 : 1;
            constexpr std::size_t kTwists[] = {kTwist, kTwist};
            found.twist += sides.at(kTwists, a, t)[c] == sides.at(kTwists, b, t)[c] ? 0 : 1;
          }
        }
        found.samples += along;
      }
    }
    return found;
  }

  template <typename T>
  void expect_equal_edges(const PackOptions& packing = {}) {
    const Differences found = run<T>(packing, {.threads = 1});
    EXPECT_EQ(found.first, 0U) << "of " << found.samples << " samples";
    EXPECT_EQ(found.second, 0U) << "of " << found.samples << " samples";
    // The twist is the patch's own: it is not made from the edge.
    EXPECT_GT(found.twist, found.samples);
  }
};

TEST_P(EdgeDerivativeTest, AlongSharedEdgesFloat) { expect_equal_edges<float>(); }
TEST_P(EdgeDerivativeTest, AlongSharedEdgesDouble) { expect_equal_edges<double>(); }
TEST_P(EdgeDerivativeTest, WithLocalOriginsFloat) {
  expect_equal_edges<float>({.local_origin = true});
}

// The counterproof.
TEST_P(EdgeDerivativeTest, ComparisonSeesOpenEdges) {
  const Differences found = run<float>({}, {.threads = 1, .watertight = false});
  EXPECT_GT(found.first, found.samples / 3);
  EXPECT_GT(found.second, found.samples / 3);
}

INSTANTIATE_FOR_EVERY_ISA(EdgeDerivativeTest);

} // namespace
} // namespace simdbezier::tests::edge_derivatives_test
