// Evaluators with one fault each, made of the example by the macro FAULT_….
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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

#if !defined(FAULT_NO_SYMBOL)
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
