// Vertices with their own u, v in every patch, and with the positions and normals of the mesh whose
// patches share vertices.
#include <algorithm>
#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include <simdbezier/evaluate_mesh.hpp>
#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/evaluated_mesh.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
#include "tests/mesh/support/random_gluing.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::split_parameters_test {
namespace {

const double kCreases[] = {kUnlimited, 0, 30, 180};

/// Triangles by positions and normals of their corners, whichever numbers vertices have.
template <typename T>
using Faces = std::vector<std::array<std::array<T, 3>, 2>>;

template <typename T, typename Triangles>
Faces<T> faces_of(const Triangles& triangles, const std::vector<std::array<T, 3>>& positions,
                  const std::vector<std::array<T, 3>>& normals) {
  Faces<T> faces;
  for (const auto& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      faces.push_back(
          {positions.at(vertex), normals.empty() ? std::array<T, 3>{} : normals.at(vertex)});
    }
  }
  return faces;
}
template <typename T>
Faces<T> faces_of(const EvaluatedMesh<T>& mesh) {
  return faces_of(std::span(&mesh.triangles, 1), mesh.position, mesh.normal);
}
template <typename T>
Faces<T> faces_of(const Mesh<T>& mesh) {
  return faces_of(mesh.triangles, mesh.positions, mesh.normals);
}

/// Whether a side of a patch is a point: that along which u runs, or v, at 0 or 1 of the other.
bool is_point(const PatchPoints& patch, bool along_u, bool far) {
  const std::size_t end = far ? 3 : 0;
  const auto at = [&](std::size_t k) { return along_u ? patch[end][k] : patch[k][end]; };
  return at(1) == at(0) && at(2) == at(0) && at(3) == at(0);
}

/// Every triangle lies in one cell of its patch's unit square, and they turn the same way and fill
/// the square. A vertex at a side that is a point has the middle of it.
void expect_to_fill_the_square(const std::vector<std::array<std::array<double, 2>, 3>>& triangles,
                               const PatchPoints& patch, const std::array<double, 2>& cells,
                               bool turned) {
  constexpr double kRounding = 1e-4; // of a quotient of type float, times the number of cells
  double area = 0;
  std::size_t wrong = 0;
  bool points = false;
  for (const auto& at : triangles) {
    for (const std::size_t c : {0U, 1U}) {
      double low = 1;
      double high = 0;
      for (const auto& x : at) {
        const bool on_side = x[1 - c] == 0 || x[1 - c] == 1;
        if (on_side && is_point(patch, c == 0, x[1 - c] == 1)) {
          wrong += x[c] == 0.5 ? 0 : 1;
          points = true;
          continue;
        }
        low = std::min(low, x[c]);
        high = std::max(high, x[c]);
      }
      wrong += high * cells[c] > std::floor(low * cells[c] + kRounding) + 1 + kRounding ? 1 : 0;
    }
    const double twice = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                         (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
    wrong += (turned ? -twice : twice) > 0 ? 0 : 1;
    area += std::fabs(twice) / 2;
  }
  EXPECT_EQ(wrong, 0U);
  if (!points) {
    EXPECT_NEAR(area, 1, 1e-5);
  }
}

template <typename T>
void expect_own_parameters(const EvaluatedMesh<T>& mesh, const MeshModel& model) {
  std::size_t own = 0;
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    SCOPED_TRACE(p);
    std::vector<std::array<std::array<double, 2>, 3>> triangles;
    for (std::size_t k = 3 * mesh.layout.first_triangle(p);
         k < 3 * mesh.layout.first_triangle(p + 1); ++k) {
      const auto& [u, v] = mesh.parameters[mesh.triangles[k]];
      triangles.resize(triangles.size() + (k % 3 == 0 ? 1 : 0));
      triangles.back()[k % 3] = {static_cast<double>(u), static_cast<double>(v)};
    }
    expect_to_fill_the_square(triangles, model.patches[p],
                              {static_cast<double>(mesh.nu[p]), static_cast<double>(mesh.nv[p])},
                              mesh.topology.is_turned(p));
    for (const std::uint32_t vertex : mesh.vertices_of(p)) {
      const auto& [u, v] = mesh.parameters[vertex];
      const auto& x = mesh.position[vertex];
      const Point exact = surface(model.patches[p], static_cast<double>(u), static_cast<double>(v));
      EXPECT_EQ(mesh.patch[vertex], p);
      EXPECT_LT(length(exact - Point{x[0], x[1], x[2]}), 1e-4);
      ++own;
    }
  }
  EXPECT_EQ(own, mesh.position.size()) << "no vertex is of two patches, or of none";
}

template <typename T>
class SplitParameters : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SplitParameters, Scalars);

TYPED_TEST(SplitParameters, are_each_patchs_own_on_the_same_mesh) {
  using T = TypeParam;
  for (const MeshModel& model : mesh_models()) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      const MeshModel turned = seed == 0 ? model : shuffled(model, seed);
      TopologyOptions how;
      how.orient = seed == 2 && model.orientable;
      how.flip = seed == 1;
      EvaluatedMesh<T> mesh(turned, seed == 0 ? 1 : 7, seed, how);
      const MeshLayout whole = mesh.layout;
      for (const double crease : kCreases) {
        SCOPED_TRACE(turned.name + ", crease " + std::to_string(crease));
        MeshLayout merged = whole;
        if (crease != kUnlimited) {
          ASSERT_EQ(split_creases(mesh.set, whole, crease, merged), Status::ok);
        }
        mesh.layout = merged;
        mesh.evaluate_all();
        const Faces<T> faces = faces_of(mesh);
        ASSERT_EQ(split_parameters(merged, mesh.layout), Status::ok);
        for (const Isa isa : available_isas()) {
          mesh.evaluate_all({.threads = 1 + static_cast<int>(seed), .isa = isa});
          expect_own_parameters(mesh, turned);
        }
        mesh.evaluate_all();
        EXPECT_TRUE(faces_of(mesh) == faces);
        // Again, or before creases, nothing changes.
        MeshLayout again;
        ASSERT_EQ(split_parameters(mesh.layout, again), Status::ok);
        EXPECT_EQ(again.size().vertices, mesh.layout.size().vertices);
        if (crease != kUnlimited) {
          ASSERT_EQ(split_parameters(whole, again), Status::ok);
          ASSERT_EQ(split_creases(mesh.set, again, crease, again), Status::ok);
          const auto positions = mesh.position;
          const auto normals = mesh.normal;
          mesh.layout = again;
          mesh.evaluate_all();
          EXPECT_EQ(mesh.position, positions);
          EXPECT_EQ(mesh.normal, normals);
        }
      }
    }
  }
}

/// The triangles that have three corners in three places.
template <typename T>
Faces<T> faces_with_area(const EvaluatedMesh<T>& mesh) {
  const Faces<T> all = faces_of(mesh);
  Faces<T> faces;
  for (std::size_t k = 0; k < all.size(); k += 3) {
    if (all[k][0] != all[k + 1][0] && all[k + 1][0] != all[k + 2][0] &&
        all[k][0] != all[k + 2][0]) {
      faces.insert(faces.end(), {all[k], all[k + 1], all[k + 2]});
    }
  }
  return faces;
}

/// Also where a patch is joined with itself in any way.
TYPED_TEST(SplitParameters, leave_triangles_of_random_gluings_as_they_are) {
  using T = TypeParam;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const RandomGluing gluing(seed);
    MeshModel model{"gluing", std::vector<PatchPoints>(gluing.patches)};
    for (std::size_t k = 0; k < gluing.values.size(); ++k) {
      model.patches[k / 48][k / 12 % 4][k / 3 % 4][k % 3] = gluing.values[k];
    }
    EvaluatedMesh<T> mesh(model, 4, seed);
    mesh.evaluate_all();
    const Faces<T> faces = faces_of(mesh);
    ASSERT_EQ(split_parameters(mesh.layout, mesh.layout), Status::ok);
    mesh.evaluate_all();
    EXPECT_TRUE(faces_with_area(mesh) == faces);
    EXPECT_TRUE(gluing.folded || mesh.triangles.size() == faces.size());
    if (!gluing.has_points && !gluing.folded) {
      expect_own_parameters(mesh, model);
    }
  }
}

/// Parts of a mesh, formats, and further components, which are each patch's own as well.
TYPED_TEST(SplitParameters, come_by_every_call) {
  using T = TypeParam;
  for (const MeshModel& model : mesh_models()) {
    SCOPED_TRACE(model.name);
    EvaluatedMesh<T> mesh(shuffled(model, 5), 6, 3);
    ASSERT_EQ(split_parameters(mesh.layout, mesh.layout), Status::ok);
    mesh.evaluate_all();
    const std::size_t n = mesh.position.size();
    std::vector<std::array<T, 3>> alone(n);
    std::vector<float> formatted(8 * n);
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      const std::size_t first = mesh.layout.first_vertex(p);
      MeshOutputs<T> out;
      out.position = Vectors<T>::xyz(std::span(alone).subspan(first));
      FormattedOutputs records;
      const auto column = [&](std::size_t at) {
        auto* const to = reinterpret_cast<unsigned char*>(formatted.data() + 8 * first + at);
        return FormattedOutput{to, 32, VertexFormat::float32};
      };
      records.position = column(0);
      records.normal = column(3);
      records.parameters = column(6);
      if (first < mesh.layout.first_vertex(p + 1)) {
        ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out, {}, {p, 1}), Status::ok);
        ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, records, {}, {p, 1}), Status::ok);
      }
    }
    EXPECT_EQ(alone, mesh.position);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t c = 0; c < 8; ++c) {
        const T expected = c < 3   ? mesh.position[k][c]
                           : c < 6 ? mesh.normal[k][c - 3]
                                   : mesh.parameters[k][c - 6];
        ASSERT_EQ(formatted[8 * k + c], static_cast<float>(expected)) << k << ", " << c;
      }
    }
    // A patch's number, as a component of its own.
    std::vector<double> values;
    for (std::size_t k = 0; k < mesh.values.size(); ++k) {
      values.push_back(mesh.values[k]);
      if (k % 3 == 2) {
        values.push_back(static_cast<double>(k / 48));
      }
    }
    PatchSet<T> numbered;
    ASSERT_TRUE(
        pack(ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3, 4), numbered));
    std::vector<T> numbers(n);
    ASSERT_EQ(
        evaluate_mesh_attributes(numbered, mesh.layout, Vectors<T>::plane(std::span(numbers)), 3),
        Status::ok);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(numbers[k], mesh.patch[k], 1e-4);
    }
  }
}

struct Request {
  const char* name;
  void (*change)(MeshOptions&);
};
const Request kRequests[] = {
    {"tolerance", [](MeshOptions& o) { o.rates.tolerance = 0.05; }},
    {"grid", [](MeshOptions& o) { o.nu = 4, o.nv = 3; }},
    {"crease", [](MeshOptions& o) { o.rates.tolerance = 0.05, o.crease_degrees = kCreases[2]; }},
    {"apart", [](MeshOptions& o) { o.nu = o.nv = 3, o.crease_degrees = 0; }},
    {"no normals", [](MeshOptions& o) { o.nu = 2, o.nv = 5, o.normals = false; }},
    {"flipped", [](MeshOptions& o) { o.nu = o.nv = 3, o.topology.flip = true; }},
    {"once each", [](MeshOptions& o) { o.nu = o.nv = 3, o.drop_repeated = true; }}};

TYPED_TEST(SplitParameters, of_tessellate_are_those_of_the_same_mesh) {
  using T = TypeParam;
  for (const MeshModel& model : mesh_models()) {
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
    for (const Request& request : kRequests) {
      SCOPED_TRACE(model.name + ", " + request.name);
      MeshOptions options;
      request.change(options);
      const Mesh<T> whole = tessellate<T>(nets, options);
      options.parameters = true;
      const Mesh<T> mesh = tessellate<T>(nets, options);
      ASSERT_TRUE(whole && mesh);
      EXPECT_TRUE(faces_of(mesh) == faces_of(whole));
      EXPECT_EQ(mesh.deviation, whole.deviation);
      EXPECT_EQ(mesh.deviations, whole.deviations);
      EXPECT_EQ(mesh.counts.open_edges, whole.counts.open_edges);
      for (const auto& triangle : mesh.triangles) {
        const std::uint32_t p = mesh.patches[triangle[0]];
        for (const std::uint32_t vertex : triangle) {
          const auto& [u, v] = mesh.parameters[vertex];
          const auto& x = mesh.positions[vertex];
          const Point exact =
              surface(model.patches[p], static_cast<double>(u), static_cast<double>(v));
          EXPECT_EQ(mesh.patches[vertex], p);
          EXPECT_LT(length(exact - Point{x[0], x[1], x[2]}), 1e-4);
        }
      }
    }
  }
}

/// A patch two sides of which, those that meet in a corner, are one point.
PatchPoints with_two_points(std::size_t corner) {
  PatchPoints patch;
  for (std::size_t k = 0; k < 16; ++k) {
    const auto a = static_cast<double>(corner % 2 == 0 ? k % 4 : 3 - k % 4);
    const auto b = static_cast<double>(corner < 2 ? k / 4 : 3 - k / 4);
    const bool pole = a == 0 || b == 0;
    patch[k / 4][k % 4] = {pole ? 0 : a, pole ? 0 : b, pole ? 0 : a * b / 4};
  }
  return patch;
}

TYPED_TEST(SplitParameters, are_of_the_point_that_two_sides_of_a_patch_are) {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    MeshModel model;
    model.patches = {with_two_points(corner)};
    const std::vector<double> values = model.values();
    for (const Request& request : kRequests) {
      SCOPED_TRACE(std::string(request.name) + ", corner " + std::to_string(corner));
      MeshOptions options;
      request.change(options);
      options.parameters = true;
      const auto mesh =
          tessellate<TypeParam>(ControlNets<double>::packed(values.data(), 1, 3, 3), options);
      ASSERT_TRUE(mesh);
      for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const auto& [u, v] = mesh.parameters[k];
        const auto& x = mesh.positions[k];
        const Point exact =
            surface(model.patches[0], static_cast<double>(u), static_cast<double>(v));
        EXPECT_LT(length(exact - Point{x[0], x[1], x[2]}), 1e-4) << "vertex " << k;
      }
    }
  }
}

TEST(SplitParametersOfNothing, are_none) {
  MeshLayout split;
  EXPECT_EQ(split_parameters(MeshLayout(), split), Status::ok);
  EXPECT_EQ(split.size().vertices, 0U);
}

} // namespace
} // namespace simdbezier::tests::split_parameters_test
