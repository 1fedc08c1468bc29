// Calls that return what they allocate.
#pragma once

#include <cstddef>
#include <new>
#include <stdexcept>

#include <simdbezier/status.hpp>

namespace simdbezier::detail {

/// What step(result) makes; where it does not succeed or memory does not suffice, an empty result
/// with the status, and with the number of the patch or curve at fault.
template <typename Result, typename Step>
Result attempt(std::size_t Result::*fault, const Step& step) noexcept {
  Result result;
  try {
    result.status = step(result);
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  } catch (const std::length_error&) {
    result.status = Status::size_overflow;
  }
  if (result) {
    return result;
  }
  Result none;
  none.status = result.status;
  none.*fault = result.*fault;
  return none;
}

} // namespace simdbezier::detail
