// What the command line asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tools/commands/command_line.hpp>
#include <tools/commands/mesh_arguments.hpp>
#include <tools/formats/csv.hpp>
#include <tools/formats/patch_file.hpp>
#include <tools/patches/grid_blocks.hpp>

namespace simdbezier::tools {

enum class Precision : std::uint8_t { f32, f64 };

struct Arguments {
  Command command = Command::info;
  std::string in;
  PatchFormat format = PatchFormat::by_name;
  ReadOptions reading;
  std::string out;
  GridSize grid;
  std::optional<std::string> samples; ///< for evaluate: a file instead of the grid
  Precision precision = Precision::f32;
  std::vector<Output> outputs; ///< for evaluate: in the order of the columns, each once
  int threads = 0;             ///< 0 means all
  MeshArguments mesh;          ///< for tessellate
  bool json = false;
};

/// Returns the names of the files that will be read; "-" is standard input.
[[nodiscard]] std::vector<std::string> inputs_of(const Arguments& arguments);

/// Reads the patches, and says on standard error what else than the file's own shape they are.
[[nodiscard]] PatchFile read_input(const Arguments& arguments);

/// Returns nothing where help or the version was asked for, which has then been printed.
/// Throws Failure with exit code 2 on bad usage.
[[nodiscard]] std::optional<Arguments> parse_arguments(int argc, const char* const* argv);

} // namespace simdbezier::tools
