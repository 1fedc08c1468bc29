// Every call of the C API that returns a status, with arguments that are valid at first.
#pragma once

#include "tests/c_api/support/c_mesh_world.hpp"

namespace simdbezier::tests {

inline void free_made(simdbezier_patch_set* made) { simdbezier_patch_set_free(made); }
inline void free_made(simdbezier_curve_set* made) { simdbezier_curve_set_free(made); }
inline void free_made(simdbezier_topology* made) { simdbezier_topology_free(made); }
inline void free_made(simdbezier_mesh_layout* made) { simdbezier_mesh_layout_free(made); }
inline void free_made(simdbezier_mesh* made) { simdbezier_mesh_free(made); }
inline void free_made(simdbezier_mesh_plan* made) { simdbezier_mesh_plan_free(made); }
inline void free_made(simdbezier_polylines* made) { simdbezier_polylines_free(made); }

/// What the calls take besides the arguments of MeshWorld.
struct EveryArgument : MeshWorld {
  EveryArgument() {
    out.normal = c_triples(normals);
    out.gaussian = c_values(more);
    out.status = statuses;
    out.status_length = curve_out.status_length = 24;
    curve_out.tangent = c_triples(normals);
    curve_out.curvature = c_values(more);
    curve_out.status = statuses;
    curve_grids.n = eight;
    curve_grids.n_length = 8;
    curve_samples.curve = patch;
    curve_samples.t = parameters;
    spline.knots_u = spline_curve.knots = knots;
    spline.knots_u_length = spline_curve.knots_length = 9;
    curve_samples.curve_length = curve_samples.t_length = 2;
    flatten_options.tolerance = 0.01;
    curve_samples.scalar = SIMDBEZIER_F32;
    places.length = 2;
    places.patch = counted;
    places.u = &doubles[0];
    places.v = &doubles[2];
    places.length_u = &doubles[4];
    places.length_v = &doubles[6];
    for (std::size_t k = 0; k < 4; ++k) {
      quarters[k] = simdbezier_packed_mutable_nets_f32(&room[96 * k], 96, 3, 3, 3, 0);
    }
    EXPECT_C_OK(tessellate());
    EXPECT_C_OK(plan());
    EXPECT_C_OK(simdbezier_flatten(&curves, SIMDBEZIER_F32, 0.01, nullptr, &made_polylines));
    std::swap(mesh, made_mesh);
    std::swap(planned, made_plan);
    std::swap(polylines, made_polylines);
  }
  EveryArgument(const EveryArgument&) = delete;
  EveryArgument& operator=(const EveryArgument&) = delete;
  ~EveryArgument() {
    const auto free_all = [](auto*... each) { (free_made(each), ...); };
    free_all(made, made_curves, made_topology, made_mesh, made_plan, made_layout, made_polylines,
             mesh, planned, polylines);
  }

  /// The address of an argument, or null where that is what is tried.
  template <typename Argument>
  Argument* at(Argument& argument) const {
    return &argument == gone ? nullptr : &argument;
  }
  template <typename Handle>
  Handle* handle(Handle* object) const {
    return object == gone ? nullptr : object;
  }
  /// Where a call may put an object.
  template <typename Handle>
  Handle** place(Handle*& object) {
    free_made(object);
    object = nullptr;
    return at(object);
  }
  simdbezier_patch_set* patches() { return handle(set.get()); }
  simdbezier_curve_set* all_curves() { return handle(curve_set.get()); }

  const void* gone = nullptr; ///< the argument that is null
  std::vector<float> normals = std::vector<float>(72);
  std::vector<float> more = std::vector<float>(24);
  std::uint8_t statuses[24] = {};
  std::uint32_t eight[8] = {2, 2, 2, 2, 2, 2, 2, 2};
  std::uint32_t counted[8] = {};
  simdbezier_curve_grids curve_grids = sized<simdbezier_curve_grids>();
  simdbezier_curve_samples curve_samples = sized<simdbezier_curve_samples>();
  simdbezier_flatten_options flatten_options = sized<simdbezier_flatten_options>();
  simdbezier_spline_surface spline =
      simdbezier_packed_spline_surface_f32(values.data(), values.size(), 4, 5, 3, 3, 3, 0);
  simdbezier_spline_curve spline_curve =
      simdbezier_packed_spline_curve_f32(values.data(), values.size(), 5, 3, 3, 0);
  double knots[9] = {0, 0, 0, 0, 1, 2, 2, 2, 2};
  double spline_u[2] = {0.25, 1.0};
  double spline_v[2] = {0.5, 0.75};
  std::size_t spline_length = 2;
  simdbezier_patch_interval intervals[2] = {};
  simdbezier_interval curve_intervals[2] = {};
  std::size_t intervals_length = 2;
  std::size_t spans_u = 0;
  std::size_t spans_v = 0;
  simdbezier_spline_places places = sized<simdbezier_spline_places>();
  simdbezier_values pieces = simdbezier_values_f32(&room[0], 24);
  simdbezier_mutable_nets quarters[4];
  simdbezier_mutable_nets slope_u = simdbezier_packed_mutable_nets_f32(&room[0], 72, 2, 3, 3, 0);
  simdbezier_mutable_nets slope_v = simdbezier_packed_mutable_nets_f32(&room[0], 72, 3, 2, 3, 0);
  simdbezier_values low_corners = simdbezier_values_f32(&room[0], 6);
  simdbezier_values high_corners = simdbezier_values_f32(&room[6], 6);
  simdbezier_parameter u = simdbezier_at(0.5);
  simdbezier_parameter v = simdbezier_at(0.25);
  char isa_name[7] = "scalar";
  double number = 0.5;
  double bound = 0;
  double doubles[96] = {};
  std::size_t doubles_length = 96;
  std::size_t views = 1; ///< elements of nets
  std::size_t first_patch = 0;
  std::size_t patch_count = 0;
  std::size_t which = 1; ///< a patch or a curve
  std::size_t vertices_found = 0;
  std::int32_t first_component = 0;
  std::int32_t levels = 2;
  std::uint32_t cells = 4;
  simdbezier_scalar scalar = SIMDBEZIER_F32;
  simdbezier_isa isa = SIMDBEZIER_ISA_AUTOMATIC;
  simdbezier_isa isa_found = 0;
  simdbezier_basis basis = SIMDBEZIER_BASIS_B_SPLINE;
  simdbezier_edge side = SIMDBEZIER_EDGE_U1;
  simdbezier_vertex_format as = SIMDBEZIER_FORMAT_UNORM16;
  simdbezier_edge_link links[8] = {};
  std::size_t links_length = 8;
  simdbezier_patch_keys keys[2] = {};
  std::size_t keys_length = 2;
  simdbezier_patch_vertices owned[2] = {};
  std::size_t owned_length = 1;
  std::size_t own_first = 1;
  std::size_t own_count = 1;
  std::vector<std::uint64_t> part_numbers = std::vector<std::uint64_t>(4096);
  std::vector<std::uint16_t> short_indices = std::vector<std::uint16_t>(6 * 4096);
  std::size_t indices_length = indices.size();
  std::size_t sizes_length = sizes.size();
  std::vector<simdbezier_cluster> clusters = std::vector<simdbezier_cluster>(64);
  std::size_t clusters_length = 64;
  std::int32_t fits = 0;
  simdbezier_topology_counts topology_counts = sized<simdbezier_topology_counts>();
  simdbezier_patch_shape shape = sized<simdbezier_patch_shape>();
  simdbezier_error_bounds_of_patch patch_bounds = sized<simdbezier_error_bounds_of_patch>();
  simdbezier_error_bounds_of_curve curve_bounds = sized<simdbezier_error_bounds_of_curve>();
  simdbezier_mesh_arrays mesh_arrays = sized<simdbezier_mesh_arrays>();
  simdbezier_mesh_plan_parts plan_parts = sized<simdbezier_mesh_plan_parts>();
  simdbezier_polyline_arrays polyline_arrays = sized<simdbezier_polyline_arrays>();
  simdbezier_mesh* mesh = nullptr;
  simdbezier_mesh_plan* planned = nullptr;
  simdbezier_polylines* polylines = nullptr;
  simdbezier_polylines* made_polylines = nullptr;
};

struct CCall {
  const char* name;
  simdbezier_status (*run)(EveryArgument& w);
};

#define SIMDBEZIER_C_CALL(name, ...)                                                               \
  {                                                                                                \
    "simdbezier_" #name, [](EveryArgument& w) { return simdbezier_##name(__VA_ARGS__); }           \
  }

inline const CCall kEveryCall[] = {
    SIMDBEZIER_C_CALL(pack, w.at(w.nets), w.views, w.scalar, w.at(w.pack_options), w.place(w.made)),
    SIMDBEZIER_C_CALL(pack_curves, w.at(w.curves), w.scalar, w.at(w.pack_options),
                      w.place(w.made_curves)),
    SIMDBEZIER_C_CALL(patch_set_shape, w.patches(), w.which, w.at(w.shape)),
    SIMDBEZIER_C_CALL(patch_error_bounds, w.patches(), w.which, w.isa, w.at(w.patch_bounds)),
    SIMDBEZIER_C_CALL(curve_error_bounds, w.all_curves(), w.which, w.isa, w.at(w.curve_bounds)),
    SIMDBEZIER_C_CALL(largest_position_bound, w.patches(), w.isa, w.at(w.bound)),
    SIMDBEZIER_C_CALL(position_errors, w.patches(), w.at(w.doubles[0]), w.doubles_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(curve_position_errors, w.all_curves(), w.at(w.doubles[0]), w.doubles_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(isa_from_name, w.at(w.isa_name[0]), w.at(w.isa_found)),
    SIMDBEZIER_C_CALL(resolve_isa, w.isa, w.at(w.isa_found)),
    SIMDBEZIER_C_CALL(evaluate_grid, w.patches(), w.at(w.grid), w.at(w.out), w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_patch_grids, w.patches(), w.at(w.grids), w.at(w.out),
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_samples, w.patches(), w.at(w.samples), w.at(w.out), w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_grid_derivatives, w.patches(), w.at(w.grid), w.at(w.derivative),
                      w.views, w.first_component, w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_sample_derivatives, w.patches(), w.at(w.samples), w.at(w.derivative),
                      w.views, w.first_component, w.at(w.options)),
    SIMDBEZIER_C_CALL(
        evaluate_tiles, w.patches(), w.at(w.grid), w.at(w.format),
        w.gone == &w.which ? nullptr : +[](const simdbezier_tile*, void*) {}, nullptr,
        w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_curve_grid, w.all_curves(), w.at(w.curve_grid), w.at(w.curve_out),
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_curve_grids, w.all_curves(), w.at(w.curve_grids), w.at(w.curve_out),
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(evaluate_curve_samples, w.all_curves(), w.at(w.curve_samples),
                      w.at(w.curve_out), w.at(w.options)),
    SIMDBEZIER_C_CALL(boundary_curves, w.at(w.nets), w.side, w.at(w.edge)),
    SIMDBEZIER_C_CALL(iso_u, w.patches(), w.number, w.at(w.pack_options), w.place(w.made_curves)),
    SIMDBEZIER_C_CALL(iso_v, w.patches(), w.number, w.at(w.pack_options), w.place(w.made_curves)),
    SIMDBEZIER_C_CALL(iso_u_points, w.at(w.nets), w.number, w.at(w.doubles[0]), w.doubles_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(iso_v_points, w.at(w.nets), w.number, w.at(w.doubles[0]), w.doubles_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(choose_polylines, w.at(w.curves), w.at(w.flatten_options), w.at(w.counted[0]),
                      w.curve_grids.n_length, w.at(w.doubles[0]), w.curve_grids.n_length),
    SIMDBEZIER_C_CALL(flatten, w.at(w.curves), w.scalar, w.number, w.at(w.options),
                      w.place(w.made_polylines)),
    SIMDBEZIER_C_CALL(polylines_look, w.handle(w.polylines), w.at(w.polyline_arrays)),
    SIMDBEZIER_C_CALL(split_u, w.at(w.nets), w.u, w.at(w.low), w.at(w.high), w.at(w.options)),
    SIMDBEZIER_C_CALL(split_v, w.at(w.nets), w.v, w.at(w.low), w.at(w.high), w.at(w.options)),
    SIMDBEZIER_C_CALL(split, w.at(w.nets), w.u, w.v, w.at(w.quarters[0]), w.at(w.options)),
    SIMDBEZIER_C_CALL(segment, w.at(w.nets), w.v, w.u, w.v, w.u, w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(elevate, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(hodograph_u, w.at(w.nets), w.at(w.slope_u), w.at(w.options)),
    SIMDBEZIER_C_CALL(hodograph_v, w.at(w.nets), w.at(w.slope_v), w.at(w.options)),
    SIMDBEZIER_C_CALL(reverse_u, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(reverse_v, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(transpose, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(to_bezier, w.basis, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(from_bezier, w.basis, w.at(w.nets), w.at(w.low), w.at(w.options)),
    SIMDBEZIER_C_CALL(spline_to_bezier, w.at(w.spline), w.views, w.at(w.low), w.at(w.intervals[0]),
                      w.intervals_length, w.at(w.options)),
    SIMDBEZIER_C_CALL(spline_pack, w.at(w.spline), w.views, w.scalar, w.at(w.intervals[0]),
                      w.intervals_length, w.at(w.pack_options), w.place(w.made)),
    SIMDBEZIER_C_CALL(spline_span_count, w.at(w.spline), w.at(w.spans_u), w.at(w.spans_v)),
    SIMDBEZIER_C_CALL(spline_locate, w.at(w.spline), w.at(w.spline_u[0]), w.spline_length,
                      w.at(w.spline_v[0]), w.spline_length, w.at(w.places)),
    SIMDBEZIER_C_CALL(spline_evaluate_grid, w.patches(), w.at(w.spline), w.at(w.spline_u[0]),
                      w.spline_length, w.at(w.spline_v[0]), w.spline_length, w.at(w.out),
                      w.at(w.options), w.first_patch),
    SIMDBEZIER_C_CALL(spline_evaluate_samples, w.patches(), w.at(w.spline), w.at(w.spline_u[0]),
                      w.spline_length, w.at(w.spline_v[0]), w.spline_length, w.at(w.out),
                      w.at(w.options), w.first_patch),
    SIMDBEZIER_C_CALL(spline_tessellate, w.at(w.spline), w.views, w.scalar, w.at(w.mesh_options),
                      w.place(w.made_mesh)),
    SIMDBEZIER_C_CALL(spline_plan_mesh, w.at(w.spline), w.views, w.scalar, w.at(w.mesh_options),
                      w.place(w.made_plan)),
    SIMDBEZIER_C_CALL(spline_curve_span_count, w.at(w.spline_curve), w.at(w.spans_u)),
    SIMDBEZIER_C_CALL(spline_curve_to_bezier, w.at(w.spline_curve), w.pieces,
                      w.at(w.curve_intervals[0]), w.intervals_length, w.at(w.options)),
    SIMDBEZIER_C_CALL(spline_curve_locate, w.at(w.spline_curve), w.at(w.spline_u[0]),
                      w.spline_length, w.at(w.places)),
    SIMDBEZIER_C_CALL(control_boxes, w.at(w.nets), w.low_corners, w.high_corners, w.at(w.options)),
    SIMDBEZIER_C_CALL(tight_boxes, w.at(w.nets), w.levels, w.low_corners, w.high_corners,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(flatness, w.at(w.nets), w.low_corners, w.at(w.options)),
    SIMDBEZIER_C_CALL(find_adjacency, w.at(w.nets), w.views, w.at(w.links[0]), w.links_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(find_patch_keys, w.at(w.nets), w.views, w.at(w.keys[0]), w.keys_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(owned_vertices, w.handle(w.layout), w.own_first, w.own_count, 0,
                      w.at(w.owned[0]), w.owned_length),
    SIMDBEZIER_C_CALL(number_part, w.handle(w.layout), w.own_first, w.own_count, 0,
                      w.at(w.owned[0]), w.owned_length, w.at(w.part_numbers[0]),
                      w.part_numbers.size()),
    SIMDBEZIER_C_CALL(find_topology, w.at(w.nets), w.views, w.at(w.topology_options),
                      w.place(w.made_topology)),
    SIMDBEZIER_C_CALL(topology_count, w.handle(w.topology), w.at(w.topology_counts)),
    SIMDBEZIER_C_CALL(topology_fits, w.handle(w.topology), w.at(w.nets), w.views, 1, w.at(w.fits)),
    SIMDBEZIER_C_CALL(choose_rates, w.at(w.nets), w.views, w.handle(w.topology),
                      w.at(w.rate_options), w.at(w.rates)),
    SIMDBEZIER_C_CALL(certify_rates, w.at(w.nets), w.views, w.handle(w.topology),
                      w.at(w.numbers[0]), w.numbers_length, w.at(w.rates), w.at(w.options)),
    SIMDBEZIER_C_CALL(certify_grids, w.at(w.nets), w.views, w.cells, w.cells, w.at(w.numbers[0]),
                      w.numbers_length, w.at(w.deviation[0]), w.rates.deviation_length,
                      w.at(w.options)),
    SIMDBEZIER_C_CALL(pixel_tolerances, w.at(w.nets), w.views, w.at(w.camera), w.number,
                      w.at(w.doubles[0]), w.doubles_length),
    SIMDBEZIER_C_CALL(separate_vertices, w.handle(w.topology), w.rates.cells_u,
                      w.rates.cells_u_length, w.rates.cells_v, w.rates.cells_v_length, nullptr),
    SIMDBEZIER_C_CALL(lay_out_mesh, w.handle(w.topology), w.at(w.rates), w.at(w.options),
                      w.place(w.made_layout)),
    SIMDBEZIER_C_CALL(write_triangles_u32, w.handle(w.layout), w.at(w.indices[0]), w.indices_length,
                      w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_triangles_u16, w.handle(w.layout), w.at(w.short_indices[0]),
                      w.indices_length, w.at(w.primitives)),
    SIMDBEZIER_C_CALL(polygon_size, w.handle(w.layout), w.at(w.polygons), w.at(w.corners),
                      w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_polygons_u32, w.handle(w.layout), w.at(w.indices[0]), w.indices_length,
                      w.at(w.sizes[0]), w.sizes_length, w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_polygons_u16, w.handle(w.layout), w.at(w.short_indices[0]),
                      w.indices_length, w.at(w.sizes[0]), w.sizes_length, w.at(w.primitives)),
    SIMDBEZIER_C_CALL(strip_size, w.handle(w.layout), w.at(w.corners), w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_strips_u32, w.handle(w.layout), w.at(w.indices[0]), w.indices_length,
                      w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_strips_u16, w.handle(w.layout), w.at(w.short_indices[0]),
                      w.indices_length, w.at(w.primitives)),
    SIMDBEZIER_C_CALL(cluster_size, w.handle(w.layout), w.at(w.polygons), w.at(w.corners),
                      w.at(w.vertices_found), w.at(w.primitives)),
    SIMDBEZIER_C_CALL(write_clusters, w.handle(w.layout), w.at(w.clusters[0]), w.clusters_length,
                      w.at(w.indices[0]), w.indices_length, w.at(w.sizes[0]), w.sizes_length,
                      w.at(w.primitives)),
    SIMDBEZIER_C_CALL(evaluate_mesh, w.patches(), w.handle(w.layout), w.at(w.mesh_out),
                      w.at(w.options), w.first_patch, w.patch_count),
    SIMDBEZIER_C_CALL(evaluate_mesh_attributes, w.patches(), w.handle(w.layout),
                      w.at(w.mesh_out.position), w.first_component, w.at(w.options), w.first_patch,
                      w.patch_count),
    SIMDBEZIER_C_CALL(split_creases, w.patches(), w.handle(w.layout), w.number, w.at(w.options),
                      w.place(w.made_layout)),
    SIMDBEZIER_C_CALL(split_parameters, w.handle(w.layout), w.place(w.made_layout)),
    SIMDBEZIER_C_CALL(find_quantisation_box, w.at(w.nets), w.views, w.as, w.at(w.box)),
    SIMDBEZIER_C_CALL(evaluate_formatted_mesh, w.patches(), w.handle(w.layout), w.at(w.formatted),
                      w.at(w.options), w.first_patch, w.patch_count),
    SIMDBEZIER_C_CALL(tessellate, w.at(w.nets), w.views, w.scalar, w.at(w.mesh_options),
                      w.place(w.made_mesh)),
    SIMDBEZIER_C_CALL(mesh_look, w.handle(w.mesh), w.at(w.mesh_arrays)),
    SIMDBEZIER_C_CALL(mesh_count, w.handle(w.mesh), w.at(w.topology_counts)),
    SIMDBEZIER_C_CALL(plan_mesh, w.at(w.nets), w.views, w.scalar, w.at(w.mesh_options),
                      w.place(w.made_plan)),
    SIMDBEZIER_C_CALL(mesh_plan_look, w.handle(w.planned), w.at(w.plan_parts)),
    SIMDBEZIER_C_CALL(mesh_plan_count, w.handle(w.planned), w.at(w.topology_counts))};
#undef SIMDBEZIER_C_CALL

} // namespace simdbezier::tests
