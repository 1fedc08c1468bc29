// An independent opinion on positions and first derivatives: Bernstein sums in long double.
//
// All terms of a weight sum are positive, so for t in [0,1] a sum's error is below
// (4 n + 8) 2^-64 sum |b| B, far below what the library's bounds in T leave room for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/reliability/fuzz/inputs/made_nets.hpp"

namespace simdbezier::fuzz {

using Real = long double;

/// t with its complement 1 - t, each rounded once.
struct RealParameter {
  Real t;
  Real complement;

  static RealParameter centred(Real x) { return {(1 + x) / 2, (1 - x) / 2}; }
  static RealParameter unit(Real t) { return {t, 1 - t}; }
};

/// B_i(t) of degree n, or their derivatives.
[[nodiscard]] inline std::array<Real, kMostDegree + 1> bernstein(int n, RealParameter at) {
  std::array<Real, kMostDegree + 1> b{};
  b[0] = 1;
  for (int level = 1; level <= n; ++level) {
    for (int i = level; i >= 0; --i) {
      const auto k = static_cast<std::size_t>(i);
      b[k] = (i < level ? at.complement * b[k] : 0) + (i > 0 ? at.t * b[k - 1] : 0);
    }
  }
  return b;
}

[[nodiscard]] inline std::array<Real, kMostDegree + 1> bernstein_slopes(int n, RealParameter at) {
  const auto lower = bernstein(n - 1, at);
  std::array<Real, kMostDegree + 1> d{};
  for (int i = 0; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    d[k] = n * ((i > 0 ? lower[k - 1] : 0) - (i < n ? lower[k] : 0));
  }
  return d;
}

struct RealSample {
  std::array<Real, kMostComponents> position{};
  std::array<Real, kMostComponents> du{};
  std::array<Real, kMostComponents> dv{};
};

/// One patch in homogeneous coordinates, less the point that packing subtracts.
class ReferencePatch {
public:
  template <typename S>
  ReferencePatch(const Nets<S>& nets, std::size_t patch, const double* relative_to = nullptr)
      : m_(nets.degree_u), n_(nets.degree_v), components_(nets.components),
        rational_(nets.rational()) {
    for (int j = 0; j <= n_; ++j) {
      for (int i = 0; i <= m_; ++i) {
        add(nets.point(patch, j, i), nets.weights, relative_to);
      }
    }
  }

  [[nodiscard]] int degree_u() const { return m_; }
  [[nodiscard]] int degree_v() const { return n_; }
  [[nodiscard]] int components() const { return components_; }
  [[nodiscard]] bool rational() const { return rational_; }
  /// The largest |P| of a component, and the ratio of the largest to the smallest weight.
  [[nodiscard]] Real size(int c) const { return size_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] Real weight_ratio() const { return heaviest_ / lightest_; }
  [[nodiscard]] Real point(int j, int i, int c) const {
    const Real* const point = at(j, i);
    return point[c] / point[components_];
  }

  [[nodiscard]] RealSample evaluate(RealParameter u, RealParameter v) const {
    const auto b_u = bernstein(m_, u);
    const auto b_v = bernstein(n_, v);
    const auto s_u = bernstein_slopes(m_, u);
    const auto s_v = bernstein_slopes(n_, v);
    const Real w = sum(b_u, b_v, components_);
    const Real w_u = sum(s_u, b_v, components_);
    const Real w_v = sum(b_u, s_v, components_);
    RealSample sample;
    for (int c = 0; c < components_; ++c) {
      const auto k = static_cast<std::size_t>(c);
      sample.position[k] = sum(b_u, b_v, c) / w;
      sample.du[k] = (sum(s_u, b_v, c) - sample.position[k] * w_u) / w;
      sample.dv[k] = (sum(b_u, s_v, c) - sample.position[k] * w_v) / w;
    }
    return sample;
  }

private:
  template <typename S>
  void add(const S* point, Weights weights, const double* relative_to) {
    const auto last = static_cast<std::size_t>(components_);
    const Real weight = rational_ ? static_cast<Real>(point[last]) : 1;
    for (std::size_t c = 0; c < last; ++c) {
      const Real shift =
          relative_to != nullptr && c < 3 ? static_cast<Real>(relative_to[c]) : Real(0);
      const Real value = weights == Weights::homogeneous
                             ? static_cast<Real>(point[c]) - shift * weight
                             : (static_cast<Real>(point[c]) - shift) * weight;
      values_.push_back(value);
      size_[c] = std::max(size_[c], std::fabs(value / weight));
    }
    values_.push_back(weight);
    lightest_ = lightest_ == 0 ? weight : std::min(lightest_, weight);
    heaviest_ = std::max(heaviest_, weight);
  }

  [[nodiscard]] const Real* at(int j, int i) const {
    return values_.data() + (j * (m_ + 1) + i) * (components_ + 1);
  }

  template <typename Factors>
  [[nodiscard]] Real sum(const Factors& in_u, const Factors& in_v, int c) const {
    Real total = 0;
    for (int j = 0; j <= n_; ++j) {
      Real row = 0;
      for (int i = 0; i <= m_; ++i) {
        row += in_u[static_cast<std::size_t>(i)] * at(j, i)[c];
      }
      total += in_v[static_cast<std::size_t>(j)] * row;
    }
    return total;
  }

  int m_;
  int n_;
  int components_;
  bool rational_;
  std::vector<Real> values_;
  std::array<Real, kMostComponents> size_{};
  Real lightest_ = 0;
  Real heaviest_ = 0;
};

} // namespace simdbezier::fuzz
