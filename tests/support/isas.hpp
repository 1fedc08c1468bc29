// Which instruction sets builds and machines have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <simdbezier/options.hpp>

namespace simdbezier::tests {

/// Every instruction set that has a name, whether this build has it or not.
inline const std::vector<Isa> kEveryIsa = [] {
  std::vector<Isa> isas;
  for (unsigned k = 1; isa_from_name(to_string(static_cast<Isa>(k))); ++k) {
    isas.push_back(static_cast<Isa>(k));
  }
  return isas;
}();

[[nodiscard]] inline bool is_available(Isa isa) {
  return std::ranges::count(available_isas(), isa) > 0;
}

/// An instruction set that calls refuse. There always is one, since no machine has both AVX-512 and
/// NEON.
[[nodiscard]] inline Isa absent_isa() { return *std::ranges::find_if_not(kEveryIsa, is_available); }

/// Whether one that is available belongs to the class of results.
[[nodiscard]] inline bool has_class(bool fused) {
  return std::ranges::count(available_isas(), fused, fuses_multiply_add) > 0;
}

/// The widest available instruction set of each class of results, narrow ones first.
[[nodiscard]] inline std::vector<Isa> widest_of_each_class() {
  const std::span<const Isa> available = available_isas();
  std::vector<Isa> widest;
  for (std::size_t k = 0; k < available.size(); ++k) {
    if (k + 1 == available.size() ||
        fuses_multiply_add(available[k]) != fuses_multiply_add(available[k + 1])) {
      widest.push_back(available[k]);
    }
  }
  return widest;
}

} // namespace simdbezier::tests
