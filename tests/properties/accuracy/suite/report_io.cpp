#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "tests/properties/accuracy/suite/report.hpp"

namespace simdbezier::tests {
namespace {

using Json = nlohmann::ordered_json;

/// The key of thresholds.json that says how many nets and samples the run had. It is absent where
/// they are the default.
constexpr const char* kRunSize = "nets, samples";

[[nodiscard]] std::string text(const RunSize& size) {
  return std::to_string(size.nets) + " nets and " + std::to_string(size.samples) + " samples";
}

[[nodiscard]] std::string hex_float(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

/// JSON has no infinity; what exceeds everything is written as a word.
[[nodiscard]] Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json("infinite");
}

[[nodiscard]] Json row_json(const Row& row) {
  Json json;
  json["family"] = row.family.name;
  json["deg"] = {row.family.degree_u, row.family.degree_v};
  if (row.family.weight_ratio > 1) {
    json["weight_ratio"] = row.family.weight_ratio;
  }
  json["type"] = row.type;
  json["class"] = class_name(row.result_class);
  json["isa"] = row.evaluator;
  json["qty"] = row.quantity_name();
  json["n"] = row.metric.count;
  json["max_u"] = number(row.metric.max);
  json["rms_u"] = number(row.metric.rms());
  json["max_ratio"] = number(row.metric.max_ratio);
  if (row.metric.max_certificate_ratio > 0) {
    json["max_ratio_certificate"] = number(row.metric.max_certificate_ratio);
  }
  if (row.quantity == Quantity::position) {
    json["max_u_cond"] = number(row.max_condition_error);
  }
  json["worst"] = {{"net", row.metric.worst.net},
                   {"component", row.metric.worst.component},
                   {"x", hex_float(row.metric.worst.x)},
                   {"y", hex_float(row.metric.worst.y)}};
  json["hash"] = row.metric.hash.text();
  return json;
}

void write_text(const std::string& text, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << text << '\n';
  file.close();
  if (!file) {
    throw std::runtime_error("cannot write " + path);
  }
}

/// "2.87/.423", or a blank where the evaluator gives no such quantity.
[[nodiscard]] std::string figures(const std::map<std::string, const Row*>& rows,
                                  const std::string& name) {
  const auto row = rows.find(name);
  if (row == rows.end()) {
    return "";
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.3g/%.3g", row->second->metric.max, row->second->metric.rms());
  return text;
}

/// Rounded up to four digits, so that the file stays readable and never too strict.
[[nodiscard]] double rounded_up(double value) {
  if (!(value > 0)) {
    return 0;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 3);
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", std::ceil(value / unit) * unit);
  return std::stod(text);
}

} // namespace

void print_table(const AccuracyReport& report) {
  std::printf(
      "max/RMS errors. P: u max|b|, Du to Dvv: u max|hodograph|, N: u, Nk: u kappa, L: degrees "
      "to the limit, Kg to Kp: error / bound\n%-28s %-24s",
      "family", "evaluator");
  for (const char* quantity : kQuantityNames) {
    std::printf(" %16s", quantity);
  }
  std::printf("\n");
  std::map<std::string, const Row*> by_name;
  for (const Row& row : report.rows) {
    by_name.emplace(row.name(), &row);
  }
  std::string last;
  for (const Row& row : report.rows) {
    const std::string line = row.family.name + "/" + row.type;
    if (line + row.evaluator == last) {
      continue;
    }
    last = line + row.evaluator;
    std::printf("%-28s %-24s", line.c_str(), row.evaluator.c_str());
    for (const char* quantity : kQuantityNames) {
      const std::string name = line + "/" + quantity + "/" + row.evaluator;
      std::printf(" %16s", figures(by_name, name).c_str());
    }
    std::printf("\n");
  }
}

void write_json(const AccuracyReport& report, const std::string& path) {
  Json rows = Json::array();
  for (const Row& row : report.rows) {
    rows.push_back(row_json(row));
  }
  Json json;
  json["rows"] = rows;
  json["failures"] = report.failures;
  write_text(json.dump(1), path);
}

Thresholds read_thresholds(const std::string& path, const RunSize& size) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  Thresholds thresholds;
  try {
    RunSize written;
    const Json json = Json::parse(file);
    for (const auto& [name, entries] : json.items()) {
      if (name == kRunSize) {
        written = {entries.at(0).get<std::size_t>(), entries.at(1).get<std::size_t>()};
        continue;
      }
      for (const auto& [key, value] : entries.items()) {
        thresholds[name][key] = {value.at(0).get<double>(), value.at(1).get<double>()};
      }
    }
    if (!(written == size)) {
      throw std::runtime_error(path + ": expected figures of " + text(size) + ", found those of " +
                               text(written));
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return thresholds;
}

void write_thresholds(const AccuracyReport& report, const std::string& path, const RunSize& size) {
  Thresholds found;
  for (const Row& row : report.rows) {
    // What is not finite gets no figures: it is a failure, and stays one.
    if (!row.threshold_class().empty() && std::isfinite(row.metric.rms())) {
      Threshold& entry = found[row.threshold_class()][row.key()];
      entry.max = std::max(entry.max, rounded_up(row.metric.max));
      entry.rms = std::max(entry.rms, rounded_up(row.metric.rms()));
    }
  }
  // One line a key: what a reviewer reads in a diff.
  std::string text = "{\n";
  if (!(size == RunSize())) {
    found[kRunSize] = {};
  }
  for (const auto& [name, entries] : found) {
    text += (text.size() > 2 ? ",\n" : "") + Json(name).dump() + ": ";
    if (name == kRunSize) {
      text += Json({size.nets, size.samples}).dump();
      continue;
    }
    text += "{\n";
    std::string separator;
    for (const auto& [key, entry] : entries) {
      const Json values = {entry.max, entry.rms};
      text += separator + "  " + Json(key).dump() + ": " + values.dump();
      separator = ",\n";
    }
    text += "\n}";
  }
  write_text(text + "\n}", path);
}

} // namespace simdbezier::tests
