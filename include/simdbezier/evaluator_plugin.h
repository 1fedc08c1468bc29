// Evaluators that simdbezier_accuracy and simdbezier_bench judge next to the library: a shared
// object with some of these functions, given by --evaluator FILE.so (docs/judge-your-own.md).
//
//     gcc -O2 -shared -fPIC $(pkg-config --cflags simdbezier) mine.c -o mine.so
//
// Each function has one layout of its results: x y z triples side by side, or planes, one array for
// each component. Write the layout that your evaluator writes by itself; the suites compare it with
// rows of the same layout. A file has at least one function that evaluates single patches.
//
// All memory belongs to the caller. Everything asked for is to be written. A function returns 0.
// Any other value means that it does not support such patches or such outputs. They are then
// skipped; this does not count as an error.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Triples. One patch at n pairs of parameters in [0,1].
//   net       control points [j][i][xyz], i runs in u: 3 (degree_u + 1) (degree_v + 1) numbers
//   weights   null, or one a control point: S = sum w P B B / sum w B B
//   position  S of every sample; du, dv: the derivatives, if not null
int sbe_evaluate_f32(const float* net, int degree_u, int degree_v, const float* weights,
                     const float* u, const float* v, size_t n, float* position, float* du,
                     float* dv);
int sbe_evaluate_f64(const double* net, int degree_u, int degree_v, const double* weights,
                     const double* u, const double* v, size_t n, double* position, double* du,
                     double* dv);

// Triples, optional: bicubic patches, 48 numbers each, on one uniform grid, nu x nv parameters i /
// (nu - 1), j / (nv - 1), u fastest, patch after patch. Benchmarks prefer this one.
int sbe_grid_f32(const float* nets, size_t patches, size_t nu, size_t nv, float* position,
                 float* du, float* dv);
int sbe_grid_f64(const double* nets, size_t patches, size_t nu, size_t nv, double* position,
                 double* du, double* dv);

// Where planes go: component c (x, y, z) of a vector of sample k is position[c][k]. The position is
// always asked for. The three planes of any other vector are null if it is not; du and dv are asked
// for together, and duu, duv and dvv are, too. The normal is du x dv, of length 1, or 0 0 0 if
// there is none. What is accepted in one call has to be accepted together with the others.
typedef struct sbe_planes_f32 {
  float* position[3];
  float* du[3];
  float* dv[3];
  float* duu[3];
  float* duv[3];
  float* dvv[3];
  float* normal[3];
} sbe_planes_f32;
typedef struct sbe_planes_f64 {
  double* position[3];
  double* du[3];
  double* dv[3];
  double* duu[3];
  double* duv[3];
  double* dvv[3];
  double* normal[3];
} sbe_planes_f64;

// Planes: the same two calls.
int sbe_evaluate_planes_f32(const float* net, int degree_u, int degree_v, const float* weights,
                            const float* u, const float* v, size_t n, const sbe_planes_f32* out);
int sbe_evaluate_planes_f64(const double* net, int degree_u, int degree_v, const double* weights,
                            const double* u, const double* v, size_t n, const sbe_planes_f64* out);
int sbe_grid_planes_f32(const float* nets, size_t patches, size_t nu, size_t nv,
                        const sbe_planes_f32* out);
int sbe_grid_planes_f64(const double* nets, size_t patches, size_t nu, size_t nv,
                        const sbe_planes_f64* out);

// Optional: what rows and tables call the evaluator. Otherwise, and for null, it has its file's
// name. Whatever is not a letter, a digit, or one of . + - becomes an underscore.
const char* sbe_name(void);

#ifdef __cplusplus
}
#endif
