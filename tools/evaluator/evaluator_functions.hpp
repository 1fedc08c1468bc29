// The functions of somebody else's evaluator (include/simdbezier/evaluator_plugin.h), and what they
// are asked for, in both types and both layouts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include <simdbezier/evaluator_plugin.h>

namespace simdbezier::tools {

/// The vectors of a sample, in the order of sbe_planes_f32.
enum PluginVector : std::uint8_t { kPosition, kDu, kDv, kDuu, kDuv, kDvv, kNormal };
inline constexpr std::size_t kPluginVectors = 7;
inline constexpr std::array<const char*, kPluginVectors> kPluginVectorNames{
    "position", "du", "dv", "duu", "duv", "dvv", "normal"};

enum class PluginLayout : std::uint8_t { triples, planes };
inline constexpr PluginLayout kPluginLayouts[] = {PluginLayout::triples, PluginLayout::planes};

/// Where results go: component c of vector k is at[k][c]. Triples have at[k][0] only, and no more
/// than position, du and dv. What is not asked for is null.
template <typename T>
struct PluginOutputs {
  PluginLayout layout = PluginLayout::triples;
  std::array<std::array<T*, 3>, kPluginVectors> at{};
};

/// One patch at many parameters.
template <typename T>
struct PluginPatchTask {
  std::span<const T> net;
  int degree_u = 3;
  int degree_v = 3;
  std::span<const T> weights;
  std::span<const T> u;
  std::span<const T> v;
  PluginOutputs<T> out;
};

/// Bicubic patches on one grid.
template <typename T>
struct PluginGridTask {
  std::span<const T> nets;
  std::size_t patches = 0;
  std::size_t nu = 0;
  std::size_t nv = 0;
  PluginOutputs<T> out;
};

/// Which functions a file has for one type, by layout.
struct EvaluatorForms {
  std::array<bool, 2> patch{};
  std::array<bool, 2> grid{};

  [[nodiscard]] bool has_patch(PluginLayout layout) const {
    return patch[static_cast<std::size_t>(layout)];
  }
  [[nodiscard]] bool has_grid(PluginLayout layout) const {
    return grid[static_cast<std::size_t>(layout)];
  }
};

/// The functions of one type; null where the file lacks them.
template <typename T>
struct EvaluatorFunctions {
  static constexpr bool kSingle = std::is_same_v<T, float>;
  using Planes = std::conditional_t<kSingle, sbe_planes_f32, sbe_planes_f64>;

  std::conditional_t<kSingle, decltype(&sbe_evaluate_f32), decltype(&sbe_evaluate_f64)> patch{};
  std::conditional_t<kSingle, decltype(&sbe_grid_f32), decltype(&sbe_grid_f64)> grid{};
  std::conditional_t<kSingle, decltype(&sbe_evaluate_planes_f32),
                     decltype(&sbe_evaluate_planes_f64)>
      patch_planes{};
  std::conditional_t<kSingle, decltype(&sbe_grid_planes_f32), decltype(&sbe_grid_planes_f64)>
      grid_planes{};

  /// Finds them in what dlopen() returned.
  explicit EvaluatorFunctions(void* library);

  [[nodiscard]] EvaluatorForms forms() const {
    return {{patch != nullptr, patch_planes != nullptr}, {grid != nullptr, grid_planes != nullptr}};
  }
  /// The function that a task needs has to be there.
  [[nodiscard]] int operator()(const PluginPatchTask<T>& task) const;
  [[nodiscard]] int operator()(const PluginGridTask<T>& task) const;
};

/// "sbe_evaluate_f32", "sbe_grid_planes_f64", …
template <typename T>
[[nodiscard]] std::string function_name(const char* call, PluginLayout layout) {
  return std::string("sbe_") + call + (layout == PluginLayout::planes ? "_planes" : "") +
         (std::is_same_v<T, float> ? "_f32" : "_f64");
}

} // namespace simdbezier::tools
