// splines.hpp: B-spline and NURBS surfaces and curves with knots. Surfaces of a call have one
// number type; their knots, ranges and parameters are double whatever it is.
#pragma once

#include <simdbezier/c/evaluate.h>
#include <simdbezier/c/meshes.h>

SIMDBEZIER_BEGIN_C

// SplineSurface: component c of control point (row, column) is points[first + row * row_stride +
// column * point_stride + c * component_stride], with a weight behind; u runs along a row.
typedef struct simdbezier_spline_surface {
  size_t struct_size;
  const void* points;
  size_t length;   // elements behind `points`; all values lie within
  ptrdiff_t first; // not 0 if a stride is negative
  size_t rows;     // degree_v + 1 or more; periodic: degree_v or more
  size_t columns;
  ptrdiff_t row_stride;
  ptrdiff_t point_stride;
  ptrdiff_t component_stride;
  const double* knots_u; // columns + degree_u + 1 of them, periodic: columns + 1; null: uniform
  size_t knots_u_length;
  const double* knots_v;
  size_t knots_v_length;
  double u_begin; // a part of the domain; equal: the whole of it
  double u_end;
  double v_begin;
  double v_end;
  double knot_tolerance;
  int32_t degree_u; // 1 to SIMDBEZIER_MOST_DEGREE
  int32_t degree_v;
  int32_t components; // 1 to SIMDBEZIER_MOST_COMPONENTS
  simdbezier_weights weights;
  simdbezier_scalar scalar;
  int32_t periodic_u;
  int32_t periodic_v;
} simdbezier_spline_surface;

// SplineCurve, in the same way.
typedef struct simdbezier_spline_curve {
  size_t struct_size;
  const void* points;
  size_t length;
  ptrdiff_t first;
  size_t count; // control points
  ptrdiff_t point_stride;
  ptrdiff_t component_stride;
  const double* knots;
  size_t knots_length;
  double begin;
  double end;
  double knot_tolerance;
  int32_t degree;
  int32_t components;
  simdbezier_weights weights;
  simdbezier_scalar scalar;
  int32_t periodic;
} simdbezier_spline_curve;

// PatchInterval: u = (U - u_begin) / (u_end - u_begin). Interval: that of a piece of a curve.
typedef struct simdbezier_patch_interval {
  double u_begin;
  double u_end;
  double v_begin;
  double v_end;
} simdbezier_patch_interval;
typedef struct simdbezier_interval {
  double begin;
  double end;
} simdbezier_interval;

// SplinePlaces: arrays of `length` elements; null: not asked for. Curves have no v and length_v.
typedef struct simdbezier_spline_places {
  size_t struct_size;
  size_t length;
  uint32_t* patch;
  double* u;
  double* v;
  double* length_u;
  double* length_v;
  double* centred_u;
  double* centred_v;
} simdbezier_spline_places;

// Control points with all values side by side, row after row, and uniform knots; set others later.
static inline simdbezier_spline_surface
simdbezier_packed_spline_surface_of(const void* points, size_t length, size_t rows, size_t columns,
                                    int32_t degree_u, int32_t degree_v, int32_t components,
                                    simdbezier_weights weights, simdbezier_scalar scalar) {
  simdbezier_spline_surface surface = {
      sizeof surface, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  surface.points = points;
  surface.length = length;
  surface.rows = rows;
  surface.columns = columns;
  surface.point_stride = (ptrdiff_t)components + (weights == SIMDBEZIER_POLYNOMIAL ? 0 : 1);
  surface.row_stride = (ptrdiff_t)((size_t)surface.point_stride * columns);
  surface.degree_u = degree_u;
  surface.degree_v = degree_v;
  surface.components = components;
  surface.weights = weights;
  surface.scalar = scalar;
  return surface;
}
static inline simdbezier_spline_curve
simdbezier_packed_spline_curve_of(const void* points, size_t length, size_t count, int32_t degree,
                                  int32_t components, simdbezier_weights weights,
                                  simdbezier_scalar scalar) {
  simdbezier_spline_curve curve = {sizeof curve, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  curve.points = points;
  curve.length = length;
  curve.count = count;
  curve.point_stride = (ptrdiff_t)components + (weights == SIMDBEZIER_POLYNOMIAL ? 0 : 1);
  curve.degree = degree;
  curve.components = components;
  curve.weights = weights;
  curve.scalar = scalar;
  return curve;
}
// simdbezier_packed_spline_surface_f32(), …_f64(), and those of curves.
#define SIMDBEZIER_PACKED_SPLINES(suffix, Number, TYPE)                                            \
  static inline simdbezier_spline_surface simdbezier_packed_spline_surface_##suffix(               \
      const Number* points, size_t length, size_t rows, size_t columns, int32_t degree_u,          \
      int32_t degree_v, int32_t components, simdbezier_weights weights) {                          \
    return simdbezier_packed_spline_surface_of(points, length, rows, columns, degree_u, degree_v,  \
                                               components, weights, TYPE);                         \
  }                                                                                                \
  static inline simdbezier_spline_curve simdbezier_packed_spline_curve_##suffix(                   \
      const Number* points, size_t length, size_t count, int32_t degree, int32_t components,       \
      simdbezier_weights weights) {                                                                \
    return simdbezier_packed_spline_curve_of(points, length, count, degree, components, weights,   \
                                             TYPE);                                                \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_PACKED_SPLINES)

// Faults of all calls below: simdbezier_fault::patch is the spline at fault, and `point` its
// control point (row * columns + column), its knot, or the parameter, as the argument says.

// span_count(): the points are not read.
SIMDBEZIER_API simdbezier_status simdbezier_spline_span_count(
    const simdbezier_spline_surface* surface, size_t* spans_u, size_t* spans_v);
SIMDBEZIER_API simdbezier_status
simdbezier_spline_curve_span_count(const simdbezier_spline_curve* curve, size_t* spans);

// to_bezier(): intervals may be null if intervals_length is 0.
SIMDBEZIER_API simdbezier_status simdbezier_spline_to_bezier(
    const simdbezier_spline_surface* surfaces, size_t length, const simdbezier_mutable_nets* out,
    simdbezier_patch_interval* intervals, size_t intervals_length,
    const simdbezier_options* options);
// Pieces of a curve: `points` are then what simdbezier_packed_curves_of() takes.
SIMDBEZIER_API simdbezier_status simdbezier_spline_curve_to_bezier(
    const simdbezier_spline_curve* curve, simdbezier_values points, simdbezier_interval* intervals,
    size_t intervals_length, const simdbezier_options* options);

// pack(): a set whose results have the type `scalar`.
SIMDBEZIER_API simdbezier_status simdbezier_spline_pack(const simdbezier_spline_surface* surfaces,
                                                        size_t length, simdbezier_scalar scalar,
                                                        simdbezier_patch_interval* intervals,
                                                        size_t intervals_length,
                                                        const simdbezier_pack_options* options,
                                                        simdbezier_patch_set** set);

// locate(): u and v are parameters of the spline, equally many. The points are not read.
// Samples of curves: locate them, pass centred_u to simdbezier_evaluate_curve_samples(), and divide
// d1 by length_u and d2 by its square.
SIMDBEZIER_API simdbezier_status simdbezier_spline_locate(const simdbezier_spline_surface* surface,
                                                          const double* u, size_t u_length,
                                                          const double* v, size_t v_length,
                                                          const simdbezier_spline_places* places);
SIMDBEZIER_API simdbezier_status
simdbezier_spline_curve_locate(const simdbezier_spline_curve* curve, const double* t,
                               size_t t_length, const simdbezier_spline_places* places);

// evaluate_grid(), evaluate_samples() of splines: the surface's patches are those of the set from
// first_patch on. u, v and derivatives are in the spline's parameters. The points are not read.
SIMDBEZIER_API simdbezier_status simdbezier_spline_evaluate_grid(
    const simdbezier_patch_set* set, const simdbezier_spline_surface* surface, const double* u,
    size_t u_length, const double* v, size_t v_length, const simdbezier_outputs* out,
    const simdbezier_options* options, size_t first_patch);
SIMDBEZIER_API simdbezier_status simdbezier_spline_evaluate_samples(
    const simdbezier_patch_set* set, const simdbezier_spline_surface* surface, const double* u,
    size_t u_length, const double* v, size_t v_length, const simdbezier_outputs* out,
    const simdbezier_options* options, size_t first_patch);

// tessellate(), plan_mesh() of splines.
SIMDBEZIER_API simdbezier_status simdbezier_spline_tessellate(
    const simdbezier_spline_surface* surfaces, size_t length, simdbezier_scalar scalar,
    const simdbezier_mesh_options* options, simdbezier_mesh** mesh);
SIMDBEZIER_API simdbezier_status simdbezier_spline_plan_mesh(
    const simdbezier_spline_surface* surfaces, size_t length, simdbezier_scalar scalar,
    const simdbezier_mesh_options* options, simdbezier_mesh_plan** plan);

SIMDBEZIER_END_C
