// Files that the readers refuse, and the line with which they do: what was expected, what found.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::format_faults_test {
namespace {

/// A sample file with one part of it replaced, or a text of its own where there is no part.
struct Fault {
  const char* name;
  const char* format;
  std::string part;
  std::string text;
  std::string message; ///< what follows the file's name
};
void PrintTo(const Fault& item, std::ostream* out) { *out << item.name; }

std::vector<Fault> bpt_faults() {
  return {
      {"DegreeZero", "bpt", "2 3\n", "0 3\n",
       ":2: expected degree 1 to 15 across the rows, found '0'"},
      {"DegreeSixteen", "bpt", "2 3\n", "2 16\n",
       ":2: expected degree 1 to 15 along a row, found '16'"},
      {"DegreeMissing", "bpt", "2 1\n", "2\n",
       ":16: expected degree 1 to 15 along a row, found '0'"},
      {"DegreeTooLow", "bpt", "2 3\n", "1 3\n",
       ":11: expected degree 1 to 15 along a row, found '-14'"},
      {"CountBelow", "bpt", "3\n2 3", "4\n2 3",
       ":26: expected 4 patches as declared in line 1, found the end of the file after 3 patches"},
      {"CountAbove", "bpt", "3\n2 3", "2\n2 3",
       ":22: expected the end of the file after 2 patches as declared in line 1, found '1'"},
  };
}

std::vector<Fault> bv_faults() {
  const std::string kinds = ":17: expected kind 4, 5 or 8 (tensor-product patches)";
  return {
      {"Empty", "bv", "", "", ":1: expected a patch, found the end of the file"},
      {"GroupOnly", "bv", "", "group 1 nothing\n", ":1: expected a patch, found the end of the"},
      {"Polyhedron", "bv", "8\n2 1", "1\n3 1", kinds + ", found kind 1 (polyhedron)"},
      {"Triangle", "bv", "8\n2 1", "3\n1", kinds + ", found kind 3 (triangular patch)"},
      {"PnTriangle", "bv", "8\n2 1", "9\n1 1", kinds + ", found kind 9 (PN triangle)"},
      {"PnQuad", "bv", "8\n2 1", "10\n1 1 1 1", kinds + ", found kind 10 (PN quad)"},
      {"UnknownKind", "bv", "8\n2 1", "7\n2 1", kinds + ", found kind 7"},
      {"WordForKind", "bv", "8\n2 1", "rational\n2 1", kinds + " or group, found 'rational'"},
      {"DegreeZero", "bv", "4 1", "4 0",
       ":26: expected degree 1 to 15 across the rows (deg_u), found '0'"},
      {"DegreeSixteen", "bv", "2 3", "2 16",
       ":3: expected degree 1 to 15 along a row (deg_v), found '16'"},
      {"WeightZero", "bv", "2 -2 2 2", "2 -2 2 0", ":20: expected a weight above 0, found '0'"},
      {"WeightNegative", "bv", "2 -2 2 2", "2 -2 2 -1",
       ":20: expected a weight above 0, found '-1"},
      {"WeightNan", "bv", "2 -2 2 2", "2 -2 2 nan", ":20: expected a finite number, found 'nan'"},
      {"CoordinateInf", "bv", "21 -5 3", "21 inf 3", ":10: expected a finite number, found 'inf'"},
      {"OnePointLess", "bv", "1 100 2\n", "",
       ":29: expected 4 points of the patch in line 26, found the end of the file in point 4"},
      {"OnePointMore", "bv", "1 100 2\n", "1 100 2\n5.5 6 7\n",
       ":31: expected kind 4, 5 or 8 (tensor-product patches) or group, found '5.5'"},
      {"EndInsideAPoint", "bv", "1 100 2\n", "1 100",
       ":30: expected 4 points of the patch in line 26, found the end of the file in point 4"},
  };
}

std::vector<Fault> itd_faults() {
  return {
      {"Empty", "itd", "", "", ":1: expected a SURFACE BEZIER, found the end of the file"},
      {"CommentOnly", "itd", "", "nothing\n[but this]\n", ":2: expected a SURFACE BEZIER, found"},
      {"Order1", "itd", "4 3 E3", "4 1 E3",
       ":5: expected order 2 to 16 (degree 1 to 15) in v, found '1'"},
      {"Order17", "itd", "4 3 E3", "17 3 E3",
       ":5: expected order 2 to 16 (degree 1 to 15) in u, found '17'"},
      {"PointType", "itd", "2 3 P3", "2 3 P4", ":21: expected point type E3 or P3, found 'P4'"},
      {"PlanePoints", "itd", "4 3 E3", "4 3 E2", ":5: expected point type E3 or P3, found 'E2'"},
      {"BSpline", "itd", "SURFACE BEZIER 2 3", "SURFACE BSPLINE 2 3 2 3",
       ":21: expected SURFACE BEZIER, found 'BSPLINE'"},
      {"Curve", "itd", "SURFACE BEZIER 2 3", "CURVE BEZIER 6",
       ":21: expected a SURFACE BEZIER, found 'CURVE'"},
      {"Polygon", "itd", "MATRIX", "POLYGON", ":36: expected a SURFACE BEZIER, found 'POLYGON'"},
      {"Instance", "itd", "MATRIX", "INSTANCE LIST", ":36: expected a SURFACE BEZIER, found 'INST"},
      {"OutsideOfObjects", "itd", "[OBJECT VIEW_MAT\n    [MATRIX", "[SURFACE BEZIER\n [",
       ":35: expected [OBJECT around all geometry, found 'SURFACE'"},
      {"OutsideOfObjectsInAList", "itd", "[OBJECT VIEW_MAT\n    [MATRIX", "[ [[SURFACE BEZIER\n [",
       ":35: expected [OBJECT around all geometry, found 'SURFACE'"},
      {"InAListWithoutAName", "itd", "SURFACE BEZIER 2 3", "[SURFACE BEZIER 2 3",
       ":21: expected one '[' before geometry, found 'SURFACE'"},
      {"ObjectInListsWithoutNames", "itd", "MATRIX", "[[OBJECT A",
       ":36: expected one '[' before geometry, found 'OBJECT'"},
      {"OnePointLess", "itd", "            [0.5 1 2.5 2.5]\n", "",
       ":27: expected 6 points in brackets, found ']' after 5"},
      {"OnePointMore", "itd", "[1 100 2]", "[1 100 2] [1 2 3]",
       ":30: expected ']' after 4 points, found '['"},
      {"CoordinateMissing", "itd", "[21 -5 3]", "[21 -5]",
       ":12: expected a finite number, found ']'"},
      {"CoordinateTooMany", "itd", "[21 -5 3]", "[21 -5 3 1]",
       ":12: expected ']' after x y z, found '1'"},
      {"WeightMissing", "itd", "[2 2 -2 2]", "[2 -2 2]",
       ":23: expected a finite number, found ']'"},
      {"WeightZero", "itd", "[2 2 -2 2]", "[0 2 -2 2]",
       ":23: expected a weight above 0, found '0'"},
      {"WeightInf", "itd", "[2 2 -2 2]", "[inf 2 -2 2]",
       ":23: expected a finite number, found 'inf'"},
      {"CoordinateNan", "itd", "[21 -5 3]", "[21 nan 3]",
       ":12: expected a finite number, found 'nan'"},
      {"CoordinateOverflow", "itd", "[21 -5 3]", "[21 1e999 3]",
       ":12: expected a finite number, found '1e999', which is too large for a double"},
      {"EndInsideAnObject", "itd", "", "[OBJECT NONE\n[COLOR 3]\n",
       ":2: expected ']' for the object in line 1, found the end of the file"},
      {"EndInsideAnAttribute", "itd", "", "[OBJECT NONE\n[COLOR 3\n",
       ":2: expected ']' for the list in line 2, found the end of the file"},
      {"EndInsideAString", "itd", "", "[OBJECT NONE\n[RGB \"1,2,3]\n",
       ":2: expected a closing quote, found the end of the file"},
      {"EndInsideASurface", "itd", "", "[OBJECT NONE [SURFACE BEZIER 2 2 E3 [0 0 0]",
       ":1: expected 4 points in brackets, found the end of the file after 1"},
  };
}

std::vector<Fault> obj_faults() {
  const std::string vertex = "v 30 3 2.25\n"; // line 7
  return {
      {"Empty", "obj", "", "", ":1: expected a surface (surf), found the end of the file"},
      {"NoSurface", "obj", "", "v 1 2 3\n", ":1: expected a surface (surf), found the end of"},
      {"Faces", "obj", "g polynomial", "f 1 2 3",
       ":18: expected a free-form surface and what belongs to it, found 'f' (polygons)"},
      {"Curve", "obj", "g polynomial", "curv 0 1 1 2 3 4",
       ":18: expected a free-form surface and what belongs to it, found 'curv' (a curve)"},
      {"Trim", "obj", "parm v 0 2\n", "parm v 0 2\ntrim 0 1 1\n",
       ":25: expected the number of a curve (curv2) before it, found '1'"},
      {"TrimOutside", "obj", "g polynomial", "trim 0 1 1",
       ":18: expected surf before trim, found 'trim'"},
      {"Superseded", "obj", "g polynomial", "bzp 1 2 3 4 5 6 7 8 9 10 11 12 1 2 3 4",
       ":18: expected a free-form surface and what belongs to it, found 'bzp' (a superseded"},
      {"UnknownType", "obj", "cstype bezier", "cstype nurbs",
       ":19: expected cstype bezier, bmatrix, bspline, cardinal or taylor, or rat and one of "
       "these, "
       "found 'nurbs'"},
      {"KnotsMissing", "obj", "cstype bezier", "cstype bspline",
       ":23: expected 8 knots or more, found the end of the line"},
      {"KnotsFall", "obj", "",
       "v 0 0 0\nv 1 1 1\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 1 2\nparm u 0 0 1 1\n"
       "parm v 0 0 1 0.5\nend\n",
       ":7: expected a knot of at least 1, found '0.5'"},
      {"KnotTooOften", "obj", "",
       "v 0 0 0\nv 1 1 1\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 1 2 1 2\nparm u 0 0 0 1 1\n"
       "parm v 0 0 1 1\nend\n",
       ":5: expected every knot at most 2 times in u, found 0 once more"},
      {"NoDomain", "obj", "",
       "v 0 0 0\nv 1 1 1\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 1 2\nparm u 1 1 1 1\n"
       "parm v 0 0 1 1\nend\n",
       ":5: expected a range within 1 1 of parm u, found 0 1"},
      {"RangeOfKnots", "obj", "",
       "v 0 0 0\nv 1 1 1\ncstype bspline\ndeg 1 1\nsurf 0 2 0 1 1 2 1 2\nparm u 0 0 1 1\n"
       "parm v 0 0 1 1\nend\n",
       ":5: expected a range within 0 1 of parm u, found 0 2"},
      {"CardinalOfAnotherDegree", "obj", "cstype bezier", "cstype cardinal",
       ":21: expected degree 3 in v for cstype cardinal, found 2"},
      {"NoStep", "obj", "cstype bezier", "cstype bmatrix",
       ":21: expected step in u before surf, found 'surf'"},
      {"NoMatrix", "obj", "cstype bezier", "step 3 2\ncstype bmatrix",
       ":22: expected bmat u of 16 numbers before surf, found 0"},
      {"ShortMatrix", "obj", "cstype bezier", "bmat u 1 2 3\nstep 3 2\ncstype bmatrix",
       ":23: expected bmat u of 16 numbers before surf, found 3"},
      {"StepZero", "obj", "cstype bezier", "step 0 1",
       ":19: expected a step, 1 to 2147483647, found '0'"},
      {"PointOfACurve", "obj", "g polynomial", "vp 1 2 1 0",
       ":18: expected up to three numbers u v w, found '0'"},
      {"CurveOfNoPoint", "obj", "g polynomial", "curv2 1 2",
       ":18: expected the number of a point (vp) before it, found '1'"},
      {"CurveWithoutEnd", "obj", "g polynomial", "vp 1 2\ncurv2 1 1\nparm u 0 1",
       ":21: expected parm or the end of the curve in line 19, found 'cstype'"},
      {"UnknownStatement", "obj", "g polynomial", "patch 1 2",
       ":18: expected a statement of .obj files, found 'patch'"},
      {"DegreeZero", "obj", "deg 3 2", "deg 3 0", ":20: expected degree 1 to 15 in v, found '0'"},
      {"DegreeSixteen", "obj", "deg 3 2", "deg 16 2",
       ":20: expected degree 1 to 15 in u, found '16'"},
      {"DegreeOfACurve", "obj", "deg 3 2", "deg 3",
       ":21: expected deg of u and v before surf, found 'surf'"},
      {"NoDegree", "obj", "deg 3 2\n", "",
       ":20: expected deg of u and v before surf, found 'surf'"},
      {"NoType", "obj", "cstype bezier\n", "", ":20: expected cstype before surf, found 'surf'"},
      {"TwoCoordinates", "obj", vertex, "v 30 3\n",
       ":7: expected x y z or x y z w, found 2 numbers"},
      {"FiveNumbers", "obj", vertex, "v 30 3 2.25 1 0\n",
       ":7: expected x y z or x y z w, found 5 numbers"},
      {"CoordinateNan", "obj", vertex, "v 30 nan 2.25\n",
       ":7: expected a finite number, found 'nan'"},
      {"WeightZero", "obj", "v 1 -1 1 2\n", "v 1 -1 1 0\n",
       ":27: expected a weight above 0, found 0"},
      {"WeightNegative", "obj", "v 1 -1 1 2\n", "v 1 -1 1 -2\n",
       ":27: expected a weight above 0, found -2"},
      {"WeightInf", "obj", "v 1 -1 1 2\n", "v 1 -1 1 inf\n",
       ":27: expected a finite number, found 'inf'"},
      {"NoVertices", "obj", "", "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n",
       ":3: expected vertices (v) before the surface, found '1'"},
      {"VertexZero", "obj", "7/1/1", "0/1/1",
       ":22: expected the number of a vertex, 1 to 12 or -1 to -12, found '0/1/1'"},
      {"VertexBeyond", "obj", "7/1/1", "13",
       ":22: expected the number of a vertex, 1 to 12 or -1 to -12, found '13'"},
      {"VertexBefore", "obj", "7/1/1", "-13",
       ":22: expected the number of a vertex, 1 to 12 or -1 to -12, found '-13'"},
      {"VertexWord", "obj", "7/1/1", "seven", ":22: expected the number of a vertex"},
      {"RangeMissing", "obj", "surf -1 1 0.5 0.75 -6 -5 -4 -3 -2 -1", "surf -1 1 0.5",
       ":34: expected a finite number, found the end of the line"},
      {"PointMissing", "obj", "-3 -2 -1", "-3 -2", ":34: expected 6 points (2 x 3), found 5"},
      {"PointTooMany", "obj", "-3 -2 -1", "-3 -2 -1 -1", ":34: expected 6 points (2 x 3), found 7"},
      {"SegmentsThatDoNotFit", "obj", "parm v 0 2", "parm v 0 1 2",
       ":21: expected 20 points (4 x 5), found 12"},
      {"BeyondTheRange", "obj", "surf 0 1 0 2", "surf 0 1 0 2.5",
       ":21: expected a range within 0 2 of parm v, found 0 2.5"},
      {"PartOfTheRange", "obj", "cstype bezier\ndeg 3 2\nsurf 0 1 0 2",
       "cstype taylor\ndeg 3 2\nsurf 0 1 0 1.5",
       ":21: expected the whole range 0 2 of parm v, found 0 1.5"},
      {"ParametersEqual", "obj", "parm v 0 2", "parm v 0 0 2",
       ":24: expected a parameter above 0, found '0'"},
      {"ParametersFall", "obj", "parm v 0 2", "parm v 2 0",
       ":24: expected a parameter above 2, found '0'"},
      {"OneParameter", "obj", "parm v 0 2", "parm v 0",
       ":24: expected 2 parameters or more, found the end of the line"},
      {"ParameterDirection", "obj", "parm v 0 2", "parm w 0 2",
       ":24: expected parm u or parm v, found 'w'"},
      {"ParameterTwice", "obj", "parm v 0 2", "parm u 0 1",
       ":24: expected one parm of each direction, found 'u'"},
      {"NoParameters", "obj", "parm v 0 2\n", "",
       ":24: expected parm v before the end of the surface in line 21, found 'end'"},
      {"ParameterOutside", "obj", "g polynomial", "parm u 0 1",
       ":18: expected surf before parm, found 'parm'"},
      {"EndOutside", "obj", "g polynomial", "end", ":18: expected surf before end, found 'end'"},
      {"SurfaceInSurface", "obj", "parm v 0 2\nend\n", "parm v 0 2\n",
       ":25: expected parm or the end of the surface in line 21, found 'v'"},
      {"EndOfFileInSurface", "obj", "19 20 21 22\nparm u 0 1\nparm v 0 1\nend\n", "19 20 21 22\n",
       ":44: expected the end of the surface in line 44, found the end of the file"},
      {"MoreOnALine", "obj", "deg 3 2", "deg 3 2 1",
       ":20: expected the end of the line, found '1'"},
  };
}

std::vector<Fault> rib_faults() {
  const std::string bilinear = "[0 0 0  1 0 5  0 100 -3  1 100 2]"; // line 23
  return {
      {"Empty", "rib", "", "",
       ":1: expected a patch (Patch, PatchMesh or NuPatch), found the end of the file"},
      {"NoPatch", "rib", "", "WorldBegin\nWorldEnd\n",
       ":2: expected a patch (Patch, PatchMesh or NuPatch), found"},
      {"Sphere", "rib", "Translate 0 0 0", "Sphere 1 -1 1 360",
       ":12: expected a Patch, PatchMesh or NuPatch, found 'Sphere'"},
      {"NuPatch", "rib", "Translate 0 0 0", "NuPatch 3 4 [0 0 0 0 1 1 1 1] 0 1",
       ":12: expected 4 points or more of order 4 in u, found 3"},
      {"OtherFile", "rib", "Translate 0 0 0", "ReadArchive \"a.rib\"",
       ":12: expected a Patch, PatchMesh or NuPatch, found 'ReadArchive'"},
      {"OtherBasis", "rib", "Translate 0 0 0", "Basis \"bezier\" 3 \"beta\" 3",
       ":13: expected a patch in a basis of RIB or a matrix, found one in 'beta'"},
      {"OtherStep", "rib", "Translate 0 0 0", "Basis \"b-spline\" 2 \"b-spline\" 1",
       ":13: expected 4 points in u and 2 more a patch, found 7"},
      {"ShortMatrix", "rib", "[-1 3 -3 1 3 -6 3 0 -3 3 0 0 1 0 0 0]", "[-1 3 -3]",
       ":9: expected a finite number, found ']'"},
      {"LongMatrix", "rib", "[-1 3 -3 1 3 -6 3 0 -3 3 0 0 1 0 0 0]",
       "[-1 3 -3 1 3 -6 3 0 -3 3 0 0 1 0 0 0 0]",
       ":9: expected ']' after 16 numbers of a basis, found '0'"},
      {"StepZero", "rib", "\"b-spline\" 1", "\"b-spline\" 0",
       ":9: expected the step of a basis (1 to 2147483648), found '0'"},
      {"BasisMissing", "rib", "\"b-spline\" 1", "1", ":9: expected a basis, found '1'"},
      {"Biquadratic", "rib", "Patch \"bilinear\" \"Pw\"", "Patch \"biquadratic\" \"Pw\"",
       ":20: expected \"bicubic\" or \"bilinear\", found 'biquadratic'"},
      {"TypeMissing", "rib", "Patch \"bilinear\" \"Pw\"", "Patch \"Pw\"",
       ":20: expected \"bicubic\" or \"bilinear\", found 'Pw'"},
      {"MeshWrap", "rib", "7 \"nonperiodic\"", "7 \"closed\"",
       ":13: expected \"periodic\" or \"nonperiodic\", found 'closed'"},
      {"MeshCountZero", "rib", "\"bicubic\" 7", "\"bicubic\" 0",
       ":13: expected the number of points in u (2 to 2147483648), found '0'"},
      {"MeshCount", "rib", "\"bicubic\" 7", "\"bicubic\" 6",
       ":13: expected 4 points in u and 3 more a patch, found 6"},
      {"MeshCountPeriodic", "rib", "\"bicubic\" 7 \"nonperiodic\"", "\"bicubic\" 7 \"periodic\"",
       ":13: expected a multiple of 3 points in periodic u, found 7"},
      {"MeshCountHuge", "rib", "\"bicubic\" 7", "\"bicubic\" 18446744073709551615",
       ":13: expected the number of points in u (2 to 2147483648), found '18446744073709551615'"},
      {"MeshCountBeyondPoints", "rib", "4 \"nonperiodic\"", "2000000002 \"nonperiodic\"",
       ":19: expected 14000000014 points of 3 numbers, found ']' after 84 numbers"},
      {"NumberMissing", "rib", bilinear, "[0 0 0  1 0 5  0 100 -3  1 100]",
       ":23: expected 4 points of 3 numbers, found ']' after 11 numbers"},
      {"NumberTooMany", "rib", bilinear, "[0 0 0  1 0 5  0 100 -3  1 100 2 3]",
       ":23: expected ']' after 4 points of 3 numbers, found '3'"},
      {"NoArray", "rib", bilinear, "0 0 0", ":23: expected '[' and 4 points, found '0'"},
      {"EndInsidePoints", "rib", "", "Patch \"bilinear\" \"P\" [0 0 0\n1 2",
       ":2: expected 4 points of 3 numbers, found the end of the file after 5 numbers"},
      {"EndInsideAnotherArray", "rib", "", "Patch \"bilinear\" \"st\" [0 0 0\n1 2",
       ":2: expected ']' for the array in line 1, found the end of the file"},
      {"EndInsideAString", "rib", "", "Patch \"bilinear\" \"P",
       ":1: expected a closing quote, found the end of the file"},
      {"HeightField", "rib", "\"P\" " + bilinear, "\"Pz\" [0 0 0 0]",
       ":23: expected \"P\" or \"Pw\" of the patch, found 'Pz'"},
      {"PointsTwice", "rib", bilinear, bilinear + " \"P\" " + bilinear,
       ":23: expected one of \"P\" and \"Pw\", found 'P'"},
      {"CoordinateNan", "rib", bilinear, "[0 0 0  1 nan 5  0 100 -3  1 100 2]",
       ":23: expected a finite number, found 'nan'"},
      {"CoordinateString", "rib", bilinear, "[0 0 0  1 \"0\" 5  0 100 -3  1 100 2]",
       ":23: expected a finite number, found '0'"},
      {"WeightZero", "rib", "2 -2 2 2", "2 -2 2 0", ":20: expected a weight above 0, found '0'"},
      {"WeightInf", "rib", "2 -2 2 2", "2 -2 2 -inf",
       ":20: expected a finite number, found '-inf'"},
  };
}

class FaultTest : public ::testing::TestWithParam<Fault> {};

TEST_P(FaultTest, IsRefusedWithItsLine) {
  const Fault& fault = GetParam();
  const std::string text =
      fault.part.empty() ? fault.text
                         : replaced(read_file(sample_path(fault.format)), fault.part, fault.text);
  EXPECT_EQ(refusal(fault.format, text).substr(0, fault.message.size()), fault.message);
}

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto& faults : {bpt_faults(), bv_faults(), itd_faults(), obj_faults(), rib_faults()}) {
    all.insert(all.end(), faults.begin(), faults.end());
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, FaultTest, ::testing::ValuesIn(all_faults()), [](const auto& test) {
  return std::string(test.param.format) + test.param.name;
});

// One of each end to end: one line on stderr, nothing left behind.
TEST(FormatFaults, EndTheProgram) {
  for (const char* const format : {"bv", "iges", "itd", "obj", "rib"}) {
    const TemporaryFolder folder;
    const std::string in = folder.write(std::string("in.") + format, "\x7f[OBJECT 1 \"\n");
    expect_failure(run({"tessellate", in, "-o", folder.path("out.obj")}), 1,
                   "simdbezier: " + in + ":1: expected ");
    EXPECT_EQ(folder.names().size(), 1U);
  }
}

} // namespace
} // namespace simdbezier::tests::format_faults_test
