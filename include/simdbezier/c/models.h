// topology.hpp, rates.hpp, mesh_layout.hpp: which edges of a model are one, how many
// cells its patches need, and what its vertices are. Nets of a call have one type.
#pragma once

#include <simdbezier/c/curves.h> // names of edges

SIMDBEZIER_BEGIN_C

// EdgeKind.
enum {
  SIMDBEZIER_EDGE_BOUNDARY,
  SIMDBEZIER_EDGE_SHARED,
  SIMDBEZIER_EDGE_NON_MANIFOLD,
  SIMDBEZIER_EDGE_COLLAPSED
};
// EdgeLink.
typedef struct simdbezier_edge_link {
  uint8_t kind;     // SIMDBEZIER_EDGE_BOUNDARY …
  uint8_t edge;     // SIMDBEZIER_EDGE_V0 …
  uint8_t reversed; // 1: the matching edge runs the other way
  size_t patch;
} simdbezier_edge_link;

// find_adjacency(): 4 links a patch.
SIMDBEZIER_API simdbezier_status simdbezier_find_adjacency(const simdbezier_nets* nets,
                                                           size_t length,
                                                           simdbezier_edge_link* links,
                                                           size_t link_length,
                                                           const simdbezier_options* options);

typedef struct simdbezier_topology simdbezier_topology;
typedef struct simdbezier_mesh_layout simdbezier_mesh_layout;

// TopologyOptions.
typedef struct simdbezier_topology_options {
  size_t struct_size;
  double point_size;
  double snap;
  int32_t orient; // not 0: patches are turned until neighbours agree
  int32_t flip;   // not 0: all patches are turned, after that
  int32_t threads;
} simdbezier_topology_options;

// TopologyCounts.
typedef struct simdbezier_topology_counts {
  size_t struct_size;
  size_t patches;
  size_t edges;
  size_t open_edges;
  size_t non_manifold_edges;
  size_t collapsed_sides;
  size_t corners;
  size_t repeated_patches;
  size_t turned_edges;
  size_t snapped_sides;
  int32_t orientable;
} simdbezier_topology_counts;

// find_topology().
SIMDBEZIER_API simdbezier_status simdbezier_find_topology(
    const simdbezier_nets* nets, size_t length, const simdbezier_topology_options* options,
    simdbezier_topology** topology);
// fits(): 1 or 0. Nets that find_topology() refuses give its status instead.
SIMDBEZIER_API simdbezier_status simdbezier_topology_fits(const simdbezier_topology* topology,
                                                          const simdbezier_nets* nets,
                                                          size_t length, int32_t threads,
                                                          int32_t* fits);
SIMDBEZIER_API void simdbezier_topology_free(simdbezier_topology* topology);
SIMDBEZIER_API simdbezier_status simdbezier_topology_count(const simdbezier_topology* topology,
                                                           simdbezier_topology_counts* counts);
// Topology::is_turned(), is_repeated(); 0 outside of the model.
SIMDBEZIER_API int32_t simdbezier_topology_is_turned(const simdbezier_topology* topology,
                                                     size_t patch);
SIMDBEZIER_API int32_t simdbezier_topology_is_repeated(const simdbezier_topology* topology,
                                                       size_t patch);

// kMostSegments, of a patch in one direction; kMostGridCells, of simdbezier_certify_grids().
enum { SIMDBEZIER_MOST_SEGMENTS = 4096, SIMDBEZIER_MOST_GRID_CELLS = 1 << 20 };

// RateOptions.
typedef struct simdbezier_rate_options {
  size_t struct_size;
  double tolerance;         // 0: none, as below
  const double* tolerances; // one value a patch, or null; with `tolerance`, the smaller counts
  size_t tolerances_length;
  const double* errors; // simdbezier_position_errors(), or null
  size_t errors_length;
  double longest_edge;
  double normal_degrees;
  uint32_t most_segments; // 0: SIMDBEZIER_MOST_SEGMENTS
  int32_t threads;
  simdbezier_isa isa;
  double keep;      // rates hold those of the frame before; below 1: none is kept
  int32_t thorough; // not 0: fewer triangles, in more time; see RateOptions (rates.hpp)
} simdbezier_rate_options;

// Camera. Zeros: its usual values.
typedef struct simdbezier_camera {
  size_t struct_size;
  double eye[3];
  double direction[3]; // all 0: (0, 0, -1)
  double focal_length; // 0: 1000
  double width;        // 0: 1920
  double height;       // 0: 1080
  double nearest;      // 0: 0.001
  int32_t orthographic;
  int32_t skip_outside;
  int32_t skip_back;
} simdbezier_camera;
// pixel_tolerances(): one value a patch.
SIMDBEZIER_API simdbezier_status simdbezier_pixel_tolerances(const simdbezier_nets* nets,
                                                             size_t length,
                                                             const simdbezier_camera* camera,
                                                             double pixels, double* tolerances,
                                                             size_t tolerances_length);

// CertifiedRates: one value a patch each. diagonals: a patch's cells are cut as PatchRates says.
typedef struct simdbezier_rates {
  size_t struct_size;
  uint32_t* cells_u;
  size_t cells_u_length;
  uint32_t* cells_v;
  size_t cells_v_length;
  uint16_t* diagonals;
  size_t diagonals_length;
  double* deviation; // may be null
  size_t deviation_length;
} simdbezier_rates;

// choose_rates(), certify_rates(); the latter reads cells_u and cells_v, and errors may be null.
SIMDBEZIER_API simdbezier_status simdbezier_choose_rates(const simdbezier_nets* nets, size_t length,
                                                         const simdbezier_topology* topology,
                                                         const simdbezier_rate_options* options,
                                                         const simdbezier_rates* rates);
SIMDBEZIER_API simdbezier_status simdbezier_certify_rates(
    const simdbezier_nets* nets, size_t length, const simdbezier_topology* topology,
    const double* errors, size_t errors_length, const simdbezier_rates* rates,
    const simdbezier_options* options);
// certify_grids(): deviation has one value a patch; errors has as many, or is null. Of the options
// of both, threads and isa count.
SIMDBEZIER_API simdbezier_status simdbezier_certify_grids(const simdbezier_nets* nets,
                                                          size_t length, uint32_t cells_u,
                                                          uint32_t cells_v, const double* errors,
                                                          size_t errors_length, double* deviation,
                                                          size_t deviation_length,
                                                          const simdbezier_options* options);
// separate_vertices(): raises small rates; `raised` may be null.
SIMDBEZIER_API simdbezier_status simdbezier_separate_vertices(
    const simdbezier_topology* topology, uint32_t* cells_u, size_t cells_u_length,
    uint32_t* cells_v, size_t cells_v_length, size_t* raised);

// lay_out_mesh(): of cells_u, cells_v and, if not null, diagonals. Of the options, threads count.
SIMDBEZIER_API simdbezier_status simdbezier_lay_out_mesh(const simdbezier_topology* topology,
                                                         const simdbezier_rates* rates,
                                                         const simdbezier_options* options,
                                                         simdbezier_mesh_layout** layout);
SIMDBEZIER_API void simdbezier_mesh_layout_free(simdbezier_mesh_layout* layout);
// MeshLayout::size(), first_triangle(), first_vertex(); 0 of null.
SIMDBEZIER_API size_t simdbezier_mesh_layout_vertices(const simdbezier_mesh_layout* layout);
SIMDBEZIER_API size_t simdbezier_mesh_layout_triangles(const simdbezier_mesh_layout* layout);
SIMDBEZIER_API size_t simdbezier_mesh_layout_first_triangle(const simdbezier_mesh_layout* layout,
                                                            size_t patch);
SIMDBEZIER_API size_t simdbezier_mesh_layout_first_vertex(const simdbezier_mesh_layout* layout,
                                                          size_t patch);

// Parts of a model that several processes work on; single vertices of a layout.

// PatchKeys.
typedef struct simdbezier_patch_keys {
  uint64_t corners[4];
  uint64_t edges[4];
  uint8_t points; // bits: 1 << SIMDBEZIER_EDGE_V0 …
} simdbezier_patch_keys;

// find_patch_keys(): one element a patch.
SIMDBEZIER_API simdbezier_status simdbezier_find_patch_keys(const simdbezier_nets* nets,
                                                            size_t length,
                                                            simdbezier_patch_keys* keys,
                                                            size_t keys_length,
                                                            const simdbezier_options* options);

// PatchVertices. kUnknownVertex is UINT64_MAX.
typedef struct simdbezier_patch_vertices {
  uint64_t corners[4];
  uint64_t edges[4];
} simdbezier_patch_vertices;

// owned_vertices(), number_part(): own patches are own_count from own_first on; here, 0 means none.
SIMDBEZIER_API simdbezier_status simdbezier_owned_vertices(const simdbezier_mesh_layout* part,
                                                           size_t own_first, size_t own_count,
                                                           uint64_t first_vertex,
                                                           simdbezier_patch_vertices* out,
                                                           size_t length);
SIMDBEZIER_API simdbezier_status simdbezier_number_part(const simdbezier_mesh_layout* part,
                                                        size_t own_first, size_t own_count,
                                                        uint64_t first_vertex,
                                                        const simdbezier_patch_vertices* ghosts,
                                                        size_t ghosts_length, uint64_t* numbers,
                                                        size_t numbers_length);

// Topology::is_entangled(); 0 outside of the model.
SIMDBEZIER_API int32_t simdbezier_topology_is_entangled(const simdbezier_topology* topology,
                                                        size_t patch);

// MeshLayout::corner(), segments(), along(), inner(); UINT32_MAX if there is no such vertex.
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_corner(const simdbezier_mesh_layout* layout,
                                                      size_t patch, size_t corner);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_segments(const simdbezier_mesh_layout* layout,
                                                        size_t patch, simdbezier_edge edge);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_along(const simdbezier_mesh_layout* layout,
                                                     size_t patch, simdbezier_edge edge,
                                                     uint32_t k);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_inner(const simdbezier_mesh_layout* layout,
                                                     size_t patch, uint32_t i, uint32_t j);

SIMDBEZIER_END_C
