// What the documents' fragments of code take for granted.
#pragma once

#include <array>
#include <cstdio>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

using namespace simdbezier;

/// Two flat bicubic patches and a grid.
#define SIMDBEZIER_DOCS_PRELUDE                                                                    \
  std::vector<std::array<float, 3>> points;                                                        \
  for (int k = 0; k < 32; ++k) {                                                                   \
    points.push_back({float(k % 4 + k / 16 * 3), float(k / 4 % 4), 0});                            \
  }                                                                                                \
  PatchSet<float> set;                                                                             \
  if (!pack(ControlNets<float>::packed(points), set)) {                                            \
    return 1;                                                                                      \
  }                                                                                                \
  [[maybe_unused]] const PatchSet<float>& patches = set;                                           \
  [[maybe_unused]] const Grid<float> grid = Grid<float>::uniform(17, 17);
