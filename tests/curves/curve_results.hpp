// Outputs of calls for curves in planes of their own, and calls that prove what ran.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/curves/curve_oracle.hpp"
#include "tests/support/hash.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {

/// Every output of a call in unit-stride planes, with untouched values around them.
template <typename T>
struct CurveResults {
  static constexpr std::size_t kGuard = 19;
  static constexpr T kUntouched = T(-777);

  std::size_t samples;
  int planes; ///< a vector
  bool bent;  ///< tangents and curvatures as well
  std::vector<T> values;
  std::vector<SampleStatus> status;

  CurveResults(std::size_t count, int components)
      : samples(count), planes(std::min(components, 3)), bent(components == 2 || components == 3),
        values(13 * (count + kGuard), kUntouched), status(count, SampleStatus::degenerate) {}

  [[nodiscard]] T* plane(std::size_t index) { return values.data() + index * (samples + kGuard); }
  [[nodiscard]] const T* plane(std::size_t index) const {
    return values.data() + index * (samples + kGuard);
  }
  /// Component c of the d-th of position, d1, d2, tangent.
  [[nodiscard]] T at(std::size_t d, std::size_t c, std::size_t sample) const {
    return plane(3 * d + c)[sample];
  }
  [[nodiscard]] T curvature(std::size_t sample) const { return plane(12)[sample]; }

  CurveOutputs<T> outputs() {
    CurveOutputs<T> out;
    const auto group = [&](std::size_t d) {
      return Vectors<T>{plane(3 * d), planes > 1 ? plane(3 * d + 1) : nullptr,
                        planes > 2 ? plane(3 * d + 2) : nullptr, 1};
    };
    out.position = group(0);
    out.d1 = group(1);
    out.d2 = group(2);
    out.status = status.data();
    if (bent) {
      out.tangent = group(3);
      out.curvature = plane(12);
    }
    return out;
  }

  void expect_guards() const {
    for (std::size_t p = 0; p < 13; ++p) {
      for (std::size_t k = 0; k < kGuard; ++k) {
        ASSERT_EQ(plane(p)[samples + k], kUntouched) << "behind plane " << p;
      }
    }
  }
  [[nodiscard]] std::uint64_t hash() const {
    Fnv1a hash;
    hash.add_all(std::span<const T>(values));
    hash.add_bytes(status.data(), status.size() * sizeof(SampleStatus));
    return hash.value();
  }
};

class CurveTest : public IsaTest {
protected:
  template <typename T, typename Where, typename How = CallOptions>
  void evaluate(const CurveSet<T>& set, const Where& where, const CurveOutputs<T>& out,
                const How& options = {}) {
    using simdbezier::evaluate;
    run(options, [&](const How& forced) { return evaluate(set, where, out, forced); });
  }

  template <typename T, typename S>
  static CurveSet<T> packed(const CurveBatch<S>& batch, const PackOptions& options = {}) {
    CurveSet<T> set;
    const Report report = pack(batch.view(), set, options);
    EXPECT_TRUE(report) << to_string(report.status) << " curve " << report.item << " point "
                        << report.point << " component " << report.component;
    return set;
  }
};

} // namespace simdbezier::tests
