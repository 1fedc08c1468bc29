// simdbezier info: what a file holds and what this machine would do with it.
#include <tools/commands.hpp>

#include <algorithm>
#include <array>
#include <string>

#include <nlohmann/json.hpp>

#include <tools/library_status.hpp>
#include <tools/output_file.hpp>
#include <tools/topology.hpp>

namespace simdbezier::tools {

namespace {

struct Box {
  std::array<double, 3> low;
  std::array<double, 3> high;
};

Box control_box(const PatchFile& file) {
  Box box{{file.points[0], file.points[1], file.points[2]},
          {file.points[0], file.points[1], file.points[2]}};
  for (std::size_t k = 0; k < file.points.size(); ++k) {
    box.low[k % 3] = std::min(box.low[k % 3], file.points[k]);
    box.high[k % 3] = std::max(box.high[k % 3], file.points[k]);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] += 0.0; // -0 is 0 to the library
    box.high[c] += 0.0;
  }
  return box;
}

std::string describe(const std::array<double, 3>& point) {
  std::string text;
  for (const double coordinate : point) {
    text += text.empty() ? "[" : ", ";
    text += shortest(coordinate);
  }
  return text + "]";
}

std::string as_text(const PatchFile& file, const Box& box, const EdgeCounts& edges, Isa chosen) {
  const std::string degrees =
      std::to_string(file.degree_u) + " in u, " + std::to_string(file.degree_v) + " in v";
  const std::string kinds = std::to_string(edges.shared) + " shared, " +
                            std::to_string(edges.boundary) + " boundary, " +
                            std::to_string(edges.collapsed) + " collapsed";
  std::string text;
  text += "patches            " + std::to_string(file.count) + "\n";
  text += "degrees            " + degrees + "\n";
  text += "control point box  " + describe(box.low) + " to " + describe(box.high) + "\n";
  text += "edges              " + kinds + " (four a patch, shared ones count on each side)\n";
  text += "instruction sets   " + available_isa_names(" ") + "\n";
  text += "chosen             " + std::string(to_string(chosen)) + "\n";
  return text;
}

std::string as_json(const PatchFile& file, const Box& box, const EdgeCounts& edges, Isa chosen) {
  nlohmann::ordered_json json;
  json["name"] = file.name;
  json["patches"] = file.count;
  json["degrees"] = {{"u", file.degree_u}, {"v", file.degree_v}};
  json["control_point_box"] = {{"min", box.low}, {"max", box.high}};
  json["edges"] = {{"total", file.count * 4},
                   {"shared", edges.shared},
                   {"boundary", edges.boundary},
                   {"collapsed", edges.collapsed}};
  json["instruction_sets"]["available"] = nlohmann::ordered_json::array();
  for (const Isa isa : available_isas()) {
    json["instruction_sets"]["available"].push_back(std::string(to_string(isa)));
  }
  json["instruction_sets"]["chosen"] = std::string(to_string(chosen));
  // File names may hold anything.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace

void run_info(const Arguments& arguments) {
  const Isa chosen = chosen_isa();
  const PatchFile file = read_patches(arguments.in, arguments.format);
  const Box box = control_box(file);
  const EdgeCounts edges = count_edges(file);
  OutputFile out("-");
  out.text(arguments.json ? as_json(file, box, edges, chosen) : as_text(file, box, edges, chosen));
  out.commit();
}

} // namespace simdbezier::tools
