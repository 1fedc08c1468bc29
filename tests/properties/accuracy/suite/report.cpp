// Judging: see report.hpp. Reading, writing and printing are in report_io.cpp.
#include "tests/properties/accuracy/suite/report.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

namespace simdbezier::tests {
namespace {

/// A change of a figure by rounding in the text of thresholds.json must not count.
constexpr double kThresholdSlack = 1.05;

/// Zeros stay zeros; below this (a thousandth of a unit, a billionth of a degree) figures are noise
/// of the oracle itself.
constexpr double kNoise = 1e-9;

[[nodiscard]] std::string line(const Row& row, const char* gate, double found, double allowed) {
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.4g where %.4g is allowed (net %zu, x %a, y %a)", gate,
                found, allowed, row.metric.worst.net, row.metric.worst.x, row.metric.worst.y);
  return row.name() + ": " + text;
}

[[nodiscard]] bool is_contract(Quantity quantity) {
  return quantity != Quantity::normal_kappa && quantity != Quantity::limit;
}

/// G5 does not compare where homogeneous sums in powers lose to positive ones, which they do in
/// proportion to the ratio of the weights.
constexpr double kComparedWeightRatio = 4;
constexpr std::size_t kComparedErrors = 5000; // the least: families have 12 852 and more by default

[[nodiscard]] double allowed_against_de_casteljau(const FamilyInfo& family) {
  const bool low = std::max(family.degree_u, family.degree_v) <= 3 && family.weight_ratio == 1;
  return low ? kRmsAgainstDeCasteljau : kRmsAgainstDeCasteljauHigh;
}

/// The best of the two forms of de Casteljau's algorithm that round like the given class.
[[nodiscard]] std::optional<double> de_casteljau_rms(const AccuracyReport& report, const Row& row) {
  const std::string suffix = row.result_class == ResultClass::nofma ? "_nofma" : "";
  std::optional<double> best;
  for (const Row& other : report.rows) {
    const bool is_baseline = other.evaluator == "de_casteljau" + suffix ||
                             other.evaluator == "de_casteljau_diff" + suffix;
    if (is_baseline && other.key() == row.key()) {
      best = std::min(best.value_or(other.metric.rms()), other.metric.rms());
    }
  }
  return best;
}

} // namespace

std::string class_name(ResultClass result_class) {
  switch (result_class) {
  case ResultClass::fma:
    return "fma";
  case ResultClass::nofma:
    return "nofma";
  case ResultClass::plugin:
    return "plugin";
  default:
    return "other";
  }
}

void AccuracyReport::add(const FamilyInfo& family, const std::string& type,
                         ResultClass result_class, const std::string& evaluator,
                         const Measurement& measurement) {
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const auto quantity = static_cast<Quantity>(q);
    if (measurement.metrics[q].count == 0) { // not given, or not for such nets
      continue;
    }
    rows.push_back({family, type, result_class, evaluator, quantity, measurement.metrics[q],
                    quantity == Quantity::position ? measurement.max_condition_error : 0});
  }
  if (result_class == ResultClass::other) {
    return;
  }
  const std::string where = family.name + "/" + type + "/" + evaluator;
  const auto expect_none = [&](std::size_t count, const char* what) {
    if (count != 0) {
      failures.push_back(where + ": " + std::to_string(count) + " " + what);
    }
  };
  expect_none(measurement.nan_values, "NaN values at finite parameters");
  if (result_class == ResultClass::plugin) {
    return;
  }
  expect_none(measurement.bad_lengths, "normals neither of unit length nor zero with a status");
  expect_none(measurement.missed_limits, "zero normals where the surface has a limit");
}

void AccuracyReport::judge_plugins(const Thresholds& own) {
  for (const Row& row : rows) {
    const bool judged = row.quantity <= Quantity::normal && !own.contains(row.threshold_class());
    if (row.result_class == ResultClass::plugin && judged && !(row.metric.max_ratio <= 1)) {
      char text[200];
      std::snprintf(text, sizeof text,
                    ": an error of %.4g u, %.3g times the library's bound (net %zu, component %d, "
                    "x %a, y %a)",
                    row.metric.max, row.metric.max_ratio, row.metric.worst.net,
                    row.metric.worst.component, row.metric.worst.x, row.metric.worst.y);
      failures.push_back(row.name() + text);
    }
  }
}

void AccuracyReport::judge_contracts() {
  std::map<std::string, const Row*> first_of_class;
  for (const Row& row : rows) {
    if (!is_ours(row.result_class)) {
      continue;
    }
    if (is_contract(row.quantity) && !(row.metric.max_ratio <= 1)) {
      failures.push_back(line(row, "G1, error / bound", row.metric.max_ratio, 1));
    }
    if (!(row.metric.max_certificate_ratio <= 1)) {
      failures.push_back(line(row, "G1, error / certificate", row.metric.max_certificate_ratio, 1));
    }
    if (row.quantity == Quantity::limit && !(row.metric.max <= kLimitDegrees)) {
      failures.push_back(line(row, "G6, degrees", row.metric.max, kLimitDegrees));
    }
    // The hill-climbed nets are worst for this scheme, and harmless for de Casteljau.
    if (row.quantity == Quantity::position && row.metric.count >= kComparedErrors &&
        row.family.name != "worst" && row.family.weight_ratio <= kComparedWeightRatio * 1.01) {
      const auto baseline = de_casteljau_rms(*this, row);
      const double factor = allowed_against_de_casteljau(row.family);
      if (baseline && !(row.metric.rms() <= factor * *baseline)) {
        failures.push_back(line(row, "G5, RMS", row.metric.rms(), factor * *baseline));
      }
    }
    const auto [first, added] =
        first_of_class.emplace(class_name(row.result_class) + row.key(), &row);
    if (first->second->metric.hash.value() != row.metric.hash.value()) {
      failures.push_back(row.name() + ": G4, other bits than " + first->second->evaluator);
    }
  }
}

std::string Row::threshold_class() const {
  if (quantity >= Quantity::gaussian || result_class == ResultClass::other) {
    return {};
  }
  return class_name(result_class) +
         (result_class == ResultClass::plugin ? "/" + evaluator : std::string());
}

void AccuracyReport::judge_thresholds(const Thresholds& thresholds) {
  for (const Row& row : rows) {
    const std::string name = row.threshold_class();
    const auto known_class = thresholds.find(name);
    const bool known = known_class != thresholds.end();
    if (name.empty() || (!known && row.result_class == ResultClass::plugin)) {
      continue;
    }
    if (!known || !known_class->second.contains(row.key())) {
      failures.push_back(row.name() + ": G2, no committed threshold");
      continue;
    }
    const Threshold& allowed = known_class->second.at(row.key());
    const double max = allowed.max * kThresholdSlack + kNoise;
    const double rms = allowed.rms * kThresholdSlack + kNoise;
    if (!(row.metric.max <= max)) {
      failures.push_back(line(row, "G2, max", row.metric.max, max));
    }
    if (!(row.metric.rms() <= rms)) {
      failures.push_back(line(row, "G2, RMS", row.metric.rms(), rms));
    }
  }
}

} // namespace simdbezier::tests
