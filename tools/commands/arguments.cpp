#include <tools/commands/arguments.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

bool is_builtin(const std::string& in) { return in.starts_with("builtin:"); }

// Refuses the value of an option that is the same in all commands that have it.
[[noreturn]] void refuse(const char* name, const std::string& found) {
  const auto entry = std::ranges::find(option_entries(), name, &OptionEntry::name);
  bad_usage(entry->name + ": expected " + entry->expected + ", found " + found);
}

std::size_t parse_grid_side(const std::string& option, std::string_view word) {
  const auto side = parse_integer(word);
  if (!side || *side < 2 || *side > kMostPerDirection) {
    refuse("--grid", in_quotes(option));
  }
  return *side;
}

GridSize parse_grid(const std::string& option) {
  const std::size_t cross = option.find('x');
  if (cross == std::string::npos) {
    const std::size_t side = parse_grid_side(option, option);
    return {side, side};
  }
  const std::string_view word = option;
  return {parse_grid_side(option, word.substr(0, cross)),
          parse_grid_side(option, word.substr(cross + 1))};
}

int parse_threads(const std::string& option) {
  const auto threads = parse_integer(option);
  if (!threads || *threads > kMostThreads) {
    refuse("--threads", in_quotes(option));
  }
  return static_cast<int>(*threads);
}

Precision parse_precision(const std::string& option) {
  if (option != "f32" && option != "f64") {
    refuse("--precision", in_quotes(option));
  }
  return option == "f32" ? Precision::f32 : Precision::f64;
}

std::optional<Output> output_of(std::string_view name) {
  for (std::size_t k = 0; k < kColumnOutputs; ++k) {
    if (const auto output = static_cast<Output>(k); name == output_name(output)) {
      return output;
    }
  }
  return std::nullopt;
}

std::vector<Output> parse_outputs(const std::string& option) {
  std::vector<Output> outputs;
  for (std::size_t first = 0; first <= option.size();) {
    const std::size_t comma = std::min(option.find(',', first), option.size());
    const auto output = output_of(std::string_view(option).substr(first, comma - first));
    if (!output) {
      refuse("--outputs", in_quotes(option));
    }
    outputs.push_back(*output);
    first = comma + 1;
  }
  std::ranges::sort(outputs);
  outputs.erase(std::unique(outputs.begin(), outputs.end()), outputs.end());
  return outputs;
}

void understand_evaluation(const Words& words, Arguments& arguments) {
  arguments.out = *words.value("-o");
  if (words.command == Command::tessellate) {
    arguments.mesh = parse_mesh_arguments(words);
  } else if (extension_of(arguments.out) != "csv" && !is_written_directly(arguments.out)) {
    bad_usage("-o: expected " + find_option("-o", command_name(words.command))->expected +
              ", found " + in_quotes(arguments.out));
  }
  if (words.has("--samples") && words.has("--grid")) {
    bad_usage("--samples: expected without --grid, found both");
  }
  arguments.grid = parse_grid(words.value("--grid").value_or("16"));
  arguments.precision = parse_precision(words.value("--precision").value_or("f32"));
  arguments.outputs = parse_outputs(words.value("--outputs").value_or("position"));
  arguments.threads = parse_threads(words.value("--threads").value_or("0"));
  arguments.samples = words.value("--samples");
  if (arguments.samples == "" || (arguments.samples == "-" && arguments.in == "-")) {
    refuse("--samples", *arguments.samples == "" ? "''" : "standard input, which IN is read from");
  }
}

} // namespace

std::vector<std::string> inputs_of(const Arguments& arguments) {
  std::vector<std::string> inputs;
  if (!is_builtin(arguments.in)) {
    inputs.push_back(arguments.in);
  }
  if (arguments.samples) {
    inputs.push_back(*arguments.samples);
  }
  return inputs;
}

PatchFile read_input(const Arguments& arguments) {
  PatchFile file = read_patches(arguments.in, arguments.format, arguments.reading);
  if (file.ignored_trims > 0) {
    std::fputs(("simdbezier: " +
                quantity(file.ignored_trims, "trimmed surface was", "trimmed surfaces were") +
                " read as a whole\n")
                   .c_str(),
               stderr);
  }
  return file;
}

std::optional<Arguments> parse_arguments(int argc, const char* const* argv) {
  const std::optional<Words> words = split_command_line(argc, argv);
  if (!words) {
    return std::nullopt;
  }
  Arguments arguments;
  arguments.command = words->command;
  arguments.in = *words->value("IN");
  if (arguments.in.empty()) {
    refuse("IN", "''");
  }
  if (const auto format = words->value("--format")) {
    arguments.format = parse_patch_format("--format", *format);
    if (is_builtin(arguments.in)) {
      bad_usage("--format: expected with a file, found " + in_quotes(arguments.in));
    }
  }
  arguments.reading.ignore_trims = words->has("--ignore-trims");
  arguments.json = words->has("--json");
  if (words->command != Command::info) {
    understand_evaluation(*words, arguments);
  }
  return arguments;
}

} // namespace simdbezier::tools
