// Every option of topologies, rates and meshes does through simdbezier.h what it does in C++.
#include <functional>

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::options_test {
namespace {

/// Two patches side by side, the second one reversed and 0.01 away; and far from them two on top of
/// each other.
std::vector<double> four_patches() {
  std::vector<double> values;
  for (int patch = 0; patch < 4; ++patch) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const int i = patch == 1 ? 7 - k : k; // the second one runs back to the first
        const double gap = patch == 1 ? 1.01 : 0;
        const double away = patch > 1 ? 10 : 0;
        values.insert(values.end(), {i - gap, j + away, i == 0 || i == 7 ? 1.0 : 0.0});
      }
    }
  }
  return values;
}

TEST(CTopologyOptions, AreThoseOfCpp) {
  const std::vector<double> values = four_patches();
  const simdbezier_nets nets = c_nets(values, 3, 3);
  struct Case {
    const char* name;
    std::function<void(TopologyOptions&)> set;
    std::function<void(simdbezier_topology_options&)> c_set;
  };
  const Case cases[] = {
      {"none", [](auto&) {}, [](auto&) {}},
      {"snap", [](auto& o) { o.snap = 0.1; }, [](auto& o) { o.snap = 0.1; }},
      {"flip", [](auto& o) { o.flip = true; }, [](auto& o) { o.flip = 1; }},
      {"orient", [](auto& o) { o.snap = 0.1, o.orient = true; },
       [](auto& o) { o.snap = 0.1, o.orient = 1; }},
      {"point_size", [](auto& o) { o.point_size = 9; }, [](auto& o) { o.point_size = 9; }}};
  std::vector<std::vector<std::size_t>> different;
  for (const Case& one : cases) {
    TopologyOptions options;
    one.set(options);
    auto c_options = sized<simdbezier_topology_options>();
    one.c_set(c_options);
    Topology expected;
    ASSERT_TRUE(find_topology(ControlNets<double>::packed(values), expected, options)) << one.name;
    simdbezier_topology* topology = nullptr;
    EXPECT_C_OK(simdbezier_find_topology(&nets, 1, &c_options, &topology));
    auto counts = sized<simdbezier_topology_counts>();
    EXPECT_C_OK(simdbezier_topology_count(topology, &counts));
    EXPECT_EQ(counts.edges, expected.counts().edges) << one.name;
    EXPECT_EQ(counts.snapped_sides, expected.counts().snapped_sides) << one.name;
    EXPECT_EQ(counts.collapsed_sides, expected.counts().collapsed_sides) << one.name;
    EXPECT_EQ(counts.turned_edges, expected.counts().turned_edges) << one.name;
    std::vector<std::size_t> found = {counts.snapped_sides, counts.collapsed_sides};
    for (std::size_t p = 0; p < 4; ++p) {
      EXPECT_EQ(simdbezier_topology_is_turned(topology, p) != 0, expected.is_turned(p)) << one.name;
      EXPECT_EQ(simdbezier_topology_is_repeated(topology, p) != 0, expected.is_repeated(p));
      found.push_back(expected.is_turned(p) ? 1 : 0);
    }
    EXPECT_EQ(std::count(different.begin(), different.end(), found), 0) << one.name;
    different.push_back(found); // otherwise nothing would show that the option was lost
    simdbezier_topology_free(topology);
  }
}

/// What a mesh of four_patches() comes out as.
struct Found {
  std::vector<double> positions;
  std::vector<double> normals;
  std::size_t triangles = 0;
  bool short_indices = false;
  friend bool operator==(const Found&, const Found&) = default;
};

Found found_in(const Mesh<double>& mesh) {
  Found found;
  for (const auto& position : mesh.positions) {
    found.positions.insert(found.positions.end(), position.begin(), position.end());
  }
  for (const auto& normal : mesh.normals) {
    found.normals.insert(found.normals.end(), normal.begin(), normal.end());
  }
  found.triangles = mesh.triangles.size() + mesh.short_triangles.size();
  found.short_indices = !mesh.short_triangles.empty();
  return found;
}

Found found_in(const simdbezier_mesh* mesh) {
  auto arrays = sized<simdbezier_mesh_arrays>();
  EXPECT_C_OK(simdbezier_mesh_look(mesh, &arrays));
  const auto all = [&](const void* first) {
    const auto* const values = static_cast<const double*>(first);
    return first == nullptr ? std::vector<double>()
                            : std::vector<double>(values, values + 3 * arrays.vertices);
  };
  return {all(arrays.positions), all(arrays.normals), arrays.triangles,
          arrays.short_indices != nullptr};
}

/// One way to fill in the options, in C++ and in C.
struct Case {
  const char* name;
  std::function<void(MeshOptions&)> set;
  std::function<void(simdbezier_mesh_options&)> c_set;
};

/// The options that are set refer to the tolerances and the camera.
std::vector<Case> option_cases(const std::vector<double>& tolerances,
                               const simdbezier_camera& camera) {
  return {
      {"none", [](auto&) {}, [](auto&) {}},
      {"tolerance", [](auto& o) { o.rates.tolerance = 1e-3; }, [](auto& o) { o.tolerance = 1e-3; }},
      {"relative", [](auto& o) { o.relative_tolerance = 1e-3; },
       [](auto& o) { o.relative_tolerance = 1e-3; }},
      {"tolerances", [&](auto& o) { o.rates.tolerances = tolerances; },
       [&](auto& o) { o.tolerances = tolerances.data(), o.tolerances_length = 4; }},
      {"pixels",
       [](auto& o) {
         o.pixels = 0.01, o.camera.eye = {0, 0, 30}, o.camera.focal_length = 10;
       },
       [&](auto& o) { o.pixels = 0.01, o.camera = &camera; }},
      {"longest_edge", [](auto& o) { o.rates.longest_edge = 0.5; },
       [](auto& o) { o.longest_edge = 0.5; }},
      {"normal_degrees", [](auto& o) { o.rates.normal_degrees = 3; },
       [](auto& o) { o.normal_degrees = 3; }},
      {"grid", [](auto& o) { o.rates = {}, o.nu = 4, o.nv = 6; },
       [](auto& o) { o.tolerance = 0, o.nu = 4, o.nv = 6; }},
      {"snap", [](auto& o) { o.topology.snap = 0.1; }, [](auto& o) { o.snap = 0.1; }},
      {"orient", [](auto& o) { o.topology.snap = 0.1, o.topology.orient = true; },
       [](auto& o) { o.snap = 0.1, o.orient = 1; }},
      {"flip", [](auto& o) { o.topology.flip = true; }, [](auto& o) { o.flip = 1; }},
      {"drop_repeated", [](auto& o) { o.drop_repeated = true; },
       [](auto& o) { o.drop_repeated = 1; }},
      {"unshared", [](auto& o) { o.crease_degrees = 0; }, [](auto& o) { o.unshared = 1; }},
      {"no_normals", [](auto& o) { o.normals = false; }, [](auto& o) { o.no_normals = 1; }},
      {"short_indices", [](auto& o) { o.short_indices = true; },
       [](auto& o) { o.short_indices = 1; }}};
}

TEST(CMeshOptions, AreThoseOfCpp) {
  const std::vector<double> values = four_patches();
  const simdbezier_nets nets = c_nets(values, 3, 3);
  auto camera = sized<simdbezier_camera>();
  camera.eye[2] = 30;
  camera.focal_length = 10;
  const std::vector<double> tolerances = {0.5, 0.02, 0.5, 0.5};
  std::vector<Found> different;
  for (const Case& one : option_cases(tolerances, camera)) {
    MeshOptions options;
    options.rates.tolerance = 0.1;
    one.set(options);
    auto c_options = sized<simdbezier_mesh_options>();
    c_options.tolerance = 0.1;
    one.c_set(c_options);
    const Mesh<double> expected = tessellate<double>(ControlNets<double>::packed(values), options);
    ASSERT_TRUE(expected) << one.name;
    simdbezier_mesh* mesh = nullptr;
    EXPECT_EQ(simdbezier_tessellate(&nets, 1, SIMDBEZIER_F64, &c_options, &mesh), SIMDBEZIER_OK)
        << one.name << ": " << simdbezier_last_message();
    const Found found = found_in(mesh);
    EXPECT_TRUE(found == found_in(expected)) << one.name;
    EXPECT_EQ(std::count(different.begin(), different.end(), found), 0)
        << one.name << " changes nothing, so it could be missed";
    different.push_back(found);
    simdbezier_mesh_free(mesh);
  }
}

/// A patch whose parameters run unevenly.
TEST(CMeshOptions, Thorough) {
  constexpr double kAlong[] = {0, 0.05, 0.9, 1.4};
  constexpr double kWide[] = {0, 0.02, 0.25, 0.3};
  std::vector<double> values;
  for (std::size_t k = 0; k < 16; ++k) {
    const std::size_t j = k / 4;
    const double height = j > 1 ? 0.2 * static_cast<double>(j) : 0;
    values.insert(values.end(), {kAlong[k % 4], kWide[k % 4] * (j > 0 ? 1 : 0.3), height});
  }
  const simdbezier_nets nets = c_nets(values, 3, 3);
  std::vector<std::size_t> triangles;
  for (const bool thorough : {false, true}) {
    MeshOptions options;
    options.rates.tolerance = 5e-3;
    options.rates.thorough = thorough;
    const Mesh<double> expected = tessellate<double>(ControlNets<double>::packed(values), options);
    auto c_options = sized<simdbezier_mesh_options>();
    c_options.tolerance = 5e-3;
    c_options.thorough = thorough ? 1 : 0;
    simdbezier_mesh* mesh = nullptr;
    ASSERT_EQ(simdbezier_tessellate(&nets, 1, SIMDBEZIER_F64, &c_options, &mesh), SIMDBEZIER_OK);
    EXPECT_TRUE(found_in(mesh) == found_in(expected));
    triangles.push_back(expected.triangles.size());
    simdbezier_mesh_free(mesh);

    std::vector<std::uint32_t> rates[2] = {{0}, {0}};
    std::vector<std::uint16_t> diagonals(1);
    auto c_rates = sized<simdbezier_rates>();
    c_rates.cells_u = rates[0].data();
    c_rates.cells_v = rates[1].data();
    c_rates.diagonals = diagonals.data();
    c_rates.cells_u_length = c_rates.cells_v_length = c_rates.diagonals_length = 1;
    auto rate_options = sized<simdbezier_rate_options>();
    rate_options.tolerance = 5e-3;
    rate_options.thorough = thorough ? 1 : 0;
    simdbezier_topology* topology = nullptr;
    ASSERT_EQ(simdbezier_find_topology(&nets, 1, nullptr, &topology), SIMDBEZIER_OK);
    ASSERT_EQ(simdbezier_choose_rates(&nets, 1, topology, &rate_options, &c_rates), SIMDBEZIER_OK);
    EXPECT_EQ(2 * rates[0][0] * rates[1][0], expected.triangles.size());
    simdbezier_topology_free(topology);
  }
  EXPECT_GT(triangles[0], 2 * triangles[1]);
}

/// Two patches above each other, beside one that is as high as both, which they touch or do not
/// touch.
TEST(CMeshOptions, SplitEdges) {
  const struct {
    bool splits;
    double gap;
    std::size_t vertices;
    std::size_t joined;
    std::size_t unjoined;
  } cases[] = {{false, 0, 10, 0, 0}, {true, 0, 9, 2, 0}, {true, 0.015625, 10, 0, 2}};
  for (const auto& one : cases) {
    const double x = -one.gap;
    const std::vector<double> values = {0,  0, 0, 1, 0, 0, 0,  2, 0, 1, 2, 0, -1, 0, 0, x, 0, 0,
                                        -1, 1, 0, x, 1, 0, -1, 1, 0, x, 1, 0, -1, 2, 0, x, 2, 0};
    const simdbezier_nets nets = c_nets(values, 1, 1);
    auto options = sized<simdbezier_mesh_options>();
    options.nu = options.nv = 2;
    options.split_edges = one.splits ? 1 : 0;
    simdbezier_mesh* mesh = nullptr;
    EXPECT_C_OK(simdbezier_tessellate(&nets, 1, SIMDBEZIER_F64, &options, &mesh));
    auto arrays = sized<simdbezier_mesh_arrays>();
    EXPECT_C_OK(simdbezier_mesh_look(mesh, &arrays));
    simdbezier_mesh_plan* plan = nullptr;
    EXPECT_C_OK(simdbezier_plan_mesh(&nets, 1, SIMDBEZIER_F64, &options, &plan));
    auto parts = sized<simdbezier_mesh_plan_parts>();
    EXPECT_C_OK(simdbezier_mesh_plan_look(plan, &parts));
    EXPECT_EQ(arrays.vertices, one.vertices);
    EXPECT_EQ(arrays.splits, one.joined);
    EXPECT_EQ(arrays.unjoined, one.unjoined);
    EXPECT_NEAR(arrays.largest_gap, one.gap, 1e-15);
    EXPECT_EQ(parts.splits, one.joined);
    EXPECT_EQ(parts.unjoined, one.unjoined);
    EXPECT_EQ(parts.largest_gap, arrays.largest_gap);
    ASSERT_EQ(parts.pieces != nullptr, one.joined > 0);
    ASSERT_EQ(parts.patch_count, one.joined > 0 ? 4U : 3U);
    if (one.joined > 0) {
      const simdbezier_patch_piece& second = parts.pieces[1];
      EXPECT_EQ(second.patch, 0U);
      EXPECT_EQ((std::array{second.u0, second.u1, second.v0, second.v1}),
                (std::array{0.0, 1.0, 0.5, 1.0}));
      EXPECT_GT(second.error, 0);
      EXPECT_LT(second.error, 1e-14);
      EXPECT_EQ(parts.pieces[3].patch, 2U);
    }
    simdbezier_mesh_plan_free(plan);
    simdbezier_mesh_free(mesh);
  }
}

} // namespace
} // namespace simdbezier::tests::options_test
