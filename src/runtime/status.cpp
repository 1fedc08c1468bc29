// Status texts.
#include <iterator>

#include <simdbezier/status.hpp>

namespace simdbezier {
namespace {

/// In the order of Status::Code.
constexpr std::string_view kTexts[] = {
    "ok",
    "a required input pointer is null",
    "no output was asked for, or the memory of one is null",
    "a degree is below 1 or above 15, or an order below 0 or above 15",
    "the components are not 1 to 16, differ, or an output needs exactly three",
    "a weight is not positive and finite, or there are some where none can be",
    "a stride lets two values share one place",
    "two outputs share memory, or an output lies in an input",
    "the offsets do not leave every patch or curve room for its samples",
    "a control point or a parameter of the whole call is nan or infinite",
    "the coefficients of a patch exceed the range of the number type",
    "too few samples (a uniform grid needs 2 x 2, a given one 1 x 1) or points of a spline",
    "patches or curves outside of the set were asked for",
    "a sample names a patch or curve outside of the set",
    "there are more samples or vertices than memory, or the numbers of indices, can address",
    "SIMDBEZIER_ISA names no instruction set",
    "the instruction set is not in this build or not in this machine",
    "out of memory",
    "the memory of the control points ends before the last one",
    "the memory of an output is too small for the samples",
    "arrays that belong together have different lengths",
    "a tolerance is not above zero, or smaller than rounding allows",
    "a patch has fewer than 1 or more than 4096 segments, or rates are not one a patch",
    "patches cannot be turned so that all normals agree",
    "an output has no y plane, which the second component of the points needs",
    "an output has no z plane, which the third component of the points needs",
    "an output has a y plane, but the points have no second component for it",
    "an output has a z plane, but the points have no third component for it",
    "snapping moves a patch by more than half of its tolerance, so that too little is left",
    "knots of a spline are too few or too many, descend, or one occurs more than degree + 1 times",
    "a range or a parameter of a spline is not inside of its domain",
    "sides that the topology joins are apart in these control nets",
};
static_assert(std::size(kTexts) == Status::bad_topology + 1);

} // namespace

std::string_view to_string(Status status) noexcept {
  return status.code() < std::size(kTexts) ? kTexts[status.code()] : "unknown status";
}

} // namespace simdbezier
