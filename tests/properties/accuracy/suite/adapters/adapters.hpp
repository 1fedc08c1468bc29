// Adapters to other libraries; each exists only where CMake found the library.
#pragma once

#include <cmath>

#include "tests/properties/accuracy/judge/evaluator.hpp"

namespace simdbezier::tests {

void add_opensubdiv(Evaluators<float>& list);
void add_opencascade(Evaluators<double>& list);
void add_sisl(Evaluators<double>& list);
void add_vtk(Evaluators<double>& list);

/// The normal as their users form it: the cross product of the tangents, divided by its length.
template <typename T>
void set_normal_from_tangents(Result<T>& result) {
  const T* a = result.du;
  const T* b = result.dv;
  const T cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
  const T size = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
  for (int c = 0; c < 3; ++c) {
    result.normal[c] = cross[c] / size;
  }
  result.status = SampleStatus::regular;
}

} // namespace simdbezier::tests
