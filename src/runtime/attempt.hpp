// Calls that return what they allocate.
#pragma once

#include <new>
#include <stdexcept>

#include <simdbezier/status.hpp>

namespace simdbezier::detail {

/// What step(result) makes; where it does not succeed or memory does not suffice, an empty result
/// with the report.
template <typename Result, typename Step>
Result attempt(const Step& step) noexcept {
  Result result;
  try {
    result.report.status = step(result);
  } catch (const std::bad_alloc&) {
    result.report.status = Status::out_of_memory;
  } catch (const std::length_error&) {
    result.report.status = Status::size_overflow;
  }
  if (result) {
    return result;
  }
  Result none;
  none.report = result.report;
  return none;
}

} // namespace simdbezier::detail
