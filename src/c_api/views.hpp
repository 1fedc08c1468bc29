// The C++ views and options that structs of simdbezier.h stand for, checked as far as C++ cannot:
// null pointers, lengths, types, numbers that stand for names.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/splines.hpp>
#include <simdbezier/status.hpp>

#include "src/c_api/structs.hpp"
#include "src/output/output_list.hpp"
#include "src/splines/spline_knots.hpp"

namespace simdbezier::c_api {

inline constexpr Path kOptions{"options"};
inline constexpr Isa kLastIsa = Isa::simd128;

inline Isa isa_of(simdbezier_isa isa, const Path& path) { return choice(isa, kLastIsa, path); }

inline Destination destination_of(simdbezier_destination destination) {
  return choice(destination, Destination::memory, kOptions / "destination");
}

/// In C, zero stands for no limit.
inline double limit_of(double value) noexcept { return value == 0 ? kUnlimited : value; }

inline Options call_options_of(const simdbezier_options* given) {
  const auto known = read_options(given, kOptions);
  return {.threads = known.threads,
          .isa = isa_of(known.isa, kOptions / "isa"),
          .watertight = known.not_watertight == 0,
          .destination = destination_of(known.destination)};
}

inline PackOptions pack_options_of(const simdbezier_pack_options* given) {
  const auto known = read_options(given, kOptions);
  PackOptions options;
  options.local_origin = known.local_origin != 0;
  std::copy_n(known.relative_to, 3, options.relative_to);
  options.threads = known.threads;
  options.isa = isa_of(known.isa, kOptions / "isa");
  return options;
}

/// What options of rates and of meshes have in common.
template <typename Struct>
void set_limits(RateOptions& options, const Given<Struct>& known) {
  options.tolerance = limit_of(known.tolerance);
  options.tolerances = SIMDBEZIER_SPAN(known, tolerances);
  options.longest_edge = limit_of(known.longest_edge);
  options.normal_degrees = limit_of(known.normal_degrees);
  options.thorough = known.thorough != 0;
}

template <typename Struct>
Weights weights_of(const Given<Struct>& given) {
  return choice(given.weights, Weights::homogeneous, given.path / "weights");
}

/// The address of the first value of `count` nets, curves or splines, and all of their memory;
/// memory that is null or too short is refused.
template <typename S, typename Struct>
auto first_value(const Given<Struct>& given, std::size_t count) {
  constexpr bool kInput = std::is_const_v<std::remove_pointer_t<decltype(given.points)>>;
  using Value = std::conditional_t<kInput, const S, S>;
  require_scalar<S>(given.scalar, given.path);
  if (count == 0) {
    return std::pair<Value*, std::span<Value>>();
  }
  require(given.points != nullptr, kInput ? SIMDBEZIER_NULL_INPUT : SIMDBEZIER_NULL_OUTPUT,
          given.path / "points");
  constexpr auto kTooSmall = kInput ? SIMDBEZIER_INPUT_TOO_SMALL : SIMDBEZIER_OUTPUT_TOO_SMALL;
  require(given.length > 0, kTooSmall, given.path / "length");
  require(given.first >= 0 && static_cast<std::size_t>(given.first) < given.length, kTooSmall,
          given.path / "first");
  Value* const points = numbers_at<S>(given.points, given.path / "points");
  return std::pair<Value*, std::span<Value>>(points + given.first, {points, given.length});
}

/// What nets, curves and splines have in common.
template <typename S, typename View, typename Struct>
void set_points(View& view, const Given<Struct>& given, std::size_t count) {
  std::tie(view.points, view.memory) = first_value<S>(given, count);
  view.point_stride = given.point_stride;
  view.component_stride = given.component_stride;
  view.components = given.components;
  view.weights = weights_of(given);
}

/// Nets = ControlNets<S> or MutableNets<S>.
template <typename S, typename Nets, typename Struct>
Nets nets_like(const Given<Struct>& given) {
  Nets nets;
  set_points<S>(nets, given, given.count);
  nets.count = given.count;
  nets.degree_u = given.degree_u;
  nets.degree_v = given.degree_v;
  nets.patch_stride = given.net_stride;
  nets.row_stride = given.row_stride;
  return nets;
}
template <typename S>
ControlNets<S> view_of(const Given<simdbezier_nets>& given) {
  return nets_like<S, ControlNets<S>>(given);
}
template <typename S>
MutableNets<S> view_of(const Given<simdbezier_mutable_nets>& given) {
  return nets_like<S, MutableNets<S>>(given);
}
template <typename S>
ControlCurves<S> view_of(const Given<simdbezier_control_curves>& given) {
  ControlCurves<S> curves;
  set_points<S>(curves, given, given.count);
  curves.count = given.count;
  curves.degree = given.degree;
  curves.curve_stride = given.curve_stride;
  return curves;
}

/// The statuses of outputs that have no members of their own.
inline constexpr std::initializer_list<Status::Code> kOutputFaults = {
    Status::null_output, Status::output_too_small, Status::overlapping_outputs};

/// The member of nets or curves that a status is about.
Path blamed_nets(Status status, const Path& nets);

/// What of curves a status is about; they have one degree.
Path blamed_curves(Status status, const Path& curves);

/// Whether values that may be left out are one a patch or a curve.
inline bool is_one_each(std::span<const double> values, std::size_t members) noexcept {
  return values.empty() || values.size() == members;
}

/// The member of RateOptions or FlattenOptions that bad_tolerance is about, at a patch or a curve.
template <typename Tolerances>
Path blamed_tolerance(const Tolerances& options, std::size_t at) {
  if (at < options.errors.size() && !(options.errors[at] >= 0)) {
    return kOptions / "errors";
  }
  return kOptions / (options.tolerances.empty() ? "tolerance" : "tolerances");
}

/// Room for what is read from an array of structs. No memory holds as many as are asked for where
/// there is none.
template <typename V>
void reserve(std::vector<V>& values, std::size_t length) {
  const bool overflows = length > values.max_size();
  try {
    values.reserve(length);
  } catch (const std::exception&) {
    throw Fault{overflows ? SIMDBEZIER_SIZE_OVERFLOW : SIMDBEZIER_OUT_OF_MEMORY, {"length"}};
  }
}

/// body(std::span<const View>) with the views that an array of structs describes. none: the numbers
/// of an array that has no element.
template <typename Struct, typename Body>
auto with_array(const Struct* array, std::size_t length, const char* name, Body body,
                simdbezier_scalar none = SIMDBEZIER_F32) {
  const simdbezier_scalar scalar = length == 0 ? none : read_element(array, 0, name).scalar;
  return with_scalar(scalar, Path{name, 0} / "scalar", [&]<typename S>() {
    std::vector<decltype(view_of<S>(read_element(array, 0, name)))> views;
    reserve(views, length);
    for (std::size_t k = 0; k < length; ++k) {
      views.push_back(view_of<S>(read_element(array, k, name)));
    }
    return body(std::span(std::as_const(views)));
  });
}
template <typename Body>
auto with_net_array(const simdbezier_nets* nets, std::size_t length, Body body) {
  return with_array(nets, length, "nets", body);
}

/// body(view) of one struct that was read.
template <typename Struct, typename Body>
auto with_view(const Given<Struct>& given, Body body) {
  return with_scalar(given.scalar, given.path / "scalar",
                     [&]<typename S>() { return body(view_of<S>(given)); });
}

template <typename S>
std::size_t patches_in(const ControlNets<S>& nets) {
  return nets.count;
}
template <typename S>
std::size_t patches_in(const SplineSurface<S>& surface) {
  return detail::spans_of(surface).patches();
}
/// Finds the element of an array of nets or splines that holds a patch.
template <typename View>
Path element_with_patch(const char* name, std::span<const View> views, std::size_t patch) {
  std::size_t k = 0;
  while (k + 1 < views.size() && patch >= patches_in(views[k])) {
    patch -= patches_in(views[k++]);
  }
  return {name, k};
}
/// The member of nets that a status is about, at a patch of several.
template <typename S>
Path blamed_nets(Status status, std::span<const ControlNets<S>> nets, std::size_t patch) {
  return blamed_nets(status, element_with_patch("nets", nets, patch));
}

template <typename T>
Vectors<T> output_of(const simdbezier_vectors& given, const Path& path) {
  if (given.x == nullptr && given.y == nullptr && given.z == nullptr && given.capacity == 0) {
    return {};
  }
  require(given.x != nullptr, SIMDBEZIER_NULL_OUTPUT, path / "x");
  require_scalar<T>(given.scalar, path);
  require(given.stride > 0, SIMDBEZIER_BAD_STRIDE, path / "stride");
  return {numbers_at<T>(given.x, path / "x"), numbers_at<T>(given.y, path / "y"),
          numbers_at<T>(given.z, path / "z"), given.stride, given.capacity};
}

template <typename T>
Values<T> output_of(const simdbezier_values& given, const Path& path) {
  if (given.first == nullptr && given.length == 0) {
    return {};
  }
  require(given.first != nullptr, SIMDBEZIER_NULL_OUTPUT, path / "first");
  require_scalar<T>(given.scalar, path);
  return std::span<T>(numbers_at<T>(given.first, path / "first"), given.length);
}

/// Whether a status is about an output, where it is wanted.
template <typename T>
bool is_at_fault(const Vectors<T>& vectors, Status status, std::size_t samples,
                 std::int64_t components) {
  if (!vectors.wanted()) {
    return false;
  }
  switch (status.code()) {
  case Status::output_too_small:
    return vectors.capacity < samples;
  case Status::bad_stride:
    return vectors.stride < components && vectors.y == vectors.x + 1;
  default:
    return detail::check_planes(vectors, static_cast<std::size_t>(components)) == status;
  }
}
template <typename V>
bool is_at_fault(const Values<V>& values, Status status, std::size_t samples,
                 std::int64_t /*components*/) {
  return status == Status::output_too_small && values.wanted() && values.capacity < samples;
}

/// The plane of a vector output that a status is about, or the whole of it.
inline Path blamed_plane(Status status, const Path& vectors) {
  return blamed(status,
                {{{Status::missing_y, Status::extra_y}, vectors / "y"},
                 {{Status::missing_z, Status::extra_z}, vectors / "z"}},
                vectors);
}

/// Structs of the C API as those of C++ that have the same layout, which the caller has asserted.
template <typename To, typename From>
std::span<To> in_place(std::span<From> from) {
  static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
  return {reinterpret_cast<To*>(from.data()), from.size()};
}

inline SetRange range_of(std::size_t first, std::size_t count) {
  // The largest count is no set's, and must not be taken for the number that means all the rest.
  return {first, count == 0 ? SetRange::kToTheEnd : std::min(count, SetRange::kToTheEnd - 1)};
}

/// What a status of an evaluation is about, where it is not one of the outputs.
Path blamed_in_call(Status status, const Path& where);

/// A parameter that something is cut at: a finite number, or a fraction of whole numbers.
template <typename T>
UnitParameter<T> parameter_of(const simdbezier_parameter& given, const Path& path) {
  if (given.denominator == 0) {
    const T value = static_cast<T>(given.value);
    require(std::isfinite(value), SIMDBEZIER_NON_FINITE_INPUT, path);
    return given.from_end != 0 ? UnitParameter<T>::from_end(value) : UnitParameter<T>(value);
  }
  const bool integer = given.value >= INT32_MIN && given.value <= INT32_MAX &&
                       given.value == static_cast<double>(static_cast<int>(given.value));
  require(integer && given.denominator > 0, SIMDBEZIER_BAD_VALUE, path);
  const auto there = UnitParameter<T>::fraction(static_cast<int>(given.value), given.denominator);
  return given.from_end != 0 ? there.mirrored() : there;
}

} // namespace simdbezier::c_api
