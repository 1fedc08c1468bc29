// How far meshes are from their surfaces: what files state, and what is asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <tools/mesh_files/mesh_file.hpp>

#include "tests/program/formats/sample_nets.hpp"
#include "tests/program/mesh_files/readers/read_meshes.hpp"

namespace simdbezier::tests::mesh_deviation_test {
namespace {

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The distance from a point to a triangle: Ericson's regions would be faster, but this is shorter.
double distance(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point n = cross(b - a, c - a);
  const double area = std::sqrt(dot(n, n));
  const auto inside = [&](const Point& from, const Point& to) {
    return dot(cross(to - from, p - from), n) >= 0;
  };
  if (area > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
    return std::abs(dot(p - a, n)) / area;
  }
  double least = HUGE_VAL;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Point side = to - from;
    const double length = dot(side, side);
    const double t = length > 0 ? std::clamp(dot(p - from, side) / length, 0.0, 1.0) : 0;
    const Point apart =
        p - Point{from[0] + t * side[0], from[1] + t * side[1], from[2] + t * side[2]};
    least = std::min(least, std::sqrt(dot(apart, apart)));
  }
  return least;
}

TEST(MeshDeviation, KeepsTheDeviationThatItStates) {
  const Outcome samples =
      run({"evaluate", "builtin:teapot", "--grid", "8", "--precision", "f64", "-o", "-"});
  const std::vector<std::vector<double>> rows = [&] {
    std::vector<std::vector<double>> all;
    std::istringstream lines(samples.out);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::vector<double>& row = all.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) {
        row.push_back(std::strtod(field.c_str(), nullptr));
      }
    }
    return all;
  }();
  ASSERT_EQ(rows.size(), 32U * 64);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--tolerance", "0.05"}, {"--grid", "4"}}) {
    const ReadMesh mesh = welded("builtin:teapot", options);
    if (options[0] == "--tolerance") {
      EXPECT_LE(*mesh.deviation, 0.05);
    }
    double farthest = 0;
    for (const std::vector<double>& row : rows) {
      double least = HUGE_VAL;
      for (const auto& face : mesh.faces) {
        least = std::min(least, distance({row[3], row[4], row[5]}, mesh.positions[face[0]],
                                         mesh.positions[face[1]], mesh.positions[face[2]]));
      }
      farthest = std::max(farthest, least);
    }
    EXPECT_LE(farthest, *mesh.deviation);
    EXPECT_GT(farthest, *mesh.deviation / 5) << "a bound without meaning";
  }
}

TEST(MeshDeviation, IsFinerWhereMoreIsAsked) {
  std::size_t faces = 0;
  for (const char* const tolerance : {"1", "0.1", "0.01", "0.001"}) {
    const ReadMesh mesh = welded("builtin:teapot", {"--tolerance", tolerance});
    EXPECT_LE(*mesh.deviation, std::strtod(tolerance, nullptr));
    EXPECT_GT(mesh.faces.size(), faces);
    faces = mesh.faces.size();
  }
}

// Readers multiply by the extent and add the corner in floats, whichever way they normalise.
TEST(MeshDeviation, OfQuantisedPositionsIncludesWhatReadersRound) {
  const struct {
    double low;
    double extent;
  } kBoxes[] = {{0, 1},      {1000.1, 10},  {-1.1, 2.4},     {-1.0270445908326944, 2.1527334588487},
                {-7, 0.001}, {0.1, 1e-300}, {-1e30, 2.1e30}, {-3.3e-40, 1e-39}};
  for (const auto& [low, extent] : kBoxes) {
    tools::MeshContents contents;
    contents.storage = tools::VertexStorage::quantised_16;
    contents.box = {{low, low, low}, {low + extent, low + extent, low + extent}};
    contents.deviation = 0;
    const double width = (low + extent) - low;
    double worst = 0;
    for (int q = 0; q <= 65535; ++q) {
      const double exact = low + width * (q / 65535.0);
      for (const float t : {static_cast<float>(q) / 65535.0F,
                            static_cast<float>(q) * static_cast<float>(1 / 65535.0)}) {
        const float scaled = static_cast<float>(width) * t;
        const float read = static_cast<float>(low) + scaled;
        worst = std::max(worst, std::abs(static_cast<double>(read) - exact));
      }
    }
    const double half_step = width / 65535 / 2;
    EXPECT_GE(tools::stated_deviation<float>(tools::MeshFormat::glb, contents),
              std::sqrt(3.0) * (half_step + worst))
        << low << " " << extent;
  }
}

TEST(MeshDeviation, RelativeTolerancesAreSharesOfTheDiagonal) {
  const std::string diagonal = number_text(std::sqrt(6.525 * 6.525 + 16 + 3.15 * 3.15) / 1024);
  EXPECT_TRUE(tessellated("builtin:teapot", "ply", {"--relative", "0.0009765625"}) ==
              tessellated("builtin:teapot", "ply", {"--tolerance", diagonal}));
}

TEST(MeshDeviation, CamerasWantMoreWhereTheyAreNear) {
  const auto faces = [](const std::string& camera, const std::vector<std::string>& more = {}) {
    std::vector<std::string> options = {"--pixels", "0.5", "--camera", camera};
    options.insert(options.end(), more.begin(), more.end());
    return welded("builtin:teapot", options).faces.size();
  };
  const std::size_t near = faces("8,0,2,0,0,1.5");
  EXPECT_GT(near, faces("80,0,2,0,0,1.5"));
  EXPECT_GT(near, faces("8,0,2,0,0,1.5", {"--view-angle", "90"}));
  EXPECT_LT(near, faces("8,0,2,0,0,1.5", {"--picture", "3840x2160"}));
  EXPECT_EQ(near, faces("8,0,2,-8,0,1", {"--view-angle", "45", "--picture", "1920x1080"}));
}

} // namespace
} // namespace simdbezier::tests::mesh_deviation_test
