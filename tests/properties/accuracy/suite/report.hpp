// The suite's rows: one per family, type, evaluator and quantity; printed, written, and judged.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/properties/accuracy/judge/measure.hpp"

namespace simdbezier::tests {

/// A family by its name (with the evaluator's variant), and what its nets have in common.
struct FamilyInfo {
  std::string name;
  int degree_u = 3;
  int degree_v = 3;
  double weight_ratio = 1; ///< largest weight to smallest; 1 where there are none
};

struct Row {
  FamilyInfo family;
  std::string type; ///< f32, f64
  ResultClass result_class = ResultClass::other;
  std::string evaluator; ///< an instruction set, or another evaluator's name
  Quantity quantity = Quantity::position;
  Metric metric;
  double max_condition_error = 0; ///< position rows only

  [[nodiscard]] std::string quantity_name() const {
    return kQuantityNames[static_cast<std::size_t>(quantity)];
  }
  /// The key of thresholds: the same for all instruction sets of a class.
  [[nodiscard]] std::string key() const { return family.name + "/" + type + "/" + quantity_name(); }
  [[nodiscard]] std::string name() const { return key() + "/" + evaluator; }
  /// Whose thresholds it has: a class of the library, or "plugin/<name>". Empty for those that have
  /// none: other libraries, and curvatures, whose errors are those of the derivatives.
  [[nodiscard]] std::string threshold_class() const;
};

/// "fma", "nofma", "plugin" or "other".
[[nodiscard]] std::string class_name(ResultClass result_class);

/// How many nets a family has and samples a net: figures depend on them.
struct RunSize {
  std::size_t nets = 500;
  std::size_t samples = 100;
  [[nodiscard]] bool operator==(const RunSize&) const = default;
};

/// Committed maximum and RMS of one key.
struct Threshold {
  double max = 0;
  double rms = 0;
};

/// threshold_class() -> key -> figures.
using Thresholds = std::map<std::string, std::map<std::string, Threshold>>;

/// What a run found: rows, and counts that must be zero.
struct AccuracyReport {
  std::vector<Row> rows;
  std::vector<std::string> failures; ///< one line each, naming the row

  void add(const FamilyInfo& family, const std::string& type, ResultClass result_class,
           const std::string& evaluator, const Measurement& measurement);
  /// G1 ratios, G4 hashes inside a class, G5 against de Casteljau, G6 limits.
  void judge_contracts();
  /// What plug-ins do outside of the bounds that hold for the library's own FMA class; those with
  /// figures of their own are judged by these instead.
  void judge_plugins(const Thresholds& own);
  /// G2: not above the committed figures by more than 5 %. Plug-ins without any are not judged.
  void judge_thresholds(const Thresholds& thresholds);
};

void print_table(const AccuracyReport& report);
/// Plug-ins among all others, by RMS error.
void print_rankings(const AccuracyReport& report);
/// Throw std::runtime_error naming the file where it cannot be read or written, and where its
/// figures are those of a run of another size.
void write_json(const AccuracyReport& report, const std::string& path);
[[nodiscard]] Thresholds read_thresholds(const std::string& path, const RunSize& size);
void write_thresholds(const AccuracyReport& report, const std::string& path, const RunSize& size);

} // namespace simdbezier::tests
