// Evaluators by the size of their errors, over the families that all of them evaluate.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "tests/properties/accuracy/suite/report.hpp"

namespace simdbezier::tests {
namespace {

struct Standing {
  std::string evaluator;
  double max = 0;
  double sum_of_squares = 0;
  std::size_t count = 0;
  [[nodiscard]] double rms() const {
    return count == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(count));
  }
};

/// Families of one type and quantity that an evaluator has rows of.
using Families = std::map<std::string, std::set<std::string>>;

[[nodiscard]] Families families_of(const AccuracyReport& report, const std::string& type,
                                   Quantity quantity) {
  Families families;
  for (const Row& row : report.rows) {
    if (row.type == type && row.quantity == quantity) {
      families[row.evaluator].insert(row.family.name);
    }
  }
  return families;
}

/// The families that all plug-ins have, as far as they have any.
[[nodiscard]] std::set<std::string> compared(const AccuracyReport& report, const std::string& type,
                                             Quantity quantity) {
  const Families all = families_of(report, type, quantity);
  std::set<std::string> common;
  bool first = true;
  for (const Row& row : report.rows) {
    const auto found = all.find(row.evaluator);
    if (row.result_class != ResultClass::plugin || found == all.end()) {
      continue;
    }
    std::set<std::string> both;
    std::set_intersection(common.begin(), common.end(), found->second.begin(), found->second.end(),
                          std::inserter(both, both.end()));
    common = first ? found->second : both;
    first = false;
  }
  return common;
}

void print_ranking(const AccuracyReport& report, const std::string& type, Quantity quantity) {
  const std::set<std::string> families = compared(report, type, quantity);
  const Families all = families_of(report, type, quantity);
  std::map<std::string, Standing> standings;
  for (const Row& row : report.rows) {
    const auto& own = all.find(row.evaluator);
    if (row.type != type || row.quantity != quantity || !families.contains(row.family.name) ||
        !std::includes(own->second.begin(), own->second.end(), families.begin(), families.end())) {
      continue;
    }
    Standing& standing = standings[row.evaluator];
    standing.evaluator = row.evaluator;
    standing.max = std::max(standing.max, row.metric.max);
    standing.sum_of_squares += row.metric.sum_of_squares;
    standing.count += row.metric.count;
  }
  std::vector<Standing> sorted;
  for (const auto& [name, standing] : standings) {
    sorted.push_back(standing);
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const Standing& a, const Standing& b) { return a.rms() < b.rms(); });
  if (sorted.empty()) {
    return;
  }
  std::printf("ranking of %s/%s over %zu families: RMS, max\n",
              kQuantityNames[static_cast<std::size_t>(quantity)], type.c_str(), families.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const Standing& standing = sorted[k];
    std::printf("%4zu. %-24s ", k + 1, standing.evaluator.c_str());
    if (std::isfinite(standing.max)) {
      std::printf("%10.3g %10.3g\n", standing.rms(), standing.max);
    } else {
      std::printf("%21s\n", "not finite: it failed");
    }
  }
}

} // namespace

void print_rankings(const AccuracyReport& report) {
  for (const char* const type : {"f32", "f64"}) {
    for (auto q = Quantity::position; q <= Quantity::normal;
         q = Quantity(static_cast<int>(q) + 1)) {
      print_ranking(report, type, q);
    }
  }
}

} // namespace simdbezier::tests
