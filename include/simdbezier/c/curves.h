// curves.hpp, flatten.hpp: curves at parameters, curves on patches, and polylines.
#pragma once

#include <simdbezier/c/sets.h>

SIMDBEZIER_BEGIN_C

// CurveGrid: n parameters of every curve; sample (curve, i) has the index
// (curve - first_curve) * n + i.
typedef struct simdbezier_curve_grid {
  size_t struct_size;
  size_t n;
  const void* t;            // null: uniform, ends included; else n values
  size_t t_length;          // elements behind t
  simdbezier_scalar scalar; // of t, if there is any: that of the set
  simdbezier_parameters parameters;
  size_t first_curve;
  size_t curve_count; // 0: all from first_curve on
} simdbezier_curve_grid;

static inline simdbezier_curve_grid simdbezier_uniform_curve_grid(size_t n) {
  const simdbezier_curve_grid grid = {sizeof grid, n, 0, 0, 0, 0, 0, 0};
  return grid;
}

// CurveGrids: a number of uniform parameters for each of the curves from first_curve on.
typedef struct simdbezier_curve_grids {
  size_t struct_size;
  const uint32_t* n;
  size_t n_length;
  const size_t* offset; // where each curve's samples begin; null: packed without gaps
  size_t offset_length;
  size_t first_curve;
} simdbezier_curve_grids;

// CurveSamples: sample k lies on curve[k] at t[k].
typedef struct simdbezier_curve_samples {
  size_t struct_size;
  const uint32_t* curve;
  size_t curve_length; // the number of samples
  const void* t;
  size_t t_length; // that of curve
  simdbezier_scalar scalar;
  simdbezier_parameters parameters;
} simdbezier_curve_samples;

// CurveOutputs.
typedef struct simdbezier_curve_outputs {
  size_t struct_size;
  simdbezier_vectors position;
  simdbezier_vectors d1;
  simdbezier_vectors d2;
  simdbezier_vectors tangent;
  simdbezier_values curvature;
  uint8_t* status;
  size_t status_length;
  int32_t first_component;
} simdbezier_curve_outputs;

// evaluate() of curves. input_too_small also for fewer t than n.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_curve_grid(const simdbezier_curve_set* set,
                                                                const simdbezier_curve_grid* grid,
                                                                const simdbezier_curve_outputs* out,
                                                                const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_curve_grids(
    const simdbezier_curve_set* set, const simdbezier_curve_grids* grids,
    const simdbezier_curve_outputs* out, const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_curve_samples(
    const simdbezier_curve_set* set, const simdbezier_curve_samples* samples,
    const simdbezier_curve_outputs* out, const simdbezier_options* options);

// sample_count() of curves, as of patches.
SIMDBEZIER_API size_t simdbezier_curve_grid_sample_count(const simdbezier_curve_set* set,
                                                         const simdbezier_curve_grid* grid);
SIMDBEZIER_API size_t simdbezier_curve_grids_sample_count(const simdbezier_curve_set* set,
                                                          const simdbezier_curve_grids* grids);

// PatchEdge.
typedef int32_t simdbezier_edge;
enum { SIMDBEZIER_EDGE_V0, SIMDBEZIER_EDGE_V1, SIMDBEZIER_EDGE_U0, SIMDBEZIER_EDGE_U1 };

// boundary_curves(): the control points of one edge of every net, in the memory of the nets.
// Returns the statuses of views, null_output, and what the C form adds.
SIMDBEZIER_API simdbezier_status simdbezier_boundary_curves(const simdbezier_nets* nets,
                                                            simdbezier_edge edge,
                                                            simdbezier_control_curves* curves);

// iso_u(), iso_v() of a set of patches: the curves S(u0, .) and S(., v0), packed in the set's type.
SIMDBEZIER_API simdbezier_status simdbezier_iso_u(const simdbezier_patch_set* patches, double u0,
                                                  const simdbezier_pack_options* options,
                                                  simdbezier_curve_set** curves);
SIMDBEZIER_API simdbezier_status simdbezier_iso_v(const simdbezier_patch_set* patches, double v0,
                                                  const simdbezier_pack_options* options,
                                                  simdbezier_curve_set** curves);
// The control points of the same curves, from nets: packed, `length` elements behind `points`.
SIMDBEZIER_API simdbezier_status simdbezier_iso_u_points(const simdbezier_nets* nets, double u0,
                                                         double* points, size_t length,
                                                         const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_iso_v_points(const simdbezier_nets* nets, double v0,
                                                         double* points, size_t length,
                                                         const simdbezier_options* options);

// flatten.hpp: curves as polylines within a tolerance; simdbezier_flatten() does both steps.
//
//     simdbezier_choose_polylines(&curves, &options, points, count, NULL, 0);   sizes first
//     grids.n = points;                                                         then points
//     simdbezier_evaluate_curve_grids(set, &grids, &out, NULL);

enum { SIMDBEZIER_MOST_POLYLINE_POINTS = 65537 }; // kMostPolylinePoints

// FlattenOptions.
typedef struct simdbezier_flatten_options {
  size_t struct_size;
  double tolerance;         // 0: none
  const double* tolerances; // one value a curve, or null; with `tolerance`, the smaller counts
  size_t tolerances_length;
  const double* errors; // simdbezier_curve_position_errors(), or null
  size_t errors_length;
  uint32_t most_points; // 0: SIMDBEZIER_MOST_POLYLINE_POINTS
  int32_t threads;      // as in simdbezier_options
} simdbezier_flatten_options;

// choose_polylines(): points and deviation have one value a curve, and deviation may be null.
SIMDBEZIER_API simdbezier_status simdbezier_choose_polylines(
    const simdbezier_control_curves* curves, const simdbezier_flatten_options* options,
    uint32_t* points, size_t points_length, double* deviation, size_t deviation_length);

typedef struct simdbezier_polylines simdbezier_polylines;

// What polylines consist of. The arrays belong to them.
typedef struct simdbezier_polyline_arrays {
  size_t struct_size;
  simdbezier_scalar scalar; // of points
  size_t curves;
  size_t vertices;     // of all polylines
  const void* points;  // 3 a vertex; null if there is none
  const size_t* first; // of every curve among the vertices, and the end of the last
  double deviation;
} simdbezier_polyline_arrays;

// flatten(): polylines whose points have the type `scalar`.
SIMDBEZIER_API simdbezier_status simdbezier_flatten(const simdbezier_control_curves* curves,
                                                    simdbezier_scalar scalar, double tolerance,
                                                    const simdbezier_options* options,
                                                    simdbezier_polylines** polylines);
SIMDBEZIER_API void simdbezier_polylines_free(simdbezier_polylines* polylines);
SIMDBEZIER_API simdbezier_status simdbezier_polylines_look(const simdbezier_polylines* polylines,
                                                           simdbezier_polyline_arrays* arrays);

SIMDBEZIER_END_C
