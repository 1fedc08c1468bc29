// The arguments of all calls of the C API on the way to a mesh, valid at first.
#pragma once

#include "tests/c_api/support/c_refusal.hpp"
#include "tests/c_api/support/c_world.hpp"

namespace simdbezier::tests {

struct MeshWorld : World {
  MeshWorld() {
    rates.cells_u = nu;
    rates.cells_v = nv;
    rates.diagonals = diagonals;
    rates.deviation = deviation;
    rates.cells_u_length = rates.cells_v_length = rates.diagonals_length = rates.deviation_length =
        2;
    rate_options.tolerance = 0.5;
    mesh_options.tolerance = 0.5;
    EXPECT_C_OK(simdbezier_find_topology(&nets, 1, nullptr, &topology));
    EXPECT_C_OK(choose());
    EXPECT_C_OK(simdbezier_lay_out_mesh(topology, &rates, nullptr, &layout));
    vertices = simdbezier_mesh_layout_vertices(layout);
    memory.resize(12 * vertices, 0x5a);
    mesh_out.position = c_triples(triples);
    formatted.position = {memory.data(), vertices, 12, SIMDBEZIER_FORMAT_UNORM16};
    formatted.normal = {memory.data() + 6, vertices, 12, SIMDBEZIER_FORMAT_OCTAHEDRAL8};
    formatted.parameters = {memory.data() + 8, vertices, 12, SIMDBEZIER_FORMAT_UNORM16};
    formatted.box.step = 1e-3;
  }
  MeshWorld(const MeshWorld&) = delete;
  MeshWorld& operator=(const MeshWorld&) = delete;
  ~MeshWorld() {
    simdbezier_mesh_layout_free(layout);
    simdbezier_topology_free(topology);
  }

  std::uint32_t nu[2] = {};
  std::uint32_t nv[2] = {};
  std::uint16_t diagonals[2] = {};
  double deviation[2] = {};
  double numbers[3] = {0.125, 0.125, 0.125};
  std::size_t numbers_length = 2;
  simdbezier_rates rates = sized<simdbezier_rates>();
  simdbezier_rate_options rate_options = sized<simdbezier_rate_options>();
  simdbezier_topology_options topology_options = sized<simdbezier_topology_options>();
  simdbezier_mesh_options mesh_options = sized<simdbezier_mesh_options>();
  simdbezier_camera camera = sized<simdbezier_camera>();
  simdbezier_formatted_outputs formatted = sized<simdbezier_formatted_outputs>();
  simdbezier_topology* topology = nullptr;
  simdbezier_mesh_layout* layout = nullptr;
  simdbezier_mesh_outputs mesh_out = sized<simdbezier_mesh_outputs>();
  std::size_t vertices = 0;
  std::vector<float> triples = std::vector<float>(3 * 4096, -7.0F);
  std::vector<unsigned char> memory;
  simdbezier_primitive_options primitives = sized<simdbezier_primitive_options>();
  std::vector<std::uint32_t> indices = std::vector<std::uint32_t>(6 * 4096, 0x5a5a5a5a);
  std::vector<std::uint8_t> sizes = std::vector<std::uint8_t>(4096, 0x5a);
  std::size_t polygons = 0;
  std::size_t corners = 0;
  simdbezier_quantisation_box box{};
  simdbezier_topology* made_topology = nullptr;
  simdbezier_mesh* made_mesh = nullptr;
  simdbezier_mesh_plan* made_plan = nullptr;
  simdbezier_mesh_layout* made_layout = nullptr;

  simdbezier_status join() {
    return simdbezier_find_topology(&nets, 1, &topology_options, &made_topology);
  }
  simdbezier_status choose() {
    return simdbezier_choose_rates(&nets, 1, topology, &rate_options, &rates);
  }
  simdbezier_status certify(const double* errors = nullptr, std::size_t length = 0) {
    return simdbezier_certify_rates(&nets, 1, topology, errors, length, &rates, &options);
  }
  simdbezier_status certify_grids(std::uint32_t nu_, std::uint32_t nv_) {
    return simdbezier_certify_grids(&nets, 1, nu_, nv_, numbers, numbers_length, deviation,
                                    rates.deviation_length, &options);
  }
  simdbezier_status lay_out() {
    return simdbezier_lay_out_mesh(topology, &rates, &options, &made_layout);
  }
  simdbezier_status plan() {
    return simdbezier_plan_mesh(&nets, 1, SIMDBEZIER_F64, &mesh_options, &made_plan);
  }
  simdbezier_status tessellate() {
    return simdbezier_tessellate(&nets, 1, SIMDBEZIER_F32, &mesh_options, &made_mesh);
  }
  simdbezier_status format_vertices(std::size_t first = 0, std::size_t count = 0) {
    return simdbezier_evaluate_formatted_mesh(set.get(), layout, &formatted, &options, first,
                                              count);
  }
  simdbezier_status evaluate_vertices(std::size_t first = 0, std::size_t count = 0) {
    return simdbezier_evaluate_mesh(set.get(), layout, &mesh_out, &options, first, count);
  }
  simdbezier_status evaluate_attributes(std::int32_t first_component) {
    return simdbezier_evaluate_mesh_attributes(set.get(), layout, &mesh_out.position,
                                               first_component, &options, 0, 0);
  }
  simdbezier_status write_triangles() {
    return simdbezier_write_triangles_u32(layout, indices.data(), indices.size(), &primitives);
  }
  simdbezier_status count_polygons() {
    return simdbezier_polygon_size(layout, &polygons, &corners, &primitives);
  }
  simdbezier_status write_polygons() {
    return simdbezier_write_polygons_u32(layout, indices.data(), indices.size(), sizes.data(),
                                         sizes.size(), &primitives);
  }
  simdbezier_status find_box(simdbezier_vertex_format as = SIMDBEZIER_FORMAT_UNORM16) {
    return simdbezier_find_quantisation_box(&nets, 1, as, &box);
  }
};

/// Nothing is made or written by a refused call.
inline void expect_all_refused(std::span<const Refusal<MeshWorld>> refusals) {
  for (const Refusal<MeshWorld>& one : refusals) {
    MeshWorld world;
    expect_refused(one, world);
    EXPECT_EQ(world.made_topology, nullptr) << one.argument;
    EXPECT_EQ(world.made_mesh, nullptr) << one.argument;
    EXPECT_EQ(world.made_plan, nullptr) << one.argument;
    EXPECT_EQ(world.made_layout, nullptr) << one.argument;
    EXPECT_EQ(world.box.step, 0) << one.argument;
    const auto untouched = [](const auto& memory, auto value) {
      return std::count(memory.begin(), memory.end(), value) ==
             static_cast<std::ptrdiff_t>(memory.size());
    };
    EXPECT_TRUE(untouched(world.memory, 0x5a)) << one.argument;
    EXPECT_TRUE(untouched(world.triples, -7.0F)) << one.argument;
    EXPECT_TRUE(untouched(world.sizes, 0x5a)) << one.argument;
    EXPECT_TRUE(untouched(world.indices, 0x5a5a5a5aU)) << one.argument;
    EXPECT_EQ(world.polygons + world.corners, 0U) << one.argument;
  }
}

} // namespace simdbezier::tests
