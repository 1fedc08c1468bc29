// flatten.hpp: curves as polylines within a tolerance; simdbezier_flatten() does both steps.
//
//     simdbezier_choose_polylines(&curves, &options, points, count, NULL, 0);   sizes first
//     grids.n = points;                                                         then points
//     simdbezier_evaluate_curve_grids(set, &grids, &out, NULL);
#pragma once

#include <simdbezier/c/sets.h>

SIMDBEZIER_BEGIN_C

enum { SIMDBEZIER_MOST_POLYLINE_POINTS = 65537 }; // kMostPolylinePoints

// FlattenOptions.
typedef struct simdbezier_flatten_options {
  size_t struct_size;
  double tolerance;         // 0: none
  const double* tolerances; // one value a curve, in addition to `tolerance`; or null
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
