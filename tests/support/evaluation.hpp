// Thin helpers over the public calls: pack nets, own the outputs, compare them bit by bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/hash.hpp"
#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

/// Nets of one shape as the library takes them, the points being those of packed_points().
template <typename T>
[[nodiscard]] ControlNets<T> control_nets(std::span<const Net> nets, const std::vector<T>& points) {
  if (nets.empty()) {
    return {};
  }
  const Net& net = nets.front();
  const Weights weights = !net.is_rational() ? Weights::none
                          : net.homogeneous  ? Weights::homogeneous
                                             : Weights::cartesian;
  return ControlNets<T>::packed(points.data(), nets.size(), net.degree_u, net.degree_v, 3, weights);
}

/// Throws where the library refuses to pack, which fails the test.
inline void expect_packed(const Report& report) {
  if (!report) {
    throw std::runtime_error("pack: " + std::string(to_string(report.status)) + " at patch " +
                             std::to_string(report.item));
  }
}

/// Packs nets of one shape.
template <typename T>
[[nodiscard]] PatchSet<T> packed(std::span<const Net> nets, const PackOptions& options = {}) {
  const std::vector<T> points = packed_points<T>(nets);
  PatchSet<T> set;
  expect_packed(pack(control_nets<T>(nets, points), set, options));
  return set;
}

[[nodiscard]] inline bool same_shape(const Net& a, const Net& b) {
  return a.degree_u == b.degree_u && a.degree_v == b.degree_v &&
         a.is_rational() == b.is_rational() && a.homogeneous == b.homogeneous;
}

/// Packs nets of any shapes: one entry for each run of nets that are alike.
template <typename T>
[[nodiscard]] PatchSet<T> packed_mixed(std::span<const Net> nets, const PackOptions& options = {}) {
  std::vector<std::vector<T>> points;
  std::vector<ControlNets<T>> entries;
  for (std::size_t first = 0, last = 0; first < nets.size(); first = last) {
    while (last < nets.size() && same_shape(nets[first], nets[last])) {
      ++last;
    }
    const auto run = nets.subspan(first, last - first);
    points.push_back(packed_points<T>(run));
    entries.push_back(control_nets<T>(run, points.back()));
  }
  PatchSet<T> set;
  expect_packed(pack(std::span<const ControlNets<T>>(entries), set, options));
  return set;
}

/// Which groups a call asks for.
struct Wanted {
  bool position = true;
  bool tangents = true;
  bool normal = true;
  bool status = true;
  bool second = false;    ///< duu, duv, dvv
  bool curvature = false; ///< all four
};

/// Twelve planes (21 with second derivatives, 25 with curvatures) and the status plane, prefilled
/// with a value no result has.
template <typename T>
class Planes {
public:
  explicit Planes(std::size_t count, Wanted wanted = {})
      : count_(count), wanted_(wanted), values_((wanted.curvature ? 25
                                                 : wanted.second  ? 21
                                                                  : 12) *
                                                    count,
                                                static_cast<T>(-777)),
        status_(count, static_cast<SampleStatus>(77)) {}

  [[nodiscard]] Outputs<T> outputs() {
    Outputs<T> out;
    if (wanted_.position) {
      out.position = group(0);
    }
    if (wanted_.tangents) {
      out.du = group(1);
      out.dv = group(2);
    }
    if (wanted_.normal) {
      out.normal = group(3);
    }
    if (wanted_.second) {
      out.duu = group(4);
      out.duv = group(5);
      out.dvv = group(6);
    }
    if (wanted_.curvature) {
      T* const first = values_.data() + 21 * count_;
      out.curvature = {first, first + count_, first + 2 * count_, first + 3 * count_};
    }
    if (wanted_.status) {
      out.status = status_;
    }
    return out;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Wanted wanted() const { return wanted_; }
  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  [[nodiscard]] const std::vector<SampleStatus>& status() const { return status_; }

  /// Groups: 0 position, 1 du, 2 dv, 3 normal; where they were asked for 4 duu, 5 duv, 6 dvv.
  [[nodiscard]] T at(std::size_t group, std::size_t component, std::size_t k) const {
    return values_[(3 * group + component) * count_ + k];
  }
  [[nodiscard]] const T* plane(std::size_t group, std::size_t component) const {
    return values_.data() + (3 * group + component) * count_;
  }
  /// Gaussian, mean, minimum, maximum, where they were asked for.
  [[nodiscard]] T curvature(std::size_t which, std::size_t k) const {
    return values_[(21 + which) * count_ + k];
  }
  [[nodiscard]] std::array<T, 3> vector(std::size_t group, std::size_t k) const {
    return {at(group, 0, k), at(group, 1, k), at(group, 2, k)};
  }

  /// Hash over samples in order, all groups of one sample together.
  [[nodiscard]] std::uint64_t hash() const {
    Fnv1a hash;
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t at = k; at < values_.size(); at += count_) {
        hash.add(values_[at]);
      }
      hash.add(static_cast<unsigned char>(status_[k]));
    }
    return hash.value();
  }

private:
  [[nodiscard]] Vectors<T> group(std::size_t index) {
    T* first = values_.data() + 3 * index * count_;
    return Vectors<T>::planes(first, first + count_, first + 2 * count_);
  }

  std::size_t count_;
  Wanted wanted_;
  std::vector<T> values_;
  std::vector<SampleStatus> status_;
};

/// How many values and statuses of two results differ in their bits.
template <typename T>
[[nodiscard]] std::size_t differing_values(const Planes<T>& a, const Planes<T>& b) {
  return differing_bits(a.values().data(), b.values().data(), a.values().size()) +
         differing_bits(a.status().data(), b.status().data(), a.count());
}

/// Scattered parameters in the three arrays that the call takes.
template <typename T>
struct SampleArrays {
  std::vector<std::uint32_t> patch;
  std::vector<T> u;
  std::vector<T> v;

  void add(std::size_t p, T first, T second) {
    patch.push_back(static_cast<std::uint32_t>(p));
    u.push_back(first);
    v.push_back(second);
  }
  [[nodiscard]] Samples<T> view(Parameters parameters) const { return {patch, u, v, parameters}; }
};

} // namespace simdbezier::tests
