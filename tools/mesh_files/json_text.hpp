// Pieces of JSON as the headers of GLB files and raw arrays have them.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

inline std::string quoted(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted(1, '"');
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      quoted += "\\u00";
      quoted += kDigits[byte >> 4];
      quoted += kDigits[byte & 15];
      continue;
    }
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

inline std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) {
    text += part;
  }
  return text;
}

inline std::string list(const std::array<double, 3>& values) {
  return joined(
      {"[", shortest(values[0]), ",", shortest(values[1]), ",", shortest(values[2]), "]"});
}

/// Returns "name":value.
inline std::string member(std::string_view name, std::string_view value) {
  return joined({quoted(name), ":", value});
}
inline std::string member(std::string_view name, std::uint64_t value) {
  return member(name, std::to_string(value));
}

} // namespace simdbezier::tools
