// An evaluator as a shader would have it: bicubic patches in powers of u and v, float, one loop
// over samples that a compiler makes vectors of. In a clone: gcc -O3 -march=native -shared -fPIC
// -I include examples/evaluators/shader_horner.c -o shader_horner.so
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

int sbe_evaluate_f32(const float* net, int degree_u, int degree_v, const float* weights,
                     const float* u, const float* v, size_t n, float* position, float* du,
                     float* dv) {
  if (degree_u != 3 || degree_v != 3 || weights != NULL)
    return 1;
  for (int component = 0; component < 3; ++component) {
    float c[4][4];
    to_powers(net + component, c);
    for (size_t k = 0; k < n; ++k) {
      float row[4], slope[4];
      for (int l = 0; l < 4; ++l) {
        row[l] = ((c[l][3] * u[k] + c[l][2]) * u[k] + c[l][1]) * u[k] + c[l][0];
        slope[l] = (3 * c[l][3] * u[k] + 2 * c[l][2]) * u[k] + c[l][1];
      }
      const float y = v[k];
      position[3 * k + component] = ((row[3] * y + row[2]) * y + row[1]) * y + row[0];
      if (du)
        du[3 * k + component] = ((slope[3] * y + slope[2]) * y + slope[1]) * y + slope[0];
      if (dv)
        dv[3 * k + component] = (3 * row[3] * y + 2 * row[2]) * y + row[1];
    }
  }
  return 0;
}
