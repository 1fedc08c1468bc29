// What the tests of all instruction sets judge by, prepared once.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "tests/properties/accuracy/judge/measure.hpp"

namespace simdbezier::tests {

/// Families with the oracle's answers and de Casteljau's RMS.
template <typename T>
struct Prepared {
  std::vector<Family<T>> families;
  std::vector<Reference> references;
  std::vector<std::array<double, 2>> de_casteljau; ///< [0] rounded twice, [1] fused

  /// rms.operator()<kFused>(family, answers at unit parameters): de Casteljau's.
  template <typename Rms>
  Prepared(std::vector<Family<T>> all, const Rms& rms) : families(std::move(all)) {
    for (const Family<T>& family : families) {
      references.push_back(make_reference(family, true));
      const Reference at_unit = make_reference(family, false);
      de_casteljau.push_back({rms.template operator()<false>(family, at_unit),
                              rms.template operator()<true>(family, at_unit)});
    }
  }
};

} // namespace simdbezier::tests
