// Values for the C API and for C++ alike: random nets, memory for results, and the helpers of
// types.h by type instead of by name.
#pragma once

#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier.h>
#include <simdbezier/simdbezier.hpp>

#include "tests/support/random.hpp"

namespace simdbezier::tests {

template <typename T>
inline constexpr simdbezier_scalar kCScalar = sizeof(T) == 4 ? SIMDBEZIER_F32 : SIMDBEZIER_F64;

/// `count` values of [1, 2): fit for weights as well.
template <typename T>
[[nodiscard]] std::vector<T> random_values(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> values(count);
  for (T& value : values) {
    value = static_cast<T>(1 + static_cast<double>(random.below(1U << 20)) / (1U << 20));
  }
  return values;
}

inline simdbezier_vectors c_triples(std::vector<float>& values, std::ptrdiff_t stride = 3) {
  return simdbezier_triples_f32(values.data(), values.size(), stride);
}
inline simdbezier_vectors c_triples(std::vector<double>& values, std::ptrdiff_t stride = 3) {
  return simdbezier_triples_f64(values.data(), values.size(), stride);
}
inline simdbezier_vectors c_pairs(std::vector<float>& values, std::ptrdiff_t stride = 2) {
  return simdbezier_pairs_f32(values.data(), values.size(), stride);
}
inline simdbezier_vectors c_pairs(std::vector<double>& values, std::ptrdiff_t stride = 2) {
  return simdbezier_pairs_f64(values.data(), values.size(), stride);
}
inline simdbezier_values c_values(std::vector<float>& values) {
  return simdbezier_values_f32(values.data(), values.size());
}
inline simdbezier_values c_values(std::vector<double>& values) {
  return simdbezier_values_f64(values.data(), values.size());
}
template <typename T>
simdbezier_nets c_nets(const std::vector<T>& values, int degree_u, int degree_v,
                       simdbezier_weights weights = SIMDBEZIER_POLYNOMIAL) {
  return simdbezier_packed_nets_of(values.data(), values.size(), degree_u, degree_v, 3, weights,
                                   kCScalar<T>);
}
template <typename T>
simdbezier_mutable_nets c_room(std::vector<T>& values, int degree_u, int degree_v,
                               simdbezier_weights weights = SIMDBEZIER_POLYNOMIAL) {
  return simdbezier_packed_mutable_nets_of(values.data(), values.size(), degree_u, degree_v, 3,
                                           weights, kCScalar<T>);
}

/// A struct of the C API with its size and zeros.
template <typename S>
[[nodiscard]] S sized() {
  S zeros{};
  zeros.struct_size = sizeof zeros;
  return zeros;
}

#define EXPECT_C_OK(call) EXPECT_EQ(call, SIMDBEZIER_OK) << simdbezier_last_message()

/// Bits, not values: zeros of both signs differ.
template <typename V>
void expect_same_bits(const std::vector<V>& a, const std::vector<V>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  if (!a.empty()) { // memcmp() takes no null pointers
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(V)), 0) << what;
  }
}

struct FreePatchSet {
  void operator()(simdbezier_patch_set* set) const { simdbezier_patch_set_free(set); }
};
using CPatchSet = std::unique_ptr<simdbezier_patch_set, FreePatchSet>;
struct FreeCurveSet {
  void operator()(simdbezier_curve_set* set) const { simdbezier_curve_set_free(set); }
};
using CCurveSet = std::unique_ptr<simdbezier_curve_set, FreeCurveSet>;

template <typename T>
CPatchSet c_pack(const simdbezier_nets& nets) {
  simdbezier_patch_set* set = nullptr;
  EXPECT_C_OK(simdbezier_pack(&nets, 1, kCScalar<T>, nullptr, &set));
  return CPatchSet(set);
}
template <typename T>
CCurveSet c_pack(const simdbezier_control_curves& curves) {
  simdbezier_curve_set* set = nullptr;
  EXPECT_C_OK(simdbezier_pack_curves(&curves, kCScalar<T>, nullptr, &set));
  return CCurveSet(set);
}

} // namespace simdbezier::tests
