// IGES: which entities become patches, where transformations and instances put them, and what
// boundaries leave of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include <tools/process/failure.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/formats/iges/iges_text.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::iges_test {
namespace {

using Entities = std::vector<IgesTextEntity>;

// The points (0,0,0) (1,0,0) (0,1,0) (2,3,4).
const std::string kPatch = iges_bilinear("0.,0.,0.,1.,0.,0.,0.,1.,0.,2.,3.,4.");
// Turns x to y and moves by (10,20,30); mirrors x; the same of it twice.
const std::string kTurn = "124,0.,-1.,0.,10.,1.,0.,0.,20.,0.,0.,1.,30.;";
const std::string kMirror = "124,-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;";

/// A file and the corners of its patches, in the order low low, high low, low high, high high.
struct Case {
  const char* name;
  Entities entities;
  std::vector<std::vector<double>> corners;
  bool ignore_trims = false;
  std::size_t ignored = 0;
  const char* refused = "entity 144 (a trimmed surface)"; ///< where trims are not ignored
};
void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }

const std::vector<double> kPlain = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 3, 4};
const std::vector<double> kTurned = {10, 20, 30, 10, 21, 30, 9, 20, 30, 7, 22, 34};
const std::string kAround = "110,0.,0.,0.,0.,1.,0.;";

Entities trimmed(const std::string& boundary_flags, const Entities& curves) {
  Entities all = {{144, "144,3," + boundary_flags + ";"},
                  {128, kPatch, 0, "00010000"},
                  {142, "142,0,3,7,0,1;", 0, "00010000"}};
  all.insert(all.end(), curves.begin(), curves.end());
  return all;
}

Entities box(const std::string& u0, const std::string& u1, const std::string& v0,
             const std::string& v1) {
  const auto line = [](const std::string& from, const std::string& to) {
    return IgesTextEntity{110, "110," + from + ",0.," + to + ",0.;", 0, "00010000"};
  };
  return {{102, "102,4,9,11,13,15;", 0, "00010000"},
          line(u0 + "," + v0, u0 + "," + v1),
          line(u0 + "," + v1, u1 + "," + v1),
          line(u1 + "," + v1, u1 + "," + v0),
          line(u1 + "," + v0, u0 + "," + v0)};
}

/// A solid of one face, with the flags that say whether its shell and its face keep their side.
Entities solid(const std::string& shell, const std::string& face, const Entities& curves,
               int matrix = 0) {
  Entities all = {{186, "186,3," + shell + ",0;"},
                  {514, "514,1,5," + face + ";", matrix, "00010000", 1},
                  {510, "510,17,1,1,19;", 0, "00010000", 1}};
  all.insert(all.end(), curves.begin(), curves.end());
  const Entities rest = {{128, kPatch, 0, "00010000"},
                         {508,
                          "508,4,0,21,1,0,1,0,9,0,21,2,1,1,0,11,0,21,3,1,1,0,13,0,21,4,0,1,0,15;",
                          0, "00010000", 1},
                         {504, "504,1,23,25,1,25,2;", 0, "00010001", 1},
                         {110, kAround, 0, "00010000"},
                         {502, "502,2,0.,0.,0.,0.,1.,0.;", 0, "00010000", 1},
                         {124, kTurn}};
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

std::vector<Case> solids() {
  const std::vector<double> turned = {0, 0, 0, 0, 1, 0, 1, 0, 0, 2, 3, 4};
  const Entities whole = box("0.", "1.", "0.", "1.");
  const char* const refused = "entity 510 (a face of a solid)";
  Entities two_loops = solid("1", "1", whole);
  two_loops[2].parameters = "510,17,2,1,19,19;";
  Entities in_space = solid("1", "1", whole);
  in_space[9].parameters = "508,2,0,21,1,0,0,0,21,1,1,0;";
  Entities face = solid("1", "1", whole);
  face[0] = {110, kAround};
  face[1] = {110, kAround};
  Entities inside = solid("1", "1", whole);
  inside[0].parameters = "186,3,1,1,3,0;";
  return {{"Solid", solid("1", "1", whole), {kPlain}},
          {"SolidTurned", solid("0", "1", whole), {turned}},
          {"SolidWithAFaceTurned", solid("1", "0", whole), {turned}},
          {"SolidTurnedTwice", solid("0", "0", whole), {kPlain}},
          {"SolidMoved", solid("1", "1", whole, 27), {kTurned}},
          {"SolidWithAShellInside", inside, {kPlain, turned}},
          {"FaceAlone", face, {kPlain}},
          {"FaceOfAPart",
           solid("1", "1", box("0.25", "0.5", "0.", "0.25")),
           {{0.25, 0, 0, 0.5, 0, 0, 0.3125, 0.375, 0.25, 0.625, 0.5, 0.5}}},
          {"FaceOutside", solid("1", "0", box("0.", "2.", "0.", "1.")), {turned}, true, 1, refused},
          {"FaceWithAHole", two_loops, {kPlain}, true, 1, refused},
          {"FaceInSpace", in_space, {kPlain}, true, 1, refused}};
}

std::vector<Case> placed() {
  return {
      {"Alone", {{128, kPatch}}, {kPlain}},
      {"Turned", {{128, kPatch, 3}, {124, kTurn}}, {kTurned}},
      {"TurnedTwice",
       {{128, kPatch, 3}, {124, kTurn, 5}, {124, kTurn}},
       {{-10, 30, 60, -11, 30, 60, -10, 29, 60, -12, 27, 64}}},
      {"Mirrored",
       {{128, kPatch, 3}, {124, kMirror, 0, "00000000", 1}},
       {{0, 0, 0, 0, 1, 0, -1, 0, 0, -2, 3, 4}}},
      {"Instance",
       {{408, "408,3,1.,2.,3.,2.;"},
        {308, "308,0,3H;,;,2,5,7;"},
        {128, kPatch, 0, "00010000"},
        {110, "110,0.,0.,0.,1.,1.,1.;", 0, "00010000"}},
       {{1, 2, 3, 3, 2, 3, 1, 4, 3, 5, 8, 11}}},
      {"InstanceWithoutScaleTwice",
       {{408, "408,5;"},
        {408, "408,5,,,1.,,;", 9},
        {308, "308,0,1HA,1,7;"},
        {128, kPatch},
        {124, kTurn}},
       {kPlain, {10, 20, 31, 10, 21, 31, 9, 20, 31, 7, 22, 35}}},
      {"InstanceOfInstances",
       {{408, "408,3,0.,0.,0.,2.;"},
        {308, "308,1,1HA,2,5,7;"},
        {408, "408,9,1.,0.,0.,1.;"},
        {402, "402,1,11;", 0, "00000000", 7},
        {308, "308,0,1HB,1,11;"},
        {128, kPatch}},
       {{2, 0, 0, 4, 0, 0, 2, 2, 0, 6, 6, 8}, {0, 0, 0, 2, 0, 0, 0, 2, 0, 4, 6, 8}}},
      {"Group", {{402, "402,1,3;", 0, "00000000", 7}, {128, kPatch, 0, "00010000"}}, {kPlain}},
      {"Blanked", {{128, kPatch}, {128, kPatch, 0, "01000000"}}, {kPlain}},
      {"BlankedParent",
       {{144, "144,3,0,0,0;", 0, "01000000"}, {128, kPatch}, {128, kPatch}},
       {kPlain}},
      {"SurfaceOfACurve",
       {{142, "142,0,3,0,0,0;"}, {128, kPatch, 0, "00010000"}, {128, kPatch}},
       {kPlain}},
      {"PlaneWithoutEnd", {{108, "108,0.,0.,1.,0.,0,0.,0.,0.,0.;"}, {128, kPatch}}, {kPlain}},
  };
}

std::vector<Case> bounded() {
  const std::vector<double> part = {0.25, 0, 0, 0.5, 0, 0, 0.3125, 0.375, 0.25, 0.625, 0.5, 0.5};
  Entities hole = trimmed("1,1,5,5", box("0.", "1.", "0.", "1."));
  Entities lines = {{143, "143,1,3,1,5;"},
                    {128, kPatch, 0, "00010000"},
                    {141, "141,1,3,3,2,7,1,1,9,7,1,1,11;", 0, "00010000"},
                    {110, "110,0.,0.,0.,1.,0.,0.;", 0, "00010000"},
                    {106, "106,1,4,0.,0.,0.,1.,0.,1.,1.,0.,1.;", 0, "00010000", 11},
                    {126,
                     "126,3,2,0,0,1,0,0.,0.,0.,.5,1.,1.,1.,1.,1.,1.,1.,0.,1.,0.,0.,.7,0.,0.,.2,0.,"
                     "0.,0.,0.,0.,1.,0.,0.,1.;",
                     0, "00010000"}};
  return {
      {"Whole", {{144, "144,3,0,0,0;"}, {128, kPatch}}, {kPlain}},
      {"WholeWithoutPointers", {{144, "144,3,0,0;"}, {128, kPatch}}, {kPlain}},
      {"Around", trimmed("1,0,5", box("0.", "1.", "0.", "1.")), {kPlain}},
      {"AroundTheOtherWay", trimmed("1,0,5", box("1.", "0.", "0.", "1.")), {kPlain}},
      {"NearlyAround", trimmed("1,0,5", box("1.D-8", "1.", "-1.D-8", "1.")), {kPlain}},
      {"Part", trimmed("1,0,5", box("0.25", "0.5", "0.", "0.25")), {part}},
      {"Bounded", lines, {kPlain}},
      {"Hole", hole, {kPlain}, true, 1},
      {"OutsideIgnored", trimmed("1,0,5", box("0.", "2.", "0.", "1.")), {kPlain}, true, 1},
      {"OnlyInSpace",
       {{144, "144,3,1,0,5;"}, {128, kPatch}, {142, "142,0,3,0,7,2;"}, {110, kAround}},
       {kPlain},
       true,
       1},
      {"PlacedByBoth",
       {{144, "144,3,0,0,0;", 5},
        {128, kPatch, 7},
        {124, kTurn},
        {124, "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,5.;"}},
       {{10, 20, 35, 10, 21, 35, 9, 20, 35, 7, 22, 39}}},
  };
}

class IgesTest : public ::testing::TestWithParam<Case> {};

TEST_P(IgesTest, HasThesePatches) {
  const Case& item = GetParam();
  const TemporaryFolder folder;
  const std::string path = folder.write("in.igs", iges_text(item.entities));
  const tools::PatchFile file =
      tools::read_patches(path, tools::PatchFormat::by_name, {item.ignore_trims});
  EXPECT_EQ(file.ignored_trims, item.ignored);
  ASSERT_EQ(file.count, item.corners.size());
  for (std::size_t p = 0; p < file.count; ++p) {
    std::vector<double> corners;
    for (const WeightedPoint& point : patch_points(file, p)) {
      corners.insert(corners.end(), {point.x, point.y, point.z});
    }
    EXPECT_EQ(corners, item.corners[p]) << "patch " << p;
  }
  if (item.ignored > 0) {
    EXPECT_NE(refusal("igs", iges_text(item.entities))
                  .find("a surface without trimming curves (--ignore-trims reads all of it), "
                        "found " +
                        std::string(item.refused)),
              std::string::npos);
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> all = placed();
  for (const std::vector<Case>& more : {bounded(), solids()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, IgesTest, ::testing::ValuesIn(all_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

// Two by one pieces whose parameters have the lengths 2, 0.5 and 4, and what does not count behind
// them: x = s, y = t, z = s t^2 + the number of the piece.
TEST(Iges, ParametricSurfacesHaveLocalParameters) {
  const auto piece = [](const std::string& number) {
    std::string text;
    for (const int one : {1, 4}) { // of s and t
      for (int k = 0; k < 16; ++k) {
        text += k == one ? "1.," : "0.,";
      }
    }
    return text + number + ".,0.,0.,0.,0.,0.,0.,0.,0.,1.,0.,0.,0.,0.,0.,0.,";
  };
  std::string dummy;
  for (int k = 0; k < 48; ++k) {
    dummy += "9.,";
  }
  const std::string text = "114,3,1,2,1,0.,2.,2.5,1.,5.," + piece("7") + dummy + piece("8") +
                           dummy + dummy + dummy.substr(0, dummy.size() - 1) + ";";
  const tools::PatchFile file = read_text("iges", iges_text({{114, text}}));
  ASSERT_EQ(file.count, 2U);
  const double lengths[] = {2, 0.5};
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<WeightedPoint> points = patch_points(file, p);
    ASSERT_EQ(points.size(), 16U);
    for (int k = 0; k < 16; ++k) {
      const int i = k % 4;
      const int j = k / 4;
      const double s = lengths[p] * i / 3;
      const double square = j < 2 ? 0 : j == 2 ? 16.0 / 3 : 16; // the control values of t^2
      EXPECT_NEAR(points[static_cast<std::size_t>(k)].x, s, 1e-15);
      EXPECT_NEAR(points[static_cast<std::size_t>(k)].y, 4.0 * j / 3, 1e-15 * 4);
      EXPECT_NEAR(points[static_cast<std::size_t>(k)].z, 7.0 + static_cast<double>(p) + s * square,
                  1e-14);
    }
  }
  EXPECT_GT(file.moved_error, 0);
  EXPECT_LT(file.moved_error, 1e-12);
  const TemporaryFolder folder; // break points are no knots to be merged, however near
  const std::string path = folder.write("in.igs", iges_text({{114, text}}));
  EXPECT_EQ(tools::read_patches(path, tools::PatchFormat::iges, {.knot_tolerance = 0.6}).count, 2U);
}

TEST(Iges, HasOtherDelimitersAndNoneAtAll) {
  std::string text = kPatch;
  std::ranges::replace(text, ',', '/');
  std::ranges::replace(text, ';', '$');
  EXPECT_EQ(refusal("iges", iges_text({{128, text}}, "1H//1H$/4Hpart$")), "");
  EXPECT_EQ(refusal("iges", iges_text({{128, kPatch}}, ",,4Hpart;")), "");
  EXPECT_EQ(refusal("iges", iges_text({{128, kPatch}}, ",;")), "");
}

TEST(Iges, WeightsThatAreEqualAreNone) {
  const std::string twos =
      replaced(kPatch, "1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,", "1.,1.,0.,0.,1.,1.,2.,2.,2.,2.,");
  EXPECT_FALSE(read_text("iges", iges_text({{128, twos}})).runs.at(0).rational());
  const std::string others = replaced(twos, "2.,2.,2.,2.", "2.,2.,2.,1.");
  EXPECT_TRUE(read_text("iges", iges_text({{128, others}})).runs.at(0).rational());
}

// Pointers to associativities and to properties may follow, each behind their number, and no more.
TEST(Iges, HasNothingBehindItsPointers) {
  const std::string patch = std::string(kPatch).substr(0, std::string(kPatch).size() - 1);
  const std::string property = "406,1,1;";
  for (const std::string rest : {",0;", ",,;", ",0,0;", ",0,1,3;", ",2,3,3,1,3;"}) {
    EXPECT_EQ(refusal("iges", iges_text({{128, patch + rest}, {406, property, 0, "00010000"}})),
              "");
  }
  constexpr struct {
    const char* rest;
    const char* message;
  } kRefused[] = {{",0,0,7;", "expected the end of the entity's parameters, found '7'"},
                  {",0,1,3,;", "expected the end of the entity's parameters, found none"},
                  {",.5;", "expected a number of associativities, found '.5'"},
                  {",0,2,3;", "expected a pointer to an associativity or a property, found"},
                  {",0,1,2;", "or a property, an odd number, found '2'"}};
  for (const auto& item : kRefused) {
    const std::string found =
        refusal("iges", iges_text({{128, patch + item.rest}, {406, property, 0, "00010000"}}));
    EXPECT_NE(found.find(item.message), std::string::npos) << found;
  }
}

// What entities show each other grows with every level, here by two.
TEST(Iges, InstancesDoNotMultiplyWithoutEnd) {
  Entities entities = {{128, kPatch}};
  for (int level = 0; level < 40; ++level) {
    const std::string last = std::to_string(level == 0 ? 1 : 4 * level + 1);
    const std::string definition = std::to_string(4 * level + 3);
    entities.push_back({308, "308,0,1HA,2," + last + "," + last + ";"});
    entities.push_back({408, "408," + definition + ";"});
  }
  EXPECT_NE(refusal("iges", iges_text(entities))
                .find("expected entities that show each other at most 100 times, found more"),
            std::string::npos);
  EXPECT_NE(refusal("iges", iges_text({{408, "408,3;"}, {308, "308,0,1HA,1,1;"}, {408, "408,3;"}}))
                .find("expected subfigures in at most 64 others, found more"),
            std::string::npos);
}

TEST(Iges, IsCalledByBothExtensions) {
  const TemporaryFolder folder;
  const std::string text = read_file(sample_path("iges"));
  for (const std::string name : {"a.igs", "a.iges"}) {
    EXPECT_EQ(run({"info", folder.write(name, text)}).exit_code, 0);
  }
  EXPECT_EQ(run({"info", "-", "--format", "igs"}, {.input = text}).exit_code, 0);
}

} // namespace
} // namespace simdbezier::tests::iges_test
