// Edge links against brute force, on random soups of all degrees, the teapot and the data files.
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <tools/formats/teapot.hpp>
#include <tools/patches/edge_counts.hpp>

#include "src/nets/edge_keys.hpp"
#include "tests/nets/net_batches.hpp"
#include "tests/support/nets/data_files.hpp"

namespace simdbezier::tests::adjacency_test {
namespace {

/// An edge's points in its own direction, a key for comparing; equal values compare equal, so -0 is
/// 0. Every point has a weight behind its components.
template <typename T>
struct Edge {
  int degree;
  Weights weights;
  std::vector<std::vector<T>> points;

  /// Quotients of homogeneous points may differ by 16 roundings.
  [[nodiscard]] bool collapsed() const {
    const double tolerance =
        weights == Weights::homogeneous ? 8 * double{std::numeric_limits<T>::epsilon()} : 0;
    for (std::size_t c = 0; c + 1 < points[0].size(); ++c) {
      std::vector<double> values;
      for (const std::vector<T>& point : points) {
        const double divisor = weights == Weights::homogeneous ? double{point.back()} : 1;
        values.push_back(double{point[c]} / divisor);
      }
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      if (*high - *low > tolerance * std::max(std::fabs(*low), std::fabs(*high))) {
        return false;
      }
    }
    return true;
  }
  /// The form of a point whose weight is 1 does not matter.
  [[nodiscard]] bool same_point(std::size_t k, const Edge& other, std::size_t l) const {
    return points[k] == other.points[l] && (points[k].back() == 1 || weights == other.weights);
  }
  [[nodiscard]] bool same(const Edge& other, bool backward) const {
    bool all = degree == other.degree && points[0].size() == other.points[0].size();
    for (std::size_t k = 0; all && k < points.size(); ++k) {
      all = same_point(k, other, backward ? points.size() - 1 - k : k);
    }
    return all;
  }
};

template <typename T>
std::vector<Edge<T>> edges_of(const std::vector<Batch<T>>& soup) {
  std::vector<Edge<T>> edges;
  for (const Batch<T>& batch : soup) {
    const int m = batch.shape.degree_u;
    const int n = batch.shape.degree_v;
    for (std::size_t p = 0; p < batch.count; ++p) {
      for (int side = 0; side < 4; ++side) {
        Edge<T> edge{side < 2 ? m : n, batch.shape.weights, {}};
        for (int k = 0; k <= edge.degree; ++k) {
          const int j = side < 2 ? side * n : k;
          const int i = side < 2 ? k : (side - 2) * m;
          const T* const point = &batch.at(p, j, i, 0);
          edge.points.emplace_back(point, point + batch.channels());
          if (edge.weights == Weights::none) {
            edge.points.back().push_back(1);
          }
        }
        edges.push_back(std::move(edge));
      }
    }
  }
  return edges;
}

template <typename T>
std::vector<EdgeLink> brute_force(const std::vector<Batch<T>>& soup) {
  const std::vector<Edge<T>> edges = edges_of(soup);
  std::vector<EdgeLink> links(edges.size());
  for (std::size_t a = 0; a < edges.size(); ++a) {
    if (edges[a].collapsed()) {
      links[a] = {EdgeKind::collapsed};
      continue;
    }
    std::size_t others = 0;
    for (std::size_t step = edges.size() - 1; step > 0;
         --step) { // the nearest one ahead comes last
      const std::size_t b = (a + step) % edges.size();
      const bool forward = edges[a].same(edges[b], false);
      if (!edges[b].collapsed() && (forward || edges[a].same(edges[b], true))) {
        ++others;
        links[a] = {EdgeKind::shared, static_cast<PatchEdge>(b % 4), !forward, b / 4};
      }
    }
    links[a].kind = others == 0   ? EdgeKind::boundary
                    : others == 1 ? EdgeKind::shared
                                  : EdgeKind::non_manifold;
  }
  return links;
}

template <typename T>
std::vector<EdgeLink> links_of(const std::vector<Batch<T>>& soup, int threads) {
  std::vector<ControlNets<T>> sets;
  std::size_t patches = 0;
  for (const Batch<T>& batch : soup) {
    sets.push_back(batch.nets());
    patches += batch.count;
  }
  std::vector<EdgeLink> links(4 * patches, {EdgeKind::shared, PatchEdge::u1, true, 99});
  EXPECT_EQ(
      find_adjacency(std::span<const ControlNets<T>>(sets), links.data(), {.threads = threads}),
      Status::ok);
  return links;
}

template <typename T>
void expect_links(const std::vector<Batch<T>>& soup) {
  const std::vector<EdgeLink> expected = brute_force(soup);
  for (const int threads : {1, 2, 3, 7}) {
    const std::vector<EdgeLink> links = links_of(soup, threads);
    ASSERT_EQ(links.size(), expected.size());
    for (std::size_t k = 0; k < links.size(); ++k) {
      EXPECT_EQ(links[k], expected[k])
          << "edge " << k << ": kind " << static_cast<int>(links[k].kind) << " for "
          << static_cast<int>(expected[k].kind) << ", patch " << links[k].patch << " for "
          << expected[k].patch;
    }
  }
}

/// Values from a handful of numbers, zeros of both signs among them: many edges match, in both
/// directions, more than once, are palindromes or collapsed.
template <typename T>
std::vector<Batch<T>> random_soup(std::uint64_t seed) {
  Random random(seed);
  std::vector<Batch<T>> soup;
  const Weights weights[] = {Weights::none, Weights::none, Weights::cartesian,
                             Weights::homogeneous};
  for (int k = 0; k < 8; ++k) {
    const int m = random.integer(1, 3);
    const int n = random.integer(1, 3);
    const Shape shape{m, n, random.integer(1, 2), weights[random.below(4)]};
    Batch<T> batch(shape, random.below(6));
    const T values[] = {T(0), T(-0.0), T(1), T(1)};
    for (std::size_t v = 0; v < batch.values.size(); ++v) {
      batch.values[v] =
          batch.is_weight(v % batch.channels()) ? T(1 + random.below(2)) : values[random.below(4)];
    }
    soup.push_back(std::move(batch));
  }
  return soup;
}

TEST(Adjacency, RandomSoupsFloat) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    expect_links(random_soup<float>(seed));
  }
}
TEST(Adjacency, RandomSoupsDouble) {
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    expect_links(random_soup<double>(seed));
  }
}

/// Patches with edges A B C D, A C B D, and both from the other end on, in different places.
template <typename T>
Batch<T> crossed_edges(Weights weights) {
  Batch<T> batch = random_batch<T>({3, 3, 3, weights}, 4, 71);
  const Batch<T> points = random_batch<T>({3, 3, 3, weights}, 1, 72);
  constexpr int kOrders[4][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {3, 1, 2, 0}, {3, 2, 1, 0}};
  for (std::size_t p = 0; p < 4; ++p) {
    for (int k = 0; k < 4; ++k) {
      const int row = p == 2 ? 3 : p == 3 ? k : 0;
      const int column = p == 3 ? 0 : k;
      for (int c = 0; c < static_cast<int>(batch.channels()); ++c) {
        batch.at(p, row, column, c) = points.at(0, 0, kOrders[p][k], c);
      }
    }
  }
  return batch;
}

// Hashes do not tell from which end an edge is read, and so cannot tell all edges apart.
TEST(Adjacency, EqualHashesOfDifferentEdges) {
  const Batch<float> batch = crossed_edges<float>(Weights::none);
  detail::EdgeKeys<float, 3, 3, false> keys(batch.nets());
  keys.read(&batch.at(0, 0, 0, 0));
  const std::uint64_t hash = keys.hash(0);
  keys.read(&batch.at(1, 0, 0, 0));
  EXPECT_EQ(keys.hash(0), hash);

  for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
    expect_links<float>({crossed_edges<float>(weights)});
    expect_links<double>({crossed_edges<double>(weights)});
  }
  const std::vector<EdgeLink> links = links_of<float>({batch}, 1);
  EXPECT_EQ(links[0], (EdgeLink{EdgeKind::shared, PatchEdge::u0, true, 3}));
  EXPECT_EQ(links[4], (EdgeLink{EdgeKind::shared, PatchEdge::v1, true, 2}));
}

// Sums of products of these points' values are 0, so that a key made of them alone would hide the
// other points of an edge from its hash, and thousands of edges would share one place in a table.
TEST(Adjacency, NoPointHidesOthersFromHashes) {
  constexpr float kHiding[2][3] = {{0.235063955F, -9.74690712e-26F, 2.47840054e-10F},
                                   {0.360965073F, -3.61747298e-26F, -1.70671812e-30F}};
  Batch<float> batch = random_batch<float>({3, 3, 3, Weights::none}, 2, 73);
  std::uint64_t hashes[2];
  for (std::size_t p = 0; p < 2; ++p) {
    for (int k = 0; k < 2; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        batch.at(p, 0, k, c) = kHiding[k][c];
      }
    }
    detail::EdgeKeys<float, 3, 3, false> keys(batch.nets());
    keys.read(&batch.at(p, 0, 0, 0));
    hashes[p] = keys.hash(0);
  }
  EXPECT_NE(hashes[0], hashes[1]);
}

// The soups hold what they are meant to hold.
TEST(Adjacency, SoupsHaveEveryKind) {
  std::size_t kinds[4] = {};
  std::size_t reversed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (const EdgeLink& link : brute_force(random_soup<float>(seed))) {
      ++kinds[static_cast<int>(link.kind)];
      reversed += link.reversed ? 1U : 0U;
    }
  }
  for (const std::size_t kind : kinds) {
    EXPECT_GT(kind, 20U);
  }
  EXPECT_GT(reversed, 20U);
}

TEST(Adjacency, Teapot) {
  const tools::PatchFile file = tools::teapot();
  Batch<double> batch({3, 3, 3, Weights::none}, file.count);
  batch.values.assign(file.points.begin(), file.points.end());
  expect_links<double>({batch});
  const tools::EdgeCounts counts(tools::joined_counts(file));
  EXPECT_EQ(counts.shared, 104U);
  EXPECT_EQ(counts.boundary, 16U);
  EXPECT_EQ(counts.collapsed, 8U);
}

TEST(Adjacency, DataFiles) {
  std::size_t files = 0;
  for (const char* const name : kDataFiles) {
    const std::vector<Net> nets = data_nets(name);
    if (nets.empty() || nets.size() > 600) { // brute force is quadratic
      continue;
    }
    SCOPED_TRACE(name);
    Batch<float> batch({3, 3, 3, Weights::none}, nets.size());
    batch.values = packed_points<float>(nets);
    expect_links<float>({batch});
    ++files;
  }
  if (files == 0) {
    GTEST_SKIP() << "no data files";
  }
}

/// One patch of degree 1 whose side v = 0 has these values at u = 0 and u = 1.
template <typename T>
Batch<T> with_side(Weights weights, std::vector<T> begin, std::vector<T> end) {
  Batch<T> batch = random_batch<T>({1, 1, 3, weights}, 1, 80 + static_cast<unsigned>(weights));
  for (std::size_t c = 0; c < batch.channels(); ++c) {
    batch.at(0, 0, 0, c) = begin[c];
    batch.at(0, 0, 1, c) = end[c];
  }
  return batch;
}

// A weight of 1 is none, point by point; another one makes points of two forms different ones.
TEST(Adjacency, FormsMatterWhereWeightsAreNotOne) {
  constexpr Weights kNone = Weights::none;
  constexpr Weights kCartesian = Weights::cartesian;
  constexpr Weights kHomogeneous = Weights::homogeneous;
  struct Case {
    Weights a;
    Weights b;
    float weight_a; // at one end
    float weight_b;
    bool same;
  };
  constexpr Case kCases[] = {
      {kNone, kCartesian, 1, 1, true},        {kNone, kHomogeneous, 1, 1, true},
      {kCartesian, kHomogeneous, 1, 1, true}, {kNone, kCartesian, 1, 2, false},
      {kNone, kHomogeneous, 1, 2, false},     {kCartesian, kHomogeneous, 2, 2, false},
      {kCartesian, kCartesian, 2, 2, true},   {kHomogeneous, kHomogeneous, 2, 2, true},
      {kCartesian, kCartesian, 1, 2, false},  {kNone, kCartesian, 1, -1, false}};
  for (const Case& one : kCases) {
    for (const bool reversed : {false, true}) {
      const std::vector<float> end{4, 5, 6, 1};
      const std::vector<float> begin{1, 2, 3, one.weight_b};
      const std::vector<Batch<float>> soup{with_side<float>(one.a, {1, 2, 3, one.weight_a}, end),
                                           reversed ? with_side<float>(one.b, end, begin)
                                                    : with_side<float>(one.b, begin, end)};
      const std::vector<EdgeLink> links = links_of(soup, 1);
      const EdgeLink expected = one.same ? EdgeLink{EdgeKind::shared, PatchEdge::v0, reversed, 1}
                                         : EdgeLink{EdgeKind::boundary};
      EXPECT_EQ(links[0], expected)
          << static_cast<int>(one.a) << static_cast<int>(one.b) << one.weight_b << reversed;
    }
  }
}

// 3/1 and 0.3/0.1 are one point, in both types, whatever the scale; points farther apart than
// roundings are not, nor are Cartesian ones that differ by a rounding.
template <typename T>
void expect_rounded_points() {
  for (const T scale : {T(1), T(7), T(0.1), T(1e6)}) {
    const auto kind = [&](Weights weights, const std::vector<T>& begin, const std::vector<T>& end) {
      return links_of<T>({with_side<T>(weights, begin, end)}, 1)[0].kind;
    };
    const std::vector<T> whole{0, 0, T(3) * scale, 1};
    const std::vector<T> tenth{0, 0, T(0.3) * scale, T(0.1)};
    const std::vector<T> far{0, 0, T(0.3) * scale * (1 + 20 * std::numeric_limits<T>::epsilon()),
                             T(0.1)};
    EXPECT_EQ(kind(Weights::homogeneous, whole, tenth), EdgeKind::collapsed) << scale;
    EXPECT_EQ(kind(Weights::homogeneous, tenth, whole), EdgeKind::collapsed) << scale;
    EXPECT_EQ(kind(Weights::homogeneous, whole, far), EdgeKind::boundary) << scale;
    const std::vector<T> up{0, 0, std::nextafter(whole[2], 2 * whole[2]), 1};
    EXPECT_EQ(kind(Weights::cartesian, whole, up), EdgeKind::boundary) << scale;
    EXPECT_EQ(kind(Weights::none, whole, up), EdgeKind::boundary) << scale;
  }
}
TEST(Adjacency, RoundedQuotientsAreOnePoint) {
  expect_rounded_points<float>();
  expect_rounded_points<double>();
}

// A regular mesh of many patches: every inner edge is shared, in time that is not quadratic.
TEST(Adjacency, LargeMesh) {
  constexpr std::size_t kSide = 250;
  Batch<float> batch({1, 1, 3, Weights::none}, kSide * kSide);
  for (std::size_t p = 0; p < batch.count; ++p) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        batch.at(p, j, i, 0) = static_cast<float>(p % kSide + static_cast<std::size_t>(i));
        batch.at(p, j, i, 1) = static_cast<float>(p / kSide + static_cast<std::size_t>(j));
        batch.at(p, j, i, 2) = 0;
      }
    }
  }
  std::vector<EdgeLink> links(4 * batch.count);
  ASSERT_EQ(find_adjacency(batch.nets(), links.data()), Status::ok);
  std::size_t boundary = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    boundary += links[k].kind == EdgeKind::boundary ? 1U : 0U;
    if (links[k].kind == EdgeKind::shared) {
      const EdgeLink& back = links[4 * links[k].patch + static_cast<std::size_t>(links[k].edge)];
      ASSERT_EQ(4 * back.patch + static_cast<std::size_t>(back.edge), k);
    }
  }
  EXPECT_EQ(boundary, 4 * kSide);
}

TEST(Adjacency, BadInput) {
  Batch<float> batch = random_batch<float>({2, 2, 3, Weights::none}, 2, 51);
  std::vector<EdgeLink> links(8, {EdgeKind::collapsed, PatchEdge::u1, true, 7});
  const std::vector<EdgeLink> before = links;
  const auto status = [&](auto change) {
    ControlNets<float> nets = batch.nets();
    change(nets);
    return find_adjacency(nets, links.data());
  };
  EXPECT_EQ(status([](auto& nets) { nets.points = nullptr; }), Status::null_input);
  EXPECT_EQ(status([](auto& nets) { nets.degree_u = 0; }), Status::bad_degree);
  EXPECT_EQ(status([](auto& nets) { nets.degree_v = 16; }), Status::bad_degree);
  EXPECT_EQ(status([](auto& nets) { nets.components = 0; }), Status::bad_components);
  EXPECT_EQ(status([](auto& nets) { nets.row_stride = 0; }), Status::bad_stride);
  EXPECT_EQ(status([](auto& nets) { nets.count = SIZE_MAX / 4; }), Status::size_overflow);
  EXPECT_EQ(status([](auto& nets) {
              nets.patch_stride = 0;
              nets.count = std::size_t{1} << 30;
            }),
            Status::size_overflow);
  EXPECT_EQ(links, before);
  EXPECT_EQ(find_adjacency(batch.nets(), nullptr), Status::null_output);
  // Nets within the room for the links.
  std::vector<EdgeLink> both(64, before[0]);
  const ControlNets<float> nets = batch.nets();
  auto* const points = reinterpret_cast<float*>(both.data() + 2);
  std::memcpy(points, nets.points, 2 * 9 * 3 * sizeof(float));
  ControlNets<float> inside = nets;
  inside.points = points;
  EXPECT_EQ(find_adjacency(inside, both.data()), Status::overlapping_outputs);
  EXPECT_EQ(both[0], before[0]);
  EXPECT_EQ(find_adjacency(inside, both.data() + 32), Status::ok);
  // Links in the gap between two nets.
  inside.patch_stride = 40 * sizeof(EdgeLink) / sizeof(float);
  EXPECT_EQ(find_adjacency(inside, both.data() + 20), Status::overlapping_outputs);
  EXPECT_EQ(both[20], before[0]);
  EXPECT_EQ(find_adjacency(std::span<const ControlNets<float>>(), nullptr), Status::ok);
  EXPECT_EQ(find_adjacency(ControlNets<float>{}, nullptr), Status::ok);
}

} // namespace
} // namespace simdbezier::tests::adjacency_test
