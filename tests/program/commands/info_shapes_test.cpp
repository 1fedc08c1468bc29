// simdbezier info on patches of any shape: which shapes there are, their box, and their edges.
#include <gtest/gtest.h>

#include <array>

#include <tools/patches/edge_counts.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::info_shapes_test {
namespace {

std::string info(const std::string& in, bool json) {
  const Outcome outcome = json ? run({"info", in, "--json"}) : run({"info", in});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  std::string text = outcome.out;
  if (json) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  }
  return text;
}

TEST(InfoShapes, CountsThePatchesOfEachShape) {
  const std::string json = info(sample_path("bv"), true);
  EXPECT_NE(json.find("\"patches\":3,\"rational\":1,\"shapes\":["
                      "{\"degree_u\":1,\"degree_v\":1,\"rational\":false,\"patches\":1},"
                      "{\"degree_u\":1,\"degree_v\":2,\"rational\":true,\"patches\":1},"
                      "{\"degree_u\":3,\"degree_v\":2,\"rational\":false,\"patches\":1}]"),
            std::string::npos)
      << json;
  EXPECT_EQ(json.find("\"degrees\""), std::string::npos);
  EXPECT_NE(info(sample_path("rib"), false)
                .find("patches            4\n"
                      "degrees            1 in u, 1 in v: 1 patch\n"
                      "                   1 in u, 1 in v, rational: 1 patch\n"
                      "                   3 in u, 3 in v: 2 patches\n"),
            std::string::npos);
}

TEST(InfoShapes, NamesTheDegreesThatAllPatchesHave) {
  const TemporaryFolder folder;
  const std::string points = "0 0 0 1  1 0 0 1  2 0 0 1  0 1 0 1  1 1 0 1  2 1 0 1\n";
  const std::string rational = folder.write("in.bv", "8\n1 2\n" + points + "8\n1 2\n" + points);
  EXPECT_NE(info(rational, false).find("degrees            2 in u, 1 in v, rational\n"),
            std::string::npos);
  EXPECT_NE(info(rational, true).find("\"degrees\":{\"u\":2,\"v\":1},\"rational\":2,"),
            std::string::npos);
}

TEST(InfoShapes, HasTheSplinesThatPatchesCameFrom) {
  const std::string text = info(sample_path("iges"), false);
  EXPECT_NE(
      text.find("splines            line 14: degrees 3 x 2, 4 x 3 points, 1 x 1 patches, 2 x 2 "
                "different knots\n"
                "                   line 19: degrees 1 x 2 (rational), 2 x 3 points, 1 x 1 "
                "patches, 2 x 2 different knots\n"),
      std::string::npos)
      << text;
  const std::string json = info(sample_path("iges"), true);
  EXPECT_NE(json.find("\"splines\":[{\"line\":14,\"first_patch\":0,\"rational\":false,\"u\":{"
                      "\"degree\":3,\"points\":4,\"periodic\":false,\"patches\":1,"
                      "\"knots\":[0.0,0.0,0.0,0.0,1.0,1.0,1.0,1.0]},\"v\":{"),
            std::string::npos)
      << json;
  EXPECT_EQ(info(sample_path("obj"), true).find("splines"), std::string::npos);
}

TEST(InfoShapes, BoxHoldsCartesianPoints) {
  for (const char* const format : {"bv", "itd", "obj"}) {
    const std::string text = info(sample_path(format), false);
    EXPECT_NE(text.find("[0, -14, -3] to [32, 100, 8.25]"), std::string::npos) << text;
  }
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bv", "8 1 1\n2 4 6 2  0 1 0 0.25  -8 0 0 4  1 1 1 1\n");
  EXPECT_NE(info(in, false).find("[-2, 0, 0] to [1, 4, 3]"), std::string::npos) << info(in, false);
}

// A patch in whose points the first of four numbers tells them apart; the last one is a weight.
using Points = std::vector<std::array<double, 4>>;
struct TestPatch {
  int degree_u;
  int degree_v;
  Weights weights;
  Points points;
};

TestPatch test_patch(int degree_u, int degree_v, double first, Weights weights = Weights::none) {
  TestPatch patch{degree_u, degree_v, weights, {}};
  for (int k = 0; k < (degree_u + 1) * (degree_v + 1); ++k) {
    patch.points.push_back({first + k, 1, 2, 1.0 + k});
  }
  return patch;
}

tools::EdgeCounts edges_of(const std::vector<TestPatch>& patches) {
  tools::PatchFile file;
  for (const TestPatch& patch : patches) {
    const std::ptrdiff_t values = patch.weights == Weights::none ? 3 : 4;
    for (const auto& point : patch.points) {
      file.points.insert(file.points.end(), point.begin(), point.begin() + values);
    }
    file.close_patch(patch.degree_u, patch.degree_v, patch.weights);
  }
  return tools::EdgeCounts(tools::joined_counts(file));
}

void expect_edges(const std::vector<TestPatch>& patches, std::size_t shared, std::size_t boundary,
                  std::size_t collapsed) {
  const tools::EdgeCounts counts = edges_of(patches);
  EXPECT_EQ(counts.shared, shared);
  EXPECT_EQ(counts.boundary, boundary);
  EXPECT_EQ(counts.collapsed, collapsed);
}

// Point k of one of the four edges: v = 0, v = 1, u = 0, u = 1.
std::array<double, 4>& edge_point(TestPatch& patch, int edge, int k) {
  const int last_u = patch.degree_u;
  const int last_v = patch.degree_v;
  const int i = edge < 2 ? k : (edge == 2 ? 0 : last_u);
  const int j = edge >= 2 ? k : (edge == 0 ? 0 : last_v);
  return patch.points[static_cast<std::size_t>(j * (last_u + 1) + i)];
}

TEST(EdgeCounts, EdgesOfEqualDegreeMeetWhateverTheOtherDegreeIs) {
  for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
    for (int degree = 1; degree <= 15; ++degree) {
      for (const int edge_a : {0, 1, 2, 3}) {
        const int other = degree == 15 ? 1 : degree + 1;
        TestPatch a = edge_a < 2 ? test_patch(degree, other, 100, weights)
                                 : test_patch(other, degree, 100, weights);
        TestPatch b = test_patch(16 - degree == degree ? 1 : 16 - degree, degree, 900, weights);
        for (int k = 0; k <= degree; ++k) {
          edge_point(b, 2, k) = edge_point(a, edge_a, edge_a % 2 == 0 ? k : degree - k);
        }
        expect_edges({a, b}, 2, 6, 0);
        edge_point(b, 2, degree / 2)[1] += 1e-9;
        expect_edges({a, b}, 0, 8, 0);
      }
    }
  }
}

TEST(EdgeCounts, WeightsBelongToAnEdge) {
  TestPatch a = test_patch(2, 1, 100, Weights::cartesian);
  TestPatch b = test_patch(2, 1, 900, Weights::cartesian);
  for (int k = 0; k <= 2; ++k) {
    edge_point(b, 0, k) = edge_point(a, 1, k);
  }
  expect_edges({a, b}, 2, 6, 0);
  edge_point(b, 0, 1)[3] = 50;
  expect_edges({a, b}, 0, 8, 0);
  edge_point(b, 0, 1) = edge_point(a, 1, 1);
  b.weights = Weights::none;
  expect_edges({a, b}, 0, 8, 0);
}

TEST(EdgeCounts, CollapsedEdgesMayHaveWeights) {
  TestPatch patch = test_patch(2, 1, 100, Weights::homogeneous);
  for (int k = 0; k <= 2; ++k) {
    const double weight = 1 << k;
    edge_point(patch, 0, k) = {3 * weight, 0, weight / 4, weight};
  }
  expect_edges({patch}, 0, 3, 1);
  patch.weights = Weights::cartesian;
  expect_edges({patch}, 0, 4, 0);
}

} // namespace
} // namespace simdbezier::tests::info_shapes_test
