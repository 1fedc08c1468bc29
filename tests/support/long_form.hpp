// The short and the long form of tests. `./run test` runs the short one, in which every kind of
// case is there, and every pair of choices that do not depend on each other. `./run accuracy` runs
// the long one: whole products of choices, and more samples.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace simdbezier::tests {

/// SIMDBEZIER_LONG_TESTS is in the environment.
[[nodiscard]] inline bool long_form() {
  static const bool asked = std::getenv("SIMDBEZIER_LONG_TESTS") != nullptr;
  return asked;
}

/// How much of something there is in each form.
template <typename N>
[[nodiscard]] N by_form(N in_short, N in_long) {
  return long_form() ? in_long : in_short;
}

/// Whether one case of a product of choices is tested: one in `share`, or all of them in the long
/// form. `sum` adds up the numbers of the choices, so that each pair of choices remains where a
/// third one has at least `share` values.
[[nodiscard]] inline bool in_form(std::size_t sum, std::size_t share) {
  return long_form() || sum % share == 0;
}

} // namespace simdbezier::tests
