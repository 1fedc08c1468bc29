// mesh_layout.hpp, evaluate_mesh.hpp, mesh.hpp: the cells of a mesh as triangles, polygons,
// strips or clusters; its vertices; all of it in one call.
#pragma once

#include <simdbezier/c/models.h>

SIMDBEZIER_BEGIN_C

// The patches whose primitives are written, and how. Null: all patches.
typedef struct simdbezier_primitive_options {
  size_t struct_size;
  size_t first_patch;
  size_t patch_count;                 // 0: all from first_patch on
  int32_t threads;                    // as in simdbezier_options
  simdbezier_destination destination; // of triangles; others are never streamed
} simdbezier_primitive_options;

// write_triangles(): three numbers a triangle. `length` counts elements, as everywhere.
SIMDBEZIER_API simdbezier_status
simdbezier_write_triangles_u32(const simdbezier_mesh_layout* layout, uint32_t* triangles,
                               size_t length, const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status
simdbezier_write_triangles_u16(const simdbezier_mesh_layout* layout, uint16_t* triangles,
                               size_t length, const simdbezier_primitive_options* options);

// polygon_size(), write_polygons(): quads and triangles; sizes contains a 3 or 4 for each polygon.
SIMDBEZIER_API simdbezier_status
simdbezier_polygon_size(const simdbezier_mesh_layout* layout, size_t* polygons, size_t* indices,
                        const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_write_polygons_u32(
    const simdbezier_mesh_layout* layout, uint32_t* indices, size_t length, uint8_t* sizes,
    size_t sizes_length, const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_write_polygons_u16(
    const simdbezier_mesh_layout* layout, uint16_t* indices, size_t length, uint8_t* sizes,
    size_t sizes_length, const simdbezier_primitive_options* options);

// strip_size(), write_strips(): the largest index ends a strip.
SIMDBEZIER_API simdbezier_status simdbezier_strip_size(const simdbezier_mesh_layout* layout,
                                                       size_t* indices,
                                                       const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status
simdbezier_write_strips_u32(const simdbezier_mesh_layout* layout, uint32_t* indices, size_t length,
                            const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status
simdbezier_write_strips_u16(const simdbezier_mesh_layout* layout, uint16_t* indices, size_t length,
                            const simdbezier_primitive_options* options);

// kMostClusterTriangles, kMostClusterVertices.
enum { SIMDBEZIER_MOST_CLUSTER_TRIANGLES = 128, SIMDBEZIER_MOST_CLUSTER_VERTICES = 128 };

// MeshCluster.
typedef struct simdbezier_cluster {
  uint32_t first_vertex;
  uint32_t first_triangle;
  uint32_t vertices;
  uint32_t triangles;
  uint32_t patch;
} simdbezier_cluster;

// cluster_size(), write_clusters(): corners contains three values a triangle.
SIMDBEZIER_API simdbezier_status
simdbezier_cluster_size(const simdbezier_mesh_layout* layout, size_t* clusters, size_t* vertices,
                        size_t* triangles, const simdbezier_primitive_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_write_clusters(
    const simdbezier_mesh_layout* layout, simdbezier_cluster* clusters, size_t clusters_length,
    uint32_t* vertices, size_t vertices_length, uint8_t* corners, size_t corners_length,
    const simdbezier_primitive_options* options);

// MeshOutputs. The x of `parameters` is u, and its y is v.
typedef struct simdbezier_mesh_outputs {
  size_t struct_size;
  simdbezier_vectors position;
  simdbezier_vectors normal;
  simdbezier_vectors parameters;
  uint32_t* patch; // null: not asked for
  size_t patch_length;
} simdbezier_mesh_outputs;

// evaluate_mesh(), evaluate_mesh_attributes() from first_patch on; patch_count 0: to the end.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_mesh(const simdbezier_patch_set* set,
                                                          const simdbezier_mesh_layout* layout,
                                                          const simdbezier_mesh_outputs* out,
                                                          const simdbezier_options* options,
                                                          size_t first_patch, size_t patch_count);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_mesh_attributes(
    const simdbezier_patch_set* set, const simdbezier_mesh_layout* layout,
    const simdbezier_vectors* out, int32_t first_component, const simdbezier_options* options,
    size_t first_patch, size_t patch_count);
// split_creases().
SIMDBEZIER_API simdbezier_status simdbezier_split_creases(const simdbezier_patch_set* set,
                                                          const simdbezier_mesh_layout* layout,
                                                          double degrees,
                                                          const simdbezier_options* options,
                                                          simdbezier_mesh_layout** split);
// split_parameters().
SIMDBEZIER_API simdbezier_status simdbezier_split_parameters(const simdbezier_mesh_layout* layout,
                                                             simdbezier_mesh_layout** split);

// MeshOptions. One member at least has to say how fine the mesh is: a tolerance, pixels, a longest
// edge, an angle between normals, or a grid.
typedef struct simdbezier_mesh_options {
  size_t struct_size;
  double tolerance;          // 0: none, as below
  double relative_tolerance; // a share of the diagonal of the box of all control points
  const double* tolerances;  // one a patch, or null
  size_t tolerances_length;
  double pixels;
  const simdbezier_camera* camera; // needed by pixels
  double longest_edge;
  double normal_degrees;
  uint32_t nu; // samples of every patch, instead of tolerances
  uint32_t nv;
  double point_size;
  double snap;
  double crease_degrees; // 0: none, all normals are merged
  int32_t unshared;      // not 0: patches share no vertices, as with crease_degrees = 0 in C++
  int32_t orient;
  int32_t flip;
  int32_t drop_repeated;
  int32_t no_normals;
  int32_t parameters; // not 0: u, v and patch of every vertex; patches then share no vertices
  int32_t short_indices;
  int32_t local_origin;
  int32_t threads;
  simdbezier_isa isa;
  int32_t split_edges; // not 0: patches are cut at corners of others on their open sides
  int32_t thorough;    // as in simdbezier_rate_options
} simdbezier_mesh_options;

typedef struct simdbezier_mesh simdbezier_mesh;

// What a mesh consists of. The arrays belong to the mesh; those that it lacks are null.
typedef struct simdbezier_mesh_arrays {
  size_t struct_size;
  simdbezier_scalar scalar; // of positions, normals and parameters
  size_t vertices;
  size_t triangles;
  const void* positions;         // 3 a vertex
  const void* normals;           // 3 a vertex
  const void* parameters;        // 2 a vertex
  const uint32_t* patches;       // 1 a vertex
  const uint32_t* indices;       // 3 a triangle
  const uint16_t* short_indices; // instead of `indices`
  const double* deviations;      // 1 a patch
  size_t patches_given;
  double deviation;
  size_t splits; // this and the two below: SplitCounts
  size_t unjoined;
  double largest_gap;
} simdbezier_mesh_arrays;

// tessellate(): a mesh whose vertices have the type `scalar`.
SIMDBEZIER_API simdbezier_status simdbezier_tessellate(const simdbezier_nets* nets, size_t length,
                                                       simdbezier_scalar scalar,
                                                       const simdbezier_mesh_options* options,
                                                       simdbezier_mesh** mesh);
SIMDBEZIER_API void simdbezier_mesh_free(simdbezier_mesh* mesh);
SIMDBEZIER_API simdbezier_status simdbezier_mesh_look(const simdbezier_mesh* mesh,
                                                      simdbezier_mesh_arrays* arrays);
// TopologyCounts of all patches given.
SIMDBEZIER_API simdbezier_status simdbezier_mesh_count(const simdbezier_mesh* mesh,
                                                       simdbezier_topology_counts* counts);

typedef struct simdbezier_mesh_plan simdbezier_mesh_plan;

// PatchPiece: which part of a given patch one patch of the set is.
typedef struct simdbezier_patch_piece {
  uint32_t patch;
  double u0;
  double u1;
  double v0;
  double v1;
  double error;
} simdbezier_patch_piece;

// MeshPlan. Handles and arrays belong to the plan, and end with it.
typedef struct simdbezier_mesh_plan_parts {
  size_t struct_size;
  const simdbezier_patch_set* set;
  const simdbezier_topology* topology;
  const simdbezier_mesh_layout* layout;
  size_t patch_count;      // of the set: that many values each below
  const uint32_t* patches; // the number of each among those given; null: the same numbers
  const uint32_t* cells_u;
  const uint32_t* cells_v;
  const double* deviations;
  double deviation;
  double diagonal;
  const simdbezier_patch_piece* pieces; // null if nothing was cut
  size_t splits;                        // as in simdbezier_mesh_arrays
  size_t unjoined;
  double largest_gap;
} simdbezier_mesh_plan_parts;

// plan_mesh(): what simdbezier_tessellate() evaluates.
SIMDBEZIER_API simdbezier_status simdbezier_plan_mesh(const simdbezier_nets* nets, size_t length,
                                                      simdbezier_scalar scalar,
                                                      const simdbezier_mesh_options* options,
                                                      simdbezier_mesh_plan** plan);
SIMDBEZIER_API void simdbezier_mesh_plan_free(simdbezier_mesh_plan* plan);
SIMDBEZIER_API simdbezier_status simdbezier_mesh_plan_look(const simdbezier_mesh_plan* plan,
                                                           simdbezier_mesh_plan_parts* parts);
SIMDBEZIER_API simdbezier_status simdbezier_mesh_plan_count(const simdbezier_mesh_plan* plan,
                                                            simdbezier_topology_counts* counts);

// Vertices of a mesh in the formats that graphics processors and glTF read.

// VertexFormat: evaluate_mesh.hpp says how far a stored value is from the vertex's own value.
typedef int32_t simdbezier_vertex_format;
enum {
  SIMDBEZIER_FORMAT_FLOAT32,
  SIMDBEZIER_FORMAT_HALF,
  SIMDBEZIER_FORMAT_UNORM16,
  SIMDBEZIER_FORMAT_SNORM16,
  SIMDBEZIER_FORMAT_OCTAHEDRAL16,
  SIMDBEZIER_FORMAT_OCTAHEDRAL8
};
// format_bytes(); 0 for other numbers.
SIMDBEZIER_API size_t simdbezier_format_bytes(simdbezier_vertex_format format, size_t components);

// FormattedOutput: the output of vertex k goes to the bytes from first + k * stride on, which may
// have any alignment. All zero: not asked for.
typedef struct simdbezier_formatted_output {
  void* first;
  size_t capacity;  // vertices that there is room for
  ptrdiff_t stride; // in bytes; 0: packed
  simdbezier_vertex_format format;
} simdbezier_formatted_output;

// QuantisationBox: position = low + step q.
typedef struct simdbezier_quantisation_box {
  double low[3];
  double step;
} simdbezier_quantisation_box;

// quantisation_box(): of all control points, for unorm16 or snorm16.
SIMDBEZIER_API simdbezier_status simdbezier_find_quantisation_box(const simdbezier_nets* nets,
                                                                  size_t length,
                                                                  simdbezier_vertex_format format,
                                                                  simdbezier_quantisation_box* box);

// FormattedOutputs.
typedef struct simdbezier_formatted_outputs {
  size_t struct_size;
  simdbezier_formatted_output position;
  simdbezier_formatted_output normal;
  simdbezier_formatted_output parameters;
  simdbezier_quantisation_box box; // of positions as unorm16 or snorm16
} simdbezier_formatted_outputs;

// evaluate_mesh() into formats, from first_patch on; patch_count 0: to the end.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_formatted_mesh(
    const simdbezier_patch_set* set, const simdbezier_mesh_layout* layout,
    const simdbezier_formatted_outputs* out, const simdbezier_options* options, size_t first_patch,
    size_t patch_count);

SIMDBEZIER_END_C
