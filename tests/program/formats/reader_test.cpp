// Files that the program must understand, and files that it must refuse with a useful line.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::reader_test {
namespace {

// Two patches as a file, with `separator` between numbers and `row_end` after every point.
std::string two_patches(const std::string& head, const std::string& degrees,
                        const std::string& separator, const std::string& row_end) {
  std::string text = head;
  for (int p = 0; p < 2; ++p) {
    text += degrees;
    for (const Vector3& point : distinct_net(p + 1).points) {
      text += number_text(point[0]) + separator + number_text(point[1]) + separator +
              number_text(point[2]) + row_end;
    }
  }
  return text;
}

struct GoodFile {
  const char* name;
  const char* extension;
  std::string text;
};
void PrintTo(const GoodFile& item, std::ostream* out) { *out << item.name; }

std::vector<GoodFile> good_files() {
  const std::string bez = two_patches("2\n", "", " ", "\n");
  const std::string bpt = two_patches("2\n", "3 3\n", " ", "\n");
  return {
      {"Plain", "bez", bez},
      {"PlainBpt", "bpt", bpt},
      {"UpperCaseExtension", "BEZ", bez},
      {"Crlf", "bez", two_patches("2\r\n", "", " ", "\r\n")},
      {"CrlfBpt", "bpt", two_patches("2\r\n", "3 3\r\n", "\t", "\r\n")},
      {"Cr", "bez", two_patches("2\r", "", " ", "\r")},
      {"ByteOrderMark", "bez", "\xef\xbb\xbf" + bez},
      {"Tabs", "bez", two_patches("2\n", "", "\t", "\t\n")},
      {"OneNumberALine", "bez", two_patches("2\n\n", "", "\n", "\n\n")},
      {"AllOnOneLine", "bpt", two_patches("2 ", "3 3 ", " ", " ")},
      {"NoLineBreakAtEnd", "bez", bez.substr(0, bez.size() - 1)},
      {"BlankLinesAtEnd", "bez", bez + "\n \n\t\n"},
      {"LeadingPlus", "bez", replaced(replaced(bez, "2\n", "+2\n"), "100 ", "+100 ")},
      {"Exponents", "bez", replaced(replaced(bez, "100 ", "1e2 "), "101 ", "1.01E+02 ")},
      {"LeadingDot", "bez", replaced(bez, "-100\n", "-.1e3\n")},
  };
}

class GoodFileTest : public ::testing::TestWithParam<GoodFile> {};

TEST_P(GoodFileTest, GivesItsCornersBack) {
  const TemporaryFolder folder;
  const std::string in = folder.write(std::string("in.") + GetParam().extension, GetParam().text);
  const Outcome outcome =
      run({"evaluate", in, "--grid", "2", "--precision", "f64", "-o", folder.path("out.csv")});
  expect_silent_success(outcome);
  const ParsedCsv csv = parse_csv(read_file(folder.path("out.csv")));
  ASSERT_EQ(csv.rows.size(), 8U);
  for (std::size_t row = 0; row < 8; ++row) {
    const Net net = distinct_net(static_cast<int>(row / 4) + 1);
    const Vector3& corner = net.points[row % 4 / 2 * 12 + row % 2 * 3];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(csv.rows[row][3 + c], corner[c]) << "row " << row;
    }
  }
}

TEST_P(GoodFileTest, IsReadFromStandardInput) {
  const bool bpt = std::string(GetParam().extension) == "bpt";
  const Outcome outcome =
      run({"info", "-", "--format", bpt ? "bpt" : "bez", "--json"}, {.input = GetParam().text});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"patches\": 2,"), std::string::npos) << outcome.out;
}

template <typename Case>
std::string case_name(const ::testing::TestParamInfo<Case>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(All, GoodFileTest, ::testing::ValuesIn(good_files()), case_name<GoodFile>);

struct BadFile {
  const char* name;
  const char* extension;
  std::string text;
  const char* message; ///< what follows "simdbezier: FILE"
};
void PrintTo(const BadFile& item, std::ostream* out) { *out << item.name; }

std::vector<BadFile> bad_files() {
  const std::string bez = two_patches("2\n", "", " ", "\n"); // points in lines 2 to 33
  const std::string bpt = two_patches("2\n", "3 3\n", " ", "\n");
  const std::string declared = "expected 2 patches of 48 coordinates as declared in line 1, ";
  return {
      {"Empty", "bez", "", ":1: expected the number of patches, found the end of the file"},
      {"EmptyBpt", "bpt", "", ":1: expected the number of patches, found the end of the file"},
      {"OnlyBlanks", "bez", "\n\n  \n", ":3: expected the number of patches, found the end"},
      {"CountOnly", "bez", "2\n",
       ":1: expected 2 patches of 48 coordinates as declared in line 1, "
       "found the end of the file after 0 patches"},
      {"CountBelow", "bez", "\n3" + bez.substr(1),
       ":34: expected 3 patches of 48 coordinates as declared in line 2, found the end of the file "
       "after 2 patches"},
      {"CountBelowBpt", "bpt", "3" + bpt.substr(1),
       ":35: expected 3 patches as declared in line 1"},
      {"Truncated", "bez", bez.substr(0, bez.rfind("201 ")), // inside the second patch
       ":18: expected 2 patches of 48 coordinates as declared in line 1, found the end of the file "
       "after 1 patch and 3 coordinates"},
      {"TruncatedBpt", "bpt", bpt.substr(0, bpt.rfind("203 ")),
       ":22: expected 2 patches as declared in line 1, found the end of the file "
       "after 1 patch and 9 coordinates"},
      {"OneCoordinateLess", "bez", bez.substr(0, bez.rfind(' ')),
       ":33: expected 2 patches of 48 coordinates as declared in line 1, found the end of the file "
       "after 1 patch and 47 coordinates"},
      {"OneCoordinateMore", "bez", bez + "\n7\n",
       ":35: expected the end of the file after 2 patches of 48 coordinates as declared in line 1, "
       "found '7'"},
      {"OneCoordinateMoreBpt", "bpt", bpt + "7",
       ":36: expected the end of the file after 2 patches"},
      {"WordAfterTheEnd", "bez", bez + "end", ":34: expected the end of the file after 2 patches"},
      {"Word", "bez", replaced(bez, "201 ", "zwei "),
       ":19: expected a finite number, found 'zwei'"},
      {"HalfANumber", "bez", replaced(bez, "201 ", "2.0.1 "), ":19: expected a finite number"},
      {"Comma", "bez", replaced(bez, "201 ", "2,01 "),
       ":19: expected a finite number, found '2,01'"},
      {"Hexadecimal", "bez", replaced(bez, "201 ", "0x10 "), ":19: expected a finite number"},
      {"ByteOrderMarkTwice", "bez", "\xef\xbb\xbf\xef\xbb\xbf" + bez,
       ":1: expected the number of patches (1 or more), found '\\xef\\xbb\\xbf2'"},
      {"WordBehindReturns", "bez", replaced(bez, "2\n", "2\r\r\n\r") + "end",
       ":36: expected the end of the file after 2 patches"},
      {"TwoSigns", "bez", replaced(bez, "201 ", "+-1 "), ":19: expected a finite number"},
      {"BareSign", "bez", replaced(bez, "201 ", "+ "), ":19: expected a finite number, found '+'"},
      {"Nan", "bez", replaced(bez, "201 ", "nan "), ":19: expected a finite number, found 'nan'"},
      {"Inf", "bez", replaced(bez, "201 ", "-inf "), ":19: expected a finite number, found '-inf'"},
      {"Infinity", "bpt", replaced(bpt, "201 ", "Infinity "), ":21: expected a finite number"},
      {"Overflow", "bez", replaced(bez, "201 ", "1e999 "),
       ":19: expected a finite number, found '1e999', which is too large for a double"},
      {"OverflowOfFloat", "bez", replaced(bez, "201 ", "1e39 "),
       ":19: expected coordinates within the range of f32, found 1e+39"},
      {"CoefficientOverflow", "bez", replaced(replaced(bez, "201 ", "3e38 "), "202 ", "-3e38 "),
       ":18: expected a patch whose coefficients fit f32"},
      {"ZeroPatches", "bez", "0\n", ":1: expected the number of patches (1 or more), found '0'"},
      {"ZeroPatchesBpt", "bpt", "0", ":1: expected the number of patches (1 or more), found '0'"},
      {"NegativeCount", "bez", "-2" + bez.substr(1), ":1: expected the number of patches"},
      {"FractionalCount", "bez", "2.5" + bez.substr(1), ":1: expected the number of patches"},
      {"ExponentCount", "bez", "2e0" + bez.substr(1), ":1: expected the number of patches"},
      {"WordCount", "bpt", "two" + bpt.substr(1), ":1: expected the number of patches"},
      {"HugeCount", "bez", "1000000000000000000" + bez.substr(1),
       ":33: expected 1000000000000000000 patches of 48 coordinates as declared in line 1, found "
       "the end of the file after 2 patches"},
      {"HugeCountBpt", "bpt", "18446744073709551615" + bpt.substr(1), ":35: expected 184467440737"},
      {"CountBeyondIntegers", "bez", "18446744073709551616" + bez.substr(1),
       ":1: expected the number of patches (1 or more), found '18446744073709551616'"},
      {"NoDegrees", "bpt", bez, ":2: expected degree 1 to 15 across the rows, found '100'"},
      {"EndBeforeDegrees", "bpt", replaced(bpt, "2\n", "3\n").substr(0, bpt.find("3 3\n2")),
       ":18: expected 3 patches as declared"},
      {"BptAsBez", "bez", bpt, ":34: expected the end of the file after 2 patches"},
      {"Binary", "bez",
       std::string("\x7f"
                   "ELF\0\1\2 \xff\n",
                   11),
       ":1: expected the number of patches (1 or more), found '\\x7fELF\\x00\\x01\\x02'"},
      {"BinaryInside", "bez", replaced(bez, "201 ", std::string("\0\r\x1b[2J ", 7)),
       ":19: expected a finite number, found '\\x00'"},
      {"EndlessWord", "bez", "2\n" + std::string(100000, 'x'), ":2: expected a finite number"},
      {"EndlessNumber", "bez", "2\n" + std::string(100000, '9'),
       ":2: expected a finite number, found '9999999999999999999999999999999999999999…', which is "
       "too "
       "large for a double"},
      {"LettersBehindALongNumber", "bez", "2\n" + std::string(600, '1') + "x",
       ":2: expected a finite number, found '1111111111111111111111111111111111111111…'"},
      {"NanWithPayload", "bez", replaced(bez, "201 ", "nan(1) "),
       ":19: expected a finite number, found 'nan(1)', which is not a number"},
      {"NegativeNan", "bpt", replaced(bpt, "201 ", "-NaN "),
       ":21: expected a finite number, found '-NaN', which is not a number"},
  };
}

class BadFileTest : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadFileTest, IsRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  const std::string in = folder.write(std::string("in.") + GetParam().extension, GetParam().text);
  const Outcome outcome = run({"tessellate", in, "-o", folder.path("out.obj")});
  expect_failure(outcome, 1, "simdbezier: " + in + GetParam().message);
  EXPECT_EQ(folder.names().size(), 1U) << "an output file was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, BadFileTest, ::testing::ValuesIn(bad_files()), case_name<BadFile>);

TEST(Reader, DoublePrecisionTakesWhatFloatCannot) {
  const TemporaryFolder folder;
  const std::string text = replaced(two_patches("2\n", "", " ", "\n"), "201 ", "1e39 ");
  const std::string in = folder.write("in.bez", text);
  expect_silent_success(
      run({"tessellate", in, "--precision", "f64", "-o", folder.path("out.obj")}));
}

std::string bez_of_zeros() {
  std::string text = " ";
  for (int k = 0; k < 48; ++k) {
    text += "0 ";
  }
  return text;
}

TEST(Reader, TakesNumbersTooSmallForADoubleAsZero) {
  const TemporaryFolder folder;
  const std::string text = replaced(two_patches("2\n", "", " ", "\n"), "100 ", "1e-999 ");
  const Outcome outcome = run({"evaluate", folder.write("in.bez", text), "--grid", "2", "-o", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(parse_csv(outcome.out).rows.at(0).at(3), 0);
}

// As many digits as one likes are a number, in all formats that have room for them and in files of
// samples.
TEST(Reader, TakesNumbersOfAnyLength) {
  for (const std::size_t length : {511U, 512U, 513U, 1024U, 5000U, 100000U}) {
    const std::string five = std::string(length - 1, '0') + "5";
    const std::string third = "0." + std::string(length - 2, '3');
    for (const std::string format : kSampleFormats) {
      if (format == "iges") {
        continue; // its lines have 80 columns
      }
      std::string text = read_file(sample_path(format));
      const std::size_t at = text.find("-7");
      ASSERT_NE(at, std::string::npos) << format;
      text.replace(at, 2, "-" + std::string(length - 2, '0') + "7");
      EXPECT_EQ(refusal(format, text), "") << format << ", " << length;
    }
    const std::string bez = "1\n" + five + " " + third + replaced(bez_of_zeros(), "0 0 ", " ");
    const tools::PatchFile file = read_text("bez", bez);
    EXPECT_EQ(file.points.at(0), 5);
    EXPECT_EQ(file.points.at(1), 1.0 / 3);
    const Outcome outcome = run({"evaluate", "builtin:teapot", "--samples", "-", "-o", "-"},
                                {.input = "patch,u,v\n" + five + "," + third + ",0\n"});
    EXPECT_TRUE(outcome.out.find("\n5,0.3333333333333333,0,") != std::string::npos) << outcome.err;
  }
}

TEST(Reader, RefusesWhatIsNoReadableFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("folder.bez"));
  std::filesystem::create_directory(folder.path("folder.xyz"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {folder.path("folder.bez"), "found a directory"},
      {folder.path("folder.xyz"), "found a directory"},
      {folder.path("absent.bez"), "found 'No such file or directory'"},
      {folder.path("absent.xyz"), "found 'No such file or directory'"},
      {folder.path("absent/in.bez"), "found 'No such file or directory'"}};
  for (const auto& [in, found] : cases) {
    for (const std::string command : {"info", "tessellate", "evaluate"}) {
      std::vector<std::string> arguments = {command, in};
      if (command != "info") {
        arguments.insert(arguments.end(),
                         {"-o", folder.path(command == "evaluate" ? "out.csv" : "out.ply")});
      }
      expect_failure(run(arguments), 1, "simdbezier: " + in + ": expected a");
      expect_failure(run(arguments), 1, found);
    }
  }
}

TEST(Reader, RefusesAFileWithoutPermission) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.bez", "1\n");
  std::filesystem::permissions(in, std::filesystem::perms::none);
  if (!read_file(in).empty()) {
    GTEST_SKIP() << "this user may read every file";
  }
  expect_failure(run({"info", in}), 1,
                 in + ": expected a readable file, found 'Permission denied'");
}

TEST(Reader, KeepsOneLineWhenAFileNameHasMore) {
  const TemporaryFolder folder;
  expect_failure(run({"info", folder.path("two\nlines.bez")}), 1, "two lines.bez");
}

} // namespace
} // namespace simdbezier::tests::reader_test
