// Nets whose points have any number of components, and the triples of components that tests of
// points in space can judge: components are planes that know nothing of each other.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/support/evaluation.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

/// `count` nets of one shape, random values in [-1,1) that float holds.
class ComponentNets {
public:
  ComponentNets(Degrees degrees, int components, bool rational, std::size_t count, Random& random)
      : degrees_(degrees), components_(components), rational_(rational), count_(count) {
    const auto points = static_cast<std::size_t>((degrees.u + 1) * (degrees.v + 1)) * count;
    for (std::size_t p = 0; p < points; ++p) {
      for (int c = 0; c < components; ++c) {
        values_.push_back(static_cast<float>(random.symmetric()));
      }
      if (rational) {
        values_.push_back(static_cast<float>(graded_weight(4, random.integer(0, 16))));
      }
    }
  }

  [[nodiscard]] int components() const { return components_; }
  [[nodiscard]] std::size_t count() const { return count_; }

  template <typename T>
  [[nodiscard]] PatchSet<T> packed(const PackOptions& options = {}) const {
    const std::vector<T> points(values_.begin(), values_.end());
    PatchSet<T> set;
    expect_packed(
        pack(ControlNets<T>::packed(points.data(), count_, degrees_.u, degrees_.v, components_,
                                    rational_ ? Weights::cartesian : Weights::none),
             set, options));
    return set;
  }

  /// Components first, first + 1 and first + 2 as points in space; 0 where there is none.
  [[nodiscard]] std::vector<Net> triple(int first) const {
    const int stride = components_ + (rational_ ? 1 : 0);
    const auto points = static_cast<std::size_t>((degrees_.u + 1) * (degrees_.v + 1));
    std::vector<Net> nets;
    for (std::size_t n = 0; n < count_; ++n) {
      Net net{degrees_.u, degrees_.v, {}};
      for (std::size_t p = n * points; p < (n + 1) * points; ++p) {
        const float* const point = values_.data() + p * static_cast<std::size_t>(stride);
        Vector3 space{};
        for (int c = 0; c < 3 && first + c < components_; ++c) {
          space[static_cast<std::size_t>(c)] = static_cast<double>(point[first + c]);
        }
        net.points.push_back(space);
        if (rational_) {
          net.weights.push_back(static_cast<double>(point[components_]));
        }
      }
      nets.push_back(std::move(net));
    }
    return nets;
  }

private:
  Degrees degrees_;
  int components_;
  bool rational_;
  std::size_t count_;
  std::vector<float> values_;
};

/// Returns the outputs for as many components as there are: z, or y and z, are null beyond them.
template <typename T>
[[nodiscard]] Outputs<T> without_missing(Outputs<T> out, int components) {
  for (Vectors<T>* const group :
       {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal}) {
    if (components < 3) {
      group->z = nullptr;
    }
    if (components < 2) {
      group->y = nullptr;
    }
  }
  return out;
}

} // namespace simdbezier::tests
