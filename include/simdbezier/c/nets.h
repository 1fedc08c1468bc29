// nets.hpp, bounds.hpp: nets from nets, and bounds. Nets of a call have one type.
#pragma once

#include <simdbezier/c/sets.h>

SIMDBEZIER_BEGIN_C

// UnitParameter: t together with 1 - t, in the type of the nets. Made by the functions below.
typedef struct simdbezier_parameter {
  double value;
  int32_t denominator; // 0: t = value; else t = value / denominator, for integer values
  int32_t from_end;    // not 0: 1 - t is meant
} simdbezier_parameter;

static inline simdbezier_parameter simdbezier_at(double t) {
  const simdbezier_parameter parameter = {t, 0, 0};
  return parameter;
}
static inline simdbezier_parameter simdbezier_from_end(double complement) {
  const simdbezier_parameter parameter = {complement, 0, 1};
  return parameter;
}
static inline simdbezier_parameter simdbezier_fraction(int32_t i, int32_t n) {
  const simdbezier_parameter parameter = {(double)i, n, 0};
  return parameter;
}

// split_u(), split_v(), split(): out[2 * (v half) + (u half)] has four elements.
SIMDBEZIER_API simdbezier_status simdbezier_split_u(const simdbezier_nets* nets,
                                                    simdbezier_parameter u,
                                                    const simdbezier_mutable_nets* low,
                                                    const simdbezier_mutable_nets* high,
                                                    const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_split_v(const simdbezier_nets* nets,
                                                    simdbezier_parameter v,
                                                    const simdbezier_mutable_nets* low,
                                                    const simdbezier_mutable_nets* high,
                                                    const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_split(const simdbezier_nets* nets,
                                                  simdbezier_parameter u, simdbezier_parameter v,
                                                  const simdbezier_mutable_nets* out,
                                                  const simdbezier_options* options);
// segment() over [u0, u1] x [v0, v1].
SIMDBEZIER_API simdbezier_status
simdbezier_segment(const simdbezier_nets* nets, simdbezier_parameter u0, simdbezier_parameter u1,
                   simdbezier_parameter v0, simdbezier_parameter v1,
                   const simdbezier_mutable_nets* out, const simdbezier_options* options);
// elevate(): to the degrees of `out`.
SIMDBEZIER_API simdbezier_status simdbezier_elevate(const simdbezier_nets* nets,
                                                    const simdbezier_mutable_nets* out,
                                                    const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_hodograph_u(const simdbezier_nets* nets,
                                                        const simdbezier_mutable_nets* out,
                                                        const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_hodograph_v(const simdbezier_nets* nets,
                                                        const simdbezier_mutable_nets* out,
                                                        const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_reverse_u(const simdbezier_nets* nets,
                                                      const simdbezier_mutable_nets* out,
                                                      const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_reverse_v(const simdbezier_nets* nets,
                                                      const simdbezier_mutable_nets* out,
                                                      const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_transpose(const simdbezier_nets* nets,
                                                      const simdbezier_mutable_nets* out,
                                                      const simdbezier_options* options);

// Basis of nets.hpp.
typedef int32_t simdbezier_basis;
enum {
  SIMDBEZIER_BASIS_POWER,
  SIMDBEZIER_BASIS_CENTRED_POWER,
  SIMDBEZIER_BASIS_HERMITE,
  SIMDBEZIER_BASIS_CATMULL_ROM,
  SIMDBEZIER_BASIS_B_SPLINE
};
SIMDBEZIER_API simdbezier_status simdbezier_to_bezier(simdbezier_basis basis,
                                                      const simdbezier_nets* nets,
                                                      const simdbezier_mutable_nets* out,
                                                      const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_from_bezier(simdbezier_basis basis,
                                                        const simdbezier_nets* nets,
                                                        const simdbezier_mutable_nets* out,
                                                        const simdbezier_options* options);

enum { SIMDBEZIER_MOST_BOX_LEVELS = 6 }; // kMostBoxLevels
// control_boxes(), tight_boxes(): net p has [p * components + c] in low and high; levels from 0 to
// SIMDBEZIER_MOST_BOX_LEVELS. flatness(): one value a net.
SIMDBEZIER_API simdbezier_status simdbezier_control_boxes(const simdbezier_nets* nets,
                                                          simdbezier_values low,
                                                          simdbezier_values high,
                                                          const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_tight_boxes(const simdbezier_nets* nets, int32_t levels,
                                                        simdbezier_values low,
                                                        simdbezier_values high,
                                                        const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_flatness(const simdbezier_nets* nets,
                                                     simdbezier_values flatness,
                                                     const simdbezier_options* options);

SIMDBEZIER_END_C
