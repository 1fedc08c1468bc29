// How much memory a file takes: in proportion to its size, whatever its points are used for.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/cli/program.hpp"

namespace simdbezier::tests {
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

std::string separate(const std::string& head, const std::string& patch, std::size_t count,
                     const std::string& tail = "") {
  std::string text = head;
  for (std::size_t k = 0; k < count; ++k) {
    text += patch;
  }
  return text + tail;
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

// What the program takes for grids, beyond what it takes for any. docs/formats.md promises this.
TEST_P(MemoryTest, IsAFewTimesTheFile) {
  if (kSanitized) {
    GTEST_SKIP() << "memory of a sanitizer";
  }
  constexpr std::size_t kTimes = 20;
  constexpr long kAlways = 24L << 10; // KiB: blocks of samples and of packed patches
  const TemporaryFolder folder;
  const std::string text = GetParam().text();
  const std::string in = folder.write(std::string("in.") + GetParam().format, text);
  const long most = kAlways + static_cast<long>(kTimes * text.size() / 1024);
  const Outcome none = run({"tessellate", "builtin:teapot", "-o", folder.path("none.ply")});
  for (const std::string out : {"out.ply", "out.csv"}) {
    const bool csv = out == "out.csv";
    const Outcome outcome = run({csv ? "evaluate" : "tessellate", in, "--grid", "2", "--threads",
                                 "1", "-o", folder.path(out)});
    expect_silent_success(outcome);
    EXPECT_LT(outcome.memory - none.memory, most) << text.size() << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(All, MemoryTest, ::testing::ValuesIn(kDense),
                         [](const auto& test) { return std::string(test.param.format); });

} // namespace
} // namespace simdbezier::tests
