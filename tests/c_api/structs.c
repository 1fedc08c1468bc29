// The sizes of the structs of simdbezier.h, which programs are compiled for: part of the ABI.
#include <stdio.h>

#include <simdbezier.h>

#define SIZE(name) printf("struct %s %zu\n", #name, sizeof(struct name))

int main(void) {
  SIZE(simdbezier_camera);
  SIZE(simdbezier_cluster);
  SIZE(simdbezier_control_curves);
  SIZE(simdbezier_curve_grid);
  SIZE(simdbezier_curve_grids);
  SIZE(simdbezier_curve_outputs);
  SIZE(simdbezier_curve_samples);
  SIZE(simdbezier_edge_link);
  SIZE(simdbezier_error_bounds_of_curve);
  SIZE(simdbezier_error_bounds_of_patch);
  SIZE(simdbezier_fault);
  SIZE(simdbezier_flatten_options);
  SIZE(simdbezier_formatted_output);
  SIZE(simdbezier_formatted_outputs);
  SIZE(simdbezier_grid);
  SIZE(simdbezier_interval);
  SIZE(simdbezier_mesh_arrays);
  SIZE(simdbezier_mesh_options);
  SIZE(simdbezier_mesh_outputs);
  SIZE(simdbezier_mesh_plan_parts);
  SIZE(simdbezier_mutable_nets);
  SIZE(simdbezier_nets);
  SIZE(simdbezier_options);
  SIZE(simdbezier_outputs);
  SIZE(simdbezier_pack_options);
  SIZE(simdbezier_parameter);
  SIZE(simdbezier_partial_derivative);
  SIZE(simdbezier_patch_grids);
  SIZE(simdbezier_patch_interval);
  SIZE(simdbezier_patch_keys);
  SIZE(simdbezier_patch_piece);
  SIZE(simdbezier_patch_shape);
  SIZE(simdbezier_patch_vertices);
  SIZE(simdbezier_polyline_arrays);
  SIZE(simdbezier_primitive_options);
  SIZE(simdbezier_quantisation_box);
  SIZE(simdbezier_rate_options);
  SIZE(simdbezier_rates);
  SIZE(simdbezier_samples);
  SIZE(simdbezier_spline_curve);
  SIZE(simdbezier_spline_places);
  SIZE(simdbezier_spline_surface);
  SIZE(simdbezier_tile);
  SIZE(simdbezier_tile_format);
  SIZE(simdbezier_topology_counts);
  SIZE(simdbezier_topology_options);
  SIZE(simdbezier_values);
  SIZE(simdbezier_vectors);
  return 0;
}
