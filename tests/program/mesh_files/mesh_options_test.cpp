// Options of tessellate that contradict each other or cannot be met.
#include <gtest/gtest.h>

#include <array>
#include <ostream>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::mesh_options_test {
namespace {

struct Refused {
  const char* name;
  int exit_code;
  std::vector<std::string> options;
  const char* message;
};
void PrintTo(const Refused& item, std::ostream* out) { *out << item.name; }

const Refused kRefused[] = {
    {"ToleranceZero",
     1,
     {"--tolerance", "0"},
     "--tolerance: expected a distance above 0, found '0'"},
    {"ToleranceNegative", 1, {"--tolerance", "-1"}, "--tolerance: expected a distance above 0"},
    {"ToleranceNan", 1, {"--tolerance", "nan"}, "--tolerance: expected a distance above 0"},
    {"ToleranceInfinite", 1, {"--tolerance", "inf"}, "--tolerance: expected a distance above 0"},
    {"ToleranceWord", 2, {"--tolerance", "fine"}, "--tolerance: expected a distance above 0"},
    {"ToleranceEmpty", 2, {"--tolerance", ""}, "--tolerance: expected a distance above 0"},
    {"ToleranceHexadecimal", 2, {"--tolerance", "0x1"}, "--tolerance: expected a distance above 0"},
    {"ToleranceBehindASpace", 2, {"--tolerance", " 1"}, "--tolerance: expected a distance above 0"},
    {"ToleranceBeforeASpace", 2, {"--tolerance", "1 "}, "--tolerance: expected a distance above 0"},
    {"ToleranceTooLarge",
     1,
     {"--tolerance", "1e999"},
     "--tolerance: expected a distance above 0, found '1e999', which is too large for a double"},
    {"ToleranceBelowRounding",
     1,
     {"--tolerance", "1e-9"},
     "--tolerance: expected a distance above the error of rounding, "},
    {"ToleranceBeyondRates",
     1,
     {"--tolerance", "1e-10", "--precision", "f64"},
     "--tolerance: expected a distance that 4096 cells a direction can keep, found 1e-10 for "
     "patch"},
    {"RelativeZero", 1, {"--relative", "0"}, "--relative: expected a share above 0, found '0'"},
    {"RelativeBelowRounding",
     1,
     {"--relative", "1e-12"},
     "--relative: expected a distance above the error of rounding, "},
    {"AngleZero", 1, {"--angle", "0"}, "--angle: expected degrees above 0 and at most 180"},
    {"AngleLarge", 1, {"--angle", "181"}, "--angle: expected degrees above 0 and at most 180"},
    {"AngleBeyondRates",
     1,
     {"--angle", "1e-5"},
     "--angle: expected degrees that 4096 cells a direction can keep, found 1e-05 for patch 0 of"},
    {"AngleBesideTolerance",
     1,
     {"--tolerance", "1", "--angle", "1e-5"},
     "--angle: expected degrees that 4096 cells a direction can keep, found 1e-05 for patch 0 of"},
    {"AngleBesideRelative",
     1,
     {"--relative", "0.5", "--angle", "1e-5"},
     "--angle: expected degrees that 4096 cells"},
    {"AngleBesidePixels",
     1,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--angle", "1e-5"},
     "--angle: expected degrees that 4096 cells"},
    {"ToleranceBesideAngle",
     1,
     {"--tolerance", "1e-9", "--angle", "10"},
     "--tolerance: expected a distance above the error of rounding, "},
    {"ToleranceBesideTinyAngle",
     1,
     {"--tolerance", "1e-9", "--angle", "1e-5"},
     "--tolerance: expected a distance above the error of rounding, "},
    {"RelativeBelowTolerance",
     1,
     {"--tolerance", "1", "--relative", "1e-12"},
     "--relative: expected a distance above the error of rounding, "},
    {"PixelsBelowTolerance",
     1,
     {"--tolerance", "1", "--pixels", "1e-9", "--camera", "9,0,0,0,0,0"},
     "--pixels: expected a distance above the error of rounding, "},
    {"ToleranceBelowPixels",
     1,
     {"--tolerance", "1e-9", "--pixels", "1", "--camera", "9,0,0,0,0,0"},
     "--tolerance: expected a distance above the error of rounding, "},
    {"PixelsZero", 1, {"--pixels", "0", "--camera", "9,0,0,0,0,0"}, "--pixels: expected a number"},
    {"PixelsWithoutCamera", 2, {"--pixels", "1"}, "--pixels: expected with --camera"},
    {"CameraWithoutPixels", 2, {"--camera", "9,0,0,0,0,0"}, "--camera: expected with --pixels"},
    {"ViewAngleWithoutCamera", 2, {"--view-angle", "30"}, "--view-angle: expected with --camera"},
    {"PictureWithoutCamera", 2, {"--picture", "4x4"}, "--picture: expected with --camera"},
    {"CameraInItsTarget",
     1,
     {"--pixels", "1", "--camera", "1,2,3,1,2,3"},
     "--camera: expected six numbers separated by commas, for two different points, found"},
    {"CameraOfFive", 2, {"--pixels", "1", "--camera", "1,2,3,4,5"}, "--camera: expected six"},
    {"CameraOfSeven", 2, {"--pixels", "1", "--camera", "1,2,3,4,5,6,7"}, "--camera: expected six"},
    {"CameraOfWords", 2, {"--pixels", "1", "--camera", "1,2,x,4,5,6"}, "--camera: expected six"},
    {"CameraNan", 1, {"--pixels", "1", "--camera", "1,2,3,4,5,nan"}, "--camera: expected six"},
    {"PictureEmpty",
     2,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--picture", "0x5"},
     "--picture: expected WxH, each from 1 to 65536, found '0x5'"},
    {"PictureOfOneNumber",
     2,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--picture", "50"},
     "--picture: expected WxH"},
    {"ViewAngleFlat",
     1,
     {"--pixels", "1", "--camera", "9,0,0,0,0,0", "--view-angle", "180"},
     "--view-angle: expected degrees above 0 and below 180"},
    {"CreaseNegative", 1, {"--crease", "-1"}, "--crease: expected degrees from 0 to 180"},
    {"CreaseNan", 1, {"--crease", "nan"}, "--crease: expected degrees from 0 to 180"},
    {"CreaseWithoutNormals",
     2,
     {"--crease", "30", "--no-normals"},
     "--crease: expected without --no-normals, found both"},
    {"SnapZero", 1, {"--snap", "0"}, "--snap: expected a distance above 0"},
    {"SnapAboveTolerance",
     1,
     {"--snap", "0.5", "--tolerance", "0.1"},
     "--snap: expected a distance that leaves room within --tolerance, 0.1, found 0.5 for patch"},
    {"PointsAboveTolerance",
     1,
     {"--point-size", "0.5", "--snap", "1e-9", "--relative", "0.001"},
     "--point-size: expected a distance that leaves room within --relative, 0.00"},
    {"SnapBesideTooFine",
     1,
     {"--snap", "1e-12", "--tolerance", "1e-10", "--precision", "f64"},
     "--tolerance: expected a distance that 4096 cells a direction can keep, found 1e-10"},
    {"PointSizeZero", 1, {"--point-size", "0"}, "--point-size: expected a distance above 0"},
    {"PointsOfSheets", 2, {"--no-weld", "--point-size", "1"}, "--point-size: expected without"},
    {"OriginUnknown", 2, {"--origin", "middle"}, "--origin: expected auto, x,y,z or none, found"},
    {"OriginOfTwo", 2, {"--origin", "1,2"}, "--origin: expected auto, x,y,z or none, found '1,2'"},
    {"OriginOfFour", 2, {"--origin", "1,2,3,4"}, "--origin: expected auto, x,y,z or none"},
    {"OriginNan", 1, {"--origin", "1,nan,3"}, "--origin: expected auto, x,y,z or none"},
    {"StoredDoublesOfFloats",
     2,
     {"--vertex-precision", "f64"},
     "--vertex-precision: expected f64 with --precision f64, found without"},
    {"StoredOtherwise",
     2,
     {"--vertex-precision", "f16"},
     "--vertex-precision: expected f32 or f64, found 'f16'"},
    {"GridBeyondRates",
     2,
     {"--grid", "5000"},
     "--grid: expected at most 4097 samples a direction without --no-weld, found 5000x5000"},
    {"GridAndTolerance",
     2,
     {"--grid", "4", "--tolerance", "1"},
     "--tolerance: expected without --grid, found both"},
    {"GridAndRelative",
     2,
     {"--grid", "4", "--relative", "1"},
     "--relative: expected without --grid"},
    {"ToleranceOfSheets",
     2,
     {"--no-weld", "--tolerance", "1"},
     "--tolerance: expected without --no-weld, found both"},
    {"CreaseOfSheets", 2, {"--no-weld", "--crease", "1"}, "--crease: expected without --no-weld"},
    {"OrientOfSheets", 2, {"--no-weld", "--orient"}, "--orient: expected without --no-weld"},
    {"RepetitionsOfSheets",
     2,
     {"--no-weld", "--drop-repeated"},
     "--drop-repeated: expected without --no-weld"},
    {"WeldedSheets", 2, {"--no-weld", "--weld"}, "--weld: expected without --no-weld"},
    {"SnapOfSheets", 2, {"--no-weld", "--snap", "1"}, "--snap: expected without --no-weld"},
    {"SplitEdgesOfSheets", 2, {"--no-weld", "--split-edges"}, "--split-edges: expected without"},
    {"ThoroughGrid",
     2,
     {"--grid", "4", "--thorough"},
     "--thorough: expected with --tolerance, --relative or --pixels, found without"},
    {"ThoroughAngle", 2, {"--angle", "4", "--thorough"}, "--thorough: expected with --tolerance"},
    {"StatsUnknown", 2, {"--stats=xml"}, "--stats: expected text or json, found 'xml'"},
    {"QuantisedPly", 2, {"--quantise", "16"}, "--quantise: expected an output in glb, found ply"},
    {"QuantisedWords", 2, {"--quantise", "12"}, "--quantise: expected 16 or 8, found '12'"},
    {"OtherFormat", 2, {"--to", "obj"}, "--to: expected the format of "},
    {"UnknownFormat",
     2,
     {"--to", "fbx"},
     "--to: expected obj, ply, stl, glb, vtu or raw, found 'fbx'"},
};

class RefusedOptions : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedOptions, AreNamedInOneLine) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.ply", "before");
  std::vector<std::string> arguments = {"tessellate", "builtin:teapot", "-o", out};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  expect_failure(run(arguments), GetParam().exit_code, GetParam().message);
  EXPECT_EQ(read_file(out), "before");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.ply"});
}

INSTANTIATE_TEST_SUITE_P(All, RefusedOptions, ::testing::ValuesIn(kRefused),
                         [](const auto& test) { return std::string(test.param.name); });

// The options that ask for so many are named, and no other ones.
TEST(RefusedMeshOptions, MoreVerticesThanIndices) {
  const TemporaryFolder folder;
  std::vector<Net> nets(1500, flat_net());
  for (std::size_t k = 0; k < nets.size(); ++k) {
    for (std::size_t m = 0; m < nets[k].points.size(); ++m) {
      Vector3& point = nets[k].points[m];
      point = {3 * point[0], 3 * point[1],
               static_cast<double>((m % 4 * 7 + m / 4 * 5) % 4) + 0.01 * static_cast<double>(k)};
    }
  }
  const std::string in = folder.write("in.bez", bez_text(nets));
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--grid", "4097"}, "--grid"},
      {{"--tolerance", "1e-6"}, "--tolerance"},
      {{"--relative", "5e-8"}, "--relative"},
      {{"--angle", "0.1"}, "--angle"},
      {{"--angle", "0.1", "--relative", "0.5"}, "--relative and --angle"},
      {{"--pixels", "1.7e-7", "--camera", "1,1,10000,1,1,0"}, "--pixels"}};
  for (const auto& [options, name] : cases) {
    std::vector<std::string> arguments = {"tessellate", in,   "--precision",
                                          "f64",        "-o", folder.path("out.ply")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    // Without the refusal, the limit keeps the disk from being filled.
    expect_failure(run(arguments, {.file_size_limit = 1 << 20}), 1,
                   "simdbezier: " + name + ": expected at most 4294967295 vertices, found more");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.bez"});
}

TEST(RefusedMeshOptions, SurfacesOfOneSide) {
  std::size_t found = 0;
  for (const MeshModel& model : mesh_models()) {
    if (model.orientable) {
      continue;
    }
    const TemporaryFolder folder;
    const std::string in = folder.write("in.bez", bez_of(model));
    expect_failure(run({"tessellate", in, "--orient", "-o", folder.path("out.ply")}), 1,
                   "--orient: expected patches that can be turned to agree with their neighbours, "
                   "found a surface of one side in " +
                       in);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.bez"});
    ++found;
  }
  EXPECT_GT(found, 0U);
}

TEST(RefusedMeshOptions, WhatAFormatDoesNotHold) {
  const std::array<std::string, 3> cases[] = {{"--quads", "stl", "obj, ply, vtu or raw"},
                                              {"--quads", "glb", "obj, ply, vtu or raw"},
                                              {"--parameters", "stl", "obj, ply, glb, vtu or raw"}};
  for (const auto& [option, extension, formats] : cases) {
    for (const std::vector<std::string>& out :
         {std::vector<std::string>{"out." + extension}, {"-", "--to", extension}}) {
      std::vector<std::string> arguments = {"tessellate", "builtin:teapot", option, "-o"};
      arguments.insert(arguments.end(), out.begin(), out.end());
      expect_failure(run(arguments), 2,
                     option + ": expected an output in " + formats + ", found " + extension + "\n");
    }
  }
}

// Standard output by all of its names, and a file that it goes to.
TEST(RefusedMeshOptions, JsonAmongData) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.ply", "before");
  const std::string message =
      "--stats: expected json for an output that is not standard output, found -o ";
  const auto outcome = [&](const std::string& name, const std::string& append) {
    return run({"tessellate", "builtin:teapot", "--stats=json", "-o", name, "--to", "ply"},
               {.append_path = append});
  };
  expect_failure(outcome("-", ""), 2, message + "-\n");
  for (const std::string name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    expect_failure(outcome(name, ""), 2, message + name + ", which is standard output");
  }
  expect_failure(outcome(out, out), 2, message + out + ", which is standard output");
  EXPECT_EQ(read_file(out), "before");
  EXPECT_EQ(outcome("/dev/null", "/dev/null").exit_code, 0) << "nothing mixes there";
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.ply"});
}

TEST(RefusedMeshOptions, StandardOutputWithoutAFormat) {
  expect_failure(
      run({"tessellate", "builtin:teapot", "-o", "-"}), 2,
      "-o: expected a name that ends in .obj, .ply, .stl, .glb, .vtu or .raw, or - with --to");
}

} // namespace
} // namespace simdbezier::tests::mesh_options_test
