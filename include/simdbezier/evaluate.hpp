// The evaluate calls: grids and scattered samples of every patch of a set.
//
// Constraints that hold for every call
//   Parameters  u, v in [0,1]; other finite values extrapolate the polynomial. Where a parameter
//               is nan or infinite, that sample's outputs are nan; its neighbours are untouched.
//   Outputs     belong to the caller, may not overlap the inputs or each other, need no alignment
//               (64 bytes are faster).
//   Accuracy    bicubic patches: |error| <= 21 u max|P| a component with FMA, 32 u without, at the
//               centred parameters as rounded (u = 2^-24 float, 2^-53 double); first derivatives
//               18 u max|hodograph control vector| with FMA, second ones 15 u (21 u without) of the
//               second hodograph's; other degrees and weights: docs/accuracy.md, error_bounds().
//   Watertight  positions on an edge depend only on that edge's control points and are
//               bit-equal on both sides whatever the orientation; corners are control points.
//               An edge whose control points are all one is that point, whatever its weights, and
//               derivatives along it are exactly zero.
//   Bits        equal for any thread count, batch size, place in the batch, layout, alignment and
//               compiler, and for all instruction sets of one class (see Isa).
//   Allocation  scratch per thread and per call only, none per sample. Nothing throws.
//   Layouts     planes of unit stride are written directly; any other is formed in registers from
//               planes in the first-level cache. Packed planes, packed triples and vertices without
//               gaps are the fast ones.
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/isa.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// How parameters are given: u in [0,1], or centred x = 2u-1 in [-1,1] (no rounding inside).
enum class Parameters : std::uint8_t { unit, centred };

/// The centred parameter 2u-1 of a double u, computed in double and rounded once to T.
template <typename T>
[[nodiscard]] SIMDBEZIER_API T to_centred(double u) noexcept;

/// A tensor grid of nu x nv parameters common to all patches; sample k = iv * nu + iu.
/// Null u (v): uniform, ends included, x_i = (2i-N)/N with N = nu-1, by one division.
/// Otherwise u holds nu values, v holds nv, in any order.
template <typename T>
struct Grid {
  std::size_t nu = 0;
  std::size_t nv = 0;
  const T* u = nullptr;
  const T* v = nullptr;
  Parameters parameters = Parameters::unit;

  [[nodiscard]] static constexpr Grid uniform(std::size_t nu, std::size_t nv) noexcept {
    return {nu, nv, nullptr, nullptr, Parameters::unit};
  }
};

/// Scattered samples in any order: sample k lies on patch[k] at (u[k], v[k]).
template <typename T>
struct Samples {
  std::size_t count = 0;
  const std::uint32_t* patch = nullptr; ///< count indices into the set
  const T* u = nullptr;                 ///< count values
  const T* v = nullptr;                 ///< count values
  Parameters parameters = Parameters::unit;
};

/// Where one vector-valued output goes: component c of sample k is c-th pointer [k * stride],
/// stride in elements. All three null: not asked for. See Options::first_component for sets whose
/// points do not have three components.
template <typename T>
struct Vectors {
  T* x = nullptr;
  T* y = nullptr;
  T* z = nullptr;
  std::ptrdiff_t stride = 1;

  /// Three planes (SoA), unit stride.
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y, T* z) noexcept { return {x, y, z, 1}; }
  /// Sets of one or two components: one or two planes, or pairs side by side.
  [[nodiscard]] static constexpr Vectors plane(T* x) noexcept { return {x, nullptr, nullptr, 1}; }
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y) noexcept { return {x, y, nullptr, 1}; }
  [[nodiscard]] static constexpr Vectors pairs(T* first, std::ptrdiff_t stride = 2) noexcept {
    return {first, first + 1, nullptr, stride};
  }
  /// x y z triples (AoS), `stride` elements from one to the next: 3 when packed, the size of a
  /// vertex when interleaved.
  [[nodiscard]] static constexpr Vectors xyz(T* first, std::ptrdiff_t stride = 3) noexcept {
    return {first, first + 1, first + 2, stride};
  }
  [[nodiscard]] constexpr bool wanted() const noexcept {
    return x != nullptr || y != nullptr || z != nullptr;
  }
};

/// Where the curvatures of a surface go: one value a sample each, unit stride; null: not asked for.
/// Principal curvatures are formed from K and H^2: where those leave the range of T, or sink below
/// its smallest normal number, they are infinite, nan or have lost digits.
///
/// There is no bound for them: they divide by |du x dv|^2, and so lose digits where that is small.
/// Measured on octants of the unit sphere (K = 1) whose pole is a collapsed edge, at distances of
/// 0.1, 0.01, 0.001 and 0.0001 from it: K is wrong by up to 5e-6, 8e-4, 0.06 and 27 in float, by
/// 1e-14, 1e-12, 1.3e-10 and 1.4e-8 in double. So float is of no use closer than about 0.001.
template <typename T>
struct Curvatures {
  T* gaussian = nullptr; ///< K = (LN - M^2) / (EG - F^2)
  T* mean = nullptr;     ///< H = (EN - 2FM + GL) / (2 (EG - F^2)), positive towards the normal
  T* minimum = nullptr;  ///< principal curvature H - sqrt(H^2 - K)
  T* maximum = nullptr;  ///< principal curvature H + sqrt(H^2 - K)

  [[nodiscard]] constexpr bool wanted() const noexcept {
    return gaussian != nullptr || mean != nullptr || minimum != nullptr || maximum != nullptr;
  }
};

/// What was found at one sample. `limit` and `degenerate` are reported where normals or curvatures
/// are asked for (tangents or curvatures, of curves).
///
/// Let N(t) be du x dv on the way from the sample's centred parameters, as rounded, to the patch's
/// middle: at (x, y) (1 - t), and from the middle itself at (t, t). The normal has the direction of
/// the first Taylor coefficient of N in t that is not zero. Which one that is, is decided exactly,
/// for the control points as given to pack(). Its angular error, where it is not the very first, is
/// at most 10^-3 degree in float and 10^-9 in double.
enum class SampleStatus : std::uint8_t {
  regular,    ///< the first coefficient, du x dv itself, is not zero
  limit,      ///< du x dv is zero, a later coefficient is not: the normal's limit
  degenerate, ///< all coefficients are zero; the zero vector was written
  non_finite  ///< a parameter was nan or infinite; the outputs are nan
};

/// The outputs of a call; every group is optional, at least one vector group or curvature is
/// required. Grid calls: sample index = (patch - first_patch) * nu * nv + iv * nu + iu. Groups may
/// share memory only as members of one vertex: equal strides, no common element.
template <typename T>
struct Outputs {
  Vectors<T> position; ///< S(u,v)
  Vectors<T> du;       ///< dS/du
  Vectors<T> dv;       ///< dS/dv
  Vectors<T> duu;      ///< d2S/du2
  Vectors<T> duv;      ///< d2S/dudv
  Vectors<T> dvv;      ///< d2S/dv2
  Vectors<T> normal;   ///< dS/du x dS/dv, unit length or zero, never nan at finite parameters
  SampleStatus* status = nullptr; ///< one value a sample, unit stride
  /// Of sets with three components. From first and second derivatives in the same pass; nan where
  /// the status is not `regular`. Source: M. P. do Carmo, Differential Geometry of Curves and
  /// Surfaces, 3.3.
  Curvatures<T> curvature;
};

/// Where the outputs should end up. Streaming stores bypass the caches: a third faster to memory,
/// much slower for whoever reads the result at once. They take effect where the output consists of
/// packed planes, packed triples or vertices without gaps; any alignment of T will do.
enum class Destination : std::uint8_t {
  automatic, ///< memory where a grid call writes more than half of the last-level cache and gains
             ///< by it (docs/performance.md), else cache; scattered samples always the latter
  cache,     ///< plain stores
  memory     ///< streaming stores, completed before the call returns
};

/// How a call runs. The defaults are what most callers want.
struct Options {
  /// 0: OpenMP's default; 1: the calling thread alone; most: 16 or two a core.
  ///
  /// 1 enters no OpenMP region and never starts a thread: such a call always returns, with a
  /// status. Otherwise OpenMP's runtime starts the threads that its pool lacks. Where the system
  /// refuses one (ulimit -u, a container's limit of processes, no memory for a stack), GNU's
  /// runtime prints a line on stderr and calls exit(1); nothing above it can prevent that. Nor does
  /// its pool survive fork(): in a child of a process that has used several threads, only calls
  /// with 1 return.
  int threads = 0;
  /// false: edges and corners come from the interior's formula; derivatives along an edge that is a
  /// point are then of the size of rounding errors instead of zero.
  bool watertight = true;
  Isa isa = Isa::automatic; ///< see resolve_isa()
  Isa* executed = nullptr;  ///< where given, the kernel that ran writes its own name here
  Destination destination = Destination::automatic;
  /// The component that comes out as x; the next ones as y and z. Sets of up to two components
  /// have null z (and y) pointers, as do calls for the last components of sets with more than
  /// three; normals and curvatures exist for sets of three only.
  int first_component = 0;
  std::size_t first_patch = 0; ///< grid calls: the first patch to evaluate
  std::size_t patch_count = static_cast<std::size_t>(-1); ///< grid calls: -1: up to the last
};

/// Evaluates every patch of the set on one grid.
///
/// Positions are S = sum_l y^l sum_k C[l][k] x^k by Horner's rule in x, then in y: degree_v fused
/// multiply-adds a component and sample, 3 for bicubic patches; first derivatives by synthetic
/// division, 5 more for those. Rational patches by the quotient rule.
/// Returns ok | null_output | bad_components (Options::first_component is outside of the set's, or
/// a normal or a curvature is asked of a set without exactly three) | bad_stride |
/// overlapping_outputs | bad_grid | bad_patch_range | size_overflow | unknown_isa | unsupported_isa
/// | out_of_memory. On an error nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_grid(const PatchSet<T>& set, const Grid<T>& grid,
                                                  const Outputs<T>& out,
                                                  const Options& options = {}) noexcept;

/// Evaluates single samples, in the grid's own order of operations: where the centred parameters
/// are equal, the bits are.
/// Returns ok | null_input | null_output | bad_components (as above) | bad_stride |
/// overlapping_outputs | bad_patch_index | unknown_isa | unsupported_isa | size_overflow |
/// out_of_memory. On an error nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_scattered(const PatchSet<T>& set,
                                                       const Samples<T>& samples,
                                                       const Outputs<T>& out,
                                                       const Options& options = {}) noexcept;

} // namespace simdbezier
