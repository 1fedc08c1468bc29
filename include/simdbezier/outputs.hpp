// What a call can be asked for at every sample of a surface, and where it goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <simdbezier/sample_status.hpp>
#include <simdbezier/vectors.hpp>

namespace simdbezier {

/// The outputs of a surface, in the order in which vertices, files and tables have them.
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
/// Those before Output::curvature are vectors.
inline constexpr auto kVectorOutputs = static_cast<std::size_t>(Output::curvature);

/// "position", "du", … "status": what the C API, Python and the program call an output.
[[nodiscard]] constexpr const char* output_name(Output output) noexcept {
  constexpr const char* kNames[] = {"position", "du",     "dv",        "duu",   "duv",
                                    "dvv",      "normal", "curvature", "status"};
  return kNames[static_cast<std::size_t>(output)];
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
  friend constexpr bool operator==(const OutputSelection&, const OutputSelection&) = default;

private:
  static constexpr unsigned bit(Output output) noexcept {
    return 1U << static_cast<unsigned>(output);
  }
  unsigned bits_ = 0;
};

/// Where the curvatures of a surface go; each may be null: not asked for. From first and second
/// derivatives; nan where the status is not `regular`.
///
/// There is no bound for them: they divide by |du x dv|^2, and lose digits where that is small
/// (docs/accuracy.md has figures; float is of no use closer than 0.001 to a pole). Principal
/// curvatures are formed from K and H^2: where those leave the range of T, or sink below its
/// smallest normal number, they are infinite, nan or have lost digits.
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
};

/// The outputs of a call; every one is optional, at least one vector or curvature is required. They
/// may share memory only as members of one vertex: equal strides, no common element.
template <typename T>
struct Outputs {
  Vectors<T> position;
  Vectors<T> du;
  Vectors<T> dv;
  Vectors<T> duu;
  Vectors<T> duv;
  Vectors<T> dvv;
  Vectors<T> normal; ///< of sets with three components only, as are curvatures
  Values<SampleStatus> status;
  Curvatures<T> curvature;
  /// The component that comes out as x; the next ones come out as y and z. Sets of up to two
  /// components have null z (and y) pointers, as do calls for the last components of sets with more
  /// than three.
  int first_component = 0;

  /// A vector output: one before Output::curvature.
  [[nodiscard]] constexpr Vectors<T>& operator[](Output output) noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }
  [[nodiscard]] constexpr const Vectors<T>& operator[](Output output) const noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }

private:
  static constexpr Vectors<T> Outputs::*kMembers[kVectorOutputs] = {
      &Outputs::position, &Outputs::du,  &Outputs::dv,    &Outputs::duu,
      &Outputs::duv,      &Outputs::dvv, &Outputs::normal};
};

} // namespace simdbezier
