#include <tools/arguments.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>

#include <tools/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr const char* kOutputNames = "position, du, dv, duu, duv, dvv, normal, curvature";
constexpr int kMostThreads = 1024;

// What the command line says, word by word.
struct Words {
  std::string in, format, out;
  std::optional<std::string> samples, tolerance;
  std::string grid = "16", precision = "f32", outputs = "position", threads = "0";
  bool no_normals = false;
  bool json = false;
};

std::size_t parse_grid_side(const std::string& option, std::string_view word) {
  const auto side = parse_integer(word);
  if (!side || *side < 2 || *side > kMostPerDirection) {
    bad_usage("--grid: expected N or NUxNV, each from 2 to " + std::to_string(kMostPerDirection) +
              ", found " + in_quotes(option));
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
    bad_usage("--threads: expected 1 to " + std::to_string(kMostThreads) +
              ", or 0 for all, found " + in_quotes(option));
  }
  return static_cast<int>(*threads);
}

Precision parse_precision(const std::string& option) {
  if (option != "f32" && option != "f64") {
    bad_usage("--precision: expected f32 or f64, found " + in_quotes(option));
  }
  return option == "f32" ? Precision::f32 : Precision::f64;
}

std::vector<OutputGroup> parse_outputs(const std::string& option) {
  constexpr std::array<std::string_view, kOutputGroups> kNames = {
      "position", "du", "dv", "duu", "duv", "dvv", "normal", "curvature"};
  std::vector<OutputGroup> groups;
  for (std::size_t first = 0; first <= option.size();) {
    const std::size_t comma = std::min(option.find(',', first), option.size());
    const std::string name = option.substr(first, comma - first);
    const auto* const found = std::ranges::find(kNames, name);
    if (found == kNames.end()) {
      bad_usage("--outputs: expected " + std::string(kOutputNames) +
                " separated by commas, found " + in_quotes(option));
    }
    groups.push_back(static_cast<OutputGroup>(found - kNames.begin()));
    first = comma + 1;
  }
  std::ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

void check_output_name(Command command, const std::string& out) {
  const std::string extension = extension_of(out);
  if (command == Command::evaluate) {
    if (extension != "csv" && !is_written_directly(out)) {
      bad_usage("-o: expected a name that ends in .csv, or - for standard output, found " +
                in_quotes(out));
    }
    return;
  }
  if (extension == "stl" || extension == "glb") {
    bad_usage("-o: writing ." + extension + " files is not supported yet");
  }
  if (extension != "obj" && extension != "ply") {
    bad_usage("-o: expected a name that ends in .obj or .ply, found " + in_quotes(out));
  }
}

Arguments understand(Command command, const Words& words) {
  Arguments arguments;
  arguments.command = command;
  arguments.in = words.in;
  if (words.in.empty()) {
    bad_usage("IN: expected builtin:teapot, the name of a file or -, found ''");
  }
  if (!words.format.empty()) {
    arguments.format = parse_patch_format("--format", words.format);
  }
  arguments.json = words.json;
  if (command == Command::info) {
    return arguments;
  }
  if (words.tolerance) {
    bad_usage("--tolerance: adaptive tessellation is not supported yet");
  }
  arguments.out = words.out;
  check_output_name(command, words.out);
  arguments.grid = parse_grid(words.grid);
  arguments.precision = parse_precision(words.precision);
  arguments.outputs = parse_outputs(words.outputs);
  arguments.threads = parse_threads(words.threads);
  arguments.normals = !words.no_normals;
  arguments.samples = words.samples;
  if (words.samples == "-" && words.in == "-") {
    bad_usage("--samples: standard input is already read for the patches");
  }
  return arguments;
}

void add_input(CLI::App& command, Words& words) {
  command
      .add_option("IN", words.in,
                  "builtin:teapot, a " + patch_format_names(".") + " file, or - for standard input")
      ->required();
  command.add_option("--format", words.format,
                     patch_format_names("") + "; otherwise the name of IN tells");
}

void add_evaluation(CLI::App& command, Words& words) {
  command.add_option("--precision", words.precision,
                     "f32 or f64 (default f32: control points are rounded to float first)");
  command.add_option("--threads", words.threads, "number of threads (default: all)");
}

CLI::App* add_tessellate(CLI::App& app, Words& words) {
  CLI::App* const command = app.add_subcommand("tessellate", "write patches as triangles");
  add_input(*command, words);
  command->add_option("-o", words.out, "OUT.obj or OUT.ply")->required();
  command->add_option("--grid", words.grid, "samples per patch: N or NUxNV (default 16)");
  command->add_option("--tolerance", words.tolerance, "not supported yet")->excludes("--grid");
  add_evaluation(*command, words);
  command->add_flag("--no-normals", words.no_normals, "positions only");
  return command;
}

CLI::App* add_evaluate(CLI::App& app, Words& words) {
  CLI::App* const command = app.add_subcommand("evaluate", "write sample values as CSV");
  add_input(*command, words);
  command->add_option("-o", words.out, "OUT.csv, or - for standard output")->required();
  command->add_option("--grid", words.grid, "samples per patch: N or NUxNV (default 16)");
  command
      ->add_option("--samples", words.samples,
                   "CSV with header patch,u,v, or patch,x,y with x = 2u-1, y = 2v-1; - is standard "
                   "input")
      ->excludes("--grid");
  add_evaluation(*command, words);
  command->add_option("--outputs", words.outputs,
                      "of " + std::string(kOutputNames) +
                          ", separated by commas (default position); curvature is four columns: "
                          "gaussian, mean, smaller and larger principal");
  return command;
}

CLI::App* add_info(CLI::App& app, Words& words) {
  CLI::App* const command = app.add_subcommand("info", "describe patches and machine");
  add_input(*command, words);
  command->add_flag("--json", words.json, "for machines");
  return command;
}

std::string version_text() {
  return "simdbezier " + std::to_string(SIMDBEZIER_VERSION_MAJOR) + "." +
         std::to_string(SIMDBEZIER_VERSION_MINOR) + "." + std::to_string(SIMDBEZIER_VERSION_PATCH);
}

/// What CLI11 says, except where words are left over. The first of them is then the mistake: what
/// is missing was most likely meant by it.
[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  const std::vector<std::string> rest = app.remaining(true);
  if (commands.empty()) {
    bad_usage("expected tessellate, evaluate, info or --help, found " +
              (rest.empty() ? "nothing" : in_quotes(rest.front())));
  }
  if (rest.empty()) {
    bad_usage(error.what());
  }
  const std::string& command = commands.front()->get_name();
  bad_usage(command + ": expected what 'simdbezier " + command + " --help' lists, found " +
            in_quotes(rest.front()));
}

} // namespace

std::optional<Arguments> parse_arguments(int argc, const char* const* argv) {
  CLI::App app("Evaluates many Bézier patches at many parameters.", "simdbezier");
  app.footer("Exit codes: 0 done, 1 bad input or failed write, 2 bad usage.\n"
             "SIMDBEZIER_ISA=scalar|sse2|avx2|avx512|neon64 overrides the choice of instruction "
             "set.");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  Words words;
  const CLI::App* const tessellate = add_tessellate(app, words);
  const CLI::App* const evaluate = add_evaluate(app, words);
  add_info(app, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      app.exit(error);
      return std::nullopt;
    }
    refuse(app, error);
  }
  return understand(tessellate->parsed() ? Command::tessellate
                    : evaluate->parsed() ? Command::evaluate
                                         : Command::info,
                    words);
}

} // namespace simdbezier::tools
