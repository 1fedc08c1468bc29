// The texts of --help: options with ranges and defaults, examples, exit codes.
#include <tools/commands/command_line.hpp>

#include <algorithm>

#include <simdbezier/options.hpp>

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
     "Writes patches as a mesh of triangles without gaps, as coarse as asked for.",
     "simdbezier tessellate builtin:teapot --relative 1e-3 --stats -o teapot.glb\n"
     "simdbezier tessellate model.bv --tolerance 0.05 --crease 30 -o model.obj\n"
     "cat model.itd.gz | simdbezier tessellate - --format itd --grid 8x24 -o model.ply\n"},
    {"evaluate", "IN -o OUT.csv [options]",
     "Writes values as CSV: of a grid on every patch, or of a file of samples.",
     "simdbezier evaluate builtin:teapot --grid 8 --outputs position,normal -o teapot.csv\n"
     "simdbezier evaluate model.bez --samples s.csv --precision f64 -o result.csv\n"
     "printf 'patch,u,v\\n0,0.5,0.5\\n' | simdbezier evaluate model.obj --samples - -o -\n"},
    {"info", "IN [options]",
     "Says what patches a file has, how they meet, and what this machine would run.",
     "simdbezier info builtin:teapot\n"
     "simdbezier info model.rib --json\n"},
    {"convert", "IN -o OUT [options]",
     "Writes patches in another format: .sbp is binary, and read piece by piece.",
     "simdbezier convert builtin:teapot --sort -o teapot.sbp\n"
     "simdbezier convert model.iges -o model.obj\n"},
    {"plan", "IN -o OUT --shards N [options]",
     "Prints the commands that make a mesh in parts, and the one that joins them.",
     "simdbezier plan builtin:teapot --relative 1e-4 --shards 4 -o teapot.ply\n"
     "simdbezier plan model.sbp --shards 64 -o model.ply > plan.txt\n"
     "head -n -1 plan.txt | parallel && tail -n 1 plan.txt | sh\n"},
    {"join", "-o OUT --shards N [options]",
     "Makes the mesh of parts that tessellate --shard has made.",
     "simdbezier join -o model.ply --shards 64 --remove-parts\n"}};

constexpr std::string_view kExitCodes =
    "Exit codes: 0 done, 1 bad input, bad number or failed write, 2 other bad usage.\n";
constexpr std::string_view kEnvironment =
    " in the environment\n"
    "overrides the choice of instruction set, SIMDBEZIER_DESTINATION=memory|cache\n"
    "whether large results go past the caches, SIMDBEZIER_SPLIT_STORES=slow|fast\n"
    "what is measured otherwise; OMP_NUM_THREADS limits what --threads 0 takes.\n"
    "TMPDIR names the folder of temporary files where the output is a pipe.\n";

// What the environment may say, whichever instruction sets this machine has.
std::string environment() {
  std::string text = "SIMDBEZIER_ISA=";
  std::string_view separator;
  for (unsigned k = 1; isa_from_name(to_string(static_cast<Isa>(k))); ++k) {
    text += std::string(separator) + std::string(to_string(static_cast<Isa>(k)));
    separator = "|";
  }
  return text + std::string(kEnvironment);
}

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
    if (entry.is_of(command)) {
      std::string term = (entry.alias.empty() ? "" : entry.alias + ", ") + entry.name;
      term += entry.value.empty() || entry.name == "IN" ? ""
              : entry.needs_value                       ? " " + entry.value
                                                        : "[=" + entry.value + "]";
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
         std::string(kExitCodes) + environment();
}

} // namespace

std::string help_text(std::optional<Command> command) {
  if (!command) {
    return program_help();
  }
  const CommandText& text = kCommandTexts[static_cast<std::size_t>(*command)];
  const std::string name(text.name);
  return "usage: simdbezier " + name + " " + std::string(text.usage) + "\n\n" +
         std::string(text.purpose) + "\n\nOptions:\n" + options_of(name) + "\nExamples:\n" +
         indented(text.examples) + "\n" + std::string(kExitCodes) + environment();
}

} // namespace simdbezier::tools
