// Binary patches, and patches converted from format to format.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <tools/formats/sbp_index.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/interruption.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/parts/part_models.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::binary_patches_test {
namespace {

using tools::PatchFile;
using tools::PatchFormat;

PatchFile read(const std::string& path) { return tools::read_patches(path, PatchFormat::by_name); }

void expect_same(const PatchFile& a, const PatchFile& b) {
  ASSERT_EQ(a.count, b.count);
  for (std::size_t patch = 0; patch < a.count; ++patch) {
    const tools::PatchRun& p = a.run_of(patch);
    const tools::PatchRun& q = b.run_of(patch);
    ASSERT_EQ(p.degree_u, q.degree_u);
    ASSERT_EQ(p.degree_v, q.degree_v);
    ASSERT_EQ(p.weights, q.weights);
    for (std::size_t k = 0; k < p.points_per_patch(); ++k) {
      const auto x = a.point(patch, k);
      const auto y = b.point(patch, k);
      ASSERT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end()));
    }
  }
}

std::string convert(const TemporaryFolder& folder, const std::string& in, const std::string& name,
                    const std::vector<std::string>& options = {}) {
  std::vector<std::string> words = {"convert", in, "-o", folder.path(name)};
  words.insert(words.end(), options.begin(), options.end());
  expect_silent_success(run(words));
  return folder.path(name);
}

TEST(BinaryPatches, hold_what_every_format_has) {
  const TemporaryFolder folder;
  std::vector<std::string> inputs = {"builtin:teapot",
                                     folder.write("gluings.bez", gluings_as_bez(1, 100))};
  for (const char* const format : kSampleFormats) {
    inputs.push_back(sample_path(format));
  }
  for (const std::string& in : inputs) {
    SCOPED_TRACE(in);
    expect_same(read(in), read(convert(folder, in, "out.sbp")));
    // Once more from itself, through a pipe and compressed names.
    const std::string bytes = read_file(folder.path("out.sbp"));
    Circumstances piped;
    piped.input = bytes;
    expect_silent_success(
        run({"convert", "-", "--format", "sbp", "-o", folder.path("again.sbp")}, piped));
    EXPECT_TRUE(read_file(folder.path("again.sbp")) == bytes);
  }
}

TEST(BinaryPatches, become_text_that_reads_back) {
  const TemporaryFolder folder;
  struct Case {
    std::string in;
    const char* out;
  };
  const Case cases[] = {{"builtin:teapot", "a.bez"},
                        {"builtin:teapot", "a.bpt"},
                        {"builtin:teapot", "a.obj"},
                        {sample_path("bpt"), "b.bpt"},
                        {sample_path("obj"), "b.obj"}};
  for (const Case& item : cases) {
    SCOPED_TRACE(item.in + " " + item.out);
    const std::string binary = convert(folder, item.in, "in.sbp");
    expect_same(read(binary), read(convert(folder, binary, item.out)));
  }
  expect_failure(run({"convert", sample_path("bv"), "-o", folder.path("d.bez")}), 1,
                 "expected bicubic patches without weights for a .bez file, found patch 0");
  expect_failure(run({"convert", sample_path("itd"), "-o", folder.path("d.obj")}), 1,
                 "with homogeneous weights");
  expect_failure(
      run({"convert", "builtin:teapot", "-o", folder.path("d.ply")}), 2,
      "-o: expected a name that ends in .bez, .bpt, .obj or .sbp, or - with --to, found");
  EXPECT_FALSE(std::filesystem::exists(folder.path("d.bez")));
}

// Neighbours on a sheet are far apart in the file, and near each other when it is sorted.
TEST(BinaryPatches, are_sorted_along_a_curve_through_space) {
  const TemporaryFolder folder;
  constexpr std::size_t kSide = 32;
  std::string text = std::to_string(kSide * kSide) + "\n";
  for (std::size_t k = 0; k < kSide * kSide; ++k) {
    const std::size_t at = k * 617 % (kSide * kSide);
    for (std::size_t p = 0; p < 16; ++p) {
      text += std::to_string(3 * (at % kSide) + p % 4) + " " +
              std::to_string(3 * (at / kSide) + p / 4) + " 0\n";
    }
  }
  const std::string in = folder.write("in.bez", text);
  const PatchFile sorted = read(convert(folder, in, "sorted.sbp", {"--sort"}));
  ASSERT_EQ(sorted.count, kSide * kSide);
  std::size_t steps = 0;
  std::vector<bool> seen(kSide * kSide);
  for (std::size_t k = 0; k < sorted.count; ++k) {
    const auto point = sorted.point(k, 0);
    seen[static_cast<std::size_t>(point[0] / 3 + point[1] / 3 * kSide)] = true;
    if (k > 0) {
      const auto before = sorted.point(k - 1, 0);
      steps += std::abs(point[0] - before[0]) + std::abs(point[1] - before[1]) == 3 ? 1 : 0;
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), kSide * kSide);
  EXPECT_GT(steps, sorted.count * 9 / 10); // the curve leaves the sheet now and then
}

// Reads a file from memory, as all readers do: header and index, then block by block.
tools::SbpIndex read_from_memory(const std::string& bytes) {
  std::size_t at = 0;
  const tools::SbpIndex index = tools::read_sbp_index("in.sbp", [&](std::span<std::byte> to) {
    const std::size_t found = std::min(to.size(), bytes.size() - at);
    std::memcpy(to.data(), bytes.data() + at, found);
    at += found;
    return found;
  });
  for (const tools::SbpBlock& block : index.blocks) {
    tools::expect_intact("in.sbp", index, block,
                         std::as_bytes(std::span(bytes)).subspan(block.offset, block.bytes));
  }
  return index;
}

TEST(BinaryPatches, every_flipped_bit_is_noticed) {
  const TemporaryFolder folder;
  const std::string path = convert(folder, sample_path("bv"), "in.sbp");
  std::string bytes = read_file(path);
  const tools::SbpIndex index = read_from_memory(bytes);
  ASSERT_EQ(index.blocks.size(), 3U);
  ASSERT_EQ(index.size, bytes.size());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const std::size_t at = bit / 8;
    std::string expected = "in.sbp: expected";
    for (std::size_t block = 0; block < index.blocks.size(); ++block) {
      if (at >= index.blocks[block].offset) {
        expected = "expected block " + std::to_string(block) + " (";
      }
    }
    const auto flip = [&] { bytes[at] = static_cast<char>(bytes[at] ^ 1 << bit % 8); };
    flip();
    std::string found;
    try {
      static_cast<void>(read_from_memory(bytes));
    } catch (const tools::Failure& failure) {
      found = failure.what();
    }
    ASSERT_NE(found.find(expected), std::string::npos) << "bit " << bit << ": " << found;
    if (in_form(bit, 211)) { // and by the reader
      ASSERT_NE(refusal("sbp", bytes), "") << "bit " << bit;
    }
    flip();
  }
}

TEST(BinaryPatches, cut_or_longer_files_are_refused) {
  const TemporaryFolder folder;
  const std::string bytes = read_file(convert(folder, sample_path("obj"), "in.sbp"));
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 7) {
    EXPECT_NE(refusal("sbp", bytes.substr(0, size)), "") << size;
  }
  EXPECT_NE(refusal("sbp", bytes + "x").find("found more"), std::string::npos);
  // Also where only a part of it would be read.
  const std::string path = folder.write("cut.sbp", bytes.substr(0, bytes.size() - 1));
  expect_failure(run({"tessellate", path, "-o", folder.path("a.ply"), "--shard", "1/2"}), 1,
                 "bytes of binary patches, found");
}

// Where a file has floats before doubles, these do not stand where the machine's numbers do.
TEST(BinaryPatches, numbers_stand_at_multiples_of_their_size) {
  tools::SbpIndex index;
  index.patches = 2;
  index.data_offset = index.size = tools::kSbpAlignment;
  for (const std::uint32_t number_bytes : {4U, 8U}) {
    tools::SbpBlock& block = index.blocks.emplace_back();
    block.first_patch = index.blocks.size() - 1;
    block.count = 1;
    block.degree_u = block.degree_v = 2; // 27 values
    block.number_bytes = number_bytes;
    block.offset = index.size;
    block.bytes = 27 * number_bytes;
    index.size += block.bytes;
  }
  std::string bytes(index.size, '\0');
  const auto refused = [&] {
    const std::vector<std::byte> head = tools::sbp_bytes(index);
    std::memcpy(bytes.data(), head.data(), head.size());
    return refusal("sbp", bytes);
  };
  EXPECT_NE(refused().find("contradicts itself"), std::string::npos);
  std::swap(index.blocks[0].number_bytes, index.blocks[1].number_bytes);
  std::swap(index.blocks[0].bytes, index.blocks[1].bytes);
  index.blocks[1].offset = tools::kSbpAlignment + 27 * 8;
  EXPECT_EQ(refused(), "");
}

// A file is mapped into memory, from which bytes vanish when somebody cuts it.
TEST(BinaryPatches, that_are_cut_while_they_are_used_are_bad_input) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers report this signal themselves";
#endif
  const TemporaryFolder folder;
  const std::string path = convert(folder, "builtin:teapot", "in.sbp");
  const auto use = [&] {
    tools::handle_interruptions();
    const PatchFile file = read(path);
    std::filesystem::resize_file(path, 0);
    std::exit(file.point(31, 0).empty() ? 2 : 3);
  };
  EXPECT_EXIT(use(), ::testing::ExitedWithCode(1), "found one that became shorter");
}

// The three lines of docs/formats.md.
TEST(BinaryPatches, are_arrays_of_numpy) {
  if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) {
    GTEST_SKIP() << "numpy is absent";
  }
  const TemporaryFolder folder;
  const std::string path = convert(folder, "builtin:teapot", "teapot.sbp");
  const std::string page = read_file(std::string(SIMDBEZIER_TEST_DATA) + "/../../docs/formats.md");
  const std::size_t begin = page.find("import numpy as np\n");
  ASSERT_NE(begin, std::string::npos);
  std::string script;
  for (const char* const first : {"import numpy as np\n", "words = np.fromfile"}) {
    const std::size_t from = page.find(first);
    script += page.substr(from, page.find("```", from) - from);
  }
  for (int k = 0; k < 3; ++k) { // three times
    script = replaced(script, "model.sbp", path);
  }
  script +=
      "points = np.asarray(points, dtype='f8')\n"
      "import sys\n"
      "sys.stdout.write(repr((points.shape, float(points.sum()), float(points[31, 2, 1, 0]))))\n"
      "assert sums == (int(head[28]) % 2**64, int(head[29]) % 2**64)\n";
  const std::string out = folder.path("out.txt");
  ASSERT_EQ(std::system(("/usr/bin/python3 " + folder.write("s.py", script) + " > " + out).c_str()),
            0);
  const PatchFile teapot = read("builtin:teapot");
  double sum = 0;
  for (const double value : teapot.points) {
    sum += value;
  }
  const std::string text = read_file(out);
  double found_sum = 0;
  double found_value = 0;
  ASSERT_EQ(std::sscanf(text.c_str(), "((32, 4, 4, 3), %lf, %lf)", &found_sum, &found_value), 2)
      << text;
  EXPECT_NEAR(found_sum, sum, 1e-9);
  EXPECT_EQ(found_value, teapot.point(31, 9)[0]);
}

} // namespace
} // namespace simdbezier::tests::binary_patches_test
