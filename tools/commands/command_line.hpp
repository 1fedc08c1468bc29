// The words of the command line: which option has which, and what --help says about them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace simdbezier::tools {

enum class Command : std::uint8_t { tessellate, evaluate, info, convert, plan, join };

/// An argument of some of the commands. What is parsed, what messages expect and what help lists
/// are the same entries.
struct OptionEntry {
  std::string name;     ///< as it is typed; IN for the input, which is typed without its name
  std::string value;    ///< what help calls its value; empty where it has none
  std::string expected; ///< what the value has to be, for messages and for help
  std::string help;     ///< what it is for
  std::string commands; ///< " tessellate evaluate info "
  std::string alias = {};
  bool needs_value = true; ///< false where the value may be left out, and follows a = otherwise

  [[nodiscard]] bool is_of(std::string_view command) const;
};

[[nodiscard]] const std::vector<OptionEntry>& option_entries();
/// Returns null where the command has no such option.
[[nodiscard]] const OptionEntry* find_option(std::string_view name, std::string_view command);
[[nodiscard]] std::string_view command_name(Command command);

/// What was typed behind a command.
struct Words {
  Command command = Command::info;
  std::map<std::string, std::string, std::less<>> values; ///< by the options' names
  bool of_ranks = false; ///< for many processes, see parse_arguments()

  [[nodiscard]] std::optional<std::string> value(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return values.contains(name); }
};

/// Returns nothing where help or the version was asked for, which has then been printed.
/// Throws Failure with exit code 2 where words are missing or left over.
[[nodiscard]] std::optional<Words> split_command_line(int argc, const char* const* argv);

/// What --help prints for a command, or for the program where there is none.
[[nodiscard]] std::string help_text(std::optional<Command> command);

inline constexpr int kMostThreads = 1024;

} // namespace simdbezier::tools
