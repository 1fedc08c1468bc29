// Long edges against several short ones: patches are cut until edges are equal.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/general_nets.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::split_edges_test {
namespace {

constexpr double kScales[] = {1, 3, 7, 0.1, 1e6};

/// Cuts one patch of a gluing in u or v into two or three, so that it has corners on the sides of
/// its neighbours, or on its own ones.
std::vector<GeneralNet> with_a_cut(std::vector<GeneralNet> nets, std::mt19937& random) {
  const long double arbitrary = static_cast<long double>(random() % 1000 + 100) / 1300;
  const long double places[] = {0.5L, 0.25L, 1 / 3.0L, 0.75L, arbitrary};
  const std::size_t at = random() % nets.size();
  const bool in_v = random() % 2 != 0;
  const bool twice = random() % 3 == 0;
  const GeneralNet net = in_v ? transposed(nets[at]) : nets[at];
  const long double t = places[random() % 5];
  nets.erase(nets.begin() + static_cast<std::ptrdiff_t>(at));
  std::vector<long double> bounds = {0, t, 1};
  if (twice) {
    bounds = {0, t / 2, t, 1};
  }
  for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
    const GeneralNet part = cut(net, bounds[k], bounds[k + 1]);
    nets.push_back(in_v ? transposed(part) : part);
  }
  std::shuffle(nets.begin(), nets.end(), random);
  return nets;
}

template <typename S>
class SplitEdges : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SplitEdges, Scalars);

/// Every vertex is the point of its patch at its parameters.
template <typename S>
void expect_parameters(const Mesh<S>& mesh, const std::vector<TestPatch>& patches, double most) {
  double worst = 0;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    ASSERT_LT(mesh.patches[k], patches.size());
    const TestPatch& patch = patches[mesh.patches[k]];
    const auto x = patch.at(static_cast<long double>(mesh.parameters[k][0]),
                            static_cast<long double>(mesh.parameters[k][1]));
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, static_cast<double>(std::fabs(
                                  x[c] - static_cast<long double>(mesh.positions[k][c]))));
    }
  }
  EXPECT_LE(worst, most);
}

/// Pieces begin where they say, but for the errors that they state; what is not cut has none.
template <typename S>
void expect_errors(const GeneralViews<S>& views, const std::vector<TestPatch>& patches) {
  SplitNets<S> split;
  ASSERT_EQ(split_edges<S>(views.nets, split), Status::ok);
  std::size_t number = 0;
  for (const ControlNets<S>& nets : split.nets) {
    for (std::size_t k = 0; k < nets.count; ++k, ++number) {
      const PatchPiece& piece = split.pieces[number];
      EXPECT_EQ(piece.error > 0, piece.u0 > 0 || piece.u1 < 1 || piece.v0 > 0 || piece.v1 < 1);
      const auto x = patches[piece.patch].at(static_cast<long double>(piece.u0),
                                             static_cast<long double>(piece.v0));
      const S* const at = nets.points + static_cast<std::ptrdiff_t>(k) * nets.patch_stride;
      const long double weight = nets.weights == Weights::homogeneous ? at[3] : S(1);
      for (std::size_t c = 0; c < 3; ++c) {
        const long double apart = std::fabs(at[c] / weight - x[c]);
        EXPECT_LE(apart, piece.error + 1e-18L * std::fabs(x[c]));
      }
    }
  }
}

/// What patches of a gluing have besides a cut: unlike ones differ in degrees and scales of
/// weights.
enum class Kind : std::uint8_t { plain, weighted, unlike };

template <typename S>
void expect_closed(unsigned seed, Kind kind) {
  const RandomGluing gluing(seed);
  std::mt19937 random(seed + 1000);
  const double size = kScales[random() % std::size(kScales)];
  std::vector<TestPatch> patches;
  for (GeneralNet net : with_a_cut(nets_of(gluing, kind != Kind::plain), random)) {
    net = kind == Kind::unlike ? raised_at_random(net, random) : net;
    const double factor = kind == Kind::unlike ? kScales[random() % std::size(kScales)] : 1;
    patches.push_back(rounded_patch<S>(weighted(placed(net, size, {0, 0, 0}), factor),
                                       kind == Kind::plain ? Weights::none
                                       : seed % 2 == 0     ? Weights::cartesian
                                                           : Weights::homogeneous));
  }
  const GeneralViews<S> views(patches);
  MeshOptions options;
  options.rates.tolerance = 0.2 * size;
  options.split_edges = true;
  options.normals = false;
  options.parameters = true;
  const MeshPlan<S> plan = plan_mesh<S, S>(views.nets, options);
  ASSERT_EQ(plan.report.status, Status::ok);
  const Mesh<S> mesh = tessellate<S, S>(views.nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  expect_parameters(mesh, patches, size * (sizeof(S) == 4 ? 1e-3 : 1e-9));
  expect_errors(views, patches);
  if (seed % 4 == 0) {
    expect_certified(plan, mesh, patches);
  }
  EXPECT_EQ(mesh.splits.unjoined, 0U);
  options.parameters = false; // which split vertices
  const TriangleCensus census = census_of(tessellate<S, S>(views.nets, options));
  EXPECT_EQ(mesh.counts.open_edges > 0, gluing.open_edges > 0);
  EXPECT_EQ(census.open > 0, gluing.open_edges > 0);
  EXPECT_EQ(gluing.folded ? 0 : census.crowded + census.degenerate, 0U);
  const Mesh<double> before =
      tessellate<double>(ControlNets<double>::packed(std::span<const double>(gluing.values)),
                         {.rates = {.tolerance = 0.2}, .normals = false});
  EXPECT_EQ(gluing.folded ? 0 : census.euler - census_of(before).euler, 0);
  EXPECT_EQ(gluing.folded ? 0 : census.loops - census_of(before).loops, 0U);
}

TYPED_TEST(SplitEdges, close_gluings_of_which_one_patch_is_cut) {
  const unsigned gluings = by_form<unsigned>(40, 500);
  for (unsigned seed = 0; seed < gluings; ++seed) {
    for (const Kind kind : {Kind::plain, Kind::weighted, Kind::unlike}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      expect_closed<TypeParam>(seed, kind);
    }
  }
}

/// The same surfaces in other words.
struct Relation {
  const char* name;
  GeneralNet (*of)(const GeneralNet& net);
  double scale = 1;
};
constexpr Relation kRelations[] = {
    {"transposed", [](const GeneralNet& net) { return transposed(net); }},
    {"reversed in u", [](const GeneralNet& net) { return reversed(net); }},
    {"reversed in v", [](const GeneralNet& net) { return transposed(reversed(transposed(net))); }},
    {"scaled",
     [](const GeneralNet& net) {
       return placed(net, 8, {0, 0, 0});
     },
     8},
    {"reweighted", [](const GeneralNet& net) { return weighted(net, 4); }},
    {"raised", [](const GeneralNet& net) { return transposed(raised(transposed(raised(net)))); }}};

template <typename S>
SplitNets<S> split_of(const std::vector<GeneralNet>& nets, const Relation* relation) {
  std::vector<TestPatch> patches;
  for (const GeneralNet& net : nets) {
    patches.push_back(
        rounded_patch<S>(relation == nullptr ? net : relation->of(net), Weights::homogeneous));
  }
  const GeneralViews<S> views(patches);
  SplitNets<S> split;
  EXPECT_EQ(split_edges<S>(views.nets, split), Status::ok);
  return split;
}

/// How many pieces each patch has.
template <typename S>
std::map<std::uint32_t, int> pieces_of(const SplitNets<S>& split) {
  std::map<std::uint32_t, int> count;
  for (const PatchPiece& piece : split.pieces) {
    ++count[piece.patch];
  }
  return count;
}

TYPED_TEST(SplitEdges, are_the_same_of_the_same_surfaces) {
  std::size_t split_edges = 0;
  for (unsigned seed = 0; seed < by_form<unsigned>(20, 100); ++seed) {
    std::mt19937 random(seed);
    const std::vector<GeneralNet> nets = with_a_cut(nets_of(RandomGluing(seed), true), random);
    const SplitNets<TypeParam> split = split_of<TypeParam>(nets, nullptr);
    EXPECT_EQ(split.counts.unjoined, 0U) << seed;
    split_edges += split.counts.splits;
    for (const Relation& relation : kRelations) {
      const SplitNets<TypeParam> other = split_of<TypeParam>(nets, &relation);
      const std::string what = std::to_string(seed) + ", " + relation.name;
      EXPECT_EQ(other.counts.splits, split.counts.splits) << what;
      EXPECT_EQ(other.counts.unjoined, 0U) << what;
      EXPECT_EQ(pieces_of(other), pieces_of(split)) << what;
      if (relation.scale != 1) {
        EXPECT_EQ(other.snap, relation.scale * split.snap) << what;
      }
    }
  }
  EXPECT_GT(split_edges, 10U);
}

/// A patch of degree 1 x 2 over x from 0 to 1, cut in v into equal parts.
std::vector<GeneralNet> column(int parts) {
  GeneralNet whole{1, 2, {}};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      whole.points.push_back({1.0L * i, 4.0L * j, j == 1 ? 4.0L : 0.0L, 1.0L});
    }
  }
  std::vector<GeneralNet> nets;
  for (int k = 0; k < parts; ++k) {
    const long double all = parts;
    nets.push_back(transposed(cut(transposed(whole), k / all, (k + 1) / all)));
  }
  return nets;
}

/// A column of some patches, and one over x from -1 to 0, whose patches are off by a distance at
/// their inner control points.
template <typename S>
std::vector<TestPatch> two_columns(int right, int left, double off) {
  std::vector<TestPatch> patches;
  for (const GeneralNet& net : column(right)) {
    patches.push_back(rounded_patch<S>(net, Weights::none));
  }
  for (const GeneralNet& net : column(left)) {
    GeneralNet moved = placed(net, 1, {-1, 0, 0});
    moved.at(1, 1)[2] += off;
    patches.push_back(rounded_patch<S>(moved, Weights::none));
  }
  return patches;
}

TYPED_TEST(SplitEdges, join_an_edge_and_its_halves) {
  const GeneralViews<TypeParam> views(two_columns<TypeParam>(1, 2, 0));
  SplitNets<TypeParam> split;
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split), Status::ok);
  EXPECT_EQ(split.counts.splits, 2U);
  EXPECT_EQ(split.counts.unjoined, 0U);
  ASSERT_EQ(split.pieces.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(split.pieces[k].patch, k < 2 ? 0 : k - 1);
    EXPECT_EQ(split.pieces[k].v0, k == 1 ? 0.5 : 0);
    EXPECT_EQ(split.pieces[k].v1, k == 0 ? 0.5 : 1);
    EXPECT_EQ(split.pieces[k].u1 - split.pieces[k].u0, 1);
  }
  Topology topology;
  ASSERT_EQ(find_topology<TypeParam>(split.nets, topology), Status::ok);
  EXPECT_EQ(topology.counts().edges, 12U);
  EXPECT_EQ(topology.counts().open_edges, 8U) << "exact halves have equal control points";
}

/// Pieces are longer than what lies beside them, until all of them are cut.
TYPED_TEST(SplitEdges, join_thirds_with_other_parts) {
  for (const int parts : {1, 2, 4, 5}) {
    const GeneralViews<TypeParam> views(two_columns<TypeParam>(3, parts, 0));
    SplitNets<TypeParam> split;
    ASSERT_EQ(split_edges<TypeParam>(views.nets, split), Status::ok);
    EXPECT_EQ(split.counts.unjoined, 0U);
    const std::size_t pieces = parts == 1 ? 3 : static_cast<std::size_t>(2 + parts);
    EXPECT_EQ(split.pieces.size(), 2 * pieces) << parts;
    Topology topology;
    TopologyOptions how;
    how.snap = split.snap;
    ASSERT_EQ(find_topology<TypeParam>(split.nets, topology, how), Status::ok);
    EXPECT_EQ(topology.counts().open_edges, 2 * pieces + 4) << parts;
  }
}

TYPED_TEST(SplitEdges, go_along_with_leaving_out_and_turning_patches) {
  std::vector<TestPatch> patches = two_columns<TypeParam>(1, 2, 0);
  patches.insert(patches.begin(), patches[0]);
  std::reverse(patches.begin() + 2, patches.end());
  const GeneralViews<TypeParam> views(patches);
  MeshOptions options;
  options.nu = options.nv = 3;
  options.split_edges = options.drop_repeated = options.topology.orient = true;
  const MeshPlan<TypeParam> plan = plan_mesh<TypeParam, TypeParam>(views.nets, options);
  ASSERT_EQ(plan.report.status, Status::ok);
  EXPECT_EQ(plan.counts.repeated_patches, 1U);
  EXPECT_EQ(plan.counts.open_edges, 8U);
  EXPECT_EQ(plan.patches, (std::vector<std::uint32_t>{0, 0, 2, 3}));
  ASSERT_EQ(plan.pieces.size(), 4U);
  EXPECT_EQ(plan.pieces[3].patch, 3U);
  const Mesh<TypeParam> mesh = tessellate<TypeParam, TypeParam>(views.nets, options);
  ASSERT_EQ(mesh.report.status, Status::ok);
  EXPECT_EQ(mesh.positions.size(), 25U);
  EXPECT_EQ(mesh.deviations.size(), 4U);
  EXPECT_EQ(mesh.deviations[1], 0);
}

/// Two patches each of which has its right side along the lower half of the other's left one: each
/// cut leads to another one of half the size, until pieces are points.
TYPED_TEST(SplitEdges, end_in_spirals) {
  const auto quad = [](const Point& a, const Point& b, const Point& c, const Point& d) {
    GeneralNet net{1, 1, {}};
    for (const Point& x : {a, b, c, d}) {
      net.points.push_back({x[0], x[1], x[2], 1.0L});
    }
    return rounded_patch<TypeParam>(net, Weights::none);
  };
  const GeneralViews<TypeParam> views({quad({0, 0, 0}, {3, 0, 1}, {0, 1, 0}, {3, 0.5, 1}),
                                       quad({3, 0, 1}, {0, 0, 0}, {3, 1, 1}, {0, 0.5, 0})});
  SplitNets<TypeParam> split;
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split), Status::ok);
  EXPECT_EQ(split.counts.unjoined, 0U);
  EXPECT_GT(split.pieces.size(), 20U);
  EXPECT_LT(split.pieces.size(), 200U);
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split, {.most_pieces = 12}), Status::ok);
  EXPECT_GT(split.counts.unjoined, 0U);
  EXPECT_LE(split.pieces.size(), 12U);
}

TYPED_TEST(SplitEdges, count_what_cannot_be_joined) {
  const GeneralViews<TypeParam> views(two_columns<TypeParam>(1, 2, 0.01));
  SplitNets<TypeParam> split;
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split), Status::ok);
  EXPECT_EQ(split.nets.size(), 3U);
  EXPECT_EQ(split.counts.splits, 0U);
  EXPECT_EQ(split.counts.unjoined, 2U);
  EXPECT_NEAR(split.counts.largest_gap, 0.01, 1e-6);
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split, {.snap = 0.011}), Status::ok);
  EXPECT_EQ(split.counts.splits, 2U);
  EXPECT_EQ(split.counts.unjoined, 0U);
  EXPECT_EQ(split.snap, 0.011);
  ASSERT_EQ(split_edges<TypeParam>(views.nets, split, {.snap = 0.011, .most_pieces = 3}),
            Status::ok);
  EXPECT_EQ(split.counts.splits, 0U);
  EXPECT_EQ(split.counts.unjoined, 2U);
  EXPECT_EQ(split.pieces.size(), 3U);
}

/// Values that are no numbers, or have no place among others, are found by nobody, and nothing
/// hangs.
/// A rectangle in the plane z = 0, from (x0, y0) to (x1, y1).
std::vector<double> rectangle(double x0, double y0, double x1, double y1) {
  return {x0, y0, 0, x1, y0, 0, x0, y1, 0, x1, y1, 0};
}

// Corners on both sides of a patch that are nearly opposite make one cut, not two beside each
// other.
TEST(SplitEdgesCuts, that_are_nearer_than_the_snap_are_one) {
  for (const double y : {0.25, 1 / 3.0, 0.37, 0.6180339}) {
    for (const double apart : {0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-7, 1e-6, 9e-6}) {
      SCOPED_TRACE(testing::Message() << y << " and " << apart << " more");
      std::vector<double> values;
      for (const auto& part :
           {rectangle(0, 0, 1, 1), rectangle(-1, 0, 0, y), rectangle(-1, y, 0, 1),
            rectangle(1, 0, 2, y + apart), rectangle(1, y + apart, 2, 1)}) {
        values.insert(values.end(), part.begin(), part.end());
      }
      MeshOptions options;
      options.nu = options.nv = 2;
      options.topology.snap = 1e-5;
      options.split_edges = true;
      const auto nets = ControlNets<double>::packed(values.data(), 5, 1, 1);
      const MeshPlan<double> plan = plan_mesh<double>(nets, options);
      ASSERT_EQ(plan.report.status, Status::ok);
      EXPECT_EQ(plan.pieces.size(), 6U);
      EXPECT_EQ(plan.splits.unjoined, 0U);
      EXPECT_EQ(tessellate<double>(nets, options).triangles.size(), 12U);
    }
  }
}

TEST(SplitEdgesInput, odd_values_end) {
  const double odd[] = {0,
                        -1,
                        1e300,
                        -1e300,
                        1e-300,
                        std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()};
  for (const Weights form : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
    std::mt19937 random(3);
    for (int round = 0; round < 500; ++round) {
      std::vector<TestPatch> patches = two_columns<double>(1, 2, 0);
      for (TestPatch& patch : patches) {
        GeneralNet net{patch.degree_u, patch.degree_v, {}};
        for (std::size_t k = 0; k < patch.values.size(); k += 3) {
          net.points.push_back({patch.values[k], patch.values[k + 1], patch.values[k + 2], 1.0L});
        }
        patch = rounded_patch<double>(net, form);
        for (double& value : patch.values) {
          value = random() % 12 == 0 ? odd[random() % std::size(odd)] : value;
        }
      }
      const GeneralViews<double> views(patches);
      SplitNets<double> split;
      const Status status = split_edges<double>(views.nets, split);
      EXPECT_LE(split.pieces.size(), 24U);
      EXPECT_TRUE(status || split.pieces.empty());
    }
  }
}

// Values that are no numbers keep no others from their edges, wherever their patches stand.
TEST(SplitEdgesInput, patches_without_a_place_leave_all_others_alone) {
  constexpr std::size_t kModels = 10;
  std::mt19937 random(1);
  const auto rectangle = [](double x, double low, double high) {
    return std::array<double, 12>{x, low, 0, x + 1, low, 0, x, high, 0, x + 1, high, 0};
  };
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int round = 0; round < 50; ++round) {
      std::vector<std::array<double, 12>> patches;
      for (std::size_t k = 0; k < kModels; ++k) {
        const auto x = static_cast<double>(20 * k);
        patches.push_back(rectangle(x, 0, 1));
        patches.push_back(rectangle(x + 1, 0, 0.5));
        patches.push_back(rectangle(x + 1, 0.5, 1));
        patches.push_back(rectangle(static_cast<double>(random() % 200), 3, 4));
        patches.back()[0] = patches.back()[6] = odd;
      }
      std::shuffle(patches.begin(), patches.end(), random);
      const auto nets = ControlNets<double>::packed(patches.front().data(), patches.size(), 1, 1);
      SplitNets<double> split;
      ASSERT_EQ(split_edges(std::span(&nets, 1), split), Status::ok);
      EXPECT_EQ(split.counts.splits, 2 * kModels);
    }
  }
}

TEST(SplitEdgesInput, bad_input_is_a_status) {
  SplitNets<double> split;
  split.counts.splits = 77;
  auto nets = ControlNets<double>::packed(nullptr, 1, 3, 3);
  const auto status = [&](const SplitOptions& options) {
    return split_edges(std::span<const ControlNets<double>>(&nets, 1), split, options);
  };
  EXPECT_EQ(status({}), Status::null_input);
  EXPECT_EQ(status({.snap = -1}), Status::bad_tolerance);
  EXPECT_EQ(split.counts.splits, 77U);
  nets.count = 0;
  EXPECT_EQ(status({}), Status::ok);
  EXPECT_EQ(split.pieces.size(), 0U);
}

} // namespace
} // namespace simdbezier::tests::split_edges_test
