// Turns a fuzzer's bytes into a case in the types that the first byte chooses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"

namespace simdbezier::fuzz {

/// Case<T> is made from a ByteSource and run.
template <template <typename> class Case>
int run_case(const std::uint8_t* data, std::size_t size) {
  ByteSource bytes(std::span(data, size));
  if (bytes.flag()) {
    Case<double>(bytes).run();
  } else {
    Case<float>(bytes).run();
  }
  return 0;
}

/// Case<T, S> of results in T from control points in S likewise.
template <template <typename, typename> class Case>
int run_mixed_case(const std::uint8_t* data, std::size_t size) {
  ByteSource bytes(std::span(data, size));
  switch (bytes.below(4)) {
  case 0:
    Case<float, float>(bytes).run();
    break;
  case 1:
    Case<double, double>(bytes).run();
    break;
  case 2:
    Case<float, double>(bytes).run();
    break;
  default:
    Case<double, float>(bytes).run();
    break;
  }
  return 0;
}

} // namespace simdbezier::fuzz
