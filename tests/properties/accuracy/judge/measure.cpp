#include "tests/properties/accuracy/judge/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace simdbezier::tests {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// error / scale, where a scale of 0 admits no error at all.
[[nodiscard]] double relative(double error, double scale) {
  if (std::isnan(error)) {
    return kInfinity;
  }
  return error == 0 ? 0 : scale == 0 ? kInfinity : error / scale;
}

[[nodiscard]] Vector3 condition_of(const Net& net, OracleParameter u, OracleParameter v) {
  Net magnitudes = control_polygon(net);
  for (Vector3& point : magnitudes.points) {
    for (double& value : point) {
      value = std::abs(value);
    }
  }
  const Vector3dd sums = oracle_derivative(magnitudes, u, v, {0, 0});
  return {sums[0].to_double(), sums[1].to_double(), sums[2].to_double()};
}

[[nodiscard]] double norm(const Vector3& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

template <typename T>
[[nodiscard]] double distance(const T* value, const Vector3& truth) {
  return std::sqrt((value[0] - truth[0]) * (value[0] - truth[0]) +
                   (value[1] - truth[1]) * (value[1] - truth[1]) +
                   (value[2] - truth[2]) * (value[2] - truth[2]));
}

/// Collects one evaluator's figures on one family.
template <typename T>
class Collector {
public:
  Collector(bool fma, bool ours, bool local_origin)
      : rule_{kUnitRoundoff<T>, fma, local_origin}, ours_(ours) {}

  void start_net(const Net& net, const std::optional<Certificate>& certificate) {
    certificate_ = certificate;
    is_bicubic_ = net.is_bicubic();
    is_rational_ = net.is_rational();
    degrees_ = {static_cast<double>(net.degree_u), static_cast<double>(net.degree_v)};
    scales_ = scales_of(control_polygon(net));
    bounds_.emplace(net, rule_);
  }

  void add(std::size_t net, std::size_t number, const Truth& truth, const Result<T>& result,
           const Capabilities& gives) {
    where_ = {net, 0, truth.x, truth.y};
    const OracleSample& exact = truth.sample;
    const SampleErrors allowed = bounds_->at(exact, truth.weight);
    allowed_position_ = allowed.position;
    if (gives.position) {
      add_vector(Quantity::position, result.position, exact.position, scales_.position,
                 allowed.position);
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::abs((exact.position[c] - result.position[c]).to_double());
        const double scale = kUnitRoundoff<T> * truth.condition[c];
        measurement_.max_condition_error =
            std::max(measurement_.max_condition_error, relative(error, scale));
      }
    }
    if (gives.tangents) {
      add_vector(Quantity::du, result.du, exact.du, scales_.du, allowed.du);
      add_vector(Quantity::dv, result.dv, exact.dv, scales_.dv, allowed.dv);
    }
    if (gives.second_derivatives) {
      add_vector(Quantity::duu, result.duu, exact.duu, scales_.duu, allowed.duu);
      add_vector(Quantity::duv, result.duv, exact.duv, scales_.duv, allowed.duv);
      add_vector(Quantity::dvv, result.dvv, exact.dvv, scales_.dvv, allowed.dvv);
    }
    if (gives.normal) {
      add_normal(truth, result, allowed);
    }
    if (gives.curvature && number % kCurvatureStride == 0) {
      add_curvature(truth, result, allowed);
    }
  }

  void add_limit(const Net& net, const Truth& truth, const Result<T>& result) {
    const Vector3 limit = oracle_limit_normal(net, truth.x, truth.y).direction;
    if (limit == Vector3{}) {
      return; // a point or a line: no normal at all
    }
    const double size = distance(result.normal, {0, 0, 0});
    if (!(size > 0.5)) {
      ++measurement_.missed_limits;
      return;
    }
    const double half_angle = std::asin(std::min(1.0, distance(result.normal, limit) / 2));
    const double degrees = 2 * half_angle * 180 / std::numbers::pi;
    at(Quantity::limit).hash.add_bytes(result.normal, sizeof result.normal);
    at(Quantity::limit).add(degrees, degrees / kDegenerateDegrees, where_);
  }

  [[nodiscard]] const Measurement& measurement() const { return measurement_; }

private:
  [[nodiscard]] Metric& at(Quantity quantity) {
    return measurement_.metrics[static_cast<std::size_t>(quantity)];
  }

  void add_vector(Quantity quantity, const T* value, const Vector3dd& truth, const Vector3& scale,
                  const Vector3& bound) {
    Metric& metric = at(quantity);
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs((truth[c] - static_cast<double>(value[c])).to_double());
      // A component in which no control point differs must be exact with us where there are no
      // weights; others are measured against the other components, and where those do not differ
      // either, against what is subtracted.
      const bool exact = scale[c] == 0 && ours_ && !is_rational_;
      const double own_scale = exact ? scale[c] : or_others(quantity, scale, c, scales_.position);
      const double own_bound = exact ? bound[c] : or_others(quantity, bound, c, allowed_position_);
      where_.component = static_cast<int>(c);
      metric.add(relative(error, kUnitRoundoff<T> * own_scale), relative(error, own_bound), where_);
      if (const double* const own = certified(quantity)) {
        metric.max_certificate_ratio =
            std::max(metric.max_certificate_ratio, relative(error, own[c]));
      }
      metric.hash.add(value[c]);
      measurement_.nan_values += std::isnan(value[c]) ? 1 : 0;
    }
  }

  /// What component c of a vector has, or else another one, or else the positions that its control
  /// values are differences of.
  [[nodiscard]] double or_others(Quantity quantity, const Vector3& values, std::size_t c,
                                 const Vector3& positions) const {
    if (values[c] != 0 || largest_of(values) != 0) {
      return values[c] != 0 ? values[c] : largest_of(values);
    }
    const auto [m, n] = degrees_;
    const double factors[] = {1, m, n, m * m, m * n, n * n};
    return factors[static_cast<std::size_t>(quantity)] * largest_of(positions);
  }

  /// The evaluator's own bounds, or null where it gives none.
  [[nodiscard]] const double* certified(Quantity quantity) const {
    if (!certificate_) {
      return nullptr;
    }
    switch (quantity) {
    case Quantity::position:
      return certificate_->position;
    case Quantity::du:
      return certificate_->du;
    case Quantity::dv:
      return certificate_->dv;
    default:
      return nullptr;
    }
  }

  void add_normal(const Truth& truth, const Result<T>& result, const SampleErrors& allowed) {
    const double size = distance(result.normal, {0, 0, 0});
    const bool zero = size == 0 && result.status == SampleStatus::degenerate;
    measurement_.nan_values += std::isnan(size) ? 1 : 0;
    measurement_.bad_lengths += zero || std::abs(size - 1) <= 4 * kUnitRoundoff<T> ? 0 : 1;
    if (truth.normal.relative_size < kVanishing) {
      return; // judged by its limit
    }
    const double units = distance(result.normal, truth.normal.direction) / kUnitRoundoff<T>;
    const double bound = is_bicubic_ ? normal_bound(rule_.fma, truth.normal.kappa)
                                     : turned_by(truth.sample, allowed);
    const double promised = kPlainDegrees * std::numbers::pi / 180 / kUnitRoundoff<T>;
    where_.component = 0;
    at(Quantity::normal).hash.add_bytes(result.normal, sizeof result.normal);
    at(Quantity::normal).add(units, units / std::min(bound, promised), where_);
    if (is_bicubic_) {
      at(Quantity::normal_kappa).add(units / truth.normal.kappa, units / bound, where_);
    }
  }

  /// What errors of the tangents can turn a normal by, in u; the cross product and the division
  /// round, too.
  [[nodiscard]] static double turned_by(const OracleSample& exact, const SampleErrors& allowed) {
    const double du = length(exact.du).hi;
    const double dv = length(exact.dv).hi;
    const double area = length(cross(exact.du, exact.dv)).hi;
    const double moved = norm(allowed.du) * dv + norm(allowed.dv) * du;
    return moved / kUnitRoundoff<T> / area + 3 * du * dv / area + 3;
  }

  [[nodiscard]] bool in_curvature_range() const {
    const double u = largest_of(scales_.du);
    const double v = largest_of(scales_.dv);
    return std::min(u, v) > 1 / kCurvatureRange<T> && std::max(u, v) < kCurvatureRange<T>;
  }

  /// Where the surface is regular enough for the first-order bound: errors of the tangents turn
  /// the normal by less than 1/32.
  void add_curvature(const Truth& truth, const Result<T>& result, const SampleErrors& allowed) {
    if (!in_curvature_range() || !(truth.normal.relative_size > kVanishing) ||
        !(turned_by(truth.sample, allowed) * kUnitRoundoff<T> < 1.0 / 32)) {
      return;
    }
    const OracleCurvatures exact = oracle_curvatures(truth.sample);
    const auto bound = curvature_errors(truth.sample, allowed.derivatives(),
                                        kCurvatureRoundings * kUnitRoundoff<T>);
    constexpr Quantity kOf[] = {Quantity::gaussian, Quantity::mean, Quantity::principal,
                                Quantity::principal};
    for (std::size_t k = 0; k < kCurvatureCount; ++k) {
      const double error =
          std::abs((exact[k] - static_cast<double>(result.curvature[k])).to_double());
      const double ratio = relative(error, bound[k]);
      where_.component = static_cast<int>(k);
      at(kOf[k]).add(ratio, ratio, where_);
      at(kOf[k]).hash.add(result.curvature[k]);
      measurement_.nan_values += std::isnan(result.curvature[k]) ? 1 : 0;
    }
  }

  BoundRule rule_;
  bool ours_;
  bool is_bicubic_ = true;
  bool is_rational_ = false;
  std::array<double, 2> degrees_{};
  NetScales scales_;
  Vector3 allowed_position_{};
  std::optional<NetBounds> bounds_;
  std::optional<Certificate> certificate_;
  Worst where_;
  Measurement measurement_;
};

template <typename T>
[[nodiscard]] Truth truth_at(const Net& net, const Parameters2<T>& at, bool centred) {
  const OracleParameter u = centred ? OracleParameter::centred(static_cast<double>(at.x))
                                    : OracleParameter::unit(static_cast<double>(at.u));
  const OracleParameter v = centred ? OracleParameter::centred(static_cast<double>(at.y))
                                    : OracleParameter::unit(static_cast<double>(at.v));
  Truth truth{oracle_sample(net, u, v), {}, weight_sample(net, u, v),
              condition_of(net, u, v),  0,  0};
  truth.normal = oracle_normal(net, truth.sample);
  // The parameters are centred doubles, which the limit formula pulls inwards; a float's 2u-1 is
  // exact there.
  truth.x = centred ? static_cast<double>(at.x) : 2 * static_cast<double>(at.u) - 1;
  truth.y = centred ? static_cast<double>(at.y) : 2 * static_cast<double>(at.v) - 1;
  return truth;
}

} // namespace

double Metric::rms() const {
  return count == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(count));
}

void Metric::add(double error, double ratio, const Worst& where) {
  ++count;
  sum_of_squares += error * error;
  max_ratio = std::max(max_ratio, std::isnan(ratio) ? kInfinity : ratio);
  if (!(error <= max)) {
    max = std::isnan(error) ? kInfinity : error;
    worst = where;
  }
}

template <typename T>
Reference make_reference(const Family<T>& family, bool centred) {
  Reference reference;
  for (std::size_t k = 0; k < family.nets.size(); ++k) {
    std::vector<Truth> truths;
    for (const Parameters2<T>& at : family.samples[k]) {
      truths.push_back(truth_at(family.nets[k], at, centred));
    }
    reference.truths.push_back(std::move(truths));
  }
  return reference;
}

template <typename T>
Measurement measure(Evaluator<T>& evaluator, const Family<T>& family, const Reference& reference) {
  const ResultClass result_class = evaluator.result_class();
  Collector<T> collector(result_class != ResultClass::nofma, is_ours(result_class),
                         evaluator.variant() == "+origin");
  const int grid = family.rule == SampleRule::grid ? kGridSamples : 0;
  for (std::size_t n = 0; n < family.nets.size(); ++n) {
    if (!evaluator.handles(family.nets[n])) {
      continue;
    }
    const auto& samples = family.samples[n];
    const Capabilities gives = evaluator.capabilities(family.nets[n]);
    std::vector<Result<T>> results(samples.size());
    evaluator.evaluate(family.nets[n], samples, grid, results);
    collector.start_net(family.nets[n], evaluator.certificate(family.nets[n]));
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const Truth& truth = reference.truths[n][k];
      collector.add(n, k, truth, results[k], gives);
      if (gives.normal && truth.normal.relative_size < kVanishing) {
        collector.add_limit(family.nets[n], truth, results[k]);
      }
    }
  }
  return collector.measurement();
}

template Reference make_reference<float>(const Family<float>&, bool);
template Reference make_reference<double>(const Family<double>&, bool);
template Measurement measure<float>(Evaluator<float>&, const Family<float>&, const Reference&);
template Measurement measure<double>(Evaluator<double>&, const Family<double>&, const Reference&);

} // namespace simdbezier::tests
