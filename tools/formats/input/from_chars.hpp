// Numbers from text. libc++ has std::from_chars() of doubles from version 20 on.
#pragma once

#include <charconv>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include <fast_float/fast_float.h>
#endif

namespace simdbezier::tools {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
/// As std::from_chars(), except that a number too large for a double may be infinity without an
/// error, which readers refuse all the same. It is large, and inlined it would be there thrice.
[[gnu::noinline]] inline fast_float::from_chars_result
from_chars(const char* begin, const char* end, double& value) noexcept {
  return fast_float::from_chars(begin, end, value);
}
#else
inline std::from_chars_result from_chars(const char* begin, const char* end,
                                         double& value) noexcept {
  return std::from_chars(begin, end, value);
}
#endif

} // namespace simdbezier::tools
