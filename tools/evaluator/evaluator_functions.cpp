#include <tools/evaluator/evaluator_functions.hpp>

#include <bit>

#include <dlfcn.h>

namespace simdbezier::tools {
namespace {

template <typename F>
void find(void* library, const std::string& name, F& function) {
  function = reinterpret_cast<F>(dlsym(library, name.c_str()));
}

} // namespace

template <typename T>
EvaluatorFunctions<T>::EvaluatorFunctions(void* library) {
  find(library, function_name<T>("evaluate", PluginLayout::triples), patch);
  find(library, function_name<T>("grid", PluginLayout::triples), grid);
  find(library, function_name<T>("evaluate", PluginLayout::planes), patch_planes);
  find(library, function_name<T>("grid", PluginLayout::planes), grid_planes);
}

template <typename T>
int EvaluatorFunctions<T>::operator()(const PluginPatchTask<T>& task) const {
  const T* const weights = task.weights.empty() ? nullptr : task.weights.data();
  const auto& at = task.out.at;
  if (task.out.layout == PluginLayout::triples) {
    return patch(task.net.data(), task.degree_u, task.degree_v, weights, task.u.data(),
                 task.v.data(), task.u.size(), at[kPosition][0], at[kDu][0], at[kDv][0]);
  }
  const auto planes = std::bit_cast<Planes>(at);
  return patch_planes(task.net.data(), task.degree_u, task.degree_v, weights, task.u.data(),
                      task.v.data(), task.u.size(), &planes);
}

template <typename T>
int EvaluatorFunctions<T>::operator()(const PluginGridTask<T>& task) const {
  const auto& at = task.out.at;
  if (task.out.layout == PluginLayout::triples) {
    return grid(task.nets.data(), task.patches, task.nu, task.nv, at[kPosition][0], at[kDu][0],
                at[kDv][0]);
  }
  const auto planes = std::bit_cast<Planes>(at);
  return grid_planes(task.nets.data(), task.patches, task.nu, task.nv, &planes);
}

template struct EvaluatorFunctions<float>;
template struct EvaluatorFunctions<double>;

} // namespace simdbezier::tools
