// Models for parts of meshes: patches that meet in all ways, of one shape and of several.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <tools/process/output_file.hpp>

#include "tests/mesh/support/random_gluing.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

/// Several random gluings side by side, whose patches are dealt like cards, as .bez. Coordinates
/// are floats, so that nothing is rounded.
inline std::string gluings_as_bez(unsigned seed, unsigned gluings) {
  std::vector<std::string> patches;
  for (unsigned k = 0; k < gluings; ++k) {
    const RandomGluing gluing(100 * seed + k);
    for (std::size_t p = 0; p < gluing.patches; ++p) {
      std::string text;
      for (std::size_t v = 0; v < 48; ++v) {
        const auto value = static_cast<float>(gluing.values[48 * p + v]) +
                           (v % 3 == 0 ? 4.0F * static_cast<float>(k) : 0.0F);
        text += std::to_string(value) + (v % 3 == 2 ? "\n" : " ");
      }
      patches.push_back(text);
    }
  }
  std::shuffle(patches.begin(), patches.end(), std::mt19937(seed));
  std::string text = std::to_string(patches.size()) + "\n";
  for (const std::string& patch : patches) {
    text += patch;
  }
  return text;
}

/// A ball of eight rational patches in rows around its axis, as .bv: each has a side in one of both
/// poles, whose homogeneous points have quotients that are rounded differently.
inline std::string ball_as_bv() {
  std::string text;
  const double angles[] = {0, 1, 2.5, 4, 6.283185307179586};
  const auto point = [](double x, double y, double z, double w) {
    std::string line;
    for (const double value : {x * w, y * w, z * w, w}) {
      line += tools::shortest(value) + " ";
    }
    return line + "\n";
  };
  for (const int half : {-1, 1}) {
    for (int k = 0; k < 4; ++k) {
      text += "8\n1 1\n";
      for (const double pole : {0.0, 1.0}) {
        for (const int end : {k, k + 1}) {
          const double angle = end == 4 ? angles[0] : angles[end];
          const double radius = 1 - pole;
          const double w = 1.1 + 0.37 * (end % 4) + 0.13 * half;
          text +=
              point(radius * angle / 7, radius * (angle - 3) * (angle - 1) / 9, half * pole / 3, w);
        }
      }
    }
  }
  return text;
}

/// A square so many times, as .bpt: all but the first one own no vertex.
inline std::string repeated_squares(std::size_t count) {
  std::string text = std::to_string(count) + "\n";
  for (std::size_t k = 0; k < count; ++k) {
    text += "1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  }
  return text;
}

struct PartModel {
  std::string name;
  std::string path;
};

/// Writes the models into the folder.
inline std::vector<PartModel> part_models(const TemporaryFolder& folder) {
  std::vector<PartModel> models = {
      {"teapot", "builtin:teapot"},
      {"mixed shapes", std::string(SIMDBEZIER_TEST_DATA) + "/sample.itd"},
      {"ball", folder.write("ball.bv", ball_as_bv())},
      {"repeated squares", folder.write("squares.bpt", repeated_squares(3))}};
  for (unsigned seed = 0; seed < 4; ++seed) {
    const std::string name = "gluings-" + std::to_string(seed);
    models.push_back({name, folder.write(name + ".bez", gluings_as_bez(seed, 4 + 4 * seed))});
  }
  return models;
}

} // namespace simdbezier::tests
