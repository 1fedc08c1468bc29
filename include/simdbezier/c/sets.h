// Packed sets: control_nets.hpp, patch_set.hpp, bounds.hpp.
#pragma once

#include <simdbezier/c/types.h>

SIMDBEZIER_BEGIN_C

// kMostDegree, in each direction; kMostComponents, of a point without its weight.
enum { SIMDBEZIER_MOST_DEGREE = 15, SIMDBEZIER_MOST_COMPONENTS = 16 };

// ControlNets: component c of control point P[j][i] of net p is points[first + p * net_stride +
// j * row_stride + i * point_stride + c * component_stride]; a weight stands behind the components.
typedef struct simdbezier_nets {
  size_t struct_size;
  const void* points; // may be null only if count is 0
  size_t length;      // elements behind `points`; all values lie within
  ptrdiff_t first;    // not 0 if a stride is negative: the net seen from its other end
  size_t count;
  ptrdiff_t net_stride;
  ptrdiff_t row_stride;
  ptrdiff_t point_stride;
  ptrdiff_t component_stride;
  int32_t degree_u; // 1 to SIMDBEZIER_MOST_DEGREE
  int32_t degree_v;
  int32_t components; // 1 to SIMDBEZIER_MOST_COMPONENTS
  simdbezier_weights weights;
  simdbezier_scalar scalar;
} simdbezier_nets;

// MutableNets: the description of nets in memory that a call writes to.
typedef struct simdbezier_mutable_nets {
  size_t struct_size;
  void* points;
  size_t length;
  ptrdiff_t first;
  size_t count;
  ptrdiff_t net_stride;
  ptrdiff_t row_stride;
  ptrdiff_t point_stride;
  ptrdiff_t component_stride;
  int32_t degree_u;
  int32_t degree_v;
  int32_t components;
  simdbezier_weights weights;
  simdbezier_scalar scalar;
} simdbezier_mutable_nets;

// ControlCurves: component c of point P[i] of curve k is points[first + k * curve_stride +
// i * point_stride + c * component_stride]; a weight stands behind the components.
typedef struct simdbezier_control_curves {
  size_t struct_size;
  const void* points;
  size_t length;
  ptrdiff_t first;
  size_t count;
  ptrdiff_t curve_stride;
  ptrdiff_t point_stride;
  ptrdiff_t component_stride;
  int32_t degree;
  int32_t components;
  simdbezier_weights weights;
  simdbezier_scalar scalar;
} simdbezier_control_curves;

// Nets with all values side by side, u fastest: as many nets as `points` contains. An incomplete
// last one counts; calls then refuse it.
#define SIMDBEZIER_PACKED_OF(kind, Void)                                                           \
  static inline simdbezier_##kind simdbezier_packed_##kind##_of(                                   \
      Void* points, size_t length, int32_t degree_u, int32_t degree_v, int32_t components,         \
      simdbezier_weights weights, simdbezier_scalar scalar) {                                      \
    const ptrdiff_t point = (ptrdiff_t)components + (weights == SIMDBEZIER_POLYNOMIAL ? 0 : 1);    \
    const ptrdiff_t row = ((ptrdiff_t)degree_u + 1) * point;                                       \
    const ptrdiff_t net = ((ptrdiff_t)degree_v + 1) * row;                                         \
    const size_t values = net < 1 ? 1 : (size_t)net;                                               \
    simdbezier_##kind nets = {sizeof nets, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};                 \
    nets.points = points;                                                                          \
    nets.length = length;                                                                          \
    nets.count = length / values + (length % values == 0 ? 0 : 1);                                 \
    nets.net_stride = net;                                                                         \
    nets.row_stride = row;                                                                         \
    nets.point_stride = point;                                                                     \
    nets.degree_u = degree_u;                                                                      \
    nets.degree_v = degree_v;                                                                      \
    nets.components = components;                                                                  \
    nets.weights = weights;                                                                        \
    nets.scalar = scalar;                                                                          \
    return nets;                                                                                   \
  }
SIMDBEZIER_PACKED_OF(nets, const void)
SIMDBEZIER_PACKED_OF(mutable_nets, void)

static inline simdbezier_control_curves
simdbezier_packed_curves_of(const void* points, size_t length, int32_t degree, int32_t components,
                            simdbezier_weights weights, simdbezier_scalar scalar) {
  // A curve is a net of one row.
  const simdbezier_nets like =
      simdbezier_packed_nets_of(points, length, degree, 0, components, weights, scalar);
  simdbezier_control_curves curves = {sizeof curves, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0};
  curves.points = points;
  curves.length = length;
  curves.count = like.count;
  curves.curve_stride = like.net_stride;
  curves.point_stride = like.point_stride;
  curves.degree = degree;
  curves.components = components;
  curves.weights = weights;
  curves.scalar = scalar;
  return curves;
}
// simdbezier_packed_nets_f32(), …_f64(), and those of mutable nets and curves.
#define SIMDBEZIER_PACKED(suffix, Number, TYPE)                                                    \
  static inline simdbezier_nets simdbezier_packed_nets_##suffix(                                   \
      const Number* points, size_t length, int32_t degree_u, int32_t degree_v, int32_t components, \
      simdbezier_weights weights) {                                                                \
    return simdbezier_packed_nets_of(points, length, degree_u, degree_v, components, weights,      \
                                     TYPE);                                                        \
  }                                                                                                \
  static inline simdbezier_mutable_nets simdbezier_packed_mutable_nets_##suffix(                   \
      Number* points, size_t length, int32_t degree_u, int32_t degree_v, int32_t components,       \
      simdbezier_weights weights) {                                                                \
    return simdbezier_packed_mutable_nets_of(points, length, degree_u, degree_v, components,       \
                                             weights, TYPE);                                       \
  }                                                                                                \
  static inline simdbezier_control_curves simdbezier_packed_curves_##suffix(                       \
      const Number* points, size_t length, int32_t degree, int32_t components,                     \
      simdbezier_weights weights) {                                                                \
    return simdbezier_packed_curves_of(points, length, degree, components, weights, TYPE);         \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_PACKED)

// PackOptions.
typedef struct simdbezier_pack_options {
  size_t struct_size;
  int32_t local_origin; // not 0: positions are formed around an origin of each patch's own
  int32_t threads;      // 0: as many as the call is worth; 1: the calling thread alone
  simdbezier_isa isa;
  double relative_to[3];
} simdbezier_pack_options;

typedef struct simdbezier_patch_set simdbezier_patch_set;
typedef struct simdbezier_curve_set simdbezier_curve_set;

// pack(): a set whose results have the type `scalar`. All nets have one type, and this may be
// another one.
SIMDBEZIER_API simdbezier_status simdbezier_pack(const simdbezier_nets* nets, size_t length,
                                                 simdbezier_scalar scalar,
                                                 const simdbezier_pack_options* options,
                                                 simdbezier_patch_set** set);
SIMDBEZIER_API void simdbezier_patch_set_free(simdbezier_patch_set* set);

// pack() of curves.
SIMDBEZIER_API simdbezier_status simdbezier_pack_curves(const simdbezier_control_curves* curves,
                                                        simdbezier_scalar scalar,
                                                        const simdbezier_pack_options* options,
                                                        simdbezier_curve_set** set);
SIMDBEZIER_API void simdbezier_curve_set_free(simdbezier_curve_set* set);

// PatchSet and PatchShape. Of null: 0.
typedef struct simdbezier_patch_shape {
  size_t struct_size;
  int32_t degree_u;
  int32_t degree_v;
  int32_t components;
  int32_t rational;
} simdbezier_patch_shape;
SIMDBEZIER_API size_t simdbezier_patch_set_size(const simdbezier_patch_set* set);
SIMDBEZIER_API simdbezier_scalar simdbezier_patch_set_scalar(const simdbezier_patch_set* set);
SIMDBEZIER_API int32_t simdbezier_patch_set_components(const simdbezier_patch_set* set);
SIMDBEZIER_API int32_t simdbezier_patch_set_has_local_origins(const simdbezier_patch_set* set);
// Returns ok | null_input | null_output | bad_struct_size | bad_patch_range.
SIMDBEZIER_API simdbezier_status simdbezier_patch_set_shape(const simdbezier_patch_set* set,
                                                            size_t patch,
                                                            simdbezier_patch_shape* shape);

// CurveSet; all curves have one shape. Of null: 0.
SIMDBEZIER_API size_t simdbezier_curve_set_size(const simdbezier_curve_set* set);
SIMDBEZIER_API simdbezier_scalar simdbezier_curve_set_scalar(const simdbezier_curve_set* set);
SIMDBEZIER_API int32_t simdbezier_curve_set_degree(const simdbezier_curve_set* set);
SIMDBEZIER_API int32_t simdbezier_curve_set_components(const simdbezier_curve_set* set);
SIMDBEZIER_API int32_t simdbezier_curve_set_rational(const simdbezier_curve_set* set);
SIMDBEZIER_API int32_t simdbezier_curve_set_has_local_origins(const simdbezier_curve_set* set);

// ErrorBounds: absolute bounds a component, 0 if there is no such component.
typedef struct simdbezier_error_bounds_of_patch {
  size_t struct_size;
  double position[SIMDBEZIER_MOST_COMPONENTS];
  double du[SIMDBEZIER_MOST_COMPONENTS];
  double dv[SIMDBEZIER_MOST_COMPONENTS];
} simdbezier_error_bounds_of_patch;
typedef struct simdbezier_error_bounds_of_curve {
  size_t struct_size;
  double position[SIMDBEZIER_MOST_COMPONENTS];
  double d1[SIMDBEZIER_MOST_COMPONENTS];
  double d2[SIMDBEZIER_MOST_COMPONENTS];
} simdbezier_error_bounds_of_curve;
// error_bounds(). Return ok | null_input | null_output | bad_struct_size | bad_patch_range |
// bad_value | unknown_isa | unsupported_isa.
SIMDBEZIER_API simdbezier_status
simdbezier_patch_error_bounds(const simdbezier_patch_set* set, size_t patch, simdbezier_isa isa,
                              simdbezier_error_bounds_of_patch* bounds);
SIMDBEZIER_API simdbezier_status
simdbezier_curve_error_bounds(const simdbezier_curve_set* set, size_t curve, simdbezier_isa isa,
                              simdbezier_error_bounds_of_curve* bounds);
// largest_position_bound(), position_errors(). Errors are one value a patch or a curve. Of the
// options, these calls read threads and isa only.
SIMDBEZIER_API simdbezier_status simdbezier_largest_position_bound(const simdbezier_patch_set* set,
                                                                   simdbezier_isa isa,
                                                                   double* bound);
SIMDBEZIER_API simdbezier_status simdbezier_position_errors(const simdbezier_patch_set* set,
                                                            double* errors, size_t length,
                                                            const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status
simdbezier_curve_position_errors(const simdbezier_curve_set* set, double* errors, size_t length,
                                 const simdbezier_options* options);

SIMDBEZIER_END_C
