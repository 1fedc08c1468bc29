// simdbezier evaluate: the CSV that it reads and the CSV that it writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <set>
#include <sstream>

#include <tools/formats/csv.hpp>

#include "tests/program/commands/mesh_parsers.hpp"
#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::evaluate_test {
namespace {

std::string evaluate(std::vector<std::string> arguments, const std::string& input = {}) {
  arguments.insert(arguments.begin(), "evaluate");
  arguments.insert(arguments.end(), {"-o", "-"});
  const Outcome outcome = run(arguments, {.input = input});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

constexpr const char* kEverything = "position,du,dv,duu,duv,dvv,normal";

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::vector<std::string> fields(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> names;
  for (std::string name; std::getline(text, name, ',');) {
    names.push_back(name);
  }
  return names;
}

// The first three columns.
std::string samples_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string samples;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t third = line.find(',', line.find(',', line.find(',') + 1) + 1);
    samples += line.substr(0, third) + "\n";
  }
  return samples;
}

TEST(Evaluate, WritesTheGridPatchByPatchWithUFastest) {
  const ParsedCsv csv = parse_csv(evaluate({"builtin:teapot", "--grid", "4x3"}));
  EXPECT_EQ(csv.header, "patch,u,v,x,y,z");
  ASSERT_EQ(csv.rows.size(), 32U * 12);
  for (std::size_t k = 0; k < csv.rows.size(); ++k) {
    EXPECT_EQ(csv.rows[k][0], static_cast<double>(k / 12));
    EXPECT_EQ(csv.rows[k][1], static_cast<double>(k % 4) / 3.0);
    EXPECT_EQ(csv.rows[k][2], static_cast<double>(k % 12 / 4) / 2.0);
  }
}

TEST(Evaluate, DefaultsToSixteenSquaredPositions) {
  const ParsedCsv csv = parse_csv(evaluate({"builtin:teapot"}));
  EXPECT_EQ(csv.header, "patch,u,v,x,y,z");
  EXPECT_EQ(csv.rows.size(), 32U * 256);
}

TEST(Evaluate, WritesColumnsInTheirOrderWhateverTheOrderAskedFor) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"position", ",x,y,z"},
      {"normal", ",nx,ny,nz"},
      {"dv,du", ",dux,duy,duz,dvx,dvy,dvz"},
      {"normal,position", ",x,y,z,nx,ny,nz"},
      {"normal,dv,position,du", ",x,y,z,dux,duy,duz,dvx,dvy,dvz,nx,ny,nz"},
      {"du,du", ",dux,duy,duz"},
      {"duv", ",duvx,duvy,duvz"},
      {"dvv,duu,dvv", ",duux,duuy,duuz,dvvx,dvvy,dvvz"},
      {"curvature,position", ",x,y,z,gaussian,mean,kmin,kmax"},
      {"curvature,normal,dv", ",dvx,dvy,dvz,nx,ny,nz,gaussian,mean,kmin,kmax"},
      {"normal,dvv,duv,duu,dv,du,position",
       ",x,y,z,dux,duy,duz,dvx,dvy,dvz,duux,duuy,duuz,duvx,duvy,duvz,dvvx,dvvy,dvvz,nx,ny,nz"}};
  const ParsedCsv all =
      parse_csv(evaluate({"builtin:teapot", "--outputs", std::string(kEverything) + ",curvature"}));
  const std::vector<std::string> names = fields(all.header);
  for (const auto& [outputs, columns] : cases) {
    const ParsedCsv csv = parse_csv(evaluate({"builtin:teapot", "--outputs", outputs}));
    ASSERT_EQ(csv.header, "patch,u,v" + columns);
    ASSERT_EQ(csv.rows.size(), all.rows.size());
    const std::vector<std::string> wanted = fields(csv.header);
    for (std::size_t column = 0; column < wanted.size(); ++column) {
      const auto full =
          static_cast<std::size_t>(std::ranges::find(names, wanted[column]) - names.begin());
      for (std::size_t row = 0; row < all.rows.size(); ++row) {
        const double value = csv.rows[row][column]; // curvatures are nan where there is no normal
        ASSERT_TRUE(value == all.rows[row][full] || std::isnan(all.rows[row][full]))
            << outputs << ": " << wanted[column];
      }
    }
  }
}

TEST(Evaluate, GivesValuesOfAKnownSurface) {
  const TemporaryFolder folder;
  const std::vector<Net> nets = {flat_net()};
  const std::string in = folder.write("in.bez", bez_text(nets));
  const ParsedCsv csv =
      parse_csv(evaluate({in, "--outputs", "position,du,dv,normal", "--precision", "f64"}));
  for (const auto& row : csv.rows) {
    const std::vector<double> expected = {row[1], row[2], 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(row[3 + k], expected[k], 1e-14);
    }
  }
}

// S = (u + u^2 v, v + u v^2, u^2 + 3 u v - v^2 / 2): every second derivative is another one.
TEST(Evaluate, GivesSecondDerivativesOfAKnownSurface) {
  const TemporaryFolder folder;
  const std::vector<Net> nets = {quadratic_net()};
  const std::string in = folder.write("in.bez", bez_text(nets));
  const ParsedCsv csv =
      parse_csv(evaluate({in, "--grid", "5x4", "--outputs", "duu,duv,dvv", "--precision", "f64"}));
  ASSERT_EQ(csv.rows.size(), 20U);
  for (const auto& row : csv.rows) {
    const double u = row[1];
    const double v = row[2];
    const std::vector<double> expected = {2 * v, 0, 2, 2 * u, 2 * v, 3, 0, 2 * u, -1};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(row[3 + k], expected[k], 1e-13) << "column " << k << " at " << u << ", " << v;
    }
  }
}

TEST(Evaluate, GridFedBackGivesTheSameBits) {
  for (const char* const grid : {"16", "7x5", "33x2", "100"}) {
    const std::string csv = evaluate({"builtin:teapot", "--grid", grid, "--outputs", kEverything});
    const std::string again =
        evaluate({"builtin:teapot", "--samples", "-", "--outputs", kEverything}, samples_of(csv));
    EXPECT_TRUE(csv == again) << grid;
  }
}

TEST(Evaluate, CentredParametersAreTakenAsTheyAre) {
  for (const std::string precision : {"f32", "f64"}) {
    const std::vector<std::string> options = {"builtin:teapot", "--precision", precision,
                                              "--samples", "-"};
    const std::string unit = evaluate(options, "patch,u,v\n3,0.25,0.625\n31,0,1\n0,1.5,-0.5\n");
    const std::string centred = evaluate(options, "patch,x,y\n3,-0.5,0.25\n31,-1,1\n0,2,-2\n");
    EXPECT_EQ(first_line(unit), "patch,u,v,x,y,z");
    EXPECT_EQ(first_line(centred), "patch,centred_u,centred_v,x,y,z");
    EXPECT_EQ(evaluate(options, samples_of(centred)), centred);
    const ParsedCsv a = parse_csv(unit);
    const ParsedCsv b = parse_csv(centred);
    ASSERT_EQ(a.rows.size(), 3U);
    ASSERT_EQ(b.rows.size(), 3U);
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_TRUE(std::equal(a.rows[row].begin() + 3, a.rows[row].end(), b.rows[row].begin() + 3));
    }
    EXPECT_EQ(b.rows[0][1], -0.5);
    EXPECT_EQ(b.rows[2][2], -2);
  }
}

TEST(Evaluate, GivesEveryColumnANameOfItsOwn) {
  for (const std::string header : {"patch,u,v", "patch,x,y"}) {
    const std::string csv = evaluate(
        {"builtin:teapot", "--samples", "-", "--outputs", std::string(kEverything) + ",curvature"},
        header + "\n0,0.5,0.5\n");
    const std::vector<std::string> names = fields(first_line(csv));
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size()) << first_line(csv);
  }
}

TEST(Evaluate, RepeatsParametersSoThatTheyReadBackTheSame) {
  const std::string samples = "patch,u,v\n0,0.1,0.3333333333333333\n1,1e-300,0.9999999999999999\n";
  EXPECT_EQ(samples_of(evaluate({"builtin:teapot", "--samples", "-"}, samples)), samples);
}

TEST(Evaluate, KeepsTheOrderOfManySamples) {
  std::string samples = "patch,u,v\n"; // more than are evaluated in one call
  for (int k = 0; k < 150000; ++k) {
    samples += std::to_string(k * 7 % 32) + "," + number_text(k % 11 / 16.0) + "," +
               number_text(k % 13 / 16.0) + "\n";
  }
  const std::string csv = evaluate({"builtin:teapot", "--samples", "-"}, samples);
  EXPECT_TRUE(samples_of(csv) == samples);
  const ParsedCsv all = parse_csv(csv);
  for (const std::size_t row : {0U, 65535U, 65536U, 131072U, 149999U}) {
    std::istringstream lines(samples);
    std::string line;
    for (std::size_t k = 0; k <= row + 1; ++k) {
      std::getline(lines, line);
    }
    const ParsedCsv one =
        parse_csv(evaluate({"builtin:teapot", "--samples", "-"}, "patch,u,v\n" + line + "\n"));
    EXPECT_EQ(one.rows.at(0), all.rows.at(row));
  }
}

TEST(Evaluate, AcceptsLooseCsv) {
  const std::string strict =
      evaluate({"builtin:teapot", "--samples", "-"}, "patch,u,v\n1,0.5,0.25\n2,1,0\n");
  for (const char* const loose :
       {"patch,u,v\r\n1,0.5,0.25\r\n2,1,0\r\n", "patch,u,v\r1,0.5,0.25\r2,1,0\r",
        "\xef\xbb\xbfpatch,u,v\n1,0.5,0.25\n2,1,0\n", "patch,u,v\n1,0.5,0.25\n2,1,0",
        "\n patch , u , v \n\n1, +0.5 ,2.5e-1\n\t2 ,1.0,0\n\n"}) {
    EXPECT_EQ(evaluate({"builtin:teapot", "--samples", "-"}, loose), strict) << loose;
  }
  EXPECT_EQ(evaluate({"builtin:teapot", "--samples", "-"}, "patch,u,v\n"), "patch,u,v,x,y,z\n");
}

struct BadSamples {
  const char* name;
  std::string text;
  const char* message;
};
void PrintTo(const BadSamples& item, std::ostream* out) { *out << item.name; }

std::vector<BadSamples> bad_samples() {
  const std::string good = "patch,u,v\n0,0.5,0.5\n";
  return {
      {"Empty", "",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found the end "
       "of the file"},
      {"NoHeader", "0,0.5,0.5\n",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found "
       "'0,0.5,0.5'"},
      {"OtherHeader", "u,v,patch\n", ":1: expected the header"},
      {"MixedHeader", "patch,u,y\n", ":1: expected the header"},
      {"LongHeader", "patch,u,v,w\n", ":1: expected the header"},
      {"TwoFields", good + "0,0.5\n", ":3: expected 3 fields, found 2 in '0,0.5'"},
      {"FourFields", good + "0,0.5,0.5,\n", ":3: expected 3 fields, found 4 in '0,0.5,0.5,'"},
      {"EmptyField", good + "0,,0.5\n", ":3: expected a finite number, found ''"},
      {"Word", good + "\n0,half,0.5\n", ":4: expected a finite number, found 'half'"},
      {"Nan", good + "0,nan,0.5\n", ":3: expected a finite number, found 'nan'"},
      {"Inf", good + "0,0.5,inf\n", ":3: expected a finite number, found 'inf'"},
      {"Overflow", good + "0,0.5,-1e999\n", ":3: expected a finite number, found '-1e999', which"},
      {"OverflowOfFloat", good + "0,0.5,1e39\n",
       ":3: expected a parameter within the range of f32, found 1e+39"},
      {"PatchBeyond", good + "32,0.5,0.5\n",
       ":3: expected a patch number from 0 to 31, found '32'"},
      {"PatchBeyondIntegers", good + "4294967296,0.5,0.5\n", ":3: expected a patch number"},
      {"PatchNegative", good + "-1,0.5,0.5\n", ":3: expected a patch number from 0 to 31"},
      {"PatchFraction", good + "1.5,0.5,0.5\n", ":3: expected a patch number from 0 to 31"},
      {"PatchEmpty", good + ",0.5,0.5\n", ":3: expected a patch number from 0 to 31, found ''"},
      {"Quotes", good + "\"0\",0.5,0.5\n", ":3: expected a patch number from 0 to 31"},
      {"EndlessLine", good + std::string(2000000, '0'),
       ":3: expected a line of at most 1048576 characters"},
      {"ColumnTwice", "patch,u,u\n0,0.5,0.5\n",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found "
       "'patch,u,u' with 'u' twice"},
      {"PatchTwice", "patch,patch,u\n",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found "
       "'patch,patch,u' with 'patch' twice"},
      {"OneColumnMoreTwice", "patch,u,v, v \n0,0.5,0.5,0.5\n",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found "
       "'patch,u,v, v' with 'v' twice"},
      {"FirstColumnAgain", "patch,u,v,patch\n",
       ":1: expected the header patch,u,v, patch,x,y or patch,centred_u,centred_v, found "
       "'patch,u,v,patch' with 'patch' "
       "twice"},
      {"NanWithPayload", good + "0,nan(1),0.5\n",
       ":3: expected a finite number, found 'nan(1)', which is not a number"},
      {"Binary", std::string("patch,u,v\n\0\1\2\3\n", 15),
       ":2: expected 3 fields, found 1 in '\\x00"},
  };
}

class BadSamplesTest : public ::testing::TestWithParam<BadSamples> {};

TEST_P(BadSamplesTest, AreRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  const std::string samples = folder.write("samples.csv", GetParam().text);
  const Outcome outcome =
      run({"evaluate", "builtin:teapot", "--samples", samples, "-o", folder.path("out.csv")});
  expect_failure(outcome, 1, "simdbezier: " + samples + GetParam().message);
  EXPECT_EQ(folder.names().size(), 1U) << "an output file was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, BadSamplesTest, ::testing::ValuesIn(bad_samples()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Evaluate, WritesNanWithoutASign) {
  const TemporaryFolder folder;
  {
    tools::OutputFile file(folder.path("out.csv"));
    file.text(tools::result_header(false, {}));
    tools::ResultWriter writer(file);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double values[] = {nan, -nan, -0.0};
    writer.line<double>({7, 0.5, 1}, values);
    file.commit();
  }
  EXPECT_EQ(read_file(folder.path("out.csv")), "patch,u,v\n7,0.5,1,nan,nan,-0\n");
}

TEST(Evaluate, RefusesADirectoryOfSamples) {
  const TemporaryFolder folder;
  expect_failure(
      run({"evaluate", "builtin:teapot", "--samples", folder.path(""), "-o", folder.path("o.csv")}),
      1, "found a directory");
}

} // namespace
} // namespace simdbezier::tests::evaluate_test
