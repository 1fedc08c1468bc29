// evaluate() of simdbezier.h, for patches and for curves.
#pragma once

#include <cstdint>
#include <type_traits>

#include <simdbezier/curves.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {

/// Where a set is evaluated, and what is wanted there. Braces read the first before the second, so
/// that of two faults the first argument's is named.
template <typename Where, typename Outputs>
struct SetCall {
  Where where;
  Outputs out;
};
template <typename Where, typename Outputs>
SetCall(Where, Outputs) -> SetCall<Where, Outputs>; // clang 14 deduces none for aggregates

/// The first wanted output of one number a sample, status apart, that has too little memory; null
/// where there is none.
template <typename T>
const char* short_values(const Outputs<T>& out, std::size_t samples) {
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    const auto curvature = static_cast<Curvature>(k);
    if (is_short(out.curvature[curvature], samples)) {
      return output_name(curvature);
    }
  }
  return nullptr;
}
template <typename T>
const char* short_values(const CurveOutputs<T>& out, std::size_t samples) {
  return is_short(out.curvature, samples) ? "curvature" : nullptr;
}

/// The output of a refused call that a status is about; all of them where it is none of them alone.
template <typename Out>
Path blamed_output(const Out& out, Status status, std::size_t samples, std::int64_t components) {
  const Path all{"out"};
  for (std::size_t k = 0; k < Out::kVectors; ++k) {
    const auto name = static_cast<typename Out::Name>(k);
    if (is_at_fault(out[name], status, samples, components)) {
      return blamed_plane(status, all / output_name(name));
    }
  }
  if (status != Status::output_too_small) {
    return all;
  }
  if (const char* const name = short_values(out, samples); name != nullptr) {
    return all / name;
  }
  return is_short(out.status, samples) ? all / "status" : all;
}

/// read(std::type_identity<T>): the SetCall of a set of T. path: the argument that says where.
template <typename Handle, typename Read>
simdbezier_status evaluate_set(const char* function, const Handle* handle, const Path& path,
                               const simdbezier_options* options, Read read) noexcept {
  return answer(function, [&] {
    with_object(
        handle, {"set"}, [&]<template <typename> typename Set, typename T>(const Set<T>& set) {
          const auto call = read(std::type_identity<T>());
          const Options how = call_options_of(options);
          require_ok(evaluate(set, call.where, call.out, how), [&](Status status) {
            const Path blamed = blamed_in_call(status, path);
            return blamed.is_of({"out"}) && blamed.member == nullptr
                       ? blamed_output(call.out, status, sample_count(set, call.where),
                                       std::int64_t{set.components()} - call.out.first_component)
                       : blamed;
          });
        });
  });
}

/// How many samples a set has where read(std::type_identity<T>()) says; 0 where something is wrong.
template <typename Handle, typename Read>
std::size_t samples_at(const Handle* handle, Read read) noexcept {
  return size_or_zero([&] {
    return with_object(handle, {"set"},
                       [&]<template <typename> typename Set, typename T>(const Set<T>& set) {
                         return sample_count(set, read(std::type_identity<T>()));
                       });
  });
}

} // namespace simdbezier::c_api
