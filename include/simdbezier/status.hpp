// Every way in which a call can end. The library never prints, throws or aborts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include <simdbezier/version.hpp>

namespace simdbezier {

/// How a call ended; true on ok, as is a Report that contains it:
///
///     if (const Status s = evaluate(set, grid, out); !s) { std::puts(to_string(s).data()); }
/// On an error a call has written nothing, and what it would have replaced is as it was, unless its
/// comment says otherwise. Comments name three groups of statuses:
/// Views:   null_input | input_too_small | bad_degree | bad_components | bad_stride |
///          size_overflow: control nets or curves, or a list of them, that cannot be read.
/// Outputs: null_output | missing_y | missing_z | extra_y | extra_z (planes unlike the components)
///          | bad_components | bad_stride | output_too_small | overlapping_outputs | size_overflow.
/// Running: unknown_isa | unsupported_isa | out_of_memory.
class Status {
public:
  enum Code : std::uint8_t {
    ok,
    null_input,     ///< a required input pointer is null
    null_output,    ///< no output was asked for, or the memory of one is null
    bad_degree,     ///< a degree or an order of derivatives is out of range, or does not fit
    bad_components, ///< components are not 1 to kMostComponents, differ, or an output needs three
    bad_weight,     ///< a weight is not positive and finite, or there are some and none can be
    bad_stride,     ///< the strides let two values share one place
    overlapping_outputs,  ///< two outputs share memory, or an output lies in an input
    bad_offsets,          ///< offsets do not ascend far enough for the samples between them
    non_finite_input,     ///< a control point or a parameter of the whole call is nan or infinite
    coefficient_overflow, ///< the control points are finite, but their coefficients are not
    bad_grid,         ///< too few samples in a direction (uniform grids: 2), or points of a spline
    bad_patch_range,  ///< patches or curves outside of the set were asked for
    bad_patch_index,  ///< a scattered sample names a patch or curve outside of the set
    size_overflow,    ///< the number of samples or bytes exceeds what memory can address
    unknown_isa,      ///< SIMDBEZIER_ISA holds a word that names no instruction set
    unsupported_isa,  ///< the instruction set is not in this build, or this machine lacks it
    out_of_memory,    ///< an allocation failed
    input_too_small,  ///< a span of control points ends before the last one
    output_too_small, ///< the memory of an output, as far as its size is known, ends too early
    unequal_lengths,  ///< spans that belong together have different lengths
    bad_tolerance,    ///< a tolerance is not above zero, or smaller than rounding allows
    bad_rates,        ///< segments of a patch are not 1 to kMostSegments, or not one value a patch
    not_orientable,   ///< no way of turning patches makes all normals agree
    missing_y,        ///< an output has no y plane for the points' second component
    missing_z,        ///< an output has no z plane for the points' third component
    extra_y,          ///< an output has a y plane, and the points no second component for it
    extra_z,          ///< an output has a z plane, and the points no third component for it
    snap_too_large,   ///< snapping moves a patch by more than half of its tolerance
    bad_knots,   ///< knots of a spline are too few, many or large, descend, or one occurs too often
    bad_range,   ///< a range or parameter of a spline is not inside of its domain
    bad_topology ///< sides that the topology joins are apart in these control nets
  };

  constexpr Status() noexcept = default;
  constexpr Status(Code code) noexcept : code_(code) {} // NOLINT: Status::ok is a Status

  [[nodiscard]] explicit constexpr operator bool() const noexcept { return code_ == ok; }
  /// The code, for a switch.
  [[nodiscard]] constexpr Code code() const noexcept { return code_; }
  friend constexpr bool operator==(Status, Status) noexcept = default;

private:
  Code code_ = ok;
};
/// The negation of Status::ok itself would be true.
constexpr bool operator!(Status::Code) = delete;

/// How a call that looks at many control points ended, and where it stopped. All but the status are
/// 0 on ok, and if no single item is at fault.
struct Report {
  Status status;
  /// The first patch, curve, or spline at fault, by its number in the whole call.
  std::size_t item = 0;
  /// Its control point at fault, j*(degree_u+1)+i, of splines row * columns + column; of knots the
  /// number of the knot. -1: an option is at fault, not a point.
  std::ptrdiff_t point = 0;
  /// 0, 1, 2 for x, y, z; the number of components for a weight. Of knots, 0 for u and 1 for v.
  int component = 0;

  [[nodiscard]] explicit constexpr operator bool() const noexcept {
    return static_cast<bool>(status);
  }
};

/// One line of English for a status; never null, static lifetime, thread-safe.
[[nodiscard]] SIMDBEZIER_API std::string_view to_string(Status status) noexcept;

// What was found at one sample of a surface or a curve.

/// How a sample's normal was found. `limit` and `degenerate` are reported only if normals or
/// curvatures are asked for (of curves: tangents or curvatures).
///
/// Let N(t) be du x dv on the way from the sample's centred parameters, as rounded, to the patch's
/// middle: at (x, y) (1 - t), and from the middle itself at (t, t). The normal has the direction of
/// the first Taylor coefficient of N in t that is not zero. Which one that is, is decided exactly,
/// for the control points as given to pack(). If a later coefficient than the first one gives the
/// normal, its angular error is at most 10^-3 degree in float and 10^-9 degree in double.
enum class SampleStatus : std::uint8_t {
  regular,    ///< the first coefficient, du x dv itself, is not zero
  limit,      ///< du x dv is zero, a later coefficient is not: the normal's limit
  degenerate, ///< all coefficients are zero; the zero vector was written
  non_finite  ///< a parameter was nan or infinite; the outputs are nan
};

} // namespace simdbezier
