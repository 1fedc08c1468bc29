// An evaluator as a shader would have it: bicubic patches in powers of u and v, float, planes,
// loops over samples that a compiler makes vectors of. In a clone: gcc -O3 -march=native
// -fno-math-errno -fno-trapping-math -shared -fPIC -I include examples/evaluators/shader_horner.c
// -o shader_horner.so
#include <math.h>
#include <string.h>

#include <simdbezier/evaluator_plugin.h>

const char* sbe_name(void) { return "shader_horner"; }

// Coefficients [power of v][power of u] of one component.
static void to_powers(const float* net, float c[4][4]) {
  static const float m[4][4] = {{1, 0, 0, 0}, {-3, 3, 0, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}};
  for (int l = 0; l < 4; ++l)
    for (int k = 0; k < 4; ++k) {
      c[l][k] = 0;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          c[l][k] += m[l][j] * m[k][i] * net[3 * (4 * j + i)];
    }
}

enum { kRun = 64 }; // samples at a time

static void positions(float c[4][4], const float* u, const float* v, size_t n, float* restrict p) {
  for (size_t k = 0; k < n; ++k) {
    float row[4];
    for (int l = 0; l < 4; ++l)
      row[l] = ((c[l][3] * u[k] + c[l][2]) * u[k] + c[l][1]) * u[k] + c[l][0];
    p[k] = ((row[3] * v[k] + row[2]) * v[k] + row[1]) * v[k] + row[0];
  }
}

static void tangents(float c[4][4], const float* u, const float* v, size_t n, float* restrict du,
                     float* restrict dv) {
  for (size_t k = 0; k < n; ++k) {
    float row[4], slope[4];
    for (int l = 0; l < 4; ++l) {
      row[l] = ((c[l][3] * u[k] + c[l][2]) * u[k] + c[l][1]) * u[k] + c[l][0];
      slope[l] = (3 * c[l][3] * u[k] + 2 * c[l][2]) * u[k] + c[l][1];
    }
    du[k] = ((slope[3] * v[k] + slope[2]) * v[k] + slope[1]) * v[k] + slope[0];
    dv[k] = (3 * row[3] * v[k] + 2 * row[2]) * v[k] + row[1];
  }
}

static void normals(float du[3][kRun], float dv[3][kRun], size_t n, float* const normal[3],
                    size_t first) {
  float* restrict nx = normal[0] + first, * restrict ny = normal[1] + first, * restrict nz = normal[2] + first;
  for (size_t k = 0; k < n; ++k) {
    const float x = du[1][k] * dv[2][k] - du[2][k] * dv[1][k];
    const float y = du[2][k] * dv[0][k] - du[0][k] * dv[2][k];
    const float z = du[0][k] * dv[1][k] - du[1][k] * dv[0][k];
    const float length = sqrtf(x * x + y * y + z * z);
    const float scale = length > 0 ? 1 / length : 0;
    nx[k] = x * scale;
    ny[k] = y * scale;
    nz[k] = z * scale;
  }
}

int sbe_evaluate_planes_f32(const float* net, int degree_u, int degree_v, const float* weights,
                            const float* u, const float* v, size_t n, const sbe_planes_f32* out) {
  if (degree_u != 3 || degree_v != 3 || weights != NULL || out->duu[0] != NULL)
    return 1;
  float c[3][4][4], du[3][kRun], dv[3][kRun];
  for (int component = 0; component < 3; ++component)
    to_powers(net + component, c[component]);
  for (size_t first = 0; first < n; first += kRun) {
    const size_t count = n - first < kRun ? n - first : kRun;
    for (int a = 0; a < 3; ++a) {
      positions(c[a], u + first, v + first, count, out->position[a] + first);
      if (out->du[0] == NULL && out->normal[0] == NULL)
        continue;
      tangents(c[a], u + first, v + first, count, du[a], dv[a]);
      if (out->du[0] == NULL)
        continue;
      memcpy(out->du[a] + first, du[a], count * sizeof(float));
      memcpy(out->dv[a] + first, dv[a], count * sizeof(float));
    }
    if (out->normal[0] != NULL)
      normals(du, dv, count, out->normal, first);
  }
  return 0;
}
