// How much memory a file takes: in proportion to its size, whatever its points are used for.
#include <gtest/gtest.h>

#include <ostream>
#include <sstream>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::memory_test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true; // memory is the sanitizer's then
#else
constexpr bool kSanitized = false;
#endif

std::string range(std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    text += " " + std::to_string(k);
  }
  return text + "\n";
}

// A mesh of patches of degree 1 that all share the same few vertices: a patch in two characters.
std::string shared_vertices(std::size_t side) {
  std::string text = "v 0 0 0\nv 1 0 1\nv 0 1 2\ncstype bezier\ndeg 1 1\nsurf 0 " +
                     std::to_string(side) + " 0 " + std::to_string(side);
  for (std::size_t k = 0; k < (side + 1) * (side + 1); ++k) {
    text += " " + std::to_string(1 + k % 3);
  }
  return text + "\nparm u" + range(side + 1) + "parm v" + range(side + 1) + "end\n";
}

// Bicubic patches all around, each of which shares all but one of its columns.
std::string closed_mesh(std::size_t side) {
  std::string text = "Basis \"bezier\" 1 \"bezier\" 1\nPatchMesh \"bicubic\" " +
                     std::to_string(side) + " \"periodic\" " + std::to_string(side) +
                     " \"periodic\" \"P\" [";
  for (std::size_t k = 0; k < side * side; ++k) {
    text += k % 2 == 0 ? "0 0 1 " : "1 2 0 ";
  }
  return text + "]\n";
}

std::string every_third_patch(std::size_t patches) {
  std::string text = "patch,u,v\n";
  for (std::size_t k = 0; k < patches; k += 3) {
    text += std::to_string(k) + ",0.5,0.5\n";
  }
  return text;
}

std::string separate(const std::string& head, const std::string& patch, std::size_t count,
                     const std::string& tail = "") {
  std::string text = head;
  for (std::size_t k = 0; k < count; ++k) {
    text += patch;
  }
  return text + tail;
}

// One a line; the corners of patch k are (k, 0, 0) and (k, 1, 2).
std::string counted_patches(std::size_t count) {
  std::string text = std::to_string(count) + "\n";
  for (std::size_t k = 0; k < count; ++k) {
    const std::string first = std::to_string(k) + " 0 0";
    text += first + separate("", " " + first, 14) + " " + std::to_string(k) + " 1 2\n";
  }
  return text;
}

std::string bilinear_of_bv() { return "4 1 0 0 0 1 0 0 0 1 0 1 1 0\n"; }

struct Dense {
  const char* format;
  std::string (*text)();
};
void PrintTo(const Dense& item, std::ostream* out) { *out << item.format; }

constexpr std::size_t kPatches = 30000;
const Dense kDense[] = {
    {"obj", [] { return shared_vertices(700); }},
    {"rib", [] { return closed_mesh(400); }},
    {"bv", [] { return separate("", bilinear_of_bv(), kPatches); }},
    {"bpt",
     [] {
       return separate(std::to_string(kPatches) + "\n", "1 1 0 0 0 1 0 0 0 1 0 1 1 0\n", kPatches);
     }},
    {"bez", [] { return separate("9000\n", separate("", "0 0 1 ", 16), 9000); }},
    {"itd", [] {
       return separate("[OBJECT A ", "[SURFACE BEZIER 2 2 E3 [0 0 0][1 0 0][0 1 0][1 1 0]]",
                       kPatches, "]");
     }}};

class MemoryTest : public ::testing::TestWithParam<Dense> {};

// What the program takes beyond what it takes for any file. docs/formats.md promises this.
TEST_P(MemoryTest, IsAFewTimesTheFile) {
  if (kSanitized) {
    GTEST_SKIP() << "memory of a sanitizer";
  }
  constexpr std::size_t kTimes = 20;
  constexpr long kAlways = 32L << 10; // KiB: blocks of samples and patches, large pages
  const TemporaryFolder folder;
  const std::string text = GetParam().text();
  const std::string in = folder.write(std::string("in.") + GetParam().format, text);
  const long most = kAlways + static_cast<long>(kTimes * text.size() / 1024);
  const Outcome none = run({"tessellate", "builtin:teapot", "-o", folder.path("none.ply")});
  const std::string samples = folder.write("samples.csv", every_third_patch(9000));
  const std::vector<std::vector<std::string>> commands = {
      {"tessellate", in, "--no-weld", "--grid", "2", "-o", folder.path("out.ply")},
      {"evaluate", in, "--grid", "2", "-o", folder.path("out.csv")},
      {"evaluate", in, "--samples", samples, "-o", folder.path("out.csv")}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"--precision", "f64", "--threads", "1"});
    const Outcome outcome = run(command);
    expect_silent_success(outcome);
    EXPECT_LT(outcome.memory - none.memory, most) << text.size() << " bytes";
  }
}

// A mesh without gaps needs all patches at once, in proportion to their number: that is much where
// few characters make a patch.
TEST(Memory, OfWeldedMeshesIsAFewTimesTheFile) {
  if (kSanitized) {
    GTEST_SKIP() << "memory of a sanitizer";
  }
  constexpr std::size_t kTimes = 1100;
  constexpr long kAlways = 24L << 10;
  const TemporaryFolder folder;
  const Outcome none = run({"tessellate", "builtin:teapot", "-o", folder.path("none.ply")});
  const std::pair<const char*, std::string> files[] = {
      {"obj", shared_vertices(120)},
      {"rib", closed_mesh(120)},
      {"bez", separate("2000\n", separate("", "0 0 1 ", 16), 2000)}};
  for (const auto& [format, text] : files) {
    const std::string in = folder.write(std::string("in.") + format, text);
    const Outcome outcome = run({"tessellate", in, "--grid", "2", "--precision", "f64", "--threads",
                                 "1", "-o", folder.path("out.ply")});
    expect_silent_success(outcome);
    EXPECT_LT(outcome.memory - none.memory,
              kAlways + static_cast<long>(kTimes * text.size() / 1024))
        << format;
  }
}

// Patches that are packed alone give the bits that they give among all.
TEST(Memory, BlocksDoNotShowInResults) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez", counted_patches(9000));
  std::string samples = "patch,u,v\n";
  for (std::size_t k = 0; k < 40000; ++k) {
    samples += std::to_string(k * 7919 % 9000) + (k % 2 == 0 ? ",0,0\n" : ",1,1\n");
  }
  const Outcome scattered = run({"evaluate", in, "--samples", "-", "-o", "-"}, {.input = samples});
  ASSERT_EQ(scattered.exit_code, 0) << scattered.err;
  std::istringstream lines(scattered.out);
  std::string line;
  std::getline(lines, line);
  for (std::size_t k = 0; k < 40000; ++k) {
    std::getline(lines, line);
    const std::string patch = std::to_string(k * 7919 % 9000);
    const std::string corner = k % 2 == 0 ? ",0,0," + patch + ",0,0" : ",1,1," + patch + ",1,2";
    ASSERT_EQ(line, patch + corner);
  }
}

TEST(Memory, BlocksDoNotHideBadPatches) {
  const TemporaryFolder folder;
  const std::string bad = replaced(counted_patches(9000), " 8999 1 2\n", " 1e39 1 2\n");
  const std::string in = folder.write("in.bez", bad);
  const std::string expected = in + ":9001: expected coordinates within the range of f32";
  expect_failure(
      run({"evaluate", in, "--samples", "-", "-o", "-"}, {.input = "patch,u,v\n0,0,0\n"}), 1,
      expected);
  expect_failure(run({"evaluate", in, "--grid", "2", "-o", "-"}), 1, expected);
}

INSTANTIATE_TEST_SUITE_P(All, MemoryTest, ::testing::ValuesIn(kDense),
                         [](const auto& test) { return std::string(test.param.format); });

} // namespace
} // namespace simdbezier::tests::memory_test
