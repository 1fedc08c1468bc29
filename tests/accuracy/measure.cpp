#include "tests/accuracy/measure.hpp"

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

/// Scales of one net, shared by its samples.
struct NetScales {
  Vector3 position;
  Vector3 du;
  Vector3 dv;
  Vector3 duu;
  Vector3 duv;
  Vector3 dvv;
};

[[nodiscard]] NetScales scales_of(const Net& net) {
  return {{largest_coordinate(net, 0), largest_coordinate(net, 1), largest_coordinate(net, 2)},
          largest_hodographs_u(net),
          largest_hodographs_v(net),
          largest_hodographs(net, {2, 0}),
          largest_hodographs(net, {1, 1}),
          largest_hodographs(net, {0, 2})};
}

[[nodiscard]] Vector3 condition_of(const Net& net, OracleParameter u, OracleParameter v) {
  Net magnitudes = net;
  for (Vector3& point : magnitudes.points) {
    for (double& value : point) {
      value = std::abs(value);
    }
  }
  const Vector3dd sums = oracle_derivative(magnitudes, u, v, {0, 0});
  return {sums[0].to_double(), sums[1].to_double(), sums[2].to_double()};
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
      : fma_(fma), ours_(ours),
        position_bound_(local_origin ? position_bound_with_origin(fma) : position_bound(fma)) {}

  void start_net(const std::optional<Certificate>& certificate) { certificate_ = certificate; }

  void add(const NetScales& scales, std::size_t net, const Truth& truth, const Result<T>& result,
           const Capabilities& gives) {
    where_ = {net, 0, truth.x, truth.y};
    if (gives.position) {
      add_vector(Quantity::position, result.position, truth.sample.position, scales.position,
                 position_bound_);
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::abs((truth.sample.position[c] - result.position[c]).to_double());
        const double scale = kUnitRoundoff<T> * truth.condition[c];
        measurement_.max_condition_error =
            std::max(measurement_.max_condition_error, relative(error, scale));
      }
    }
    if (gives.tangents) {
      add_vector(Quantity::du, result.du, truth.sample.du, scales.du, derivative_bound(fma_));
      add_vector(Quantity::dv, result.dv, truth.sample.dv, scales.dv, derivative_bound(fma_));
    }
    if (gives.second_derivatives) {
      const double bound = second_derivative_bound(fma_);
      add_vector(Quantity::duu, result.duu, truth.sample.duu, scales.duu, bound);
      add_vector(Quantity::duv, result.duv, truth.sample.duv, scales.duv, bound);
      add_vector(Quantity::dvv, result.dvv, truth.sample.dvv, scales.dvv, bound);
    }
    if (gives.normal) {
      add_normal(truth, result);
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
                  double bound) {
    Metric& metric = at(quantity);
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs((truth[c] - static_cast<double>(value[c])).to_double());
      // A component in which no control point differs must be exact with us; others are measured
      // against the other components.
      const double own_scale = scale[c] == 0 && !ours_ ? largest_of(scale) : scale[c];
      const double units = relative(error, kUnitRoundoff<T> * own_scale);
      where_.component = static_cast<int>(c);
      metric.add(units, units / bound, where_);
      if (const double* const own = certified(quantity)) {
        metric.max_certificate_ratio =
            std::max(metric.max_certificate_ratio, relative(error, own[c]));
      }
      metric.hash.add(value[c]);
      measurement_.nan_values += std::isnan(value[c]) ? 1 : 0;
    }
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

  void add_normal(const Truth& truth, const Result<T>& result) {
    const double size = distance(result.normal, {0, 0, 0});
    const bool zero = size == 0 && result.status == SampleStatus::degenerate;
    measurement_.nan_values += std::isnan(size) ? 1 : 0;
    measurement_.bad_lengths += zero || std::abs(size - 1) <= 4 * kUnitRoundoff<T> ? 0 : 1;
    if (truth.normal.relative_size < kVanishing) {
      return; // judged by its limit
    }
    const double units = distance(result.normal, truth.normal.direction) / kUnitRoundoff<T>;
    const double bound = normal_bound(fma_, truth.normal.kappa);
    const double promised = kPlainDegrees * std::numbers::pi / 180 / kUnitRoundoff<T>;
    where_.component = 0;
    at(Quantity::normal).hash.add_bytes(result.normal, sizeof result.normal);
    at(Quantity::normal).add(units, units / std::min(bound, promised), where_);
    at(Quantity::normal_kappa).add(units / truth.normal.kappa, units / bound, where_);
  }

  bool fma_;
  bool ours_;
  double position_bound_;
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
  Truth truth{oracle_sample(net, u, v), {}, condition_of(net, u, v), 0, 0};
  truth.normal = oracle_normal(net, truth.sample);
  // As centred doubles, which the limit formula pulls inwards; a float's 2u-1 is exact there.
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
  Collector<T> collector(result_class != ResultClass::nofma, result_class != ResultClass::other,
                         evaluator.variant() == "+origin");
  const Capabilities gives = evaluator.capabilities();
  const int grid = family.rule == SampleRule::grid ? kGridSamples : 0;
  for (std::size_t n = 0; n < family.nets.size(); ++n) {
    const auto& samples = family.samples[n];
    std::vector<Result<T>> results(samples.size());
    evaluator.evaluate(family.nets[n], samples, grid, results);
    const NetScales scales = scales_of(family.nets[n]);
    collector.start_net(evaluator.certificate(family.nets[n]));
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const Truth& truth = reference.truths[n][k];
      collector.add(scales, n, truth, results[k], gives);
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
