// What the library's rows have in common: outputs in its terms, and the proof which code ran.
#pragma once

#include <span>
#include <string>

#include <simdbezier/simdbezier.hpp>

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

/// Returns the library's outputs, in the order of the name.
inline std::span<const simdbezier::Output> outputs_of(OutputGroups groups) {
  using simdbezier::Output;
  static constexpr Output kDerivatives[] = {Output::position, Output::du,  Output::dv,
                                            Output::duu,      Output::duv, Output::dvv};
  static constexpr Output kNormal[] = {Output::position, Output::normal};
  if (groups == OutputGroups::position_normal) {
    return kNormal;
  }
  return std::span(kDerivatives).first(group_count(groups));
}

template <typename T>
simdbezier::Outputs<T> library_outputs(const Results<T>& results) {
  simdbezier::Outputs<T> out;
  T* const* p = results.component;
  for (const simdbezier::Output output : outputs_of(results.groups)) {
    out[output] = {p[0], p[1], p[2], static_cast<std::ptrdiff_t>(results.stride)};
    p += 3;
  }
  if (results.groups == OutputGroups::curvature) {
    out.curvature = {p[0], p[1], p[2], p[3]};
  }
  return out;
}

template <typename T>
Results<T> results_of(const simdbezier::Outputs<T>& out, OutputGroups groups) {
  Results<T> results;
  results.groups = groups;
  T** p = results.component;
  for (const simdbezier::Output output : outputs_of(groups)) {
    const simdbezier::Vectors<T>& group = out[output];
    *p++ = group.x;
    *p++ = group.y;
    *p++ = group.z;
    results.stride = static_cast<std::size_t>(group.stride);
  }
  return results;
}

/// Runs call(options), which returns a Status. Returns an empty string, or what went wrong: an
/// error, or another instruction set than the one that options.isa names.
template <typename Call>
std::string run_verified(const simdbezier::Options& options, Call call) {
  static_cast<void>(simdbezier::take_executed_isa()); // of calls before
  const simdbezier::Status status = call(options);
  const simdbezier::Isa executed = simdbezier::take_executed_isa();
  if (status != simdbezier::Status::ok) {
    return std::string(simdbezier::to_string(status));
  }
  if (options.isa != simdbezier::Isa::automatic && executed != options.isa) {
    return "another instruction set ran: " + std::string(simdbezier::to_string(executed));
  }
  return {};
}

/// Does so for a call that reads `patches` patches of a set, if the set has them.
template <typename T, typename Call>
std::string run_verified(const simdbezier::PatchSet<T>& set, std::size_t patches,
                         const simdbezier::Options& options, Call call) {
  return set.size() < patches ? "the patches could not be packed" : run_verified(options, call);
}

} // namespace simdbezier_bench
