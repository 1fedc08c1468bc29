// Tangents and their statuses where C' vanishes, against exact Taylor coefficients: grids, counted
// and scattered samples, every type and form of weights, on every instruction set.
#include <cmath>
#include <map>

#include "tests/properties/limits/limit_tally.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::tangent_limits_test {
namespace {

using Curves = std::span<const LimitNet>; ///< of one shape

[[nodiscard]] Weights weights_of(const Net& net) {
  return !net.is_rational() ? Weights::none
         : net.homogeneous  ? Weights::homogeneous
                            : Weights::cartesian;
}

template <typename T, typename S>
[[nodiscard]] CurveSet<T> packed_curves(Curves curves, const PackOptions& options) {
  std::vector<S> points;
  for (const LimitNet& curve : curves) {
    for (std::size_t k = 0; k < curve.net.points.size(); ++k) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(curve.components); ++c) {
        points.push_back(static_cast<S>(curve.net.points[k][c]));
      }
      if (curve.net.is_rational()) {
        points.push_back(static_cast<S>(curve.net.weights[k]));
      }
    }
  }
  CurveSet<T> set;
  expect_packed(pack(ControlCurves<S>::packed(points.data(), curves.size(), curves[0].net.degree_u,
                                              curves[0].components, weights_of(curves[0].net)),
                     set, options));
  return set;
}

/// Tangents in planes.
template <typename T>
struct Tangents {
  std::vector<T> values;
  std::vector<SampleStatus> status;
  int components;

  Tangents(std::size_t count, int planes)
      : values(3 * count), status(count, SampleStatus::non_finite), components(planes) {}
  [[nodiscard]] CurveOutputs<T> outputs() {
    CurveOutputs<T> out;
    T* const x = values.data();
    const std::size_t n = status.size();
    out.tangent =
        components == 2 ? Vectors<T>::planes(x, x + n) : Vectors<T>::planes(x, x + n, x + 2 * n);
    out.status = status.data();
    return out;
  }
  [[nodiscard]] FoundDirection at(std::size_t k) const {
    FoundDirection found;
    for (std::size_t c = 0; c < 3; ++c) {
      found.direction[c] = static_cast<double>(values[c * status.size() + k]);
    }
    found.status = status[k];
    return found;
  }
};

class TangentLimits : public IsaTest {
protected:
  template <typename T, typename S>
  void judge(const char* title) {
    constexpr LimitTypes kTypes{sizeof(T) == 8, sizeof(S) == 8};
    static const std::vector<LimitNet> all =
        limit_curves(kTypes, limit_net_count(), 81 + sizeof(T) + sizeof(S));
    LimitTally tally(allowed_angles(sizeof(T) == 8));
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
      while (last < all.size() && same_limit_shape(all[first], all[last])) {
        ++last;
      }
      const Curves curves(&all[first], last - first);
      for (const bool origins : {false, true}) {
        const auto set = packed_curves<T, S>(curves, {.local_origin = origins, .isa = isa()});
        judge_scattered(set, curves, tally);
        judge_grids(set, curves, tally);
      }
    }
    tally.report(std::string(to_string(isa())) + ", " + title);
  }

  template <typename T>
  void judge_scattered(const CurveSet<T>& set, Curves curves, LimitTally& tally) {
    std::vector<std::uint32_t> curve;
    std::vector<T> x;
    for (std::size_t k = 0; k < curves.size(); ++k) {
      for (const LimitSample& sample : curves[k].samples) {
        curve.push_back(static_cast<std::uint32_t>(k));
        x.push_back(static_cast<T>(sample.x));
      }
    }
    Tangents<T> found(x.size(), curves[0].components);
    const CurveSamples<T> samples{curve, x, Parameters::centred};
    run_call(set, samples, found.outputs());
    std::size_t at = 0;
    for (const LimitNet& entry : curves) {
      for (const LimitSample& sample : entry.samples) {
        tally.add(entry, sample, found.at(at++), "scattered");
      }
    }
  }

private:
  template <typename T>
  void judge_grids(const CurveSet<T>& set, Curves curves, LimitTally& tally) {
    Tangents<T> grid(curves.size() * kLimitGrid, curves[0].components);
    run_call(set, CurveGrid<T>::uniform(kLimitGrid), grid.outputs());
    Tangents<T> counted(curves.size() * kLimitGrid, curves[0].components);
    const std::vector<std::uint32_t> n(curves.size(), kLimitGrid);
    run_call(set, CurveGrids{n}, counted.outputs());
    for (std::size_t k = 0; k < curves.size(); ++k) {
      for (std::size_t i = 0; i < kLimitGrid; ++i) {
        tally.add(curves[k], curves[k].samples[i], grid.at(k * kLimitGrid + i), "grid");
        tally.add(curves[k], curves[k].samples[i], counted.at(k * kLimitGrid + i), "counted");
      }
    }
  }

  template <typename T, typename Samples>
  void run_call(const CurveSet<T>& set, const Samples& samples, const CurveOutputs<T>& out) {
    run({}, [&](const Options& forced) { return evaluate(set, samples, out, forced); });
  }
};

TEST_P(TangentLimits, Float) { judge<float, float>("float"); }
TEST_P(TangentLimits, Double) { judge<double, double>("double"); }
TEST_P(TangentLimits, FloatFromDouble) { judge<float, double>("float from double"); }

/// Curves whose tangents are known by hand.
TEST_P(TangentLimits, KnownCurves) {
  const Vector3 o{};
  const double root = std::sqrt(0.2);
  const Vector3 along{root, 2 * root, 0};
  LimitTally tally(allowed_angles(true));
  const auto add = [&](int degree, int equal, double weight, std::size_t light, double x) {
    Net net = shaped_net({degree, 0}, [&](int, int i) {
      return i < equal ? o : Vector3{i - equal + 1.0, 2.0 * (i - equal + 1), 0};
    });
    net.weights.assign(net.points.size(), 1);
    for (std::size_t k = net.weights.size() - light; k < net.weights.size(); ++k) {
      net.weights[k] = weight;
    }
    const SampleStatus status = x == -1 && equal > 1 ? SampleStatus::limit : SampleStatus::regular;
    const LimitNet curve{"known", net, 3, {{x, 0, status, along, 1}}};
    const auto set = packed_curves<double, double>(Curves(&curve, 1), {.isa = isa()});
    judge_scattered(set, Curves(&curve, 1), tally);
  };
  add(2, 2, 1e-4, 1, -1);
  add(4, 4, 0.01, 1, -1);
  add(7, 7, 0.1, 1, -1);
  add(5, 5, 1e-4, 1, -15.0 / 16); // t = 1/32
  add(15, 15, 1e-6, 1, -1);
  add(3, 1, 1, 1, 0.5);
  tally.report(std::string(to_string(isa())) + ", known curves");
}

/// A straight line has one tangent, however light one of its ends is and however far away it lies.
TEST_P(TangentLimits, LightAndFarLines) {
  const Vector3 along{1 / 3.0, 2 / 3.0, -2 / 3.0};
  AllowedAngles strict = allowed_angles(false);
  strict.unit_roundoff = 0; // sums of weights are no excuse
  LimitTally tally(strict);
  std::vector<LimitNet> lines;
  for (const bool rational : {false, true}) {
    for (int light = rational ? -30 : 0; light <= 0; light += 5) {
      for (int far = 0; far <= 20; far += 5) {
        const double away = std::ldexp(1.0, far);
        const Vector3 start{away + 1, 3 - away, away};
        Net net{1, 0, {start, plus(start, 1, {1, 2, -2})}};
        if (rational) {
          net.weights = {1, std::ldexp(1.0, light)};
        }
        LimitNet line{"line", std::move(net), 3, {}};
        for (const double x : {-1.0, -0.5, 0.0, 0.75, 1.0}) {
          line.samples.push_back({x, 0, SampleStatus::regular, along, 1});
        }
        lines.push_back(std::move(line));
      }
    }
  }
  const Curves plain(lines.data(), 5);
  const Curves weighted(lines.data() + 5, lines.size() - 5);
  for (const Curves& part : {plain, weighted}) {
    for (const bool origins : {false, true}) {
      judge_scattered(packed_curves<float, float>(part, {.local_origin = origins, .isa = isa()}),
                      part, tally);
    }
  }
  tally.report(std::string(to_string(isa())) + ", lines");
}
INSTANTIATE_FOR_EVERY_ISA(TangentLimits);

} // namespace
} // namespace simdbezier::tests::tangent_limits_test
