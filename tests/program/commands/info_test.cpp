// simdbezier info: counts, bounds and edges.
#include <gtest/gtest.h>

#include <cmath>

#include <simdbezier/options.hpp>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/nets/net_shapes.hpp"

namespace simdbezier::tests::info_test {
namespace {

// The number that follows "key": in JSON text; -1 where there is none.
double json_number(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": ");
  return at == std::string::npos ? -1 : std::strtod(json.c_str() + at + key.size() + 4, nullptr);
}

std::string info_json(const std::string& in) {
  const Outcome outcome = run({"info", in, "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

struct Edges {
  double shared, boundary, collapsed, non_manifold = 0;
  bool operator==(const Edges&) const = default;
};
void PrintTo(const Edges& edges, std::ostream* out) {
  *out << edges.shared << " shared, " << edges.boundary << " boundary, " << edges.collapsed
       << " collapsed, " << edges.non_manifold << " non-manifold";
}

Edges edges_of(const std::vector<Net>& nets) {
  const TemporaryFolder folder;
  const std::string json = info_json(folder.write("in.bez", bez_text(nets)));
  EXPECT_EQ(json_number(json, "total"), static_cast<double>(4 * nets.size()));
  return {json_number(json, "shared"), json_number(json, "boundary"),
          json_number(json, "collapsed"), json_number(json, "non_manifold")};
}

TEST(Info, DescribesTheTeapot) {
  const std::string json = info_json("builtin:teapot");
  EXPECT_EQ(json_number(json, "patches"), 32);
  EXPECT_EQ(json_number(json, "u"), 3);
  EXPECT_EQ(json_number(json, "v"), 3);
  EXPECT_EQ(json_number(json, "total"), 128);
  EXPECT_EQ(json_number(json, "shared"), 104);
  EXPECT_EQ(json_number(json, "boundary"), 16);
  EXPECT_EQ(json_number(json, "collapsed"), 8);
  std::string compact = json;
  std::erase_if(compact, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(compact.find("\"control_point_box\":{\"min\":[-3.0,-2.0,0.0],"
                         "\"max\":[3.525,2.0,3.15]}"),
            std::string::npos)
      << compact;
}

TEST(Info, SaysTheSameInWords) {
  const std::string isas = "instruction sets   " + std::string(to_string(available_isas().front()));
  const Outcome outcome = run({"info", "builtin:teapot"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* const part :
       {"patches            32\n", "degrees            3 in u, 3 in v\n",
        "control point box  [-3, -2, 0] to [3.525, 2, 3.15]\n",
        "104 shared, 16 boundary, 8 collapsed, 0 non-manifold", isas.c_str(), "chosen  "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  }
}

TEST(Info, FindsSharedEdgesInEveryOrientation) {
  for (int edge_a = 0; edge_a < 4; ++edge_a) {
    for (int edge_b = 0; edge_b < 4; ++edge_b) {
      for (const bool reversed : {false, true}) {
        Net a = distinct_net(1);
        Net b = distinct_net(2);
        for (int k = 0; k < 4; ++k) {
          side_point(b, edge_b, reversed ? 3 - k : k) = side_point(a, edge_a, k);
        }
        EXPECT_EQ(edges_of({a, b}), (Edges{2, 6, 0})) << edge_a << " " << edge_b << reversed;
      }
    }
  }
}

TEST(Info, ComparesEdgesBitByBitButZeroes) {
  Net a = flat_net();
  Net b = flat_net();
  for (Vector3& point : b.points) {
    point[0] += 1;
    point[2] = -0.0;
  }
  for (int j = 0; j < 4; ++j) {
    b.at(j, 0) = a.at(j, 3);
    b.at(j, 0)[2] = -0.0;
  }
  EXPECT_EQ(edges_of({a, b}), (Edges{2, 6, 0}));
  b.at(1, 0)[1] = std::nextafter(b.at(1, 0)[1], 2);
  EXPECT_EQ(edges_of({a, b}), (Edges{0, 8, 0}));
}

TEST(Info, KnowsClosedAndCollapsedEdges) {
  Net closed = distinct_net(1); // its two columns are one: a tube
  for (int j = 0; j < 4; ++j) {
    closed.at(j, 3) = closed.at(j, 0);
  }
  EXPECT_EQ(edges_of({closed}), (Edges{2, 2, 0}));

  Net loop = distinct_net(1); // an edge that ends where it begins, and its reverse
  loop.at(0, 3) = loop.at(0, 0);
  Net other = distinct_net(2);
  for (int i = 0; i < 4; ++i) {
    other.at(0, i) = loop.at(0, 3 - i);
  }
  EXPECT_EQ(edges_of({loop, other}), (Edges{2, 6, 0}));

  Net collapsed = distinct_net(1);
  for (int i = 1; i < 4; ++i) {
    collapsed.at(3, i) = collapsed.at(3, 0);
  }
  EXPECT_EQ(edges_of({collapsed}), (Edges{0, 3, 1}));
  EXPECT_EQ(edges_of({collapsed, collapsed}), (Edges{6, 0, 2}));
  EXPECT_EQ(edges_of({collapsed, collapsed, collapsed}), (Edges{0, 0, 3, 9}));
}

} // namespace
} // namespace simdbezier::tests::info_test
