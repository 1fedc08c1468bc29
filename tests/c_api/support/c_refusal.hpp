// Calls of the C API with one argument spoiled, and how they have to end.
#pragma once

#include <functional>
#include <string>

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests {

/// `call` spoils one of the arguments that a World holds, and returns the status.
template <typename World>
struct Refusal {
  simdbezier_status status;
  std::string argument;
  std::function<simdbezier_status(World&)> call;
};

template <typename World>
void expect_refused(const Refusal<World>& one, World& world) {
  const simdbezier_status status = one.call(world);
  auto fault = sized<simdbezier_fault>();
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_EQ(status, one.status) << one.argument << "; " << simdbezier_last_message();
  EXPECT_EQ(fault.status, status);
  EXPECT_EQ(fault.argument, one.argument) << simdbezier_last_message();
}

/// A struct of a later version, with a member that this library does not know.
template <typename S>
struct Later {
  explicit Later(const S& of, std::size_t value = 1) : known(of), unknown(value) {
    known.struct_size = sizeof *this;
  }
  S known;
  std::size_t unknown;
};

/// Moves an address by half a float.
inline void between(void*& address) { address = static_cast<char*>(address) + 2; }
inline void between(const void*& address) { address = static_cast<const char*>(address) + 2; }

} // namespace simdbezier::tests
