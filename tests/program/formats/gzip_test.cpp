// Inputs that gzip has compressed are read as what they stand for; damaged ones and bombs are
// refused.
#include <gtest/gtest.h>

#include <zlib.h>

#include <ostream>
#include <random>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::gzip_test {
namespace {

// A whole gzip file.
std::string gzip(const std::string& text, int level = 6) {
  constexpr int kGzip = 15 + 16;
  z_stream stream = {};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
    ADD_FAILURE() << "zlib cannot begin";
    return "";
  }
  std::string packed(deflateBound(&stream, text.size()), '\0');
  std::string copy = text;
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// Patches whose text hardly repeats, of `count` times about 1 KB.
std::string random_patches(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-100, 1000);
  std::vector<Net> nets(static_cast<std::size_t>(count));
  for (Net& net : nets) {
    for (Vector3& point : net.points) {
      point = {place(random), place(random), place(random)};
    }
  }
  return bez_text(nets);
}

const std::string& patches() {
  static const std::string text = random_patches(300); // several blocks of the reader's memory
  return text;
}

std::string info(const std::string& in) {
  const Outcome outcome = run({"info", in});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.out;
}

struct Packed {
  const char* name;
  const char* file;
  std::string bytes;
};
void PrintTo(const Packed& item, std::ostream* out) { *out << item.name; }

std::vector<Packed> packed_files() {
  const std::string& text = patches();
  const std::size_t half = text.size() / 2;
  return {{"Usual", "in.bez.gz", gzip(text)},
          {"Stored", "in.bez.gz", gzip(text, 0)},
          {"InCapitals", "in.BEZ.GZ", gzip(text)},
          {"Smallest", "in.bez.gz", gzip(text, 9)},
          {"WithoutItsExtension", "in.bez", gzip(text)},
          {"PlainInSpiteOfItsName", "in.bez.gz", text},
          {"SeveralFiles", "in.bez.gz", gzip(text.substr(0, half)) + gzip(text.substr(half))},
          {"WithEmptyFiles", "in.bez.gz", gzip("") + gzip(text) + gzip("")},
          {"ManyTinyFiles", "in.bez.gz",
           [&] {
             std::string all;
             for (std::size_t k = 0; k < text.size(); k += 1000) {
               all += gzip(text.substr(k, 1000));
             }
             return all;
           }()},
          {"WithZerosBehind", "in.bez.gz", gzip(text) + std::string(512, '\0')},
          {"WithManyZerosBehind", "in.bez.gz", gzip(text) + std::string(200000, '\0')},
          {"SeveralWithZerosBehind", "in.bez.gz",
           gzip(text.substr(0, half)) + gzip(text.substr(half)) + std::string(1, '\0')},
          {"CrLfAndMark", "in.bez.gz", gzip("\xef\xbb\xbf" + replaced(text, "\n", "\r\n"))}};
}

class PackedFile : public ::testing::TestWithParam<Packed> {};

TEST_P(PackedFile, IsReadLikeThePlainOne) {
  const TemporaryFolder folder;
  const std::string expected = info(folder.write("plain.bez", patches()));
  EXPECT_EQ(info(folder.write(GetParam().file, GetParam().bytes)), expected);
  const Outcome piped = run({"info", "-", "--format", "bez"}, {.input = GetParam().bytes});
  EXPECT_EQ(piped.out, expected) << piped.err;
}

INSTANTIATE_TEST_SUITE_P(All, PackedFile, ::testing::ValuesIn(packed_files()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Gzip, FilesOfSamplesMayBePacked) {
  const TemporaryFolder folder;
  const std::string samples = folder.write("s.csv", gzip("patch,u,v\n3,0.5,0.25\n"));
  const Outcome outcome = run({"evaluate", "builtin:teapot", "--samples", samples, "-o", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\n3,0.5,0.25,"), std::string::npos) << outcome.out;
}

struct Damaged {
  const char* name;
  std::string bytes;
  const char* message; ///< behind "FILE:"
};
void PrintTo(const Damaged& item, std::ostream* out) { *out << item.name; }

std::string changed(std::string bytes, std::size_t from_end, char add) {
  bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] + add);
  return bytes;
}

std::vector<Damaged> damaged_files() {
  const std::string packed = gzip(patches());
  const std::string rest = "expected the rest of the compressed data, found the end of the file";
  const std::string zeros(std::size_t{40} << 20, '\n');
  return {
      {"MagicOnly", "\x1f\x8b", "1: expected the rest of the compressed data"},
      {"HeaderOnly", packed.substr(0, 10), "1: expected the rest of the compressed data"},
      {"Truncated", packed.substr(0, packed.size() / 2), "expected the rest of the compressed"},
      {"WithoutItsEnd", packed.substr(0, packed.size() - 1), "expected the rest of the compressed"},
      {"SumIsWrong", changed(packed, 8, 1),
       "expected data that gzip has compressed, found 'incorrect data check'"},
      {"LengthIsWrong", changed(packed, 4, 1),
       "expected data that gzip has compressed, found 'incorrect length check'"},
      {"OtherMethod", changed(packed, packed.size() - 2, 1),
       "1: expected data that gzip has compressed, found 'unknown compression method'"},
      {"SomethingBehind", packed + "more",
       "expected data that gzip has compressed, found 'incorrect header check'"},
      {"SomethingBehindZeros", packed + std::string(512, '\0') + "more",
       "expected zeros up to the end behind compressed data, found something else"},
      {"AFileBehindZeros", packed + std::string(70000, '\0') + packed,
       "expected zeros up to the end behind compressed data, found something else"},
      {"TruncatedSecond", packed + packed.substr(0, 5), "expected the rest of the compressed data"},
      {"NoPatches", gzip(""), "1: expected the number of patches, found the end of the file"},
      {"BadNumber", gzip(replaced(patches(), "\n", "\nx ")),
       "2: expected a finite number, found 'x"},
      {"Bomb", gzip("1\n" + zeros, 9),
       "expected compressed data that unpack to at most 100 times their size and 16777216 bytes, "
       "found "},
      {"BombOfManyFiles",
       [&] {
         const std::string one = gzip(zeros.substr(0, std::size_t{10} << 20), 9);
         return one + one + one;
       }(),
       "expected compressed data that unpack to at most 100 times"}};
}

class DamagedFile : public ::testing::TestWithParam<Damaged> {};

TEST_P(DamagedFile, IsRefusedWithALine) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez.gz", GetParam().bytes);
  const Outcome outcome = run({"tessellate", in, "-o", folder.path("out.ply")});
  expect_failure(outcome, 1, "simdbezier: " + in + ":");
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.names().size(), 1U) << "an output file was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, ::testing::ValuesIn(damaged_files()),
                         [](const auto& test) { return std::string(test.param.name); });

// 16 MiB and 100 times what is stored are allowed, so text that repeats itself is no bomb.
TEST(Gzip, TextMayRepeatItself) {
  std::string text = "30000\n";
  for (int k = 0; k < 30000; ++k) {
    text += std::string(96, ' ').replace(0, 4, "0 0 ");
    for (int c = 2; c < 48; ++c) {
      text += "0 ";
    }
  }
  const TemporaryFolder folder;
  const std::string packed = gzip(text);
  ASSERT_GT(text.size(), 100 * packed.size());
  EXPECT_NE(info(folder.write("in.bez", packed)).find("patches            30000"),
            std::string::npos);
}

// Some name has to tell the format.
TEST(Gzip, NamesAreJudgedWithoutTheirExtension) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.gz", gzip(patches()));
  expect_failure(run({"info", in}), 2, in + ": expected a name that ends in .bez");
  EXPECT_EQ(run({"info", in, "--format", "bez"}).exit_code, 0);
}

} // namespace
} // namespace simdbezier::tests::gzip_test
