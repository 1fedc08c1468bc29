// CLI11 takes the words apart. The messages about what is wrong with them are made here, all in one
// way: the argument, what was expected, what was found.
#include <tools/commands/command_line.hpp>

#include <algorithm>
#include <array>
#include <memory>

#include <CLI/CLI.hpp>

#include <tools/formats/input/text_input.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::array<std::string_view, 6> kCommands = {"tessellate", "evaluate", "info",
                                                       "convert",    "plan",     "join"};

struct Parser {
  CLI::App app{"", "simdbezier"};
  std::map<std::string, std::string, std::less<>> values; // CLI11 writes them here
  std::array<CLI::App*, kCommands.size()> commands{};
};

void add_options(CLI::App& app, std::string_view command, Parser& parser) {
  app.set_help_flag();
  app.allow_extras();
  for (const OptionEntry& entry : option_entries()) {
    if (!entry.is_of(command)) {
      continue;
    }
    if (entry.value.empty()) {
      app.add_flag((entry.alias.empty() ? "" : entry.alias + ",") + entry.name)
          ->disable_flag_override();
    } else if (!entry.needs_value) {
      app.add_flag(entry.name + "{}", parser.values[entry.name]);
    } else {
      app.add_option(entry.name, parser.values[entry.name])->take_last();
    }
  }
}

std::unique_ptr<Parser> make_parser() {
  auto parser = std::make_unique<Parser>();
  add_options(parser->app, "simdbezier", *parser);
  parser->app.require_subcommand(0, 1);
  for (std::size_t k = 0; k < kCommands.size(); ++k) {
    parser->commands[k] = parser->app.add_subcommand(std::string(kCommands[k]));
    add_options(*parser->commands[k], kCommands[k], *parser);
  }
  return parser;
}

[[noreturn]] void refuse_missing(const OptionEntry& entry, const std::string& found) {
  bad_usage(entry.name + ": expected " + entry.expected + ", found " + found);
}

// Calls visit(option, what follows its =, whether it is the last word) for all words that look like
// options of their command.
template <typename Visit>
void for_options(int argc, const char* const* argv, Visit&& visit) {
  std::string_view command = "simdbezier";
  for (int k = 1; k < argc && argv[k] != std::string_view("--"); ++k) {
    const std::string word = argv[k];
    if (std::ranges::find(kCommands, word) != kCommands.end()) {
      command = command == "simdbezier" ? argv[k] : command;
      continue;
    }
    const std::size_t equals = word.find('=');
    const OptionEntry* const entry = find_option(word.substr(0, equals), command);
    if (entry != nullptr) {
      const bool has_value = equals != std::string::npos;
      visit(*entry, has_value ? std::optional(word.substr(equals + 1)) : std::nullopt,
            k == argc - 1);
    }
  }
}

// CLI11 takes "--option=" for the option without a value, and the next word for its value; of
// "-o=name", it takes "=name" for the value.
void refuse_lost_values(int argc, const char* const* argv) {
  for_options(argc, argv,
              [](const OptionEntry& entry, const std::optional<std::string>& value, bool) {
                if (value == "") {
                  bad_usage(entry.name + ": expected " +
                            (entry.value.empty() ? "no value" : entry.expected) + ", found ''");
                }
                if (value && entry.name.size() == 2 && entry.needs_value) {
                  bad_usage(entry.name + ": expected " + entry.expected + ", found " +
                            in_quotes("=" + *value));
                }
              });
}

// CLI11 objects in two cases only: an option that takes no value has one, or the last option lacks
// its value.
[[noreturn]] void refuse_values(int argc, const char* const* argv) {
  for_options(argc, argv,
              [](const OptionEntry& entry, const std::optional<std::string>& value, bool last) {
                if (entry.value.empty() && value) {
                  bad_usage(entry.name + ": expected no value, found " + in_quotes(*value));
                }
                if (entry.needs_value && !entry.value.empty() && last) {
                  refuse_missing(entry, "the end of the command line");
                }
              });
  bad_usage("expected what 'simdbezier --help' lists, found " + in_quotes(argv[argc - 1]));
}

bool is_name_of_option(const std::string& word, const std::string& command) {
  return word.size() > 1 && word[0] == '-' &&
         find_option(word.substr(0, word.find('=')), command) != nullptr;
}

void check_option(const OptionEntry& entry, const CLI::Option& option, const std::string& value,
                  const std::string& command) {
  if (option.count() > 1) {
    bad_usage(entry.name + ": expected once, found " + std::to_string(option.count()) + " times");
  }
  // Then the value of this option is missing, and not the one that CLI11 misses at the end.
  if (entry.needs_value && is_name_of_option(value, command)) {
    refuse_missing(entry, in_quotes(value));
  }
}

// The first word that is left over is the mistake, since it most likely stands for what is missing.
void check_rest(const CLI::App& app, const std::string& command,
                const std::optional<std::string>& in) {
  std::vector<std::string> rest = app.remaining(true);
  std::erase(rest, "--"); // what stands behind it is no option
  if (rest.empty()) {
    return;
  }
  const std::string& word = rest.front();
  if (word.starts_with('-') || !in) {
    bad_usage(command + ": expected what 'simdbezier " + command + " --help' lists, found " +
              in_quotes(word));
  }
  bad_usage(command + ": expected one IN, found " + in_quotes(word) + " behind " + in_quotes(*in));
}

Words collect(const Parser& parser, Command command) {
  const std::string name(command_name(command));
  const CLI::App& app = *parser.commands[static_cast<std::size_t>(command)];
  Words words{command, {}, false};
  for (const OptionEntry& entry : option_entries()) {
    const CLI::Option* const option = entry.is_of(name) ? app.get_option(entry.name) : nullptr;
    if (option == nullptr || option->count() == 0) {
      continue;
    }
    const auto value = parser.values.find(entry.name);
    const std::string text = value == parser.values.end() ? "" : value->second;
    check_option(entry, *option, text, name);
    words.values[entry.name] = text;
  }
  check_rest(parser.app, name, words.value("IN"));
  for (const char* const required : {"IN", "-o", "--shards"}) {
    const OptionEntry* const entry = find_option(required, name);
    if (entry != nullptr && !words.has(required)) {
      refuse_missing(*entry, "nothing");
    }
  }
  return words;
}

std::nullopt_t print(const std::string& text) {
  OutputFile out("-");
  out.text(text);
  out.commit();
  return std::nullopt;
}

} // namespace

bool OptionEntry::is_of(std::string_view command) const {
  return commands.find(" " + std::string(command) + " ") != std::string::npos;
}

const OptionEntry* find_option(std::string_view name, std::string_view command) {
  const auto found = std::ranges::find_if(option_entries(), [&](const OptionEntry& entry) {
    return entry.is_of(command) && (entry.name == name || (!name.empty() && entry.alias == name));
  });
  return found == option_entries().end() ? nullptr : &*found;
}

std::string_view command_name(Command command) {
  return kCommands[static_cast<std::size_t>(command)];
}

std::optional<std::string> Words::value(std::string_view name) const {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Words> split_command_line(int argc, const char* const* argv) {
  refuse_lost_values(argc, argv);
  const std::unique_ptr<Parser> parser = make_parser();
  try {
    parser->app.parse(argc, argv);
  } catch (const CLI::ParseError&) {
    refuse_values(argc, argv);
  }
  if (parser->app.count("--help") > 0) {
    return print(help_text(std::nullopt));
  }
  if (parser->app.count("--version") > 0) {
    return print(program_version() + "\n");
  }
  for (std::size_t k = 0; k < kCommands.size(); ++k) {
    if (parser->commands[k]->parsed()) {
      const auto command = static_cast<Command>(k);
      return parser->commands[k]->count("--help") > 0 ? print(help_text(command))
                                                      : std::optional(collect(*parser, command));
    }
  }
  const std::vector<std::string> rest = parser->app.remaining(true);
  bad_usage("expected tessellate, evaluate, info, convert, plan, join or --help, found " +
            (rest.empty() ? "nothing" : in_quotes(rest.front())));
}

} // namespace simdbezier::tools
