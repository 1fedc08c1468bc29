// evaluate() of simdbezier.h, for patches and for curves.
#pragma once

#include <cstdint>
#include <type_traits>

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

/// read(std::type_identity<T>): the SetCall of a set of T. path: the argument that says where.
/// blame(out, status, samples, components): which output is at fault.
template <typename Handle, typename Read, typename Blame>
simdbezier_status evaluate_set(const char* function, const Handle* handle, const Path& path,
                               const simdbezier_options* options, Read read, Blame blame) noexcept {
  return answer(function, [&] {
    with_object(handle, {"set"},
                [&]<template <typename> typename Set, typename T>(const Set<T>& set) {
                  const auto call = read(std::type_identity<T>());
                  const CallOptions how(options);
                  require_ok(evaluate(set, call.where, call.out, *how), [&](Status status) {
                    const Path blamed = blamed_in_call(status, path);
                    return blamed.is_of({"out"}) && blamed.member == nullptr
                               ? blame(call.out, status, sample_count(set, call.where),
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
