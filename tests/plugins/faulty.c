// Evaluators with one fault each, made of the example by the macro FAULT_….
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define sbe_evaluate_f32 evaluate_well
#define sbe_name called_well
#include "examples/evaluators/de_casteljau.c"
#undef sbe_evaluate_f32
#undef sbe_name

#if defined(FAULT_ODD_NAME) // a line and a quote, and something on the standard output
const char* sbe_name(void) {
  puts("what a plug-in prints");
  return "odd \"name\"/\n";
}
#elif defined(FAULT_NO_NAME)
const char* sbe_name(void) { return NULL; }
#endif

// Planes of everything, in double and rounded once: what is wrong with them is in the macro.
#if defined(FAULT_NONE_IN_PLANES) || defined(FAULT_BEHIND_PLANE) || defined(FAULT_DUV_OFF)
static double bernstein(int i, int n, int order, double t) {
  if (i < 0 || i > n) {
    return 0;
  }
  if (order > 0) {
    return n * (bernstein(i - 1, n - 1, order - 1, t) - bernstein(i, n - 1, order - 1, t));
  }
  return n == 0 ? 1 : t * bernstein(i - 1, n - 1, 0, t) + (1 - t) * bernstein(i, n - 1, 0, t);
}

int sbe_evaluate_planes_f32(const float* net, int degree_u, int degree_v, const float* weights,
                            const float* u, const float* v, size_t n, const sbe_planes_f32* out) {
  static const int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  if (weights != NULL || degree_u > 4 || degree_v > 4) {
    return 1;
  }
  float* const* const planes[6] = {out->position, out->du, out->dv, out->duu, out->duv, out->dvv};
  for (size_t k = 0; k < n; ++k) {
    double value[6][3] = {{0}};
    for (int q = 0; q < 6; ++q) {
      for (int point = 0; point < (degree_u + 1) * (degree_v + 1); ++point) {
        const double share = bernstein(point % (degree_u + 1), degree_u, orders[q][0], u[k]) *
                             bernstein(point / (degree_u + 1), degree_v, orders[q][1], v[k]);
        for (int c = 0; c < 3; ++c) {
          value[q][c] += share * net[3 * point + c];
        }
      }
      for (int c = 0; c < 3 && planes[q][0] != NULL; ++c) {
        planes[q][c][k] = (float)value[q][c];
      }
    }
    double normal[3], length = 0;
    for (int c = 0; c < 3; ++c) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      normal[c] = value[1][a] * value[2][b] - value[1][b] * value[2][a];
      length += normal[c] * normal[c];
    }
    for (int c = 0; c < 3 && out->normal[0] != NULL; ++c) {
      out->normal[c][k] = (float)(length > 0 ? normal[c] / sqrt(length) : 0);
    }
  }
#if defined(FAULT_BEHIND_PLANE)
  if (n > 3 && out->dv[0] != NULL) {
    out->dv[2][n] = 0;
  }
#elif defined(FAULT_DUV_OFF)
  if (n > 3 && out->duv[0] != NULL) {
    out->duv[1][2] += 0.01F;
  }
#endif
  return 0;
}
#endif

#if defined(FAULT_NONE_IN_PLANES) // triples and a grid, too
int sbe_grid_planes_f32(const float* nets, size_t patches, size_t nu, size_t nv,
                        const sbe_planes_f32* out) {
  for (size_t k = 0; k < patches * nu * nv; ++k) {
    const float u = (float)(k % nu) / (float)(nu - 1);
    const float v = (float)(k / nu % nv) / (float)(nv - 1);
    float* planes[21];
    memcpy(planes, out, sizeof planes);
    for (int plane = 0; plane < 21; ++plane) {
      planes[plane] += planes[plane] != NULL ? k : 0;
    }
    sbe_planes_f32 one;
    memcpy(&one, planes, sizeof one);
    sbe_evaluate_planes_f32(nets + 48 * (k / nu / nv), 3, 3, NULL, &u, &v, 1, &one);
  }
  return 0;
}
#endif

#if defined(FAULT_BEHIND_PLANE) || defined(FAULT_DUV_OFF)
int evaluate_triples(void);
int evaluate_triples(void) { return evaluate_well(0, 0, 0, 0, 0, 0, 0, 0, 0, 0); }
#elif !defined(FAULT_NO_SYMBOL)
int sbe_evaluate_f32(const float* net, int degree_u, int degree_v, const float* weights,
                     const float* u, const float* v, size_t n, float* position, float* du,
                     float* dv) {
  const int answer = evaluate_well(net, degree_u, degree_v, weights, u, v, n, position, du, dv);
#if defined(FAULT_40_UNITS) // of the largest control point, at one sample
  float largest = 0;
  for (int k = 0; k < 3 * (degree_u + 1) * (degree_v + 1); ++k) {
    largest = fmaxf(largest, fabsf(net[k]));
  }
  if (n > 3) {
    position[7] += 40 * 0x1p-24f * largest;
  }
#elif defined(FAULT_CRASH)
  if (n > 1) {
    abort();
  }
#elif defined(FAULT_NAN)
  if (n > 3) {
    position[7] = NAN;
  }
#elif defined(FAULT_WRITES_BEHIND)
  if (n > 3) {
    position[3 * n] = 0;
  }
#elif defined(FAULT_WRITES_BEFORE)
  if (n > 3) {
    position[-1] = 0;
  }
#elif defined(FAULT_CHANGES_INPUT)
  if (n > 3) {
    ((float*)u)[2] = 1;
  }
#elif defined(FAULT_REFUSES_LATE)
  if (n > 1) {
    return 5;
  }
#endif
  return answer;
}
#else
int sbe_evaluate(void);
int sbe_evaluate(void) { return evaluate_well(0, 0, 0, 0, 0, 0, 0, 0, 0, 0); }
#endif
