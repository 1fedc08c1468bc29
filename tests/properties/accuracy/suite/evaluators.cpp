#include "tests/properties/accuracy/suite/evaluators.hpp"

#include "tests/properties/accuracy/judge/library_evaluator.hpp"
#include "tests/properties/accuracy/judge/scalar_evaluators.hpp"
#include "tests/properties/accuracy/suite/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

// Other libraries, each in the one type that it evaluates in.
void add_others([[maybe_unused]] Evaluators<float>& list) {
#if defined(SIMDBEZIER_WITH_OPENSUBDIV)
  add_opensubdiv(list);
#endif
}

void add_others([[maybe_unused]] Evaluators<double>& list) {
#if defined(SIMDBEZIER_WITH_OPENCASCADE)
  add_opencascade(list);
#endif
#if defined(SIMDBEZIER_WITH_SISL)
  add_sisl(list);
#endif
#if defined(SIMDBEZIER_WITH_VTK)
  add_vtk(list);
#endif
}

} // namespace

template <typename T>
Evaluators<T> all_evaluators() {
  Evaluators<T> list;
  for (const Isa isa : available_isas()) {
    list.push_back(std::make_unique<LibraryEvaluator<T>>(isa));
    list.push_back(std::make_unique<LibraryEvaluator<T>>(isa, PackOptions{.local_origin = true}));
  }
  const auto add_scalar = [&]<typename Scheme>(const Scheme* /*tag*/) {
    list.push_back(std::make_unique<ScalarEvaluator<T, Scheme>>());
  };
  add_scalar(static_cast<DeCasteljau<T, WeightedLerp<T, true>>*>(nullptr));
  add_scalar(static_cast<DeCasteljau<T, DifferenceLerp<T, true>>*>(nullptr));
  add_scalar(static_cast<DeCasteljau<T, WeightedLerp<T, false>>*>(nullptr));
  add_scalar(static_cast<DeCasteljau<T, DifferenceLerp<T, false>>*>(nullptr));
  add_scalar(static_cast<CornerHorner<T>*>(nullptr));
  add_others(list);
  return list;
}

template Evaluators<float> all_evaluators<float>();
template Evaluators<double> all_evaluators<double>();

} // namespace simdbezier::tests
