// Where surfaces are evaluated: on one grid, on a grid for each patch, or at single samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// How parameters are given: as u in [0,1], or centred as x = 2u-1 in [-1,1], which is used without
/// a rounding. Kernels work with x/2, so that an x of the smallest denormal counts as 0.
///
/// Other values extrapolate, as long as |2u-1| is below 2^64 (float) or 2^512 (double). Beyond
/// that, multiples of the parameter's square are infinite, and directions of degree 3 to 5 give
/// infinities or nan. Second derivatives by a parameter of degree 5 contain its cube, so that their
/// limits are 2^43 and 2^341. Normals are never nan for any finite parameter.
enum class Parameters : std::uint8_t { unit, centred };

/// The centred parameter 2u-1 of a double u, computed in double and rounded once to T.
template <typename T>
[[nodiscard]] SIMDBEZIER_API T to_centred(double u) noexcept;

/// Consecutive patches or curves of a set, or patches of a mesh, for calls on a part of them.
struct SetRange {
  static constexpr std::size_t kToTheEnd = static_cast<std::size_t>(-1);
  std::size_t first = 0;
  std::size_t count = kToTheEnd;
};

/// A tensor grid of nu x nv parameters for all patches of a range. Sample (patch, iu, iv) has the
/// index (patch - patches.first) * nu * nv + iv * nu + iu. If u (v) is null, the parameters are
/// uniform, ends included: x_i = (2i-N)/N with N = nu-1, by one division. Otherwise u holds nu
/// values and v holds nv, in any order.
template <typename T>
struct Grid {
  std::size_t nu = 0;
  std::size_t nv = 0;
  const T* u = nullptr;
  const T* v = nullptr;
  Parameters parameters = Parameters::unit;
  SetRange patches = {};

  [[nodiscard]] static constexpr Grid uniform(std::size_t nu, std::size_t nv,
                                              SetRange patches = {}) noexcept {
    return {nu, nv, nullptr, nullptr, Parameters::unit, patches};
  }
  /// Every pair of the parameters given.
  [[nodiscard]] static constexpr Grid at(std::span<const T> u, std::span<const T> v,
                                         Parameters parameters = Parameters::unit,
                                         SetRange patches = {}) noexcept {
    return {u.size(), v.size(), u.data(), v.data(), parameters, patches};
  }
};

/// Uniform grids, ends included, one for each patch of a range. The samples have compressed-row
/// form: sample (iu, iv) of the k-th of these patches has the index offset[k] + iv * nu[k] + iu.
struct PatchGrids {
  std::span<const std::uint32_t> nu; ///< 2 or more
  std::span<const std::uint32_t> nv; ///< 2 or more; as many as nu
  /// Where each patch's samples begin, ascending by nu*nv or more (samples in between are not
  /// touched). Empty: packed without gaps.
  std::span<const std::size_t> offset = {};
  /// The patches. A count, if given, must be the size of nu and nv (else unequal_lengths).
  SetRange patches = {};
};

/// Single samples in any order: sample k lies on patch[k] at (u[k], v[k]).
template <typename T>
struct Samples {
  std::span<const std::uint32_t> patch; ///< indices into the set
  std::span<const T> u;                 ///< as many
  std::span<const T> v;                 ///< as many
  Parameters parameters = Parameters::unit;
};

/// The number of samples of a call, for which every output needs room. 0 if patches are not in the
/// set or PatchGrids are refused; the largest std::size_t if memory cannot address them.
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>& set,
                                                      const Grid<T>& grid) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const PatchSet<T>& set,
                                                      const PatchGrids& grids) noexcept;
template <typename T>
[[nodiscard]] std::size_t sample_count(const PatchSet<T>& /*set*/,
                                       const Samples<T>& samples) noexcept {
  return samples.patch.size();
}

} // namespace simdbezier
