// OBJ surfaces of every cstype against the specification's own formulas: sums of basis functions of
// the surface's own parameters, in long double. And what trimming curves leave of surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include <tools/patches/move_patches.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::obj_bases_test {
namespace {

using Real = long double;
using Numbers = std::vector<double>;

/// One direction: its parameters, and where its patches begin and end.
struct Direction {
  int degree;
  Numbers parameters;
  double first, last;
  int step = 0; ///< of bmatrix
  Numbers matrix = {};
};
struct Case {
  const char* name;
  const char* type;
  Direction u, v;
};
void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }

// B-splines by Cox and de Boor.
Real bspline(const Numbers& t, std::size_t i, int degree, Real x) {
  if (degree == 0) {
    const bool is_last = x == t.back() && t[i] < t[i + 1] && t[i + 1] == t.back();
    return (t[i] <= x && x < t[i + 1]) || is_last ? 1 : 0;
  }
  const auto p = static_cast<std::size_t>(degree);
  const Real left = Real(t[i + p]) - t[i];
  const Real right = Real(t[i + p + 1]) - t[i + 1];
  return (left == 0 ? 0 : (x - t[i]) / left * bspline(t, i, degree - 1, x)) +
         (right == 0 ? 0 : (t[i + p + 1] - x) / right * bspline(t, i + 1, degree - 1, x));
}

Real binomial(int n, int k) {
  Real value = 1;
  for (int j = 1; j <= k; ++j) {
    value = value * Real(n - k + j) / Real(j);
  }
  return value;
}

/// The value of basis function k of a piece at t, 0 to 1.
Real piece(const std::string& type, const Direction& d, int k, Real t) {
  if (type == "bezier") {
    return binomial(d.degree, k) * std::pow(t, Real(k)) * std::pow(1 - t, Real(d.degree - k));
  }
  if (type == "taylor") {
    return std::pow(t, Real(k));
  }
  if (type == "cardinal") { // Hermite's with tangents (p2 - p0) / 2 and (p3 - p1) / 2
    const Real h00 = (1 + 2 * t) * (1 - t) * (1 - t);
    const Real h10 = t * (1 - t) * (1 - t);
    const Real h01 = t * t * (3 - 2 * t);
    const Real h11 = t * t * (t - 1);
    const Real values[] = {-h10 / 2, h00 - h11 / 2, h01 + h10 / 2, h11 / 2};
    return values[k];
  }
  Real value = 0;
  for (int j = 0; j <= d.degree; ++j) {
    value += d.matrix[static_cast<std::size_t>(k * (d.degree + 1) + j)] * std::pow(t, Real(j));
  }
  return value;
}

int step_of(const std::string& type, const Direction& d) {
  return type == "bezier"     ? d.degree
         : type == "taylor"   ? d.degree + 1
         : type == "cardinal" ? 1
                              : d.step;
}

std::size_t points_of(const std::string& type, const Direction& d) {
  const auto order = static_cast<std::size_t>(d.degree) + 1;
  return type == "bspline"
             ? d.parameters.size() - order
             : (d.parameters.size() - 2) * static_cast<std::size_t>(step_of(type, d)) + order;
}

/// The factors of all values at x, in the piece that has `inside`.
std::vector<Real> factors(const std::string& type, const Direction& d, Real x, Real inside) {
  std::vector<Real> all(points_of(type, d));
  const Numbers& t = d.parameters;
  if (type == "bspline") {
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = bspline(t, i, d.degree, x);
    }
    return all;
  }
  std::size_t at = 0;
  while (at + 2 < t.size() && inside > t[at + 1]) {
    ++at;
  }
  for (int k = 0; k <= d.degree; ++k) {
    all[at * static_cast<std::size_t>(step_of(type, d)) + static_cast<std::size_t>(k)] =
        piece(type, d, k, (x - t[at]) / (Real(t[at + 1]) - t[at]));
  }
  return all;
}

/// Where patches begin and end.
Numbers breaks(const Direction& d) {
  Numbers all = {d.first};
  for (const double t : d.parameters) {
    if (t > all.back() && t < d.last) {
      all.push_back(t);
    }
  }
  all.push_back(d.last);
  return all;
}

std::vector<Case> cases() {
  const Numbers clamped = {0, 0, 0, 0, 1, 1.5, 1.5, 4, 4, 4, 4};
  const Numbers loose = {-1, 0, 0.25, 1, 2, 2.5, 4};
  const Numbers bezier = {1, -3, 3, -1, 0, 3, -6, 3, 0, 0, 3, -3, 0, 0, 0, 1};
  const Numbers quadratic = {0.5, -1, 0.5, 0.5, 1, -1, 0, 0, 0.5}; // a uniform B-spline
  return {
      {"BSpline", "bspline", {3, clamped, 0, 4}, {2, loose, 0.25, 2}},
      {"PartOfABSpline", "bspline", {3, clamped, 0.5, 2}, {2, loose, 0.5, 1.5}},
      {"LinearBSpline",
       "bspline",
       {1, {0, 0, 1, 2, 2}, 0, 2},
       {4, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, 0, 1}},
      {"Bezier", "bezier", {2, {0, 1, 3}, 0, 3}, {3, {-1, 1}, -1, 1}},
      {"PartOfABezier", "bezier", {2, {0, 1, 3}, 0.5, 2}, {3, {-1, 1}, -1, 0.25}},
      {"Cardinal", "cardinal", {3, {0, 1, 3}, 0, 3}, {3, {0, 1, 2, 5}, 0, 5}},
      {"Taylor", "taylor", {2, {0, 2, 3}, 0, 3}, {4, {1, 2}, 1, 2}},
      {"BezierMatrix", "bmatrix", {3, {0, 1, 3}, 0, 3, 3, bezier}, {3, {0, 1}, 0, 1, 3, bezier}},
      {"OtherMatrix",
       "bmatrix",
       {2, {0, 1, 2, 4}, 0, 4, 1, quadratic},
       {3, {0, 1, 2}, 0, 2, 4, bezier}},
  };
}

std::string listed(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) {
    text += " " + std::to_string(number);
  }
  return text + "\n";
}

/// A surface with these values x y z w, which come first in the file.
std::string surface_text(const Case& item, bool rational, std::size_t count) {
  std::string text = "cstype " + std::string(rational ? "rat " : "") + item.type + "\ndeg " +
                     std::to_string(item.u.degree) + " " + std::to_string(item.v.degree) + "\n";
  if (item.u.step > 0) {
    text += "bmat u" + listed(item.u.matrix) + "bmat v" + listed(item.v.matrix) + "step " +
            std::to_string(item.u.step) + " " + std::to_string(item.v.step) + "\n";
  }
  text += "surf" + listed({item.u.first, item.u.last, item.v.first, item.v.last});
  text.back() = ' ';
  for (std::size_t k = 0; k < count; ++k) { // by turns from the beginning and from the end
    text += (k % 2 == 0 ? std::to_string(k + 1)
                        : std::to_string(static_cast<long>(k) - static_cast<long>(count))) +
            " \\\n";
  }
  return text + "\nparm u" + listed(item.u.parameters) + "parm v" + listed(item.v.parameters) +
         "end\n";
}

std::string vertices_text(const std::vector<WeightedPoint>& values) {
  std::string text;
  for (const WeightedPoint& p : values) {
    text += "v" + listed({p.x, p.y, p.z, p.w});
  }
  return text;
}

/// Values with few digits, so that their decimals are exact.
std::vector<WeightedPoint> random_values(std::size_t count) {
  std::mt19937 random(7);
  const auto next = [&] { return static_cast<double>(random() % 512) / 64 - 4; };
  std::vector<WeightedPoint> values;
  for (std::size_t k = 0; k < count; ++k) {
    values.push_back({next(), next(), next(), 1 + static_cast<double>(random() % 64) / 64});
  }
  return values;
}

class ObjBasisTest : public ::testing::TestWithParam<std::tuple<Case, bool>> {};

/// Sums of the values with the factors in both directions, divided by the weight.
WeightedPoint sum_of(const std::vector<WeightedPoint>& values, const std::vector<Real>& u,
                     const std::vector<Real>& v, bool rational) {
  Real sum[4] = {};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Real w = rational ? values[k].w : 1;
    const Real factor = u[k % u.size()] * v[k / u.size()] * w;
    sum[0] += factor * values[k].x;
    sum[1] += factor * values[k].y;
    sum[2] += factor * values[k].z;
    sum[3] += factor;
  }
  const Real w = rational ? sum[3] : 1;
  return {static_cast<double>(sum[0] / w), static_cast<double>(sum[1] / w),
          static_cast<double>(sum[2] / w), static_cast<double>(w)};
}

TEST_P(ObjBasisTest, IsTheSpecificationsSum) {
  const auto& [item, rational] = GetParam();
  const std::string type = item.type;
  const std::size_t count = points_of(type, item.u) * points_of(type, item.v);
  std::vector<WeightedPoint> values = random_values(count);
  if (rational && type == "taylor") { // a weight of 1 plus little
    for (std::size_t k = 0; k < count; ++k) {
      values[k].w = k % 3 == 0 && k / points_of(type, item.u) == 0 ? 16 : 0.125;
    }
  }
  // A surface with vertices of its own stands behind it: they keep their numbers.
  const std::string text = vertices_text(values) + surface_text(item, rational, count) +
                           "v 7 8 9\nv 1 0 0\nv 0 1 0\nv 1 1 0\ncstype bezier\ndeg 1 1\n"
                           "surf 0 1 0 1 -4 -3 -2 -1\nparm u 0 1\nparm v 0 1\nend\n";
  const tools::PatchFile file = read_text("obj", text);
  const Numbers u = breaks(item.u);
  const Numbers v = breaks(item.v);
  ASSERT_EQ(file.count, (u.size() - 1) * (v.size() - 1) + 1);
  EXPECT_EQ(patch_points(file, file.count - 1)[0], (WeightedPoint{7, 8, 9, 1}));
  const Direction bernstein_u = {item.u.degree, {0, 1}, 0, 1};
  const Direction bernstein_v = {item.v.degree, {0, 1}, 0, 1};
  for (std::size_t patch = 0; patch + 1 < file.count; ++patch) {
    const std::size_t iu = patch % (u.size() - 1);
    const std::size_t iv = patch / (u.size() - 1);
    const std::vector<WeightedPoint> points = patch_points(file, patch);
    for (const double s : {0.0625, 0.5, 0.75}) {
      for (const double t : {0.125, 0.5, 0.9375}) {
        const Real x = u[iu] + (Real(u[iu + 1]) - u[iu]) * s;
        const Real y = v[iv] + (Real(v[iv + 1]) - v[iv]) * t;
        const WeightedPoint expected =
            sum_of(values, factors(type, item.u, x, x), factors(type, item.v, y, y), rational);
        const WeightedPoint found = sum_of(points, factors("bezier", bernstein_u, s, s),
                                           factors("bezier", bernstein_v, t, t), rational);
        EXPECT_NEAR(found.x, expected.x, 1e-13);
        EXPECT_NEAR(found.y, expected.y, 1e-13);
        EXPECT_NEAR(found.z, expected.z, 1e-13);
        EXPECT_NEAR(found.w, expected.w, 1e-13 * 16);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ObjBasisTest,
                         ::testing::Combine(::testing::ValuesIn(cases()), ::testing::Bool()),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) ? "Rational" : "");
                         });

// Vertices have four values each, and those of patches that come from splines have three.
TEST(ObjBases, MoveWithSurfacesThatNameTheirPoints) {
  const std::string range = "parm u 0 0 1 1\nparm v 0 0 1 1\nend\n";
  tools::PatchFile file = read_text(
      "obj", "v 1 1 1\nv 2 1 1\nv 1 2 1\nv 2 2 1\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n" +
                 range + "cstype bezier\nsurf 0 1 0 1 4 3 2 1\nparm u 0 1\nparm v 0 1\nend\n" +
                 "cstype rat bspline\nsurf 0 1 0 1 1 2 3 4\n" + range);
  tools::move_patches(file, {1, 0, 0});
  ASSERT_EQ(file.count, 3U);
  for (std::size_t patch = 0; patch < 3; ++patch) {
    const std::vector<WeightedPoint> points = patch_points(file, patch);
    EXPECT_EQ(points[patch == 1 ? 3 : 0], (WeightedPoint{0, 1, 1, 1}));
    EXPECT_EQ(points[patch == 1 ? 0 : 3], (WeightedPoint{1, 2, 1, 1}));
  }
}

// A bilinear B-spline over [0,2] x [0,1] and the statements that trim it.
struct Trim {
  const char* name;
  std::string curves; ///< before the surface, with vp 1 to 5: the corners, and (1, 0.5)
  std::string body;
  double last_x; ///< of its last corner where it is taken; 0: refused without --ignore-trims
};
void PrintTo(const Trim& trim, std::ostream* out) { *out << trim.name; }

std::vector<Trim> trims() {
  const std::string around = "cstype bspline\ndeg 1\ncurv2 1 2 3 4 1\nparm u 0 0 1 2 3 4 4\nend\n";
  const std::string halves = "cstype bezier\ndeg 1\ncurv2 1 2 3\nparm u 0 1 2\nend\n"
                             "curv2 3 4 -5\nparm u 0 1 5\nend\n";
  const std::string half = "vp 1 0\nvp 1 1\ndeg 1\ncstype bezier\ncurv2 1 -2 -1 4 1\n"
                           "parm u 0 1 2 3 4\nend\n";
  const std::string cubic = "cstype bezier\ndeg 4\ncurv2 1 2 3 4 1\nparm u 0 1\nend\n";
  return {
      {"Around", around, "trim 0 4 1\n", 2},
      {"InTwoParts", halves, "trim 0 2 1 0 5 -1\n", 2},
      {"TheOtherWay", "cstype bezier\ndeg 1\ncurv2 4 3 2 1 4\nparm u 0 1 2 3 4\nend\n",
       "trim 0 4 1\n", 2},
      {"Half", half, "trim 0 4 1\n", 1},
      {"PartOfACurve", around, "trim 0 3 1\n", 0},
      {"Curved", cubic, "trim 0 1 1\n", 0},
      {"Inside", "deg 1\ncstype bezier\ncurv2 1 2 5 1\nparm u 0 1 2 3\nend\n", "trim 0 3 1\n", 0},
      {"Hole", around, "hole 0 4 1\n", 0},
      {"WithAHole", around, "trim 0 4 1\nhole 0 4 1\n", 0},
      {"Twice", around, "trim 0 4 1\ntrim 0 4 1\n", 0},
      {"SpecialCurves", around, "scrv 0 4 1\nsp 1 2\n", 2},
  };
}

std::string trimmed_text(const Trim& trim) {
  return "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 2 1 0\nvp 0 0\nvp 2 0\nvp 2 1 1\nvp 0 1\nvp 1 .5\n" +
         trim.curves + "cstype bspline\ndeg 1 1\nstech curv 0.5 10\nsurf 0 2 0 1 1 2 3 4\n" +
         "parm u 0 0 2 2\n" + trim.body + "parm v 0 0 1 1\nend\n";
}

class ObjTrimTest : public ::testing::TestWithParam<Trim> {};

TEST_P(ObjTrimTest, LeavesARectangleOrIsRefused) {
  const Trim& trim = GetParam();
  const std::string text = trimmed_text(trim);
  if (trim.last_x == 0) {
    EXPECT_NE(refusal("obj", text)
                  .find(": expected a surface without trimming curves (--ignore-trims reads all of "
                        "it), found '" +
                        trim.body.substr(0, 4) + "'"),
              std::string::npos)
        << refusal("obj", text);
  }
  const TemporaryFolder folder;
  const tools::PatchFile file = tools::read_patches(
      folder.write("in.obj", text), tools::PatchFormat::by_name, {trim.last_x == 0});
  ASSERT_EQ(file.count, 1U);
  EXPECT_EQ(file.ignored_trims, trim.last_x == 0 ? 1U : 0U);
  EXPECT_EQ(patch_points(file, 0)[3], (WeightedPoint{trim.last_x == 0 ? 2 : trim.last_x, 1, 0, 1}));
}

INSTANTIATE_TEST_SUITE_P(All, ObjTrimTest, ::testing::ValuesIn(trims()),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace simdbezier::tests::obj_bases_test
