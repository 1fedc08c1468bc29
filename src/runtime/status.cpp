// Status texts.
#include <simdbezier/status.hpp>

namespace simdbezier {

std::string_view to_string(Status status) noexcept {
  switch (status.code()) {
  case Status::ok:
    return "ok";
  case Status::null_input:
    return "a required input pointer is null";
  case Status::null_output:
    return "no output was asked for, or the memory of one is null";
  case Status::input_too_small:
    return "the memory of the control points ends before the last one";
  case Status::output_too_small:
    return "the memory of an output is too small for the samples";
  case Status::unequal_lengths:
    return "arrays that belong together have different lengths";
  case Status::bad_degree:
    return "a degree is below 1 or above 15, or an order below 0 or above 15";
  case Status::bad_components:
    return "the components are not 1 to 16, differ, or an output needs exactly three";
  case Status::bad_weight:
    return "a weight is not positive and finite, or there are some where none can be";
  case Status::bad_stride:
    return "a stride lets two values share one place";
  case Status::overlapping_outputs:
    return "two outputs share memory, or an output lies in an input";
  case Status::bad_offsets:
    return "the offsets do not leave every patch or curve room for its samples";
  case Status::non_finite_input:
    return "a control point or a parameter of the whole call is nan or infinite";
  case Status::coefficient_overflow:
    return "the coefficients of a patch exceed the range of the number type";
  case Status::bad_grid:
    return "a uniform grid needs at least 2 x 2 samples, a given one 1 x 1";
  case Status::bad_tolerance:
    return "a tolerance is not above zero, or smaller than rounding allows";
  case Status::bad_rates:
    return "a patch has fewer than 1 or more than 4096 segments, or rates are not one a patch";
  case Status::not_orientable:
    return "patches cannot be turned so that all normals agree";
  case Status::missing_y:
    return "an output has no y plane, which the second component of the points needs";
  case Status::missing_z:
    return "an output has no z plane, which the third component of the points needs";
  case Status::extra_y:
    return "an output has a y plane, but the points have no second component for it";
  case Status::extra_z:
    return "an output has a z plane, but the points have no third component for it";
  case Status::snap_too_large:
    return "snapping moves a patch by more than half of its tolerance, so that too little is left";
  case Status::bad_knots:
    return "knots of a spline are too few or too many, descend, or one occurs more than degree + 1 "
           "times";
  case Status::bad_range:
    return "a range or a parameter of a spline is not inside of its domain";
  case Status::bad_topology:
    return "sides that the topology joins are apart in these control nets";
  case Status::bad_patch_range:
    return "patches or curves outside of the set were asked for";
  case Status::bad_patch_index:
    return "a sample names a patch or curve outside of the set";
  case Status::size_overflow:
    return "there are more samples or vertices than memory, or the numbers of indices, can address";
  case Status::unknown_isa:
    return "SIMDBEZIER_ISA names no instruction set";
  case Status::unsupported_isa:
    return "the instruction set is not in this build or not in this machine";
  case Status::out_of_memory:
    return "out of memory";
  }
  return "unknown status";
}

} // namespace simdbezier
