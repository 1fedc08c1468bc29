// Evaluators that a careful engineer would write first, as the measure of "not worse than".
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/properties/accuracy/judge/evaluator.hpp"

namespace simdbezier::tests {

/// Runs a function of one net and one parameter over all samples; normals by the cross product.
template <typename T, typename Scheme>
class ScalarEvaluator : public Evaluator<T> {
public:
  [[nodiscard]] std::string name() const override { return Scheme::kName; }
  [[nodiscard]] bool handles(const Net& net) const override {
    return Scheme::kAnyShape || net.is_bicubic();
  }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int /*grid*/,
                std::span<Result<T>> results) override {
    const Scheme weight(channel(net, 3), net.degree_u, net.degree_v);
    for (std::size_t c = 0; c < 3; ++c) {
      const Scheme scheme(channel(net, c), net.degree_u, net.degree_v);
      for (std::size_t k = 0; k < at.size(); ++k) {
        std::array<T, 3> result = scheme.evaluate(at[k].u, at[k].v);
        if (net.is_rational()) {
          const std::array<T, 3> w = weight.evaluate(at[k].u, at[k].v);
          result[0] /= w[0];
          result[1] = (result[1] - result[0] * w[1]) / w[0];
          result[2] = (result[2] - result[0] * w[2]) / w[0];
        }
        results[k].position[c] = result[0];
        results[k].du[c] = result[1];
        results[k].dv[c] = result[2];
      }
    }
    for (Result<T>& result : results) {
      set_normal(result);
    }
  }

private:
  /// The values of one component, times their weights where there are any, or the weights (3).
  [[nodiscard]] static std::vector<T> channel(const Net& net, std::size_t c) {
    std::vector<T> values;
    for (int j = 0; j <= net.degree_v; ++j) {
      for (int i = 0; i <= net.degree_u; ++i) {
        const T weight = static_cast<T>(net.weight(j, i));
        const T value = c == 3 ? weight : static_cast<T>(net.at(j, i)[c]);
        values.push_back(c == 3 || net.homogeneous ? value : weight * value);
      }
    }
    return values;
  }

  static void set_normal(Result<T>& result) {
    const T* a = result.du;
    const T* b = result.dv;
    const T cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    const T size = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      result.normal[c] = cross[c] / size;
    }
    result.status = SampleStatus::regular;
  }
};

/// t b + c, fused or rounded twice: each class of results is compared with its like.
template <bool kFused, typename T>
[[nodiscard]] T multiply_add(T t, T b, T c) {
  return kFused ? std::fma(t, b, c) : t * b + c;
}

/// (1-t) a + t b: exact where a == b and t is 0 or 1, never outside of [a, b] by much.
template <typename T, bool kFused = true>
struct WeightedLerp {
  static constexpr const char* kName = kFused ? "de_casteljau" : "de_casteljau_nofma";
  [[nodiscard]] static T lerp(T a, T b, T t) { return multiply_add<kFused>(t, b, (1 - t) * a); }
};

/// a + t (b - a).
template <typename T, bool kFused = true>
struct DifferenceLerp {
  static constexpr const char* kName = kFused ? "de_casteljau_diff" : "de_casteljau_diff_nofma";
  [[nodiscard]] static T lerp(T a, T b, T t) { return multiply_add<kFused>(t, b - a, a); }
};

/// De Casteljau's algorithm in u, then v; tangents on the differenced nets, which is its most
/// accurate form (differences of the last level lose 5 digits at offset 1e3).
template <typename T, typename Lerp>
class DeCasteljau {
public:
  static constexpr const char* kName = Lerp::kName;
  static constexpr bool kAnyShape = true;

  DeCasteljau(const std::vector<T>& values, int m, int n) : values_(values), m_(m), n_(n) {}

  [[nodiscard]] std::array<T, 3> evaluate(T u, T v) const {
    const int width = m_ + 1;
    std::vector<T> in_u;
    std::vector<T> in_v;
    for (int j = 0; j <= n_; ++j) {
      for (int i = 0; i <= m_; ++i) {
        const T here = at(j * width + i);
        if (i < m_) {
          in_u.push_back(static_cast<T>(m_) * (at(j * width + i + 1) - here));
        }
        if (j < n_) {
          in_v.push_back(static_cast<T>(n_) * (at((j + 1) * width + i) - here));
        }
      }
    }
    return {surface(values_, m_, n_, u, v), surface(in_u, m_ - 1, n_, u, v),
            surface(in_v, m_, n_ - 1, u, v)};
  }

private:
  [[nodiscard]] T at(int k) const { return values_[static_cast<std::size_t>(k)]; }

  [[nodiscard]] static T curve(std::vector<T> points, T t) {
    for (std::size_t level = points.size() - 1; level > 0; --level) {
      for (std::size_t i = 0; i < level; ++i) {
        points[i] = Lerp::lerp(points[i], points[i + 1], t);
      }
    }
    return points[0];
  }

  [[nodiscard]] static T surface(const std::vector<T>& values, int m, int n, T u, T v) {
    std::vector<T> rows;
    for (int j = 0; j <= n; ++j) {
      const auto first = values.begin() + j * (m + 1);
      rows.push_back(curve(std::vector<T>(first, first + m + 1), u));
    }
    return curve(rows, v);
  }

  std::vector<T> values_;
  int m_;
  int n_;
};

/// Textbook Horner on the power basis at (0,0), coefficients formed in T. Bicubic nets only.
template <typename T>
class CornerHorner {
public:
  static constexpr const char* kName = "horner_corner";
  static constexpr bool kAnyShape = false;

  CornerHorner(const std::vector<T>& values, int /*m*/, int /*n*/) {
    std::array<std::array<T, 4>, 4> rows;
    for (std::size_t j = 0; j < 4; ++j) {
      rows[j] = to_powers({values[4 * j], values[4 * j + 1], values[4 * j + 2], values[4 * j + 3]});
    }
    for (std::size_t k = 0; k < 4; ++k) {
      power_[k] = to_powers({rows[0][k], rows[1][k], rows[2][k], rows[3][k]});
    }
  }

  [[nodiscard]] std::array<T, 3> evaluate(T u, T v) const {
    std::array<T, 4> along_v;
    std::array<T, 4> slope_v;
    for (std::size_t k = 0; k < 4; ++k) {
      along_v[k] = value(power_[k], v);
      slope_v[k] = slope(power_[k], v);
    }
    return {value(along_v, u), slope(along_v, u), value(slope_v, u)};
  }

private:
  [[nodiscard]] static std::array<T, 4> to_powers(const std::array<T, 4>& b) {
    return {b[0], 3 * (b[1] - b[0]), 3 * ((b[0] - 2 * b[1]) + b[2]),
            (b[3] - b[0]) + 3 * (b[1] - b[2])};
  }
  [[nodiscard]] static T value(const std::array<T, 4>& a, T t) {
    return std::fma(std::fma(std::fma(a[3], t, a[2]), t, a[1]), t, a[0]);
  }
  [[nodiscard]] static T slope(const std::array<T, 4>& a, T t) {
    return std::fma(std::fma(3 * a[3], t, 2 * a[2]), t, a[1]);
  }

  std::array<std::array<T, 4>, 4> power_;
};

} // namespace simdbezier::tests
