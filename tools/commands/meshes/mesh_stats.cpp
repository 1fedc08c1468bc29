#include <tools/commands/meshes/mesh_stats.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// Writes six digits, which people can read.
std::string rounded(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.6g", value);
  return digits.data();
}

// Writes the least number of six digits that is not below the value, for bounds.
std::string rounded_up(double value) {
  double above = value;
  while (std::strtod(rounded(above).c_str(), nullptr) < value) {
    above = std::nextafter(above * (1 + 0x1p-23), HUGE_VAL); // less than a fifth of a last digit
  }
  return rounded(above);
}

std::string of_stages(const StageSeconds& seconds) {
  std::string text;
  const auto add = [&](const char* name, double value) {
    text += text.empty() ? "" : ", ";
    text += std::string(name) + " " + rounded(value);
  };
  add("read", seconds.read);
  add("pack", seconds.pack);
  add("rates", seconds.rates);
  add("topology", seconds.topology);
  add("evaluate", seconds.evaluate);
  add("write", seconds.write);
  return text;
}

double samples_per_second(const MeshStats& stats) {
  const double seconds = stats.seconds.evaluate;
  return seconds > 0 ? static_cast<double>(stats.samples) / seconds : 0;
}

} // namespace

std::string stats_as_text(const MeshStats& stats) {
  std::string text;
  text += "patches            " + std::to_string(stats.patches) + "\n";
  if (stats.ignored_trims > 0) {
    text += "ignored trims      " + std::to_string(stats.ignored_trims) + "\n";
  }
  if (stats.merged_splines > 0) {
    text += "merged knots       of " + quantity(stats.merged_splines, "spline", "splines") + "\n";
  }
  text += "vertices           " + std::to_string(stats.vertices) + "\n";
  text += "triangles          " + std::to_string(stats.triangles) + "\n";
  text += "deviation          ";
  text += std::isfinite(stats.deviation) ? rounded_up(stats.deviation) + " at most, certified"
                                         : "not bounded";
  text += stats.diagonal > 0 && std::isfinite(stats.deviation)
              ? "; " + rounded_up(stats.deviation / stats.diagonal) + " of the diagonal\n"
              : "\n";
  if (stats.was_there) {
    return text;
  }
  text += "diagonal           " + rounded(stats.diagonal) + "\n";
  text += stats.origin ? "origin             " + spaced(*stats.origin) + "\n" : "";
  text += "edges of patches   " + std::to_string(stats.open_edges) + " open, " +
          std::to_string(stats.non_manifold_edges) + " non-manifold";
  if (stats.joined) {
    text += ", " + std::to_string(stats.joined->turned_edges) + " between patches that disagree";
    text += stats.joined->orientable ? "" : "; a surface of one side";
    text += "\nrepeated patches   " + std::to_string(stats.joined->repeated_patches);
  }
  if (stats.splits) {
    text += "\nsplit edges        " + std::to_string(stats.splits->splits) + " joined, " +
            std::to_string(stats.splits->unjoined) + " not; largest gap " +
            rounded(stats.splits->largest_gap);
  }
  text += "\nsamples            " + std::to_string(stats.samples);
  const double rate = samples_per_second(stats);
  text += rate > 0 ? "; " + rounded(rate) + " a second\n" : "\n";
  return text + "seconds            " + of_stages(stats.seconds) + "\n";
}

std::string stats_as_json(const MeshStats& stats) {
  // It is made as an object, because null that becomes one leaks where memory runs out.
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["patches"] = stats.patches;
  if (stats.ignored_trims > 0) {
    json["ignored_trims"] = stats.ignored_trims;
  }
  if (stats.merged_splines > 0) {
    json["merged_splines"] = stats.merged_splines;
  }
  json["vertices"] = stats.vertices;
  json["triangles"] = stats.triangles;
  json["deviation"] = stats.deviation;
  if (stats.was_there) {
    return json.dump(2) + "\n";
  }
  json["diagonal"] = stats.diagonal;
  if (stats.origin) {
    json["origin"] = *stats.origin;
  }
  json["open_edges"] = stats.open_edges;
  json["non_manifold_edges"] = stats.non_manifold_edges;
  if (stats.joined) {
    json["turned_edges"] = stats.joined->turned_edges;
    json["orientable"] = stats.joined->orientable;
    json["repeated_patches"] = stats.joined->repeated_patches;
  }
  if (stats.splits) {
    json["split_edges"] = stats.splits->splits;
    json["unjoined_edges"] = stats.splits->unjoined;
    json["largest_gap"] = stats.splits->largest_gap;
  }
  json["samples"] = stats.samples;
  json["samples_per_second"] = samples_per_second(stats);
  const StageSeconds& seconds = stats.seconds;
  json["seconds"] = {{"read", seconds.read},         {"pack", seconds.pack},
                     {"rates", seconds.rates},       {"topology", seconds.topology},
                     {"evaluate", seconds.evaluate}, {"write", seconds.write}};
  return json.dump(2) + "\n";
}

} // namespace simdbezier::tools
