// What a call can be asked for at every sample of a surface, and where it goes.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

// The caller's memory for results: vectors in any layout, and single values.

/// The capacity of memory that is given by a pointer alone: the call trusts that it suffices.
inline constexpr std::size_t kTrusted = static_cast<std::size_t>(-1);

/// Where one vector-valued output goes: component c of sample k is the element k * stride behind
/// the c-th pointer. All three null: not asked for. Vectors that are made from spans know their
/// capacity, and calls with more samples return output_too_small. A stride may be negative.
template <typename T>
struct Vectors {
  T* x = nullptr;
  T* y = nullptr;
  T* z = nullptr;
  std::ptrdiff_t stride = 1;
  std::size_t capacity = kTrusted; ///< samples

  /// x y z triples (AoS), `stride` elements from one to the next: 3 if packed, the size of a vertex
  /// if interleaved. A span begins with the first triple and needs a stride of 3 or more.
  [[nodiscard]] static constexpr Vectors xyz(T* first, std::ptrdiff_t stride = 3) noexcept {
    return {first, first + 1, first + 2, stride};
  }
  [[nodiscard]] static constexpr Vectors xyz(std::span<T> values,
                                             std::ptrdiff_t stride = 3) noexcept {
    Vectors triples = values.empty() ? Vectors{} : xyz(values.data(), stride);
    triples.capacity = records(values.size(), 3, stride);
    return triples;
  }
  [[nodiscard]] static constexpr Vectors xyz(std::span<std::array<T, 3>> points) noexcept {
    Vectors triples = points.empty() ? Vectors{} : xyz(points.front().data());
    triples.capacity = points.size();
    return triples;
  }

  /// Three planes (SoA), unit stride.
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y, T* z) noexcept { return {x, y, z}; }
  [[nodiscard]] static constexpr Vectors planes(std::span<T> x, std::span<T> y,
                                                std::span<T> z) noexcept {
    return {x.data(), y.data(), z.data(), 1, std::min({x.size(), y.size(), z.size()})};
  }

  /// Sets of one or two components: one or two planes, or pairs side by side.
  [[nodiscard]] static constexpr Vectors plane(T* x) noexcept { return {x}; }
  [[nodiscard]] static constexpr Vectors plane(std::span<T> x) noexcept {
    return {x.data(), nullptr, nullptr, 1, x.size()};
  }
  [[nodiscard]] static constexpr Vectors planes(T* x, T* y) noexcept { return {x, y}; }
  [[nodiscard]] static constexpr Vectors planes(std::span<T> x, std::span<T> y) noexcept {
    return {x.data(), y.data(), nullptr, 1, std::min(x.size(), y.size())};
  }
  [[nodiscard]] static constexpr Vectors pairs(T* first, std::ptrdiff_t stride = 2) noexcept {
    return {first, first + 1, nullptr, stride};
  }
  [[nodiscard]] static constexpr Vectors pairs(std::span<T> values,
                                               std::ptrdiff_t stride = 2) noexcept {
    Vectors pairs_of = values.empty() ? Vectors{} : pairs(values.data(), stride);
    pairs_of.capacity = records(values.size(), 2, stride);
    return pairs_of;
  }

  /// Whether the output is asked for. An empty span counts, since the call has to refuse it.
  [[nodiscard]] constexpr bool wanted() const noexcept {
    return x != nullptr || y != nullptr || z != nullptr || capacity != kTrusted;
  }

private:
  /// How many records of `members` values, `stride` apart, fit.
  static constexpr std::size_t records(std::size_t values, std::size_t members,
                                       std::ptrdiff_t stride) noexcept {
    return values < members || stride <= 0
               ? 0
               : (values - members) / static_cast<std::size_t>(stride) + 1;
  }
};

/// Where an output of one value a sample goes, unit stride; null: not asked for. A pointer is
/// trusted, the size of a span or a vector is checked.
template <typename T>
struct Values {
  T* first = nullptr;
  std::size_t capacity = kTrusted;

  constexpr Values() noexcept = default;
  constexpr Values(T* memory) noexcept : first(memory) {} // NOLINT: implicit on purpose
  template <std::convertible_to<std::span<T>> Range>
  constexpr Values(Range&& range) noexcept // NOLINT: implicit on purpose
      : Values(std::span<T>(range)) {}
  constexpr Values(std::span<T> values) noexcept // NOLINT: implicit on purpose
      : first(values.data()), capacity(values.size()) {}

  [[nodiscard]] constexpr bool wanted() const noexcept {
    return first != nullptr || capacity != kTrusted;
  }
  [[nodiscard]] constexpr T& operator[](std::size_t sample) const noexcept { return first[sample]; }
};

/// The outputs of a surface, in the order of vertices, files and tables.
enum class Output : std::uint8_t {
  position,  ///< S(u,v)
  du,        ///< dS/du
  dv,        ///< dS/dv
  duu,       ///< d2S/du2
  duv,       ///< d2S/dudv
  dvv,       ///< d2S/dv2
  normal,    ///< dS/du x dS/dv, unit length or zero, never nan at finite parameters
  curvature, ///< all four members of Curvatures
  status     ///< SampleStatus
};
/// The outputs before Output::curvature are vectors.
inline constexpr auto kVectorOutputs = static_cast<std::size_t>(Output::curvature);
/// Output::status is the last output, so that this is the number of all of them.
inline constexpr std::size_t kOutputs = static_cast<std::size_t>(Output::status) + 1;

namespace detail {

/// What code has to know about an output besides its formula.
struct OutputTraits {
  Output output;
  const char* name;     ///< see output_name()
  int derivative_order; ///< see derivative_order()
  bool needs_space;     ///< see needs_space()
};
inline constexpr OutputTraits kOutputTraits[] = {{Output::position, "position", 0, false},
                                                 {Output::du, "du", 1, false},
                                                 {Output::dv, "dv", 1, false},
                                                 {Output::duu, "duu", 2, false},
                                                 {Output::duv, "duv", 2, false},
                                                 {Output::dvv, "dvv", 2, false},
                                                 {Output::normal, "normal", 1, true},
                                                 {Output::curvature, "curvature", 2, true},
                                                 {Output::status, "status", 0, false}};

constexpr bool has_traits_of_all() noexcept {
  bool all = std::size(kOutputTraits) == kOutputs;
  for (std::size_t k = 0; k < std::size(kOutputTraits); ++k) {
    all = all && kOutputTraits[k].output == static_cast<Output>(k);
  }
  return all;
}
static_assert(has_traits_of_all(), "every Output has a row here, in the order of Output");

} // namespace detail

/// "position", "du", … "status": what the C API, Python and the program call an output.
[[nodiscard]] constexpr const char* output_name(Output output) noexcept {
  return detail::kOutputTraits[static_cast<std::size_t>(output)].name;
}
/// The highest order of the derivatives of S from which an output is computed. A status has 0,
/// since it reports what other outputs have found.
[[nodiscard]] constexpr int derivative_order(Output output) noexcept {
  return detail::kOutputTraits[static_cast<std::size_t>(output)].derivative_order;
}
/// Whether an output needs points in space, because a cross product is part of it.
[[nodiscard]] constexpr bool needs_space(Output output) noexcept {
  return detail::kOutputTraits[static_cast<std::size_t>(output)].needs_space;
}

/// A set of outputs: {Output::position, Output::normal}.
class OutputSelection {
public:
  constexpr OutputSelection() noexcept = default;
  constexpr OutputSelection(std::initializer_list<Output> outputs) noexcept {
    for (const Output output : outputs) {
      add(output);
    }
  }
  constexpr void add(Output output) noexcept { bits_ = bits_ | bit(output); }
  [[nodiscard]] constexpr bool holds(Output output) const noexcept {
    return (bits_ & bit(output)) != 0;
  }
  /// Whether one output at least is part of both sets.
  [[nodiscard]] constexpr bool holds_any(const OutputSelection& others) const noexcept {
    return (bits_ & others.bits_) != 0;
  }
  /// The set as a number, in which bit k stands for Output(k).
  [[nodiscard]] constexpr unsigned bits() const noexcept { return bits_; }
  friend constexpr bool operator==(const OutputSelection&, const OutputSelection&) = default;

private:
  static constexpr unsigned bit(Output output) noexcept {
    return 1U << static_cast<unsigned>(output);
  }
  unsigned bits_ = 0;
};

/// The members of Curvatures, in their order.
enum class Curvature : std::uint8_t { gaussian, mean, minimum, maximum };
inline constexpr std::size_t kCurvatureKinds = static_cast<std::size_t>(Curvature::maximum) + 1;

/// "gaussian", "mean", …: what the C API and Python call a curvature.
[[nodiscard]] constexpr const char* output_name(Curvature curvature) noexcept {
  constexpr const char* kNames[] = {"gaussian", "mean", "minimum", "maximum"};
  static_assert(std::size(kNames) == kCurvatureKinds);
  return kNames[static_cast<std::size_t>(curvature)];
}

/// Where the curvatures of a surface go; null means not asked for. They are computed from first and
/// second derivatives, and are nan if the status is not `regular`, or if all components of du or of
/// dv are below the smallest normal number.
///
/// They have no error bound, because they are divided by |du x dv|^2 and lose digits if that is
/// small. docs/accuracy.md has figures: near a pole of the unit sphere, errors in float are 6 % at
/// a distance of 0.001, and no digit is right at 0.0001. Principal curvatures are computed from K
/// and H^2. If K or H^2 leaves the range of T, or sinks below its smallest normal number, principal
/// curvatures are infinite, nan or have lost digits.
/// Source: M. P. do Carmo, Differential Geometry of Curves and Surfaces, 3.3.
template <typename T>
struct Curvatures {
  Values<T> gaussian; ///< K = (LN - M^2) / (EG - F^2)
  Values<T> mean;     ///< H = (EN - 2FM + GL) / (2 (EG - F^2)), positive towards the normal
  Values<T> minimum;  ///< principal curvature H - sqrt(H^2 - K)
  Values<T> maximum;  ///< principal curvature H + sqrt(H^2 - K)

  [[nodiscard]] constexpr bool wanted() const noexcept {
    return gaussian.wanted() || mean.wanted() || minimum.wanted() || maximum.wanted();
  }
  [[nodiscard]] constexpr Values<T>& operator[](Curvature curvature) noexcept {
    return this->*kMembers[static_cast<std::size_t>(curvature)];
  }
  [[nodiscard]] constexpr const Values<T>& operator[](Curvature curvature) const noexcept {
    return this->*kMembers[static_cast<std::size_t>(curvature)];
  }

private:
  static constexpr Values<T> Curvatures::*kMembers[] = {&Curvatures::gaussian, &Curvatures::mean,
                                                        &Curvatures::minimum, &Curvatures::maximum};
  static_assert(std::size(kMembers) == kCurvatureKinds);
};

/// The outputs of a call. Every one is optional, but at least one vector or curvature is required.
/// They may share memory only as members of one vertex: equal strides, no common element.
template <typename T>
struct Outputs {
  Vectors<T> position;
  Vectors<T> du;
  Vectors<T> dv;
  Vectors<T> duu;
  Vectors<T> duv;
  Vectors<T> dvv;
  Vectors<T> normal; ///< for sets of three components only, as curvatures are
  Values<SampleStatus> status;
  Curvatures<T> curvature;
  /// The component that goes to x. The next two go to y and z. If the set has no such component,
  /// the pointers z (and y) are null.
  int first_component = 0;

  /// How the vectors are numbered, and how many there are.
  using Name = Output;
  static constexpr std::size_t kVectors = kVectorOutputs;
  /// The vector output of a name, which has to be one before Output::curvature.
  [[nodiscard]] constexpr Vectors<T>& operator[](Output output) noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }
  [[nodiscard]] constexpr const Vectors<T>& operator[](Output output) const noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }

private:
  static constexpr Vectors<T> Outputs::*kMembers[] = {
      &Outputs::position, &Outputs::du,  &Outputs::dv,    &Outputs::duu,
      &Outputs::duv,      &Outputs::dvv, &Outputs::normal};
  static_assert(std::size(kMembers) == kVectors, "every vector output has a member, in its order");
};

/// The vector outputs of a curve. Derivatives are with respect to t.
enum class CurveOutput : std::uint8_t {
  position, ///< C(t)
  d1,       ///< C'(t)
  d2,       ///< C''(t)
  tangent   ///< C' / |C'|
};
inline constexpr std::size_t kCurveVectorOutputs =
    static_cast<std::size_t>(CurveOutput::tangent) + 1;

/// "position", "d1", …: what the C API and Python call an output.
[[nodiscard]] constexpr const char* output_name(CurveOutput output) noexcept {
  constexpr const char* kNames[] = {"position", "d1", "d2", "tangent"};
  static_assert(std::size(kNames) == kCurveVectorOutputs);
  return kNames[static_cast<std::size_t>(output)];
}

// A derivative of any order that a call is asked for.

/// The highest order in each direction. Polynomials have only zeros beyond their degree; rational
/// patches have derivatives of any order.
inline constexpr int kMostDerivativeOrder = kMostDegree;

/// One derivative that is asked for: d^(a+b) S / du^a dv^b, a = order_u, b = order_v, each from 0
/// to kMostDerivativeOrder; (0, 0) is the position.
template <typename T>
struct PartialDerivative {
  int order_u = 0;
  int order_v = 0;
  Vectors<T> out; ///< required; layouts as in Outputs
};

} // namespace simdbezier
