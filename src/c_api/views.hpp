// The C++ views and options that structs of simdbezier.h stand for, checked as far as C++ cannot:
// null pointers, lengths, types, numbers that stand for names.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/status.hpp>

#include "src/c_api/structs.hpp"
#include "src/output/output_list.hpp"

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
  const simdbezier_options known = read_options(given, kOptions);
  return {.threads = known.threads,
          .isa = isa_of(known.isa, kOptions / "isa"),
          .watertight = known.not_watertight == 0,
          .destination = destination_of(known.destination)};
}

inline PackOptions pack_options_of(const simdbezier_pack_options* given) {
  const simdbezier_pack_options known = read_options(given, kOptions);
  PackOptions options;
  options.local_origin = known.local_origin != 0;
  std::copy_n(known.relative_to, 3, options.relative_to);
  options.threads = known.threads;
  options.isa = isa_of(known.isa, kOptions / "isa");
  return options;
}

inline Weights weights_of(simdbezier_weights weights, const Path& path) {
  return choice(weights, Weights::homogeneous, path / "weights");
}

inline Parameters parameters_of(simdbezier_parameters parameters, const Path& path) {
  return choice(parameters, Parameters::centred, path / "parameters");
}

/// The address of the first value of nets or curves; memory that is null or too short is refused.
template <typename S, typename Struct>
auto first_value(const Struct& given, const Path& path) {
  constexpr bool kInput = std::is_const_v<std::remove_pointer_t<decltype(given.points)>>;
  using Value = std::conditional_t<kInput, const S, S>;
  require_scalar<S>(given.scalar, path);
  if (given.count == 0) {
    return std::pair<Value*, std::span<Value>>();
  }
  require(given.points != nullptr, kInput ? SIMDBEZIER_NULL_INPUT : SIMDBEZIER_NULL_OUTPUT,
          path / "points");
  constexpr auto kTooSmall = kInput ? SIMDBEZIER_INPUT_TOO_SMALL : SIMDBEZIER_OUTPUT_TOO_SMALL;
  require(given.length > 0, kTooSmall, path / "length");
  require(given.first >= 0 && static_cast<std::size_t>(given.first) < given.length, kTooSmall,
          path / "first");
  Value* const points = numbers_at<S>(given.points, path / "points");
  return std::pair<Value*, std::span<Value>>(points + given.first, {points, given.length});
}

/// Nets = ControlNets<S> or MutableNets<S>.
template <typename S, typename Nets, typename Struct>
Nets nets_like(const Struct& given, const Path& path) {
  const auto [points, memory] = first_value<S>(given, path);
  return {points,
          given.count,
          given.degree_u,
          given.degree_v,
          given.net_stride,
          given.row_stride,
          given.point_stride,
          given.component_stride,
          given.components,
          weights_of(given.weights, path),
          memory};
}
template <typename S>
ControlNets<S> nets_of(const simdbezier_nets& given, const Path& path) {
  return nets_like<S, ControlNets<S>>(given, path);
}
template <typename S>
MutableNets<S> nets_of(const simdbezier_mutable_nets& given, const Path& path) {
  return nets_like<S, MutableNets<S>>(given, path);
}
template <typename S>
ControlCurves<S> curves_of(const simdbezier_control_curves& given, const Path& path) {
  const auto [points, memory] = first_value<S>(given, path);
  return {points,
          given.count,
          given.degree,
          given.curve_stride,
          given.point_stride,
          given.component_stride,
          given.components,
          weights_of(given.weights, path),
          memory};
}

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

/// body(std::span<const ControlNets<S>>) with the nets of an array, S being their type.
template <typename Body>
auto with_net_array(const simdbezier_nets* nets, std::size_t length, Body body) {
  const simdbezier_scalar scalar =
      length == 0 ? SIMDBEZIER_F32 : read_element(nets, 0, "nets").scalar;
  return with_scalar(scalar, Path{"nets", 0} / "scalar", [&]<typename S>() {
    std::vector<ControlNets<S>> views;
    reserve(views, length);
    for (std::size_t k = 0; k < length; ++k) {
      views.push_back(nets_of<S>(read_element(nets, k, "nets"), {"nets", k}));
    }
    return body(std::span<const ControlNets<S>>(views));
  });
}

/// Finds the nets, of several, that hold a patch.
template <typename S>
Path nets_with_patch(std::span<const ControlNets<S>> nets, std::size_t patch) {
  std::size_t k = 0;
  while (k + 1 < nets.size() && patch >= nets[k].count) {
    patch -= nets[k++].count;
  }
  return {"nets", k};
}

template <typename T>
Vectors<T> vectors_of(const simdbezier_vectors& given, const Path& path) {
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
Values<T> values_of(const simdbezier_values& given, const Path& path) {
  if (given.first == nullptr && given.length == 0) {
    return {};
  }
  require(given.first != nullptr, SIMDBEZIER_NULL_OUTPUT, path / "first");
  require_scalar<T>(given.scalar, path);
  return std::span<T>(numbers_at<T>(given.first, path / "first"), given.length);
}

/// Structs of the C API as those of C++ that have the same layout, which the caller has asserted.
template <typename To, typename From>
std::span<To> in_place(std::span<From> from) {
  static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
  return {reinterpret_cast<To*>(from.data()), from.size()};
}

/// SIMDBEZIER_SAMPLE_… and SampleStatus are the same bytes.
inline Values<SampleStatus> sample_statuses(std::uint8_t* first, std::size_t length,
                                            const Path& path) {
  if (first == nullptr && length == 0) {
    return {};
  }
  require(first != nullptr, SIMDBEZIER_NULL_OUTPUT, path / "status");
  return std::span(reinterpret_cast<SampleStatus*>(first), length);
}

/// What members of a struct of parameters are called.
struct ParameterNames {
  const char* values;
  const char* length;
};

/// `count` parameters of a grid; null: uniform ones.
template <typename T>
const T* grid_parameters(const void* first, std::size_t length, std::size_t count,
                         simdbezier_scalar scalar, const Path& path, const ParameterNames& names) {
  if (first == nullptr) {
    require(length == 0, SIMDBEZIER_NULL_INPUT, path / names.length);
    return nullptr;
  }
  require_scalar<T>(scalar, path);
  require(length >= count, SIMDBEZIER_INPUT_TOO_SMALL, path / names.length);
  return numbers_at<T>(first, path / names.values);
}

/// The parameters of single samples.
template <typename T>
std::span<const T> sample_parameters(const void* first, std::size_t length,
                                     simdbezier_scalar scalar, const Path& path,
                                     const char* member) {
  require_scalar<T>(scalar, path);
  return span_of(numbers_at<T>(first, path / member), length, path / member);
}

inline SetRange range_of(std::size_t first, std::size_t count) {
  // The largest count is no set's, and must not be taken for the number that means all the rest.
  return {first, count == 0 ? SetRange::kToTheEnd : std::min(count, SetRange::kToTheEnd - 1)};
}

/// Whether an output of one number a sample is wanted and has too little memory.
template <typename V>
bool is_short(const Values<V>& values, std::size_t samples) {
  return values.wanted() && values.capacity < samples;
}

/// One vector output of a call, where it is wanted, that a status is about.
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

/// The plane of a vector output that a status is about, or the whole of it.
inline Path blamed_plane(Status status, const Path& vectors) {
  switch (status.code()) {
  case Status::missing_y:
  case Status::extra_y:
    return vectors / "y";
  case Status::missing_z:
  case Status::extra_z:
    return vectors / "z";
  default:
    return vectors;
  }
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
