// simdbezier info: what a file holds and what this machine would do with it.
#include <tools/commands/commands.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <tools/patches/edge_counts.hpp>
#include <tools/patches/grid_blocks.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// Patches of one shape are evaluated alike. Shapes are ordered by degrees.
struct Shape {
  int degree_u;
  int degree_v;
  bool rational;
  auto operator<=>(const Shape&) const = default;
};

/// What info says about a file.
struct Summary {
  std::string name;
  std::size_t patches = 0;
  std::size_t rational = 0;
  std::size_t ignored_trims = 0;
  std::size_t merged_splines = 0;
  std::vector<SplineRecord> splines;
  MeshBox box;
  std::map<Shape, std::size_t> shapes; ///< how many patches there are of each
  TopologyCounts joined;
  Isa chosen = Isa::automatic;
};

Summary summarise(PatchFile file, Isa chosen) {
  Summary summary;
  summary.name = file.name;
  summary.patches = file.count;
  summary.ignored_trims = file.ignored_trims;
  summary.merged_splines = file.merged_splines;
  summary.splines = std::move(file.splines);
  summary.chosen = chosen;
  for (const PatchRun& run : file.runs) {
    summary.shapes[{run.degree_u, run.degree_v, run.rational()}] += run.count;
    summary.rational += run.rational() ? run.count : 0;
  }
  summary.box = box_of(file);
  summary.joined = joined_counts(file);
  return summary;
}

std::string describe(const std::array<double, 3>& point) {
  std::string text;
  for (const double coordinate : point) {
    text += text.empty() ? "[" : ", ";
    text += shortest(coordinate);
  }
  return text + "]";
}

std::string describe(const Shape& shape) {
  return std::to_string(shape.degree_u) + " in u, " + std::to_string(shape.degree_v) + " in v" +
         (shape.rational ? ", rational" : "");
}

// Prints one line where all patches are alike, and otherwise one for each shape with its count.
std::string describe(const std::map<Shape, std::size_t>& shapes) {
  std::string text;
  for (const auto& [shape, count] : shapes) {
    text += text.empty() ? "degrees            " : "                   ";
    text += describe(shape);
    if (shapes.size() > 1) {
      text += ": " + quantity(count, "patch", "patches");
    }
    text += "\n";
  }
  return text;
}

std::vector<double> different(std::vector<double> knots) {
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

// Prints one line for each spline, or for as many as can be looked through; all are in JSON.
std::string describe(const std::vector<SplineRecord>& splines) {
  constexpr std::size_t kMost = 16;
  const auto both = [](std::size_t u, std::size_t v) {
    return std::to_string(u) + " x " + std::to_string(v);
  };
  std::string text;
  for (std::size_t k = 0; k < std::min(splines.size(), kMost); ++k) {
    const SplineRecord& spline = splines[k];
    text += k == 0 ? "splines            " : "                   ";
    text +=
        "line " + std::to_string(spline.line) + ": degrees " +
        both(static_cast<std::size_t>(spline.u.degree), static_cast<std::size_t>(spline.v.degree)) +
        (spline.rational ? " (rational), " : ", ") + both(spline.u.points, spline.v.points) +
        " points, " + both(spline.spans.u, spline.spans.v) + " patches, " +
        both(different(spline.u.knots).size(), different(spline.v.knots).size()) +
        " different knots\n";
  }
  if (splines.size() > kMost) {
    text += "                   and " + std::to_string(splines.size() - kMost) + " more\n";
  }
  return text;
}

nlohmann::ordered_json as_json(const SplineDirection& direction, std::size_t patches) {
  return {{"degree", direction.degree},
          {"points", direction.points},
          {"periodic", direction.periodic},
          {"patches", patches},
          {"knots", direction.knots}};
}

std::string as_text(const Summary& summary) {
  const EdgeCounts edges(summary.joined);
  const std::string kinds = std::to_string(edges.shared) + " shared, " +
                            std::to_string(edges.boundary) + " boundary, " +
                            std::to_string(edges.collapsed) + " collapsed, " +
                            std::to_string(edges.non_manifold) + " non-manifold";
  std::string text;
  text += "patches            " + std::to_string(summary.patches) + "\n";
  text += describe(summary.shapes);
  text += describe(summary.splines);
  if (summary.ignored_trims > 0) {
    text += "ignored trims      " + std::to_string(summary.ignored_trims) + "\n";
  }
  if (summary.merged_splines > 0) {
    text += "merged knots       of " + quantity(summary.merged_splines, "spline", "splines") + "\n";
  }
  text += "control point box  " + describe(summary.box.low) + " to " + describe(summary.box.high) +
          "\n";
  text += "edges              " + kinds + " (four a patch, shared ones count on each side)\n";
  text += "repeated patches   " + std::to_string(summary.joined.repeated_patches) + "\n";
  text += "orientation        " + quantity(summary.joined.turned_edges, "edge", "edges") +
          " between patches that disagree" +
          (summary.joined.orientable ? "" : "; a surface of one side") + "\n";
  text += "instruction sets   " + available_isa_names(" ") + "\n";
  text += "chosen             " + std::string(to_string(summary.chosen)) + "\n";
  return text;
}

// "degrees" appears where all patches have the same ones, and "shapes" always.
std::string as_json(const Summary& summary) {
  // These are made as objects, because null that becomes one leaks where memory runs out.
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["name"] = summary.name;
  json["patches"] = summary.patches;
  const Shape& first = summary.shapes.begin()->first;
  const Shape& last = summary.shapes.rbegin()->first;
  if (first.degree_u == last.degree_u && first.degree_v == last.degree_v) {
    json["degrees"] = {{"u", first.degree_u}, {"v", first.degree_v}};
  }
  json["rational"] = summary.rational;
  if (summary.ignored_trims > 0) {
    json["ignored_trims"] = summary.ignored_trims;
  }
  if (summary.merged_splines > 0) {
    json["merged_splines"] = summary.merged_splines;
  }
  json["shapes"] = nlohmann::ordered_json::array();
  for (const auto& [shape, count] : summary.shapes) {
    json["shapes"].push_back({{"degree_u", shape.degree_u},
                              {"degree_v", shape.degree_v},
                              {"rational", shape.rational},
                              {"patches", count}});
  }
  if (!summary.splines.empty()) {
    json["splines"] = nlohmann::ordered_json::array();
  }
  for (const SplineRecord& spline : summary.splines) {
    json["splines"].push_back({{"line", spline.line},
                               {"first_patch", spline.first_patch},
                               {"rational", spline.rational},
                               {"u", as_json(spline.u, spline.spans.u)},
                               {"v", as_json(spline.v, spline.spans.v)}});
  }
  json["control_point_box"] = {{"min", summary.box.low}, {"max", summary.box.high}};
  const EdgeCounts edges(summary.joined);
  json["edges"] = {{"total", summary.patches * 4},
                   {"shared", edges.shared},
                   {"boundary", edges.boundary},
                   {"collapsed", edges.collapsed},
                   {"non_manifold", edges.non_manifold}};
  json["turned_edges"] = summary.joined.turned_edges;
  json["orientable"] = summary.joined.orientable;
  json["repeated_patches"] = summary.joined.repeated_patches;
  json["instruction_sets"] = nlohmann::ordered_json::object();
  json["instruction_sets"]["available"] = nlohmann::ordered_json::array();
  for (const Isa isa : available_isas()) {
    json["instruction_sets"]["available"].push_back(std::string(to_string(isa)));
  }
  json["instruction_sets"]["chosen"] = std::string(to_string(summary.chosen));
  // File names may hold anything.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace

void run_info(const Arguments& arguments) {
  const Isa chosen = chosen_isa();
  refuse_input_as_output("-", inputs_of(arguments));
  const Summary summary = summarise(read_input(arguments), chosen);
  OutputFile out("-");
  out.text(arguments.json ? as_json(summary) : as_text(summary));
  out.commit();
}

} // namespace simdbezier::tools
