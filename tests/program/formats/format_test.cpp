// What the readers make of good files of every format: degrees, order of points, weights, lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

void PrintTo(const WeightedPoint& p, std::ostream* out) {
  *out << "(" << p.x << ", " << p.y << ", " << p.z << "; " << p.w << ")";
}

namespace {

void expect_patches(const tools::PatchFile& file, const std::vector<ExpectedPatch>& patches) {
  ASSERT_EQ(file.count, patches.size());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const tools::PatchRun& run = file.run_of(p);
    EXPECT_EQ(run.degree_u, patches[p].degree_u) << "patch " << p;
    EXPECT_EQ(run.degree_v, patches[p].degree_v) << "patch " << p;
    EXPECT_EQ(run.rational(), patches[p].rational) << "patch " << p;
    EXPECT_EQ(patch_points(file, p), expected_points(patches[p])) << "patch " << p;
  }
}

class SampleFileTest : public ::testing::TestWithParam<const char*> {};

TEST_P(SampleFileTest, HoldsItsPatches) {
  const std::string path = sample_path(GetParam());
  expect_patches(tools::read_patches(path, tools::PatchFormat::by_name),
                 sample_patches(GetParam()));
}

TEST_P(SampleFileTest, IsReadFromStandardInput) {
  const Outcome outcome = run({"info", "-", "--format", GetParam(), "--json"},
                              {.input = read_file(sample_path(GetParam()))});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t patches = sample_patches(GetParam()).size();
  EXPECT_NE(outcome.out.find("\"patches\": " + std::to_string(patches) + ","), std::string::npos)
      << outcome.out;
}

// What has no bearing on a text, whatever its format: points and their lines stay.
TEST_P(SampleFileTest, MayHaveAnyLineEndsAndAByteOrderMark) {
  const std::string text = read_file(sample_path(GetParam()));
  const tools::PatchFile plain = read_text(GetParam(), text);
  for (const std::string mark : {"", "\xef\xbb\xbf"}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      SCOPED_TRACE(testing::PrintToString(mark + end));
      const tools::PatchFile file = read_text(GetParam(), mark + with_line_ends(text, end));
      expect_patches(file, sample_patches(GetParam()));
      EXPECT_EQ(file.lines, plain.lines);
    }
  }
}

TEST(TextBlocks, AreNotSeen) {
  const std::string text = read_file(sample_path("obj"));
  const std::size_t line = read_text("obj", text).lines.front();
  for (std::size_t size = 65533; size <= 65537; ++size) { // blocks have 65536 bytes
    const std::string padded = std::string(size, ' ') + "\r\n" + text;
    EXPECT_EQ(read_text("obj", padded).lines.front(), line + 1) << size;
  }
  EXPECT_NE(refusal("obj", std::string(65536, ' ') + "\xef\xbb\xbf" + text), "");
}

// Cut anywhere, a file is refused or holds fewer patches, but never makes up other ones.
TEST_P(SampleFileTest, IsRefusedWhereItIsCutShort) {
  const std::string text = read_file(sample_path(GetParam()));
  const std::size_t all = sample_patches(GetParam()).size();
  for (std::size_t size = 0; size < text.size(); size += 7) {
    const std::string message = refusal(GetParam(), text.substr(0, size));
    if (message.empty()) {
      EXPECT_LE(read_text(GetParam(), text.substr(0, size)).count, all) << size;
    } else {
      EXPECT_NE(message.find(": expected "), std::string::npos) << message;
      EXPECT_NE(message.find(", found "), std::string::npos) << message;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SampleFileTest, ::testing::ValuesIn(kSampleFormats),
                         [](const auto& test) { return std::string(test.param); });

TEST(Formats, KeepTheLineOfEveryPoint) {
  struct Case {
    const char* format;
    std::size_t patch, point;
    const char* line;
  };
  const Case cases[] = {{"bpt", 0, 0, ":3"},   {"bpt", 1, 0, ":16"},  {"bpt", 2, 3, ":26"},
                        {"bv", 0, 11, ":15"},  {"bv", 1, 0, ":19"},   {"bv", 2, 0, ":27"},
                        {"iges", 0, 5, ":14"}, {"iges", 1, 0, ":19"}, {"iges", 2, 3, ":23"},
                        {"itd", 0, 5, ":11"},  {"itd", 1, 0, ":22"},  {"itd", 2, 1, ":30"},
                        {"obj", 0, 11, ":15"}, {"obj", 1, 0, ":26"},  {"obj", 2, 3, ":41"},
                        {"rib", 0, 4, ":16"},  {"rib", 1, 0, ":15"},  {"rib", 2, 0, ":20"}};
  for (const Case& item : cases) {
    const std::string path = sample_path(item.format);
    const tools::PatchFile file = tools::read_patches(path, tools::PatchFormat::by_name);
    EXPECT_EQ(file.place(item.patch, item.point), path + item.line);
  }
}

// Coordinates on lines of their own, some of which no quick way takes (a plus sign), around the end
// of a block: a point has the line of its first coordinate, and no number is cut in two.
TEST(Formats, NumbersMayStandAnywhere) {
  for (std::size_t size = 65536 - 200; size < 65536; ++size) { // blocks have 65536 bytes
    SCOPED_TRACE(size);
    std::string text = "1" + std::string(size - 1, ' ');
    std::vector<double> values;
    std::vector<std::uint32_t> lines;
    std::uint32_t line = 1;
    for (int k = 0; k < 48; ++k) {
      const std::uint32_t breaks = k % 5 == 2 ? 2 : k % 3 == 0 ? 0 : 1;
      text += std::string(breaks, '\n') + (k % 7 == 3 ? " +" : " ") + std::to_string(k) + ".25";
      line += breaks;
      values.push_back(k + 0.25);
      if (k % 3 == 0) {
        lines.push_back(line);
      }
    }
    const tools::PatchFile file = read_text("bez", text);
    EXPECT_TRUE(std::equal(values.begin(), values.end(), file.points.begin(), file.points.end()));
    EXPECT_TRUE(std::equal(lines.begin(), lines.end(), file.lines.begin(), file.lines.end()));
  }
}

// The bicubic patches of sample_nets.hpp, in the words of every format; points_text() runs along u.
std::string bicubic_text(const std::string& format, const Net& net) {
  const std::string points = points_text(net);
  if (format == "bv") {
    return "4 3\n" + points;
  }
  if (format == "rib") {
    return "Patch \"bicubic\" \"P\" [" + points + "]";
  }
  std::string text = format == "itd" ? "[OBJECT NONE [SURFACE BEZIER 4 4 E3\n" : "";
  for (std::size_t first = 0; first < points.size();) {
    const std::size_t last = points.find('\n', first);
    const std::string point = points.substr(first, last - first);
    text += format == "itd" ? "[" + point + "]\n" : "v " + point + "\n";
    first = last + 1;
  }
  return text + (format == "itd" ? "]]\n"
                                 : "cstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9 10 11 "
                                   "12 13 14 15 16\nparm u 0 1\nparm v 0 1\nend\n");
}

TEST(Formats, EvaluateToTheSameBitsWhereverABicubicPatchComesFrom) {
  const TemporaryFolder folder;
  const Net net = quadratic_net();
  const std::string bez = folder.write("in.bez", bez_text(std::vector<Net>{net}));
  const Outcome expected = run({"evaluate", bez, "--outputs", "position,du,dv", "-o", "-"});
  EXPECT_EQ(expected.exit_code, 0) << expected.err;
  for (const std::string format : {"bv", "itd", "obj", "rib"}) {
    const std::string in = folder.write("in." + format, bicubic_text(format, net));
    const Outcome outcome = run({"evaluate", in, "--outputs", "position,du,dv", "-o", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out == expected.out) << format;
  }
}

TEST(Formats, TakeEveryDegree) {
  for (int degree_u = 1; degree_u <= 15; ++degree_u) {
    const int degree_v = 16 - degree_u;
    std::string text = "1\n" + std::to_string(degree_v) + " " + std::to_string(degree_u) + "\n";
    for (int k = 0; k < (degree_u + 1) * (degree_v + 1); ++k) {
      text += std::to_string(k) + " 0 0\n";
    }
    const tools::PatchFile file = read_text("bpt", text);
    ASSERT_EQ(file.count, 1U);
    EXPECT_EQ(file.runs[0].degree_u, degree_u);
    EXPECT_EQ(file.runs[0].degree_v, degree_v);
    const std::vector<WeightedPoint> points = patch_points(file, 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k].x, static_cast<double>(k));
    }
  }
}

TEST(Formats, MakeOneRunOfPatchesOfOneShape) {
  const std::string bilinear = "4 1\n0 0 0 1 0 0 0 1 0 1 1 0\n";
  const std::string rational = "8 1 1\n0 0 0 1 1 0 0 1 0 1 0 1 1 1 0 1\n";
  const tools::PatchFile file =
      read_text("bv", bilinear + bilinear + rational + bilinear + rational + rational);
  ASSERT_EQ(file.count, 6U);
  ASSERT_EQ(file.runs.size(), 4U);
  const std::size_t first[] = {0, 2, 3, 4};
  const std::size_t value[] = {0, 24, 40, 52};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(file.runs[k].first_patch, first[k]);
    EXPECT_EQ(file.runs[k].first_value, value[k]);
    EXPECT_EQ(file.runs[k].rational(), k % 2 == 1);
  }
}

} // namespace
} // namespace simdbezier::tests
