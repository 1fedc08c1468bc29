// The texts of --help: options with ranges and defaults, examples, exit codes.
#include <tools/command_line.hpp>

#include <algorithm>

#include <tools/grid_blocks.hpp>
#include <tools/patch_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kIndent = 24;

struct CommandText {
  std::string_view name;
  std::string_view usage;
  std::string_view purpose;
  std::string_view examples; // one a line
};
constexpr CommandText kCommandTexts[] = {
    {"tessellate", "IN -o OUT [options]",
     "Writes patches as triangles, each patch as a grid of vertices.",
     "simdbezier tessellate builtin:teapot --grid 32 -o teapot.ply\n"
     "simdbezier tessellate model.bv --grid 8x24 --no-normals -o model.obj\n"
     "cat model.itd | simdbezier tessellate - --format itd -o model.ply\n"},
    {"evaluate", "IN -o OUT.csv [options]",
     "Writes values as CSV: of a grid on every patch, or of a file of samples.",
     "simdbezier evaluate builtin:teapot --grid 8 --outputs position,normal -o teapot.csv\n"
     "simdbezier evaluate model.bez --samples s.csv --precision f64 -o result.csv\n"
     "printf 'patch,u,v\\n0,0.5,0.5\\n' | simdbezier evaluate model.obj --samples - -o -\n"},
    {"info", "IN [options]",
     "Says what patches a file has, how they meet, and what this machine would run.",
     "simdbezier info builtin:teapot\n"
     "simdbezier info model.rib --json\n"}};

constexpr std::string_view kExitCodes =
    "Exit codes: 0 done, 1 bad input or failed write, 2 bad usage.\n";
constexpr std::string_view kEnvironment =
    "SIMDBEZIER_ISA=scalar|sse2|avx2|avx512|neon64 in the environment overrides the\n"
    "choice of instruction set; OMP_NUM_THREADS limits what --threads 0 takes.\n";

// A term and what it means, in lines of at most kWidth.
std::string explained(const std::string& term, std::string_view meaning) {
  std::string text;
  std::string line = "  " + term;
  if (line.size() + 2 > kIndent) {
    text = line + "\n";
    line.clear();
  }
  line.resize(kIndent, ' ');
  while (!meaning.empty()) {
    const std::size_t end = std::min(meaning.find(' '), meaning.size());
    if (line.size() > kIndent && line.size() + 1 + end > kWidth) {
      text += line + "\n";
      line.assign(kIndent, ' ');
    }
    line += line.size() > kIndent ? " " : "";
    line += meaning.substr(0, end);
    meaning.remove_prefix(std::min(end + 1, meaning.size()));
  }
  return text + line + "\n";
}

std::string options_of(std::string_view command) {
  std::string text;
  for (const OptionEntry& entry : option_entries()) {
    if (entry.listed && entry.is_of(command)) {
      std::string term = (entry.alias.empty() ? "" : entry.alias + ", ") + entry.name;
      term += entry.value.empty() || entry.name == "IN" ? "" : " " + entry.value;
      text += explained(term, entry.help + (entry.expected.empty() ? "" : ": " + entry.expected));
    }
  }
  return text;
}

std::string indented(std::string_view lines) {
  std::string text;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n') + 1;
    text += "  " + std::string(lines.substr(0, end));
    lines.remove_prefix(end);
  }
  return text;
}

std::string program_help() {
  std::string text = "usage: simdbezier COMMAND …\n\n"
                     "Evaluates many Bézier patches at many parameters.\n\nCommands:\n";
  std::string examples;
  for (const CommandText& command : kCommandTexts) {
    text +=
        explained(std::string(command.name) + " " + std::string(command.usage), command.purpose);
    examples += command.examples.substr(0, command.examples.find('\n') + 1);
  }
  return text + "\nOptions:\n" + options_of("simdbezier") + "\nExamples:\n" + indented(examples) +
         "\n'simdbezier COMMAND --help' lists the options of a command.\n" +
         std::string(kExitCodes) + std::string(kEnvironment);
}

std::vector<OptionEntry> make_entries() {
  const std::string all = " tessellate evaluate info ";
  const std::string both = " tessellate evaluate ";
  const std::string side = std::to_string(kMostPerDirection);
  return {
      {"IN", "IN", "builtin:teapot, the name of a file or - for standard input",
       "Patches (" + patch_format_names(".") + ")", all},
      {"-o", "OUT", "a name that ends in .obj, .ply, .stl or .glb", "Output, required",
       " tessellate "},
      {"-o", "OUT", "a name that ends in .csv, or - for standard output", "Output, required",
       " evaluate "},
      {"--format", "NAME", patch_format_names(""), "Format of IN, which otherwise its name tells",
       all},
      {"--grid", "N|NUxNV", "N or NUxNV, each from 2 to " + side,
       "Samples of every patch (default 16)", both},
      {"--samples", "FILE.csv", "the name of a CSV file or - for standard input",
       "Samples instead of a grid, with the header patch,u,v, or patch,x,y with x = 2u-1, y = "
       "2v-1",
       " evaluate "},
      {"--outputs", "LIST", std::string(kOutputNames) + " separated by commas",
       "Columns (default position); curvature is four: gaussian, mean, smaller and larger "
       "principal",
       " evaluate "},
      {"--precision", "TYPE", "f32 or f64",
       "Numbers to compute with (default f32, control points are rounded to float first)", both},
      {"--threads", "N", "1 to " + std::to_string(kMostThreads) + ", or 0 for all",
       "Threads to compute with (default 0)", both},
      {"--no-normals", "", "", "Positions only", " tessellate "},
      {"--json", "", "", "One JSON object, for machines", " info "},
      {"--tolerance", "D", "a distance", "", " tessellate ", false},
      {"--version", "", "", "Print the version", " simdbezier "},
      {"--help", "", "", "Print this text", " simdbezier tessellate evaluate info ", true, "-h"},
  };
}

} // namespace

const std::vector<OptionEntry>& option_entries() {
  static const std::vector<OptionEntry> entries = make_entries();
  return entries;
}

std::string help_text(std::optional<Command> command) {
  if (!command) {
    return program_help();
  }
  const CommandText& text = kCommandTexts[static_cast<std::size_t>(*command)];
  const std::string name(text.name);
  return "usage: simdbezier " + name + " " + std::string(text.usage) + "\n\n" +
         std::string(text.purpose) + "\n\nOptions:\n" + options_of(name) + "\nExamples:\n" +
         indented(text.examples) + "\n" + std::string(kExitCodes) + std::string(kEnvironment);
}

} // namespace simdbezier::tools
