// Every file of the shared data folder, from one end of the program to the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/teapot.hpp>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/process/program.hpp"
#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/support/nets/data_files.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::data_files_test {
namespace {

constexpr const char* kNoData = "the shared data files are not here";

std::string without_gz(const std::string& name) {
  return name.ends_with(".gz") ? name.substr(0, name.size() - 3) : name;
}

class DataFileTest : public ::testing::TestWithParam<const char*> {
protected:
  void SetUp() override {
    const std::string text = data_text(GetParam());
    if (text.empty()) {
      GTEST_SKIP() << kNoData;
    }
    in_ = folder_.write(without_gz(GetParam()), text);
    nets_ = data_nets(GetParam());
  }
  [[nodiscard]] static bool lies() {
    return std::string(GetParam()).find("lying") != std::string::npos;
  }

  TemporaryFolder folder_;
  std::string in_;
  std::vector<Net> nets_;
};

TEST_P(DataFileTest, IsCounted) {
  const Outcome outcome = run({"info", in_, "--json"});
  if (lies()) {
    expect_failure(outcome, 1,
                   in_ + ":33: expected 32 patches of 48 coordinates as declared in line 1, found "
                         "the end of the file after 8 patches");
    return;
  }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"patches\": " + std::to_string(nets_.size()) + ","),
            std::string::npos)
      << outcome.out;
}

TEST_P(DataFileTest, IsTessellatedWithItsCornersInPlace) {
  for (const std::string extension : {"obj", "ply"}) {
    const std::string out = folder_.path("out." + extension);
    const Outcome outcome = run({"tessellate", in_, "--no-weld", "--grid", "4", "-o", out});
    if (lies()) {
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_FALSE(std::filesystem::exists(out));
      continue;
    }
    expect_silent_success(outcome);
    const ParsedMesh mesh =
        extension == "obj" ? parse_obj(read_file(out)) : parse_ply(read_file(out));
    EXPECT_EQ(mesh.triangles.size(), nets_.size() * 18);
    ASSERT_EQ(mesh.positions.size(), nets_.size() * 16);
    ASSERT_EQ(mesh.normals.size(), nets_.size() * 16);
    // On a 4x4 grid the corners have the numbers that they have among the control points.
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      const std::size_t point = k % 16;
      if (point == 0 || point == 3 || point == 12 || point == 15) {
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(static_cast<float>(mesh.positions[k][c]),
                    static_cast<float>(nets_[k / 16].points[point][c]))
              << "patch " << k / 16;
        }
      }
    }
  }
}

// Judges rows of positions by the published bound, at the centred parameters as rounded.
template <typename T>
void expect_accurate(const ParsedCsv& csv, std::vector<Net> nets, double bound) {
  for (Net& net : nets) {
    for (Vector3& point : net.points) {
      std::ranges::transform(point, point.begin(),
                             [](double x) { return double{static_cast<T>(x)}; });
    }
  }
  double worst = 0;
  for (const auto& row : csv.rows) {
    const Net& net = nets.at(static_cast<std::size_t>(row[0]));
    const Vector3dd exact = oracle_derivative(
        net, OracleParameter::centred(static_cast<T>(std::fma(2, row[1], -1))),
        OracleParameter::centred(static_cast<T>(std::fma(2, row[2], -1))), {0, 0});
    for (std::size_t c = 0; c < 3; ++c) {
      double largest = 0;
      for (const Vector3& point : net.points) {
        largest = std::max(largest, std::abs(point[c]));
      }
      const double error =
          std::abs((DoubleDouble(static_cast<T>(row[3 + c])) - exact[c]).to_double());
      EXPECT_LE(error, bound * kUnitRoundoff<T> * largest) << "patch " << row[0];
      worst = largest > 0 ? std::max(worst, error / largest / kUnitRoundoff<T>) : worst;
    }
  }
  EXPECT_GT(worst, 0) << "no sample was rounded, so nothing was judged";
}

TEST_P(DataFileTest, IsEvaluatedWithinTheBound) {
  if (lies()) {
    GTEST_SKIP() << "this file is refused";
  }
  Isa chosen = Isa::automatic;
  ASSERT_EQ(resolve_isa(Isa::automatic, chosen), Status::ok);
  const double bound = position_bound(fuses_multiply_add(chosen));
  const char* const grid = nets_.size() > 200 ? "4" : "16";
  for (const std::string precision : {"f32", "f64"}) {
    const Outcome outcome = run(
        {"evaluate", in_, "--grid", grid, "--precision", precision, "-o", folder_.path("out.csv")});
    expect_silent_success(outcome);
    const ParsedCsv csv = parse_csv(read_file(folder_.path("out.csv")));
    ASSERT_EQ(csv.rows.size(), nets_.size() * (nets_.size() > 200 ? 16 : 256));
    precision == "f32" ? expect_accurate<float>(csv, nets_, bound)
                       : expect_accurate<double>(csv, nets_, bound);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DataFileTest, ::testing::ValuesIn(kDataFiles), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, '.', '_');
  return name;
});

TEST(DataFiles, BuiltInTeapotIsThePublishedOne) {
  const std::vector<Net> nets = data_nets("teapot.bpt");
  if (nets.empty()) {
    GTEST_SKIP() << kNoData;
  }
  const tools::PatchFile teapot = tools::teapot();
  ASSERT_EQ(teapot.count, nets.size());
  ASSERT_EQ(teapot.points.size(), nets.size() * 48);
  for (std::size_t p = 0; p < nets.size(); ++p) {
    EXPECT_EQ(std::memcmp(nets[p].points.data(), &teapot.points[p * 48], 48 * sizeof(double)), 0)
        << "patch " << p;
  }
}

TEST(DataFiles, BuiltInTeapotEvaluatesLikeTheFile) {
  const TemporaryFolder folder;
  const std::string text = data_text("teapot.bpt");
  if (text.empty()) {
    GTEST_SKIP() << kNoData;
  }
  const std::string in = folder.write("teapot.bpt", text);
  for (const std::string precision : {"f32", "f64"}) {
    const Outcome file = run({"evaluate", in, "--precision", precision, "-o", "-"});
    const Outcome builtin =
        run({"evaluate", "builtin:teapot", "--precision", precision, "-o", "-"});
    EXPECT_EQ(file.exit_code, 0);
    EXPECT_TRUE(file.out == builtin.out);
  }
}

TEST(DataFiles, GumboHasItsEdges) {
  const TemporaryFolder folder;
  const std::string text = data_text("gumbo.bez");
  if (text.empty()) {
    GTEST_SKIP() << kNoData;
  }
  const Outcome outcome = run({"info", folder.write("gumbo.bez", text)});
  EXPECT_NE(outcome.out.find("494 shared, 8 boundary, 10 collapsed"), std::string::npos)
      << outcome.out;
}

TEST(DataFiles, CompressedFilesAreRead) {
  const std::string in = std::string(SIMDBEZIER_SHARED_DATA) + "/car4.bez.gz";
  if (!std::filesystem::exists(in)) {
    GTEST_SKIP() << kNoData;
  }
  EXPECT_NE(run({"info", in}).out.find("patches            14901\n"), std::string::npos);
}

} // namespace
} // namespace simdbezier::tests::data_files_test
