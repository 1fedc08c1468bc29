// See limit_cases.hpp.
#include "tests/properties/limits/limit_cases.hpp"
#include "tests/support/nets/points_by_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <tuple>

#include "tests/support/long_form.hpp"
#include "tests/support/nets/degenerate_curves.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/net_forms.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests {
namespace {

constexpr Degrees kLimitDegrees[] = {{3, 3}, {2, 2}, {3, 3}, {1, 1}, {3, 2}, {3, 3},
                                     {2, 5}, {1, 3}, {3, 3}, {7, 2}, {4, 4}, {3, 3},
                                     {2, 1}, {6, 3}, {3, 3}, {2, 2}};
constexpr std::size_t kRareShape = 61; ///< every so many nets one of degree 15
constexpr int kManyPoints = 60;        ///< nets with more points have fewer samples

[[nodiscard]] Net rounded(Net net, bool to_double) {
  return to_double ? rounded_to<double>(std::move(net)) : rounded_to<float>(std::move(net));
}

/// One coordinate moved by its last bit, or by more, or from zero by next to nothing: nearly
/// singular, and regular most often.
void perturb(Net& net, int components, bool points_double, Random& random) {
  Vector3& point = net.points[random.below(net.points.size())];
  double& value = point[random.below(static_cast<std::uint64_t>(components))];
  const int digits = points_double ? 52 : 23;
  const int down = random.below(2) == 0 ? digits : random.integer(4, digits);
  if (value == 0) {
    value = random.sign() * std::ldexp(1, -random.integer(1, points_double ? 400 : 100));
  } else {
    value += std::ldexp(random.sign(), std::ilogb(value) - down);
  }
}

/// Weights in one of their forms, or none.
[[nodiscard]] Net in_some_form(const Net& from, bool points_double, std::size_t form,
                               Random& random) {
  if (form == 0) {
    Net net = from;
    net.weights.clear();
    return placed(std::move(net), random);
  }
  Net net =
      random.below(2) == 0 ? weighted_points(from, random) : weighted_numerators(from, random);
  net = placed(std::move(net), random);
  if (form == 1) {
    return net;
  }
  return points_double ? exactly_homogeneous<double>(net) : exactly_homogeneous<float>(net);
}

[[nodiscard]] double centred_as(double x, bool values_double) {
  return values_double ? x : static_cast<double>(static_cast<float>(x));
}

/// Anywhere on a side, near one, or inside.
void add_random_samples(std::vector<LimitSample>& samples, std::size_t count, bool values_double,
                        Random& random) {
  for (std::size_t k = 0; k < count; ++k) {
    double x = centred_as(random.symmetric(), values_double);
    double y = random.sign();
    if (k % 4 == 2) {
      y *= 1 - std::ldexp(1, -random.integer(1, values_double ? 50 : 22));
    } else if (k % 4 == 3) {
      x = random.integer(-15, 15) / 16.0;
      y = centred_as(random.symmetric(), values_double);
    }
    if (random.below(2) == 0) {
      std::swap(x, y);
    }
    samples.push_back({x, y});
  }
}

void answer(const LimitNet& net, const IntegerNet& integers, LimitSample& sample) {
  const ExactDirection exact = exact_normal(integers, sample.x, sample.y);
  sample.status = status_of(exact);
  sample.direction = exact.direction;
  if (sample.status == SampleStatus::regular) {
    const OracleNormal normal = oracle_normal(net.net, oracle_sample(net.net, sample.x, sample.y));
    sample.kappa = normal.kappa == 0 ? HUGE_VAL : normal.kappa;
  }
}

void answer_curve(const LimitNet& curve, const IntegerNet& integers, LimitSample& sample) {
  const ExactDirection exact = exact_tangent(integers, sample.x);
  sample.status = status_of(exact);
  sample.direction = exact.direction;
  if (sample.status == SampleStatus::regular) {
    const double size = largest_of(largest_hodographs_u(control_polygon(curve.net)));
    const double slope = length(oracle_sample(curve.net, sample.x, 0).du).to_double();
    sample.kappa = slope > 0 ? size / slope : HUGE_VAL;
    if (curve.net.is_rational()) {
      const auto at =
          channel_derivatives(curve.net, OracleParameter::centred(sample.x), {}, {0, 0});
      sample.lightness = *std::max_element(curve.net.weights.begin(), curve.net.weights.end()) /
                         at[kWeightChannel].to_double();
    }
  }
}

[[nodiscard]] auto shape_key(const LimitNet& entry) {
  const Net& net = entry.net;
  return std::tuple(net.degree_u, net.degree_v, net.is_rational(), net.homogeneous,
                    entry.components);
}

void sort_by_shape(std::vector<LimitNet>& nets) {
  std::stable_sort(nets.begin(), nets.end(), [](const LimitNet& a, const LimitNet& b) {
    return shape_key(a) < shape_key(b);
  });
}

/// With weights or without, placed somewhere, as the set's type of points has it; one in eight is
/// perturbed.
[[nodiscard]] LimitNet entry_of(const char* kind, const Net& made, int components,
                                bool points_double, Random& random) {
  Net net = in_some_form(made, points_double, random.below(3), random);
  if (components == 2) { // turned in space, maybe
    for (Vector3& point : net.points) {
      point[2] = 0;
    }
  }
  net = rounded(std::move(net), points_double);
  if (random.below(8) == 0) {
    perturb(net, components, points_double, random);
  }
  return {kind, rounded(std::move(net), points_double), components, {}};
}

} // namespace

SampleStatus status_of(const ExactDirection& exact) {
  return exact.order == 0  ? SampleStatus::regular
         : exact.order > 0 ? SampleStatus::limit
                           : SampleStatus::degenerate;
}

double degrees_apart(const Vector3& a, const Vector3& b) {
  const double distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return 2 * std::asin(std::min(1.0, distance / 2)) * 180 / std::numbers::pi;
}

std::vector<LimitNet> limit_nets(LimitTypes types, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<LimitNet> nets;
  for (std::size_t k = 0; k < count; ++k) {
    const SingularRow& row = kSingularRows[k % std::size(kSingularRows)];
    const Degrees degrees = k % kRareShape == kRareShape - 1
                                ? Degrees{15, 15}
                                : kLimitDegrees[random.below(std::size(kLimitDegrees))];
    SingularNet made = turned(row.make(degrees, random), static_cast<unsigned>(random.below(8)));
    LimitNet entry = entry_of(row.name, made.net, 3, types.points_double, random);
    if (has_points_by_rounding(entry.net, types.points_double)) {
      continue;
    }
    for (int iv = 0; iv < kLimitGrid; ++iv) {
      for (int iu = 0; iu < kLimitGrid; ++iu) {
        entry.samples.push_back({uniform_centred<double>(iu, kLimitGrid - 1),
                                 uniform_centred<double>(iv, kLimitGrid - 1)});
      }
    }
    entry.samples.push_back({made.x, made.y});
    const bool large = (degrees.u + 1) * (degrees.v + 1) > kManyPoints;
    add_random_samples(entry.samples, large ? 2 : 12, types.values_double, random);
    const IntegerNet integers(entry.net);
    for (LimitSample& sample : entry.samples) {
      answer(entry, integers, sample);
    }
    nets.push_back(std::move(entry));
  }
  sort_by_shape(nets);
  return nets;
}

std::vector<LimitNet> limit_curves(LimitTypes types, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<LimitNet> curves;
  for (std::size_t k = 0; k < count; ++k) {
    const SingularCurveRow& row = kSingularCurveRows[k % std::size(kSingularCurveRows)];
    const int degree = k % 4 == 3 ? random.integer(1, kMostDegree) : random.integer(1, 5);
    SingularNet made = row.make(degree, random);
    made = random.below(2) == 0 ? reversed_u(std::move(made)) : made;
    LimitNet entry = entry_of(row.name, made.net, k % 3 == 2 ? 2 : 3, types.points_double, random);
    if (has_points_by_rounding(entry.net, types.points_double)) {
      continue;
    }
    for (int i = 0; i < kLimitGrid; ++i) {
      entry.samples.push_back({uniform_centred<double>(i, kLimitGrid - 1)});
    }
    entry.samples.push_back({made.x});
    for (int i = 0; i < 4; ++i) {
      const double near = random.sign() * (1 - std::ldexp(1, -random.integer(1, 22)));
      entry.samples.push_back({near});
      entry.samples.push_back({centred_as(random.symmetric(), types.values_double)});
    }
    const IntegerNet integers(entry.net);
    for (LimitSample& sample : entry.samples) {
      answer_curve(entry, integers, sample);
    }
    curves.push_back(std::move(entry));
  }
  sort_by_shape(curves);
  return curves;
}

bool same_limit_shape(const LimitNet& a, const LimitNet& b) { return shape_key(a) == shape_key(b); }

std::size_t limit_net_count() { return by_form<std::size_t>(60, 10'000); }

std::string described(const LimitNet& net, const LimitSample& sample) {
  std::ostringstream text;
  text << std::hexfloat << net.kind << ", " << net.net.degree_u << " x " << net.net.degree_v
       << (net.net.homogeneous     ? " homogeneous"
           : net.net.is_rational() ? " cartesian"
                                   : "")
       << " at centred " << sample.x << ", " << sample.y << "\n";
  for (std::size_t k = 0; k < net.net.points.size(); ++k) {
    for (const double value : net.net.points[k]) {
      text << value << ", ";
    }
    if (net.net.is_rational()) {
      text << net.net.weights[k] << ", ";
    }
    text << ((k + 1) % static_cast<std::size_t>(net.net.degree_u + 1) == 0 ? "\n" : "  ");
  }
  return text.str();
}

} // namespace simdbezier::tests
