// The arguments of all calls of the C API on the way to a mesh, valid at first.
#pragma once

#include "tests/c_api/c_world.hpp"

namespace simdbezier::tests {

struct MeshWorld : World {
  MeshWorld() {
    rates.nu = nu;
    rates.nv = nv;
    rates.diagonals = diagonals;
    rates.deviation = deviation;
    rates.nu_length = rates.nv_length = rates.diagonals_length = rates.deviation_length = 2;
    rate_options.tolerance = 0.5;
    mesh_options.tolerance = 0.5;
    EXPECT_C_OK(simdbezier_find_topology(&nets, 1, nullptr, &topology));
    EXPECT_C_OK(choose());
    EXPECT_C_OK(simdbezier_lay_out_mesh(topology, &rates, &layout));
    vertices = simdbezier_mesh_layout_vertices(layout);
    memory.resize(12 * vertices, 0x5a);
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
  std::size_t vertices = 0;
  std::vector<unsigned char> memory;
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
    return simdbezier_certify_rates(&nets, 1, topology, errors, length, &rates, 0);
  }
  simdbezier_status certify_grids(std::uint32_t nu_, std::uint32_t nv_) {
    return simdbezier_certify_grids(&nets, 1, nu_, nv_, numbers, numbers_length, deviation,
                                    rates.deviation_length, 0);
  }
  simdbezier_status lay_out() { return simdbezier_lay_out_mesh(topology, &rates, &made_layout); }
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
  simdbezier_status find_box(simdbezier_vertex_format as = SIMDBEZIER_FORMAT_UNORM16) {
    return simdbezier_find_quantisation_box(&nets, 1, as, &box);
  }
};

} // namespace simdbezier::tests
