// The arguments of all calls of the C API, valid at first; a test spoils one of them.
#pragma once

#include <limits>

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct World {
  World() {
    set = c_pack<float>(nets);
    curve_set = c_pack<float>(curves);
    out.position = c_triples(positions);
    curve_out.position = c_triples(positions);
    samples.scalar = SIMDBEZIER_F32;
    grids.nu = grids.nv = counts;
    grids.nu_length = grids.nv_length = 2;
    derivative.out = c_triples(positions);
  }

  std::vector<float> values = random_values<float>(2 * 48, 4);
  simdbezier_nets nets = c_nets(values, 3, 3);
  simdbezier_control_curves curves =
      simdbezier_packed_curves_f32(values.data(), values.size(), 3, 3, SIMDBEZIER_POLYNOMIAL);
  simdbezier_pack_options pack_options = sized<simdbezier_pack_options>();
  CPatchSet set;
  CCurveSet curve_set;
  simdbezier_grid grid = simdbezier_uniform_grid(3, 3);
  std::uint32_t counts[2] = {2, 2};
  simdbezier_patch_grids grids = sized<simdbezier_patch_grids>();
  std::uint32_t patch[2] = {0, 1};
  float parameters[3] = {0.25F, 0.5F, 1.0F};
  simdbezier_samples samples = simdbezier_samples_f32(patch, parameters, parameters, 2);
  simdbezier_curve_grid curve_grid = simdbezier_uniform_curve_grid(3);
  std::vector<float> positions = std::vector<float>(3 * 24, -7.0F);
  std::vector<float> room = std::vector<float>(8 * 48, -7.0F);
  simdbezier_outputs out = sized<simdbezier_outputs>();
  simdbezier_curve_outputs curve_out = sized<simdbezier_curve_outputs>();
  simdbezier_options options = sized<simdbezier_options>();
  simdbezier_partial_derivative derivative = sized<simdbezier_partial_derivative>();
  simdbezier_tile_format format = sized<simdbezier_tile_format>();
  simdbezier_mutable_nets low = simdbezier_packed_mutable_nets_f32(room.data(), 96, 3, 3, 3, 0);
  simdbezier_mutable_nets high =
      simdbezier_packed_mutable_nets_f32(room.data() + 96, 96, 3, 3, 3, 0);
  simdbezier_control_curves edge = sized<simdbezier_control_curves>();
  simdbezier_patch_set* made = nullptr;
  simdbezier_curve_set* made_curves = nullptr;

  // The calls of the table.
  simdbezier_status pack() {
    return simdbezier_pack(&nets, 1, SIMDBEZIER_F32, &pack_options, &made);
  }
  simdbezier_status evaluate() {
    return simdbezier_evaluate_grid(set.get(), &grid, &out, &options);
  }
  simdbezier_status evaluate_grids() {
    return simdbezier_evaluate_patch_grids(set.get(), &grids, &out, &options);
  }
  simdbezier_status evaluate_samples() {
    return simdbezier_evaluate_samples(set.get(), &samples, &out, &options);
  }
  simdbezier_status evaluate_curves() {
    return simdbezier_evaluate_curve_grid(curve_set.get(), &curve_grid, &curve_out, &options);
  }
  simdbezier_status differentiate() {
    return simdbezier_evaluate_grid_derivatives(set.get(), &grid, &derivative, 1, 0, &options);
  }
  simdbezier_status take_edge() {
    return simdbezier_boundary_curves(&nets, SIMDBEZIER_EDGE_U1, &edge);
  }
  simdbezier_status split() {
    return simdbezier_split_u(&nets, simdbezier_at(0.5), &low, &high, &options);
  }
};

} // namespace simdbezier::tests
