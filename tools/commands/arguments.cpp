#include <tools/commands/arguments.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/patches/write_patches.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

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
  if (words.command != Command::evaluate) {
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

std::size_t parse_shards(const std::string& option, const char* name) {
  const auto shards = parse_integer(option);
  if (!shards || *shards < 1) {
    refuse(name, in_quotes(option));
  }
  return *shards;
}

// I/N, where I may be what Slurm says.
Shard parse_shard(const std::string& option) {
  const std::size_t slash = std::min(option.find('/'), option.size());
  std::string number = option.substr(0, slash);
  if (number == "slurm") {
    const char* const task = std::getenv("SLURM_ARRAY_TASK_ID");
    if (task == nullptr) {
      bad_usage("--shard: expected SLURM_ARRAY_TASK_ID in the environment, found none");
    }
    number = task;
  }
  const auto shard = parse_integer(number);
  const auto all = parse_integer(option.substr(std::min(slash + 1, option.size())));
  if (!shard || !all || *shard < 1 || *shard > *all) {
    refuse("--shard", in_quotes(slash == option.size() ? option : number + option.substr(slash)));
  }
  return {*shard - 1, *all};
}

// What decides the mesh beside the model. A value is joined to its option.
std::string words_of_mesh(const Words& words) {
  std::string text;
  for (const auto& [name, value] : words.values) {
    const bool elsewhere = name == "IN" || name == "-o" || name == "--shard" ||
                           name == "--shards" || name == "--stats" || name == "--threads" ||
                           name == "--shard-patches";
    if (!elsewhere) {
      text += " " + name + (value.empty() ? "" : "=" + for_shell(value));
    }
  }
  return text;
}

void understand_parts(const Words& words, Arguments& arguments) {
  if (const auto shard = words.value("--shard")) {
    arguments.shard = parse_shard(*shard);
  }
  if (const auto patches = words.value("--shard-patches")) {
    arguments.shard_patches = parse_shards(*patches, "--shard-patches");
  }
  arguments.words = words_of_mesh(words);
  if (arguments.shard || words.command == Command::plan) {
    expect_local_options(arguments);
    if (arguments.mesh.format == MeshFormat::obj) {
      bad_usage("-o: expected a mesh in ply, stl, glb, vtu or raw for parts, found obj");
    }
  }
}

void understand_conversion(const Words& words, Arguments& arguments) {
  arguments.out = *words.value("-o");
  arguments.sort = words.has("--sort");
  const auto to = words.value("--to");
  const auto format = written_patch_format(to.value_or(extension_of(arguments.out)));
  if (!format) {
    const OptionEntry& entry = *find_option(to ? "--to" : "-o", command_name(words.command));
    bad_usage(entry.name + ": expected " + entry.expected + ", found " +
              in_quotes(to.value_or(arguments.out)));
  }
  arguments.written = *format;
}

} // namespace

std::string for_shell(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./,:=+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) {
    return word;
  }
  std::string quoted = "'";
  for (const char c : word) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

void expect_local_options(const Arguments& arguments) {
  const MeshArguments& mesh = arguments.mesh;
  const auto refuse_if = [](bool found, const char* option) {
    if (found) {
      bad_usage(std::string(option) + ": expected without parts of the mesh, found both");
    }
  };
  refuse_if(mesh.snap > 0, "--snap");
  refuse_if(mesh.split_edges, "--split-edges");
  refuse_if(mesh.point_size > 0, "--point-size");
  refuse_if(mesh.orient, "--orient");
  refuse_if(mesh.drop_repeated, "--drop-repeated");
  refuse_if(mesh.bezier_cells, "--cells bezier");
  if (is_written_directly(arguments.out)) {
    bad_usage("-o: expected a file for parts of a mesh, found " + arguments.out);
  }
}

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
  if (file.merged_splines > 0) {
    std::fputs(("simdbezier: --knot-tolerance made different knots of " +
                quantity(file.merged_splines, "spline", "splines") + " one\n")
                   .c_str(),
               stderr);
  }
  return file;
}

std::optional<Arguments> parse_arguments(int argc, const char* const* argv, bool of_ranks) {
  std::optional<Words> words = split_command_line(argc, argv);
  if (!words) {
    return std::nullopt;
  }
  words->of_ranks = of_ranks && words->command == Command::tessellate; // others run in one process
  Arguments arguments;
  arguments.command = words->command;
  arguments.in = words->value("IN").value_or("");
  if (arguments.in.empty() && words->command != Command::join) {
    refuse("IN", "''");
  }
  if (const auto format = words->value("--format")) {
    arguments.format = parse_patch_format("--format", *format);
    if (is_builtin(arguments.in)) {
      bad_usage("--format: expected with a file, found " + in_quotes(arguments.in));
    }
  }
  arguments.reading.ignore_trims = words->has("--ignore-trims");
  arguments.reading.knot_tolerance = positive(*words, "--knot-tolerance").value_or(0);
  arguments.json = words->has("--json");
  if (const auto shards = words->value("--shards")) {
    arguments.shards = parse_shards(*shards, "--shards");
  }
  arguments.remove_parts = words->has("--remove-parts");
  switch (words->command) {
  case Command::info:
    break;
  case Command::convert:
    understand_conversion(*words, arguments);
    break;
  case Command::join:
    arguments.out = *words->value("-o");
    arguments.mesh = parse_mesh_arguments(*words);
    break;
  case Command::tessellate:
  case Command::evaluate:
  case Command::plan:
    understand_evaluation(*words, arguments);
    understand_parts(*words, arguments);
  }
  return arguments;
}

} // namespace simdbezier::tools
