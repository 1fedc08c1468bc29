// Control nets from the shared data files, read as plain streams of numbers and without the
// project's own readers. The folder may be absent; callers then skip.
#pragma once

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/nets/net.hpp"

#ifndef SIMDBEZIER_SHARED_DATA
#error "the build defines SIMDBEZIER_SHARED_DATA, the folder of the shared data files"
#endif

namespace simdbezier::tests {

/// The whole file as text, unpacked by gzip where its name ends in .gz; empty where absent.
#if defined(__wasm__)
// A WebAssembly module has no files.
[[nodiscard]] inline std::string data_text(const std::string& /*name*/) { return {}; }
#else
[[nodiscard]] inline std::string data_text(const std::string& name) {
  const std::string path = std::string(SIMDBEZIER_SHARED_DATA) + "/" + name;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return {};
  }
  if (!name.ends_with(".gz")) {
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string text;
  FILE* pipe = popen(("gzip -dc '" + path + "'").c_str(), "r");
  if (pipe == nullptr) {
    return {};
  }
  char buffer[65536];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    text.append(buffer, n);
  }
  pclose(pipe);
  return text;
}
#endif

/// All complete bicubic nets of a `.bez` or `.bpt` file; empty where the file is absent.
[[nodiscard]] inline std::vector<Net> data_nets(const std::string& name) {
  std::istringstream text(data_text(name));
  const bool has_degrees = name.find(".bpt") != std::string::npos;
  std::size_t count = 0;
  text >> count;
  std::vector<Net> nets;
  for (std::size_t p = 0; p < count; ++p) {
    Net net;
    if (has_degrees && !(text >> net.degree_v >> net.degree_u)) {
      break;
    }
    for (Vector3& point : net.points) {
      text >> point[0] >> point[1] >> point[2];
    }
    if (!text) {
      break;
    }
    nets.push_back(net);
  }
  return nets;
}

/// Every file of the folder that holds at least one complete net.
inline constexpr const char* kDataFiles[] = {
    "teapot.bpt",    "teapot28.bez",           "teacup.bez",    "teaspoon.bez", "gumbo.bez",
    "wavy_cube.bez", "sphere_lying_count.bez", "bigguy.bez.gz", "pawn2.bez.gz", "car4.bez.gz"};

} // namespace simdbezier::tests
