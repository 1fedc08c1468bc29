// Numbers of vertices in OBJ files, in all of their forms and in forms that are none.
#include <gtest/gtest.h>

#include <string>

#include <tools/formats/obj/statements.hpp>

#include "tests/program/formats/format_files.hpp"

namespace simdbezier::tests::obj_statements_test {
namespace {

std::string with_reference(const std::string& reference) {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 " +
         reference + " 4\nparm u 0 1\nparm v 0 1\nend\n";
}

TEST(ObjReference, HasFourForms) {
  for (const char* const word : {"3", "+3", "-2", "3/7", "3/-7", "3//5", "3//-5", "3/7/5",
                                 "-2/-1/-1", "003", "3/999999999999/1"}) {
    EXPECT_EQ(refusal("obj", with_reference(word)), "") << word;
    EXPECT_EQ(patch_points(read_text("obj", with_reference(word)), 0).at(2),
              (WeightedPoint{0, 1, 0, 1}))
        << word;
  }
}

TEST(ObjReference, HasNoOther) {
  for (const char* const word :
       {"3/",    "3//",     "3///",  "3////", "3/1/", "3/1/1/", "3/1/1/1", "3/x", "3/1/x",
        "3/x/1", "3/x/y/z", "3//x",  "3/0",   "3//0", "3/1/0",  "3/1.5",   "/3",  "//3",
        "-+3",   "+-3",     "--2",   "++3",   "-",    "+",      "/",       "3.0", "3e0",
        "0x3",   "3/+-1",   "3/-+1", "0",     "-0",   "5",      "-5",      "nan"}) {
    const std::string expected =
        ":7: expected the number of a vertex, 1 to 4 or -1 to -4, found '" + std::string(word) +
        "'";
    EXPECT_EQ(refusal("obj", with_reference(word)), expected);
  }
}

// Coordinates are multiplied by Cartesian weights and divided by homogeneous ones.
TEST(Weights, WhoseProductsOverflowAreRefused) {
  const std::string obj =
      "v 0 0 0\nv 1e200 0 0 1e200\nv 0 1 0\nv 1 1 0\ncstype rat bezier\ndeg 1 1\n"
      "surf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n";
  EXPECT_EQ(refusal("obj", obj),
            ":2: expected coordinates that are finite when multiplied by their "
            "weight, found 1e+200 * 1e+200");
  EXPECT_EQ(refusal("obj", replaced(obj, "rat bezier", "bezier")), "")
      << "its weight does not count";
}

TEST(Weights, WhoseQuotientsOverflowAreRefused) {
  const std::string expected =
      " expected coordinates that are finite when divided by their weight, "
      "found -1e+200 / 1e-200";
  const std::string rest = "\n0 0 0 1\n0 1 0 1\n1 1 0 1\n";
  EXPECT_EQ(refusal("bv", "8 1 1\n0 -1e200 0 1e-200" + rest), ":2:" + expected);
  EXPECT_EQ(refusal("itd", "[OBJECT A [SURFACE BEZIER 2 2 P3 [1 0 0 0]\n[1e-200 0 0 -1e200]\n"
                           "[1 0 0 0] [1 1 1 1]]]"),
            ":2:" + expected);
  EXPECT_EQ(refusal("rib", "Patch \"bilinear\" \"Pw\" [\n-1e200 0 0 1e-200" + rest + "]"),
            ":2:" + expected);
}

} // namespace
} // namespace simdbezier::tests::obj_statements_test
