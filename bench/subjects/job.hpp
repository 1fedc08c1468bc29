// What one call computes, in terms that the library's rows and the baselines share. Objects of
// every instruction set include this file, so it has plain data only, and nothing with a body that
// the linker could take from the wrong object.
#pragma once

#include <cstddef>
#include <cstdint>

namespace simdbezier_bench {

/// The outputs of a call. The second derivatives come with everything before them: position, du,
/// dv, duu, duv, dvv. Curvature stands for the position, then the Gaussian, mean, smaller and
/// larger principal curvature.
enum class OutputGroups {
  position,
  position_normal,
  position_derivatives,
  second_derivatives,
  curvature
};

constexpr std::size_t kMostGroups = 6;
constexpr std::size_t kCurvatures = 4;

/// The number of vectors of three components that a sample has.
constexpr std::size_t group_count(OutputGroups groups) {
  constexpr std::size_t kCounts[] = {1, 2, 3, kMostGroups, 1};
  return kCounts[static_cast<int>(groups)];
}

/// The number of all values of a sample: three a vector, one a curvature.
constexpr std::size_t value_count(OutputGroups groups) {
  return 3 * group_count(groups) + (groups == OutputGroups::curvature ? kCurvatures : 0);
}

/// Where results lie: component c of group g of sample k is component[3 * g + c][k * stride], with
/// the groups in the order of OutputGroups' names. Planes have stride 1. x y z triples have stride
/// 3, and the components of a group follow each other. Vertices have stride value_count. Curvatures
/// follow the vectors and are always planes, and so are vectors beside them.
template <typename T>
struct Results {
  OutputGroups groups = OutputGroups::position;
  T* component[3 * kMostGroups] = {};
  std::size_t stride = 1;
};

/// The kind of patches that a batch consists of.
struct BatchShape {
  int degree_u = 3;
  int degree_v = 3;
  bool rational = false; ///< points are x y z w, S = (sum w P B B) / (sum w B B)
};

constexpr bool is_bicubic(BatchShape shape) {
  return shape.degree_u == 3 && shape.degree_v == 3 && !shape.rational;
}

constexpr std::size_t values_per_point(BatchShape shape) { return shape.rational ? 4 : 3; }

constexpr std::size_t values_per_patch(BatchShape shape) {
  return static_cast<std::size_t>((shape.degree_u + 1) * (shape.degree_v + 1)) *
         values_per_point(shape);
}

/// Every patch of a batch is evaluated on one uniform nu x nv grid, u fastest, patch after patch.
template <typename T>
struct GridJob {
  std::size_t patches = 0;
  std::size_t nu = 0;
  std::size_t nv = 0;
  /// 48 values a patch: control points [j][i][xyz] for de_casteljau, power-basis coefficients
  /// [power of v][xyz][power of u] for autovectorised.
  const T* input = nullptr;
  const T* u = nullptr;  ///< i / (nu-1)
  const T* v = nullptr;  ///< i / (nv-1)
  Results<T> out;        ///< triples for de_casteljau, planes for autovectorised
  BatchShape shape = {}; ///< bicubic for both
};

/// Every cubic of a batch is evaluated at the same n parameters, curve after curve.
template <typename T>
struct CurveJob {
  std::size_t curves = 0;
  std::size_t n = 0;
  const T* points = nullptr; ///< control points [curve][i][xyz]
  const T* t = nullptr;      ///< i / (n-1)
  Results<T> out;            ///< triples for de_casteljau
};

/// Single samples are evaluated: sample k lies on patch[k] at (u[k], v[k]).
template <typename T>
struct ScatteredJob {
  std::size_t count = 0;
  const T* nets = nullptr; ///< control points [patch][j][i][xyz]
  const std::uint32_t* patch = nullptr;
  const T* u = nullptr;
  const T* v = nullptr;
  Results<T> out; ///< triples for de_casteljau
};

} // namespace simdbezier_bench
