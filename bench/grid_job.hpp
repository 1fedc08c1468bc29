// What one grid call computes, in terms that the library's rows and the baselines share.
// Objects of every instruction set include this file: plain data only, nothing with a body that
// the linker could take from the wrong object.
#pragma once

#include <cstddef>

namespace simdbezier_bench {

enum class OutputGroups { position, position_normal, position_derivatives };

/// Every patch of a batch on one uniform n x n grid, u fastest, patch after patch.
template <typename T>
struct GridJob {
  OutputGroups groups = OutputGroups::position;
  std::size_t patches = 0;
  std::size_t n = 0;
  /// 48 values a patch: control points [j][i][xyz] for de_casteljau, power-basis coefficients
  /// [power of v][xyz][power of u] for autovectorised.
  const T* input = nullptr;
  /// The n values i / (n-1).
  const T* parameters = nullptr;
  /// Three entries a group, in the order of the group's name. SoA: one plane each. AoS: the first
  /// of the three is where x y z triples begin, the others are not used.
  T* planes[9] = {};
};

constexpr std::size_t group_count(OutputGroups groups) {
  return groups == OutputGroups::position ? 1 : groups == OutputGroups::position_normal ? 2 : 3;
}

} // namespace simdbezier_bench
