// IGES files that are refused, and the line with which they are.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/iges/iges_text.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::iges_faults_test {
namespace {

struct Fault {
  const char* name;
  std::string part; ///< of the sample
  std::string text; ///< replaces it, or is a file of its own where there is no part
  std::string message;
};
void PrintTo(const Fault& item, std::ostream* out) { *out << item.name; }

std::string columns(const std::string& text, const std::string& last) {
  return text + std::string(72 - text.size(), ' ') + last;
}

/// A file of one entity.
std::string only(int type, const std::string& parameters, int form = 0) {
  return iges_text({{type, parameters, 0, "00000000", form}});
}

std::vector<Fault> record_faults() {
  const std::string section_g = columns("1H,,1H;,6Hsample,11Hsample.iges,4Hhand,4Hhand,32,38,6,308,"
                                        "15,6Hsample,",
                                        "G      1\n");
  const std::string start = columns("Three surfaces, a line that is passed over, and a name", "S");
  const std::string fourth = "2.,-14.,0.,12.,-13.,2.25,22.,-12.,5.,32.,-11.,8.25,0.,1.,0.,2.;";
  return {
      {"Empty", "", "", ":1: expected section S, found the end of the file"},
      {"ShortLine", "", "S      1\n",
       ":1: expected S in column 73, as its section has, found 8 columns"},
      {"LongLine", "D      1\n", "D      1x\n", ":4: expected lines of 80 columns, found a longer"},
      {"Compressed", "", columns("", "C0000001\n"),
       ":1: expected IGES in its fixed ASCII form, found the compressed form (C in column 73)"},
      {"Binary", "", columns("", "B0000001\n"),
       ":1: expected IGES in its fixed ASCII form, found the binary form"},
      {"NoStart", start + "      1\n", "",
       ":1: expected S in column 73, as its section has, found 'G'"},
      {"NoDirectory", "", start + "      1\n" + section_g + columns("110;", "P      1\n"),
       ":3: expected G or D in column 73, as its section has, found 'P'"},
      {"NoEnd", "S      1G      2D     10P     11", std::string(32, ' '),
       ":25: expected S1 as the number of lines of that section, found ''"},
      {"WrongCount", "D     10P     11", "D     10P     12",
       ":25: expected P11 as the number of lines of that section, found 'P     12'"},
      {"CutShort", "", start + "      1\n" + section_g,
       ":2: expected section D, found the end of the file"},
      {"NumberOfALine", "D      2\n", "D      3\n",
       ":5: expected line number 2 of section D in columns 74 to 80, found '3'"},
      {"MoreBehind", "T      1\n", "T      1\nx",
       ":26: expected the end of the file behind section"},
      {"DelimiterThatIsADigit", "1H,,1H;,", "1H1,1H;,",
       ":2: expected 1H, and 1H; (or other delimiters) or nothing as the first two parameters"},
      {"DelimitersThatAreEqual", "1H,,1H;,", "1H,,1H,,", ":2: expected two different delimiters"},
      {"OtherDelimiters", "1H,,1H;,", "1H:,1H;:",
       ":2: expected 1H, and 1H; (or other delimiters) or nothing as the first two parameters"},
      {"DelimitersOfOtherParameters", "1H,,1H;,", "1H:::1H;",
       ":14: expected type 128 as in line 4 of the directory, found '128,3,2,3,2"},
      {"TypeOfTheSecondLine", "     128       0       0       4",
       "     144       0       0       4",
       ":5: expected type 128 as in the line before, found '144'"},
      {"TypeOfTheParameters", "110,0.", "100,0.", ""}, // a line that nothing reads
      {"TypeOfTheParametersThatCount", "128,1,2,1,2", "126,1,2,1,2",
       ":19: expected type 128 as in line 8 of the directory, found '126'"},
      {"FieldOfTheDirectory", "     128       1       0", "     128     one       0",
       ":4: expected the line of an entity's parameters, found 'one'"},
      {"LinesBeyond", "     128       0       0       2", "     128       0       0       3",
       ":12: expected parameters within the 11 lines of section P, found 3 lines from line 10 on"},
      {"OneLineLess", "     128       0       0       4", "     128       0       0       3",
       ":16: expected ',' or ';' behind the parameter, found the end of the entity's lines"},
      {"ParametersThatEnd", fourth, replaced(fourth, "5.,32.,", "5.;32.,"),
       ":17: expected x of a point, found the end of the entity's parameters"},
  };
}

std::vector<Fault> surface_faults() {
  const auto bilinear = [](const std::string& from, const std::string& to) {
    return only(128, replaced(iges_bilinear("0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0."), from, to));
  };
  return {
      {"IndexZero", "", bilinear("128,1,", "128,0,"),
       ":5: expected the largest index of points in u, found '0'"},
      {"DegreeZero", "", bilinear("128,1,1,1", "128,1,1,0"),
       ":5: expected degree 1 to 1 in u, found '0'"},
      {"DegreeAboveThePoints", "", bilinear("128,1,1,1,1", "128,1,1,1,2"),
       ":5: expected degree 1 to 1 in v, found '2'"},
      {"DegreeSixteen", "", bilinear("128,1,1,1,1", "128,40,1,16,1"),
       ":5: expected degree 1 to 15 in u, found '16'"},
      {"Flag", "", bilinear("0,0,1,0,0", "0,0,2,0,0"),
       ":5: expected a flag of the surface, 0 or 1, found '2'"},
      {"KnotsFall", "", bilinear("0.,0.,1.,1.,0.", "0.,0.,-1.,1.,0."),
       ":5: expected a knot of at least 0, found -1"},
      {"KnotTooOften", "", bilinear("0.,0.,1.,1.,0.,0.,1.,1.", "0.,0.,0.,1.,0.,0.,1.,1."),
       ":6: expected a range in u within that of the knots, 0 to 0, found 0 to 1"},
      {"InnerKnotTooOften", "",
       only(128, "128,4,1,1,1,0,0,1,0,0,0.,0.,.5,.5,.5,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,"
                 "1.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
                 "0.,0.,0.,0.,0.,0.,1.,0.,1.;"),
       ":5: expected every knot at most 2 times in u, found 0.5 once more"},
      {"NoDomain", "", bilinear("0.,0.,1.,1.,0.", "0.,1.,1.,2.,0."),
       ":6: expected a range in u within that of the knots, 1 to 1, found 0 to 1"},
      {"WeightZero", "", bilinear("1.,1.,1.,1.,0.,0.,0.,1.", "1.,1.,0.,1.,0.,0.,0.,1."),
       ":5: expected a weight above 0, found 0"},
      {"WeightNegative", "", bilinear("1.,1.,1.,1.,0.,0.,0.,1.", "1.,1.,-1.,1.,0.,0.,0.,1."),
       ":5: expected a weight above 0, found -1"},
      {"WeightMissing", "", bilinear("1.,1.,1.,1.,0.,0.,0.,1.", "1.,1.,,1.,0.,0.,0.,1."),
       ":5: expected a weight above 0, found 0"},
      {"CoordinateNan", "", bilinear("0.,0.,0.,1.,0.,0.", "0.,nan,0.,1.,0.,0."),
       ":6: expected a finite number (y of a point), found 'nan'"},
      {"CoordinateTooLarge", "", bilinear("0.,0.,0.,1.,0.,0.", "0.,1.D999,0.,1.,0.,0."),
       ":6: expected a finite number (y of a point), found '1.D999'"},
      {"CoordinateString", "", bilinear("0.,0.,0.,1.,0.,0.", "0.,2H0.,0.,1.,0.,0."),
       ":6: expected a finite number (y of a point), found a string"},
      {"TwoNumbers", "", bilinear("0.,0.,0.,1.,0.,0.", "0. 1.,0.,1.,0.,0."),
       ":5: expected a finite number (x of a point), found '0. 1.'"},
      {"Product", "", bilinear("1.,1.,1.,1.,0.,0.,0.,1.,0.", "1.,1.,1.D290,1.,0.,0.,0.,1.,0."), ""},
      {"CoordinateThatMightOverflow", "",
       bilinear("1.,1.,1.,1.,0.,0.,0.,1.,0.", "1.,1.,1.,1.,0.,0.,0.,1.D300,0."),
       ":5: expected coordinates of at most 1e295, also when multiplied by weights, found others"},
      {"ProductTooLarge", "",
       bilinear("1.,1.,1.,1.,0.,0.,0.,1.,0.", "1.,1.D300,1.,1.,0.,0.,0.,1.D300,0."),
       ":6: expected coordinates that are finite when multiplied by their weight, found 1e+300 *"},
      {"PointsMissing", "", bilinear("0.,0.,0.,1.,0.,0.,", ""),
       ":6: expected y of a point, found the end of the entity's parameters"},
      {"RangeOutside", "", bilinear("0.,1.,0.,1.;", "0.,1.5,0.,1.;"),
       ":6: expected a range in u within that of the knots, 0 to 1, found 0 to 1.5"},
      {"RangeTurned", "", bilinear("0.,1.,0.,1.;", "0.,1.,1.,0.;"),
       ":6: expected a range in v within that of the knots, 0 to 1, found 1 to 0"},
      {"StringBeyond", "", only(308, "308,0,99HA,1,1;"),
       ":5: expected a string within the entity's lines, found '99H'"},
      {"BreakPoints", "", only(114, "114,3,1,1,1,0.,0.,0.,1.;"),
       ":5: expected a break point above 0, found 0"},
      {"PiecesMissing", "", only(114, "114,3,1,1,1,0.,1.,0.,1.,0.;"),
       ":5: expected a coefficient, found the end of the entity's parameters"},
      {"TooManyPieces", "", only(114, "114,3,1,536870912,536870912,0.,1.;"),
       ":5: expected a break point, found the end of the entity's parameters"},
  };
}

std::vector<Fault> entity_faults() {
  const std::string surfaces = ":3: expected surfaces of entities 128 and 114, untrimmed, found ";
  const std::string patch = iges_bilinear("0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.");
  return {
      {"NoSurface", "", only(110, "110,0.,0.,0.,1.,1.,1.;"),
       ":3: expected a directory with a surface to be shown (entity 128 or 114), found none"},
      {"Plane", "", only(108, "108,0.,0.,1.,0.,1,0.,0.,0.,0.;", 1),
       surfaces + "entity 108 (a plane)"},
      {"Revolution", "", only(120, "120,1,3,0.,1.;"), surfaces + "entity 120 (a surface of revolu"},
      {"Solid", "", only(186, "186,3,1,0;"),
       ":5: expected the number of a shell (entity 514), found '3'"},
      {"ShellOfSurfaces", "", iges_text({{514, "514,1,3,1;"}, {128, patch}}),
       ":7: expected the number of a face (entity 510), found '3'"},
      {"ShellOfNothing", "", only(514, "514,0;"), ":5: expected the number of faces, found '0'"},
      {"FaceOfAPlane", "",
       iges_text({{510, "510,3,1,1,5;"}, {190, "190,1,1;"}, {508, "508,1,0,1,1,1,0;"}}),
       ":5: expected surfaces of entities 128 and 114, untrimmed, found entity 190 (a plane)"},
      {"Block", "", only(150, "150,1.,1.,1.;"), surfaces + "entity 150 (a block)"},
      {"Unknown", "", only(999, "999;"), surfaces + "entity 999"},
      {"Macro", "", only(10001, "10001;"), surfaces + "entity 10001"},
      {"OffsetUnderTrim", "", iges_text({{144, "144,3,0,0,0;"}, {140, "140,0.,0.,1.,1.,1;"}}),
       ":5: expected surfaces of entities 128 and 114, untrimmed, found entity 140 (an offset"},
      {"NoSurfaceUnderTrim", "", only(144, "144,0,0,0,0;"),
       ":5: expected the number of a surface (entity 128 or 114), found '0'"},
      {"PointerEven", "", only(144, "144,2,0,0,0;"), ":5: expected the number of a surface"},
      {"PointerBeyond", "", only(144, "144,3,0,0,0;"),
       ":5: expected the number of a surface (entity 128 or 114), found '3'"},
      {"TransformationMissing", "", iges_text({{128, patch, 9}}),
       ":3: expected the number of a transformation (entity 124), found 9"},
      {"TransformationOfAnotherKind", "", iges_text({{128, patch, 3}, {110, "110;"}}),
       ":3: expected the number of a transformation (entity 124), found 3"},
      {"TransformationOfItself", "",
       iges_text({{128, patch, 3}, {124, "124,1.,0.,0.,1.,0.,1.,0.,0.,0.,0.,1.,0.;", 3}}),
       ":3: expected at most 64 transformations of transformations, found more"},
      {"TransformationTooLarge", "",
       iges_text({{128, patch, 3},
                  {124, "124,1.,0.,0.,1.D308,0.,1.,0.,0.,0.,0.,1.,0.;", 5},
                  {124, "124,9.,0.,0.,1.D308,0.,1.,0.,0.,0.,0.,1.,0.;"}}),
       ":9: expected "},
      {"InstanceOfASurface", "", iges_text({{408, "408,3,0.,0.,0.,1.;"}, {128, patch}}),
       ":7: expected the number of a subfigure (entity 308), found '3'"},
  };
}

class IgesFaultTest : public ::testing::TestWithParam<Fault> {};

TEST_P(IgesFaultTest, IsRefusedWithItsLine) {
  const Fault& fault = GetParam();
  const std::string text = fault.part.empty()
                               ? fault.text
                               : replaced(read_file(sample_path("iges")), fault.part, fault.text);
  const std::string message = refusal("iges", text);
  EXPECT_EQ(message.substr(0, fault.message.size()), fault.message) << message;
  EXPECT_EQ(message.empty(), fault.message.empty()) << message;
}

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto& faults : {record_faults(), surface_faults(), entity_faults()}) {
    all.insert(all.end(), faults.begin(), faults.end());
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, IgesFaultTest, ::testing::ValuesIn(all_faults()),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace simdbezier::tests::iges_faults_test
