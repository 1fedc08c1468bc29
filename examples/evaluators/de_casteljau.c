// An evaluator in 30 lines of C: de Casteljau's algorithm in float, polynomial patches, any degree.
#include <simdbezier/evaluator_plugin.h>

const char* sbe_name(void) { return "my_de_casteljau"; }

// The curve with values a[0], a[stride] … at t, and its derivative.
static float point(const float* a, int degree, int stride, float t, float* derivative) {
  float b[16] = {0};
  for (int i = 0; i <= degree; ++i)
    b[i] = a[i * stride];
  for (int level = degree; level > 1; --level)
    for (int i = 0; i < level; ++i)
      b[i] = (1 - t) * b[i] + t * b[i + 1];
  *derivative = (float)degree * (b[1] - b[0]);
  return (1 - t) * b[0] + t * b[1];
}

int sbe_evaluate_f32(const float* net, int degree_u, int degree_v, const float* weights,
                     const float* u, const float* v, size_t n, float* position, float* du,
                     float* dv) {
  if (weights != NULL)
    return 1; // not for this one: the suite leaves such patches out
  for (size_t k = 0; k < 3 * n; ++k) {
    float column[16] = {0}, slope[16] = {0}, along_v, unused;
    for (int j = 0; j <= degree_v; ++j)
      column[j] = point(net + 3 * j * (degree_u + 1) + k % 3, degree_u, 3, u[k / 3], &slope[j]);
    position[k] = point(column, degree_v, 1, v[k / 3], &along_v);
    if (du != NULL)
      du[k] = point(slope, degree_v, 1, v[k / 3], &unused);
    if (dv != NULL)
      dv[k] = along_v;
  }
  return 0;
}
