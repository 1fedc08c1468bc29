// Evaluators that simdbezier_accuracy and simdbezier_bench judge beside the library: a shared
// object with some of these functions, given by --evaluator FILE.so. docs/judge-your-own.md has
// examples.
//
//     gcc -O2 -shared -fPIC $(pkg-config --cflags simdbezier) mine.c -o mine.so
//
// All memory belongs to the caller and holds x y z triples side by side. Everything asked for is to
// be written. A function returns 0; another number says that it does not evaluate such patches,
// which is no fault: they are left out.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// One patch at n pairs of parameters in [0,1].
//   net       control points [j][i][xyz], i runs in u: 3 (degree_u + 1) (degree_v + 1) numbers
//   weights   null, or one a control point: S = sum w P B B / sum w B B
//   position  S of every sample; du, dv: the derivatives, where not null
int sbe_evaluate_f32(const float* net, int degree_u, int degree_v, const float* weights,
                     const float* u, const float* v, size_t n, float* position, float* du,
                     float* dv);
int sbe_evaluate_f64(const double* net, int degree_u, int degree_v, const double* weights,
                     const double* u, const double* v, size_t n, double* position, double* du,
                     double* dv);

// Optional: bicubic patches, 48 numbers each, on one uniform grid of nu x nv parameters i / (nu -
// 1), j / (nv - 1), u fastest, patch after patch. Benchmarks call this one where it is there.
int sbe_grid_f32(const float* nets, size_t patches, size_t nu, size_t nv, float* position,
                 float* du, float* dv);

// Optional: what rows and tables call the evaluator. Otherwise, and for null, it has its file's
// name. Whatever is not a letter, a digit, or one of . + - becomes an underscore.
const char* sbe_name(void);

#ifdef __cplusplus
}
#endif
