// Turns values into the bits of vertex formats.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <simdbezier/evaluate_mesh.hpp>

namespace simdbezier::detail {

/// The bits of the nearest half-precision number, ties to even.
inline std::uint16_t to_half(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000U;
  const std::uint32_t magnitude = bits & 0x7fffffffU;
  if (magnitude > 0x7f800000U) {
    return static_cast<std::uint16_t>(sign | 0x7e00U); // nan
  }
  if (magnitude >= 0x477ff000U) { // rounds to 2^16 or more
    return static_cast<std::uint16_t>(sign | 0x7c00U);
  }
  if (magnitude < 0x38800000U) { // below 2^-14: a multiple of 2^-24, rounded by the addition
    const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000U));
  }
  const std::uint32_t odd = magnitude >> 13 & 1U;
  return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000U + 0xfffU + odd) >> 13));
}

/// The nearest whole number within limits; halves upwards. The lower limit for nan.
inline double to_whole(double value, double low, double high) noexcept {
  return std::min(std::max(low, std::floor(value + 0.5)), high);
}

template <typename Value>
void put_value(unsigned char*& to, Value value) noexcept {
  std::memcpy(to, &value, sizeof value);
  to += sizeof value;
}

/// Writes a component of a position or a parameter. low, step: of whole numbers, whose value k
/// stands for low + k * step.
inline void put_component(VertexFormat format, double value, double low, double step,
                          unsigned char*& to) noexcept {
  switch (format) {
  case VertexFormat::float32:
    put_value(to, static_cast<float>(value));
    break;
  case VertexFormat::half:
    put_value(to, to_half(static_cast<float>(value)));
    break;
  case VertexFormat::unorm16:
    put_value(to, static_cast<std::uint16_t>(to_whole((value - low) / step, 0, 65535)));
    break;
  default:
    put_value(to, static_cast<std::int16_t>(to_whole((value - low) / step, -32767, 32767)));
  }
}

/// A unit normal, or zero.
inline void put_normal(VertexFormat format, const double (&n)[3], unsigned char* to) noexcept {
  if (format == VertexFormat::float32) {
    for (const double component : n) {
      put_value(to, static_cast<float>(component));
    }
    return;
  }
  const double sum = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  double s = sum > 0 ? n[0] / sum : 0;
  double t = sum > 0 ? n[1] / sum : 0;
  if (n[2] < 0) {
    const double folded = std::copysign(1 - std::fabs(t), s);
    t = std::copysign(1 - std::fabs(s), t);
    s = folded;
  }
  for (const double value : {s, t}) {
    if (format == VertexFormat::octahedral16) {
      put_value(to, static_cast<std::int16_t>(to_whole(32767 * value, -32767, 32767)));
    } else {
      put_value(to, static_cast<std::int8_t>(to_whole(127 * value, -127, 127)));
    }
  }
}

} // namespace simdbezier::detail
