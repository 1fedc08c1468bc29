// How a target says that something is wrong: it prints what and aborts, which the fuzzer records.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>

#include <simdbezier/status.hpp>

namespace simdbezier::fuzz {

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

inline void require(bool condition, std::string_view what) {
  if (!condition) {
    fail(std::string(what));
  }
}

/// Fails with a message that takes time to make, where the condition is not met.
template <typename F>
requires requires(F& message) { std::string(message()); }
void require(bool condition, F&& message) {
  if (!condition) {
    fail(message());
  }
}

/// What a call may return, ok included.
inline void require_status(Status status, std::initializer_list<Status> documented,
                           std::string_view call) {
  for (const Status one : documented) {
    if (status == one) {
      return;
    }
  }
  fail(std::string(call) + " returned " + std::string(to_string(status)));
}

/// Equal bits; nans are equal whatever their sign, which depends on the machine.
template <typename T>
[[nodiscard]] bool same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

/// Ranges of equal length with equal bits.
template <typename A, typename B>
void require_equal(const A& a, const B& b, const std::string& what) {
  require(std::size(a) == std::size(b), [&] { return what + ": another number of values"; });
  for (std::size_t k = 0; k < std::size(a); ++k) {
    require(same_bits(a[k], b[k]), [&] {
      char values[96];
      std::snprintf(values, sizeof values, ": value %zu is %a instead of %a", k,
                    static_cast<double>(a[k]), static_cast<double>(b[k]));
      return what + values;
    });
  }
}

} // namespace simdbezier::fuzz
