// simdbezier_accuracy: the whole accuracy suite. Every family x type x evaluator, against the
// oracle; prints a table, writes rows as JSON, judges the gates, exits 1 naming what regressed.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <regex>
#include <string>

#include <tools/formats/input/text_input.hpp>
#include <tools/process/failure.hpp>

#include "tests/properties/accuracy/suite/evaluators.hpp"
#include "tests/properties/accuracy/suite/plugin_evaluator.hpp"
#include "tests/properties/accuracy/suite/report.hpp"
#include "tests/properties/accuracy/suite/spline_rows.hpp"
#include "tests/support/nets/shape_families.hpp"

namespace simdbezier::tests {
namespace {

constexpr const char* kUsage =
    "usage: simdbezier_accuracy [--json FILE] [--thresholds FILE] [--write-thresholds]\n"
    "                           [--quick | --nets N --samples N] [--filter REGEX]\n"
    "                           [--evaluator FILE.so]...\n"
    "  --evaluator FILE.so  judge another evaluator beside the library's own\n"
    "                       (simdbezier/evaluator_plugin.h, docs/judge-your-own.md)\n"
    "  --json FILE          write all rows, worst inputs as hexadecimal floats\n"
    "  --thresholds FILE    compare with committed figures "
    "(tests/properties/accuracy/suite/thresholds.json);\n"
    "                       other evaluators that FILE has figures of are judged by them, and\n"
    "                       not by the library's bounds\n"
    "  --write-thresholds   write that file instead of comparing, with all evaluators' figures;\n"
    "                       to be reviewed by hand\n"
    "  --nets, --samples    nets a family (500) and samples a net (100); figures hold for the\n"
    "                       numbers that they were written with\n"
    "  --quick              --nets 12 --samples 16: some seconds\n"
    "  --filter REGEX       measure those of FAMILY/TYPE/EVALUATOR only, which REGEX is found in\n"
    "exit: 0 all gates hold, 1 a regression or a plug-in's fault (each is named), 2 bad usage, a\n"
    "file's error, or a filter that nothing matches\n";

struct Settings {
  std::string json;
  std::string thresholds;
  bool write_thresholds = false;
  RunSize size;
  std::string filter;
  std::vector<std::string> evaluators; ///< files
};

/// Plug-ins that run; what is wrong with the others is a failure like any.
[[nodiscard]] std::vector<PluginProcess> start_plugins(const Settings& settings,
                                                       AccuracyReport& report) {
  std::vector<PluginProcess> plugins;
  for (const std::string& file : settings.evaluators) {
    try {
      plugins.push_back(std::make_shared<tools::EvaluatorProcess>(file));
    } catch (const tools::Failure& failure) {
      report.failures.emplace_back(failure.what());
    }
  }
  return plugins;
}

[[nodiscard]] std::size_t parse_count(const std::string& option, const std::string& value) {
  constexpr std::size_t kMost = 1'000'000; // far more than there is time for
  const auto count = tools::parse_integer(value);
  if (!count || *count < 1 || *count > kMost) {
    tools::bad_usage(option + ": expected 1 to " + std::to_string(kMost) + ", found " +
                     tools::in_quotes(value));
  }
  return *count;
}

[[nodiscard]] std::optional<Settings> parse(int argc, char** argv) {
  Settings settings;
  for (int k = 1; k < argc; ++k) {
    const std::string name = argv[k];
    if (name == "--write-thresholds") {
      settings.write_thresholds = true;
      continue;
    }
    if (name == "--quick") {
      settings.size = {12, 16};
      continue;
    }
    if (k + 1 == argc) {
      return std::nullopt;
    }
    const std::string value = argv[++k];
    if (name == "--json") {
      settings.json = value;
    } else if (name == "--thresholds") {
      settings.thresholds = value;
    } else if (name == "--evaluator") {
      settings.evaluators.push_back(value);
    } else if (name == "--filter") {
      settings.filter = value;
    } else if (name == "--nets") {
      settings.size.nets = parse_count(name, value);
    } else if (name == "--samples") {
      settings.size.samples = parse_count(name, value);
    } else {
      return std::nullopt;
    }
  }
  const bool complete = !settings.write_thresholds || !settings.thresholds.empty();
  return complete ? std::optional(settings) : std::nullopt;
}

template <typename T>
[[nodiscard]] FamilyInfo describe(const Family<T>& family, const std::string& variant) {
  const Net& net = family.nets.front();
  double least = 1;
  double most = 1;
  for (const double weight : net.weights) {
    least = std::min(least, weight);
    most = std::max(most, weight);
  }
  return {family.name + variant, net.degree_u, net.degree_v, most / least};
}

/// Measures one evaluator on one family. One that died is a failure, and measured no more.
template <typename T>
void run_one(std::unique_ptr<Evaluator<T>>& evaluator, const Family<T>& family, const char* type,
             const Reference& reference, AccuracyReport& report) {
  const FamilyInfo info = describe(family, evaluator->variant());
  try {
    report.add(info, type, evaluator->result_class(), evaluator->name(),
               measure(*evaluator, family, reference));
  } catch (const tools::EvaluatorDied& died) {
    report.failures.push_back(info.name + "/" + type + "/" + evaluator->name() + ": " +
                              died.what() + "; it is left out from here on");
    evaluator.reset();
  }
}

template <typename T>
void run(const char* type, const Settings& settings, const std::vector<PluginProcess>& plugins,
         AccuracyReport& report) {
  Evaluators<T> evaluators = all_evaluators<T>();
  for (const PluginProcess& plugin : plugins) {
    add_plugin(plugin, evaluators);
  }
  const auto [nets, samples] = settings.size;
  std::vector<Family<T>> families = all_families<T>(nets, samples);
  // There are many shapes: a twelfth of the samples each.
  for (Family<T>& family : shape_families<T>(nets / 4 + 1, samples / 3 + 1)) {
    families.push_back(std::move(family));
  }
  const std::regex filter(settings.filter);
  for (const Family<T>& family : families) {
    std::array<std::optional<Reference>, 2> references; // at u, v; at x, y
    for (auto& evaluator : evaluators) {
      if (evaluator == nullptr || !(evaluator->variant().empty() || family.with_origins) ||
          !std::regex_search(
              family.name + evaluator->variant() + "/" + type + "/" + evaluator->name(), filter)) {
        continue;
      }
      const bool centred = evaluator->reads_centred();
      std::optional<Reference>& reference = references[centred ? 1 : 0];
      if (!reference) {
        std::fprintf(stderr, "%s/%s\n", family.name.c_str(), type);
        reference = make_reference(family, centred);
      }
      run_one(evaluator, family, type, *reference, report);
    }
  }
}

[[nodiscard]] int run_suite(const Settings& settings) {
  AccuracyReport report;
  Thresholds thresholds;
  const bool compares = !settings.thresholds.empty() && !settings.write_thresholds;
  if (compares) {
    thresholds = read_thresholds(settings.thresholds, settings.size);
  }
  const std::vector<PluginProcess> plugins = start_plugins(settings, report);
  run<float>("f32", settings, plugins, report);
  run<double>("f64", settings, plugins, report);
#if defined(SIMDBEZIER_WITH_GMP)
  measure_splines<float>("f32", settings.size.nets, settings.filter, report);
  measure_splines<double>("f64", settings.size.nets, settings.filter, report);
#endif
  if (report.rows.empty() && report.failures.empty()) {
    tools::bad_input("--filter " + settings.filter + ": nothing that was measured matches");
  }
  report.judge_contracts();
  report.judge_plugins(thresholds);
  if (compares) {
    report.judge_thresholds(thresholds);
  }
  print_table(report);
  if (!plugins.empty()) {
    print_rankings(report);
  }
  if (!settings.json.empty()) {
    write_json(report, settings.json);
  }
  for (const std::string& failure : report.failures) {
    std::printf("FAILED %s\n", failure.c_str());
  }
  std::printf("%zu rows, %zu failures\n", report.rows.size(), report.failures.size());
  if (settings.write_thresholds) {
    write_thresholds(report, settings.thresholds, settings.size);
  }
  return report.failures.empty() ? 0 : 1;
}

} // namespace
} // namespace simdbezier::tests

int main(int argc, char** argv) {
  using namespace simdbezier::tests;
  try {
    if (argc == 2 && std::strcmp(argv[1], "--help") == 0) {
      std::fputs(kUsage, stdout);
      return 0;
    }
    const auto settings = parse(argc, argv);
    if (!settings) {
      std::fputs(kUsage, stderr);
      return 2;
    }
    return run_suite(*settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simdbezier_accuracy: %s\n", error.what());
    return 2;
  }
}
