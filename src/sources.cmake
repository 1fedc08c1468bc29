# The library's sources, folder by folder. What runs once per call, or for patches that are in doubt,
# gains nothing by -O3, which is up to twice the code of -O2 or -Os. Where -Os makes calls of a few
# samples slower it is not used. Of functions that several objects have, of vectors for example, the
# linker takes the first: folders of -O2 and -Os come last.
function(simdbezier_add_sources folder level)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/src/${folder}/ OUTPUT_VARIABLE sources)
  target_sources(simdbezier PRIVATE ${sources})
  if(NOT level STREQUAL "O3")
    set_property(SOURCE ${sources} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-${level}>)
  endif()
endfunction()

simdbezier_add_sources(calls O3 counted_grids.cpp evaluate_curve_grid.cpp evaluate_curve_grids.cpp
                       evaluate_curve_samples.cpp evaluate_samples.cpp grid_plan.cpp
                       piece_evaluator.cpp samples.cpp)
simdbezier_add_sources(calls O2 evaluate_derivatives.cpp evaluate_grid.cpp evaluate_patch_grids.cpp
                       evaluate_tiles.cpp)
simdbezier_add_sources(choice O3 clock.cpp line_costs.cpp measured_call.cpp strategies.cpp)
simdbezier_add_sources(nets O3 adjacency.cpp bounds.cpp edge_rings.cpp iso_points.cpp
                       linear_maps.cpp net_call.cpp net_operations.cpp net_places.cpp
                       patch_keys.cpp)
simdbezier_add_sources(splines O3 evaluate_spline_samples.cpp evaluate_splines.cpp
                       extraction_error.cpp locate.cpp pack_splines.cpp spline_factors.cpp
                       spline_knots.cpp spline_list.cpp spline_nets.cpp splines.cpp)
simdbezier_add_sources(output O3 delivery.cpp output_check.cpp)
simdbezier_add_sources(output O2 output_plan.cpp)
simdbezier_add_sources(runtime O3 batch.cpp cache_sizes.cpp dispatch.cpp fp_environment.cpp
                       instruction_sets.cpp status.cpp threads_${SIMDBEZIER_THREADS}.cpp
                       useful_threads.cpp)
simdbezier_add_sources(mesh/topology O3 entanglement.cpp fit.cpp
                       forced_diagonals.cpp net_corners.cpp orientation.cpp snapping.cpp
                       topology.cpp)
simdbezier_add_sources(mesh/split O3 split_edges.cpp)
simdbezier_add_sources(mesh/bounds O3 cell_graph.cpp chord_distance.cpp group_bound.cpp
                       normal_bends.cpp separable_bound.cpp
                       space_bound.cpp vector_patch.cpp)
simdbezier_add_sources(mesh/rates O3 cell_search.cpp certify_grids.cpp flatten.cpp pixels.cpp
                       position_errors.cpp rates.cpp space_search.cpp)
simdbezier_add_sources(mesh/layout O3 mesh_layout.cpp mesh_parts.cpp separation.cpp)
simdbezier_add_sources(mesh/primitives O3 write_primitives.cpp write_triangles.cpp)
simdbezier_add_sources(mesh/vertices O3 evaluate_formatted.cpp evaluate_mesh.cpp)
simdbezier_add_sources(mesh/vertices O2 split_creases.cpp)
simdbezier_add_sources(certificate O3 certificate.cpp curve_certificate.cpp)
simdbezier_add_sources(exact O3 prime_field.cpp)
simdbezier_add_sources(exact O2 normal_fallback.cpp tangent_fallback.cpp)
simdbezier_add_sources(pack O2 iso_curves.cpp pack.cpp pack_curves.cpp set_layout.cpp)
simdbezier_add_sources(mesh O2 tessellate.cpp)
simdbezier_add_sources(c_api O3 curves.cpp evaluate.cpp library.cpp primitives.cpp)
simdbezier_add_sources(c_api Os meshes.cpp models.cpp nets.cpp rates.cpp sets.cpp
                       splines.cpp vertices.cpp)

# Square roots that could set errno are not vectorised, and normals at shared vertices need many.
set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/mesh/vertices/evaluate_formatted.cpp
                    ${PROJECT_SOURCE_DIR}/src/mesh/vertices/evaluate_mesh.cpp
             APPEND PROPERTY COMPILE_OPTIONS -fno-math-errno)
# Where a parent compiles several sources as one, these stay alone, for they share names.
file(GLOB c_api_sources ${PROJECT_SOURCE_DIR}/src/c_api/*.cpp)
set_property(SOURCE ${c_api_sources} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
