// Vertices have the same bits whatever the call: threads, instruction sets, layouts, destinations,
// parts of a mesh. And calls refuse what they cannot do.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/mesh/support/evaluated_mesh.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::vertex_outputs_test {
namespace {

MeshModel model_named(const std::string& name) {
  for (MeshModel& model : mesh_models()) {
    if (model.name == name) {
      return model;
    }
  }
  ADD_FAILURE() << "no model " << name;
  return {};
}

/// Every value of a mesh, side by side.
template <typename T>
using Bits = std::vector<T>;

template <typename T>
Bits<T> bits_of(const EvaluatedMesh<T>& mesh) {
  Bits<T> bits;
  for (std::size_t k = 0; k < mesh.position.size(); ++k) {
    bits.insert(bits.end(), mesh.position[k].begin(), mesh.position[k].end());
    bits.insert(bits.end(), mesh.normal[k].begin(), mesh.normal[k].end());
    bits.insert(bits.end(), mesh.parameters[k].begin(), mesh.parameters[k].end());
    bits.push_back(static_cast<T>(mesh.patch[k]));
  }
  return bits;
}

template <typename T>
bool same_bits(const Bits<T>& a, const Bits<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

template <typename T>
class VertexCalls : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(VertexCalls, Scalars);

struct Case {
  const char* model;
  std::uint32_t most; ///< rates
};
constexpr Case kCases[] = {{"torus 4 x 3", 7}, {"torus 4 x 3", 40}, {"ball 3 x 3", 12},
                           {"cube", 70},       {"book of 4", 9},    {"torus 1 x 1", 5}};

TYPED_TEST(VertexCalls, have_the_same_bits_for_any_threads_destination_and_instruction_set) {
  using T = TypeParam;
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.model);
    EvaluatedMesh<T> mesh(shuffled(model_named(c.model), 4), c.most, 7);
    Bits<T> expected[2]; // by class of instruction sets
    for (const Isa isa : available_isas()) {
      for (const int threads : {1, 2, 3, 7}) {
        for (const Destination destination :
             {Destination::automatic, Destination::cache, Destination::memory}) {
          Options options;
          options.isa = isa;
          options.threads = threads;
          options.destination = destination;
          mesh.evaluate_all(options);
          const Bits<T> bits = bits_of(mesh);
          Bits<T>& same = expected[fuses_multiply_add(isa) ? 1 : 0];
          same = same.empty() ? bits : same;
          EXPECT_TRUE(same_bits(same, bits))
              << to_string(isa) << ", " << threads << ", " << static_cast<int>(destination);
        }
      }
    }
  }
}

/// This holds for bicubic patches, which have kernels of their own, and for patches of any degrees
/// and weights.
TYPED_TEST(VertexCalls, give_parameters_and_patches_alone_for_patches_of_any_shape) {
  using T = TypeParam;
  struct Shape {
    int degree;
    Weights weights;
  };
  for (const Shape shape : {Shape{3, Weights::none}, Shape{2, Weights::none},
                            Shape{2, Weights::cartesian}, Shape{4, Weights::homogeneous}}) {
    for (const std::uint32_t rate : {1U, 2U, 7U}) {
      SCOPED_TRACE(std::to_string(shape.degree) + ", " + std::to_string(rate));
      std::vector<double> values;
      for (int j = 0; j <= shape.degree; ++j) {
        for (int i = 0; i <= shape.degree; ++i) {
          values.insert(values.end(), {1.0 * i, 1.0 * j, 1.0 * i * j});
          values.resize(values.size() + (shape.weights == Weights::none ? 0 : 1), 1.0);
        }
      }
      const auto nets = ControlNets<double>::packed(values.data(), 1, shape.degree, shape.degree, 3,
                                                    shape.weights);
      Topology topology;
      ASSERT_EQ(find_topology(nets, topology), Status::ok);
      MeshLayout layout;
      const std::vector<std::uint32_t> rates = {rate};
      ASSERT_EQ(lay_out_mesh(topology, {rates, rates, {}}, layout), Status::ok);
      PatchSet<T> set;
      ASSERT_TRUE(pack(nets, set));
      const std::size_t n = layout.size().vertices;
      std::vector<T> positions(3 * n);
      std::vector<T> together(2 * n);
      std::vector<T> alone(2 * n, T(77));
      MeshOutputs<T> out;
      out.position = Vectors<T>::xyz(positions.data(), 3);
      out.parameters = Vectors<T>::pairs(together.data(), 2);
      ASSERT_EQ(evaluate_mesh(set, layout, out), Status::ok);
      out.position = {};
      out.parameters = Vectors<T>::pairs(alone.data(), 2);
      ASSERT_EQ(evaluate_mesh(set, layout, out), Status::ok);
      EXPECT_EQ(alone, together);
      std::vector<std::uint32_t> patch(n, 77);
      out = {};
      out.patch = patch;
      ASSERT_EQ(evaluate_mesh(set, layout, out), Status::ok);
      EXPECT_EQ(patch, std::vector<std::uint32_t>(n, 0));
    }
  }
}

/// Vertices as one record each, as planes, or alone.
TYPED_TEST(VertexCalls, have_the_same_bits_in_any_layout) {
  using T = TypeParam;
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.model);
    EvaluatedMesh<T> mesh(model_named(c.model), c.most, 8);
    mesh.evaluate_all();
    const std::size_t n = mesh.position.size();
    constexpr T kUntouched = T(77);
    for (const std::size_t stride : {std::size_t(8), std::size_t(11)}) {
      std::vector<T> records(stride * n, kUntouched);
      const auto step = static_cast<std::ptrdiff_t>(stride);
      MeshOutputs<T> out;
      out.position = Vectors<T>::xyz(records.data(), step);
      out.normal = Vectors<T>::xyz(records.data() + 3, step);
      out.parameters = Vectors<T>::pairs(records.data() + 6, step);
      ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < stride; ++i) {
          const T expected = i < 3   ? mesh.position[k][i]
                             : i < 6 ? mesh.normal[k][i - 3]
                             : i < 8 ? mesh.parameters[k][i - 6]
                                     : kUntouched;
          ASSERT_EQ(records[stride * k + i], expected) << k << ", " << i;
        }
      }
    }
    // Kernels write whole vertices in one order alone.
    constexpr std::size_t kPlaces[][3] = {{2, 5, 0}, {3, 0, 6}, {0, 5, 3}, {5, 0, 3}};
    for (const auto& [position, normal, parameters] : kPlaces) {
      std::vector<T> records(8 * n, kUntouched);
      MeshOutputs<T> out;
      out.position = Vectors<T>::xyz(records.data() + position, 8);
      out.normal = Vectors<T>::xyz(records.data() + normal, 8);
      out.parameters = Vectors<T>::pairs(records.data() + parameters, 8);
      ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
      for (std::size_t k = 0; k < n; ++k) {
        const T* const record = &records[8 * k];
        for (std::size_t i = 0; i < 3; ++i) {
          ASSERT_EQ(record[position + i], mesh.position[k][i]) << k << ", " << i;
          ASSERT_EQ(record[normal + i], mesh.normal[k][i]) << k << ", " << i;
          ASSERT_TRUE(i == 2 || record[parameters + i] == mesh.parameters[k][i]) << k << ", " << i;
        }
      }
    }
    std::vector<T> planes(3 * n);
    MeshOutputs<T> out;
    out.normal = Vectors<T>::planes(&planes[0], &planes[n], &planes[2 * n]);
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
    for (std::size_t k = 0; k < 3 * n; ++k) {
      ASSERT_EQ(planes[k], mesh.normal[k % n][k / n]);
    }
    out = {};
    out.position = Vectors<T>::planes(&planes[0], &planes[n], &planes[2 * n]);
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
    for (std::size_t k = 0; k < 3 * n; ++k) {
      ASSERT_EQ(planes[k], mesh.position[k % n][k / n]);
    }
    std::vector<std::uint32_t> patch(n);
    out = {};
    out.patch = patch;
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
    EXPECT_EQ(patch, mesh.patch);
  }
}

/// Patches of equal rates go together, and those with few cells in ways of their own. Alone, each
/// one's grid has the same samples.
TYPED_TEST(VertexCalls, are_samples_of_grids_where_patches_share_nothing) {
  using T = TypeParam;
  constexpr std::size_t kPatches = 70;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<double> points(kPatches * 48);
  std::generate(points.begin(), points.end(), [&] { return coordinate(random); });
  const auto nets = ControlNets<double>::packed(std::span<const double>(points), 3, 3, 3);
  PatchSet<T> set;
  ASSERT_TRUE(pack(nets, set));
  Topology topology;
  ASSERT_EQ(find_topology(nets, topology), Status::ok);
  for (const Isa isa : available_isas()) {
    Options options;
    options.isa = isa;
    // With 10 and 18, one inner column is left when registers of 8 and 16 are full.
    for (const std::uint32_t nu : {1U, 2U, 3U, 4U, 5U, 6U, 10U, 18U, 20U}) {
      for (const std::uint32_t nv : {1U, 2U, 3U, 4U, 5U, 9U}) {
        SCOPED_TRACE(std::string(to_string(isa)) + ", " + std::to_string(nu) + " x " +
                     std::to_string(nv));
        const std::vector<std::uint32_t> us(kPatches, nu);
        const std::vector<std::uint32_t> vs(kPatches, nv);
        MeshLayout layout;
        ASSERT_EQ(lay_out_mesh(topology, {us, vs, {}}, layout), Status::ok);
        const std::size_t n = layout.size().vertices;
        ASSERT_EQ(n, kPatches * (nu + 1) * (nv + 1));
        std::vector<T> records(8 * n);
        std::vector<std::uint32_t> patch(n);
        MeshOutputs<T> out;
        out.position = Vectors<T>::xyz(records.data(), 8);
        out.normal = Vectors<T>::xyz(records.data() + 3, 8);
        out.parameters = Vectors<T>::pairs(records.data() + 6, 8);
        out.patch = patch;
        ASSERT_EQ(evaluate_mesh(set, layout, out, options), Status::ok);
        std::vector<T> samples(6 * n);
        for (std::size_t k = 0; k < kPatches; ++k) {
          T* const first = &samples[k * 6 * (nu + 1) * (nv + 1)];
          Outputs<T> own;
          own.position = Vectors<T>::xyz(first, 6);
          own.normal = Vectors<T>::xyz(first + 3, 6);
          auto grid = Grid<T>::uniform(nu + 1, nv + 1);
          grid.patches = {k, 1};
          ASSERT_EQ(evaluate(set, grid, own, options), Status::ok);
        }
        for (std::size_t vertex = 0; vertex < n; ++vertex) {
          const T* const record = &records[8 * vertex];
          const auto i = static_cast<std::size_t>(std::lround(record[6] * static_cast<T>(nu)));
          const auto j = static_cast<std::size_t>(std::lround(record[7] * static_cast<T>(nv)));
          ASSERT_EQ(record[6], static_cast<T>(i) / static_cast<T>(nu));
          ASSERT_EQ(record[7], static_cast<T>(j) / static_cast<T>(nv));
          const T* const sample = &samples[6 * ((patch[vertex] * (nv + 1) + j) * (nu + 1) + i)];
          for (std::size_t c = 0; c < 6; ++c) {
            ASSERT_EQ(record[c], sample[c]) << i << ", " << j << ", " << c;
          }
        }
      }
    }
  }
}

TYPED_TEST(VertexCalls, write_parts_of_a_mesh) {
  using T = TypeParam;
  EvaluatedMesh<T> mesh(model_named("torus 4 x 3"), 9, 3);
  mesh.evaluate_all();
  const std::size_t patches = mesh.nu.size();
  for (std::size_t first = 0; first < patches; first += 5) {
    const SetRange range{first, std::min<std::size_t>(5, patches - first)};
    const std::size_t begin = mesh.layout.first_vertex(first);
    const std::size_t end = mesh.layout.first_vertex(first + range.count);
    std::vector<std::array<T, 3>> position(end - begin);
    std::vector<std::array<T, 2>> parameters(end - begin);
    MeshOutputs<T> out;
    out.position = Vectors<T>::xyz(position);
    out.parameters = Vectors<T>::pairs(std::span<T>(parameters.front().data(), 2 * (end - begin)));
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out, {}, range), Status::ok);
    for (std::size_t k = begin; k < end; ++k) {
      EXPECT_EQ(position[k - begin], mesh.position[k]);
      EXPECT_EQ(parameters[k - begin], mesh.parameters[k]);
    }
    const std::size_t before = 3 * mesh.layout.first_triangle(first);
    const std::size_t behind = 3 * mesh.layout.first_triangle(first + range.count);
    std::vector<std::uint32_t> triangles(behind - before);
    ASSERT_EQ(write_triangles(mesh.layout, std::span(triangles), {.threads = 1}, range),
              Status::ok);
    EXPECT_TRUE(std::equal(triangles.begin(), triangles.end(),
                           mesh.triangles.begin() + static_cast<std::ptrdiff_t>(before)));
  }
  EXPECT_EQ(mesh.layout.first_vertex(patches), mesh.position.size());
}

/// Colours as two further components of a set of five, and of a set of their own.
TYPED_TEST(VertexCalls, evaluate_further_components) {
  using T = TypeParam;
  const MeshModel model = model_named("sheet");
  EvaluatedMesh<T> mesh(model, 6, 9);
  mesh.evaluate_all();
  std::vector<double> points;
  for (std::size_t k = 0; k < mesh.values.size(); k += 3) {
    const double* const p = &mesh.values[k];
    points.insert(points.end(), {p[0], p[1], p[2], p[2], p[0]});
  }
  PatchSet<T> set;
  ASSERT_TRUE(pack(ControlNets<double>::packed(std::span<const double>(points), 3, 3, 5), set));
  std::vector<T> pairs(2 * mesh.position.size());
  ASSERT_EQ(evaluate_mesh_attributes(set, mesh.layout, Vectors<T>::pairs(std::span<T>(pairs)), 3),
            Status::ok);
  for (std::size_t k = 0; k < mesh.position.size(); ++k) {
    EXPECT_EQ(pairs[2 * k], mesh.position[k][2]);
    EXPECT_EQ(pairs[2 * k + 1], mesh.position[k][0]);
  }
  EXPECT_EQ(evaluate_mesh_attributes(set, mesh.layout, Vectors<T>::pairs(std::span<T>(pairs)), 5),
            Status::bad_components);
  EXPECT_EQ(evaluate_mesh(set, mesh.layout, mesh.outputs()), Status::bad_components);
}

TYPED_TEST(VertexCalls, refuse_bad_input) {
  using T = TypeParam;
  EvaluatedMesh<T> mesh(model_named("cube"), 5, 2);
  const auto status = [&](const auto& change, SetRange patches = {}) {
    MeshOutputs<T> out = mesh.outputs();
    change(out);
    return evaluate_mesh(mesh.set, mesh.layout, out, {}, patches);
  };
  const auto none = [](auto&) {};
  EXPECT_EQ(status(none), Status::ok);
  EXPECT_EQ(status([](auto& out) { out = {}; }), Status::null_output);
  EXPECT_EQ(status([](auto& out) { out.position.y = nullptr; }), Status::missing_y);
  EXPECT_EQ(status([](auto& out) { out.parameters.y = nullptr; }), Status::missing_y);
  EXPECT_EQ(status([](auto& out) { --out.position.capacity; }), Status::output_too_small);
  EXPECT_EQ(status([](auto& out) { --out.normal.capacity; }), Status::output_too_small);
  EXPECT_EQ(status([](auto& out) { --out.parameters.capacity; }), Status::output_too_small);
  EXPECT_EQ(status([](auto& out) { --out.patch.capacity; }), Status::output_too_small);
  EXPECT_EQ(status([](auto& out) { out.position.stride = 2; }), Status::bad_stride);
  EXPECT_EQ(status([](auto& out) { out.parameters.stride = 1; }), Status::bad_stride);
  EXPECT_EQ(status([](auto& out) { out.normal = out.position; }), Status::overlapping_outputs);
  EXPECT_EQ(status([](auto& out) {
              out.parameters.x = out.normal.x;
              out.parameters.y = out.normal.y;
            }),
            Status::overlapping_outputs);
  EXPECT_EQ(
      status([](auto& out) { out.patch.first = reinterpret_cast<std::uint32_t*>(out.normal.x); }),
      Status::overlapping_outputs);
  EXPECT_EQ(status(none, {0, 7}), Status::bad_patch_range);
  EXPECT_EQ(status(none, {7, 0}), Status::bad_patch_range);
  EXPECT_EQ(evaluate_mesh(PatchSet<T>(), mesh.layout, mesh.outputs()), Status::unequal_lengths);
  EXPECT_EQ(evaluate_mesh(mesh.set, MeshLayout(), mesh.outputs()), Status::unequal_lengths);
  EXPECT_EQ(evaluate_mesh(PatchSet<T>(), MeshLayout(), mesh.outputs()), Status::ok);
  Options options;
  options.isa = absent_isa();
  EXPECT_EQ(evaluate_mesh(mesh.set, mesh.layout, mesh.outputs(), options), Status::unsupported_isa);
  std::vector<std::uint32_t> triangles(3 * mesh.layout.size().triangles - 1);
  EXPECT_EQ(write_triangles(mesh.layout, std::span(triangles), {.threads = 1}),
            Status::output_too_small);
  EXPECT_EQ(write_triangles(mesh.layout, std::span(triangles), {.threads = 1}, {3, 9}),
            Status::bad_patch_range);
}

} // namespace
} // namespace simdbezier::tests::vertex_outputs_test
