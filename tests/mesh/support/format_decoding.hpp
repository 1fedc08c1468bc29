// Decodes the bytes of vertex formats to values.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <simdbezier/evaluate_mesh.hpp>

#include "tests/mesh/support/mesh_oracle.hpp"

namespace simdbezier::tests {

template <typename Value>
Value read(const std::vector<unsigned char>& bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, &bytes[at], sizeof value);
  return value;
}

inline double from_half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const double fraction = bits & 1023;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == 31) {
    return sign * std::numeric_limits<double>::infinity();
  }
  return sign *
         (exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25));
}

/// Component c of what is stored at a place.
inline double decode(VertexFormat format, const std::vector<unsigned char>& bytes, std::size_t at,
                     std::size_t c, const QuantisationBox& box) {
  switch (format) {
  case VertexFormat::float32:
    return static_cast<double>(read<float>(bytes, at + 4 * c));
  case VertexFormat::half:
    return from_half(read<std::uint16_t>(bytes, at + 2 * c));
  case VertexFormat::unorm16:
    return box.low[c] + box.step * read<std::uint16_t>(bytes, at + 2 * c);
  default:
    return box.low[c] + box.step * read<std::int16_t>(bytes, at + 2 * c);
  }
}

inline Point decode_normal(VertexFormat format, const std::vector<unsigned char>& bytes,
                           std::size_t at) {
  if (format == VertexFormat::float32) {
    return {read<float>(bytes, at), read<float>(bytes, at + 4), read<float>(bytes, at + 8)};
  }
  const bool wide = format == VertexFormat::octahedral16;
  double s = wide ? read<std::int16_t>(bytes, at) / 32767.0 : read<std::int8_t>(bytes, at) / 127.0;
  double t =
      wide ? read<std::int16_t>(bytes, at + 2) / 32767.0 : read<std::int8_t>(bytes, at + 1) / 127.0;
  const double z = 1 - std::fabs(s) - std::fabs(t);
  if (z < 0) {
    const double folded = std::copysign(1 - std::fabs(t), s);
    t = std::copysign(1 - std::fabs(s), t);
    s = folded;
  }
  const Point n = {s, t, z};
  return 1 / length(n) * n;
}

} // namespace simdbezier::tests
