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

/// One of several parts of a mesh, from 0.
struct Shard {
  std::size_t number = 0;
  std::size_t all = 1;
};

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
  std::optional<Shard> shard; ///< for tessellate
  std::size_t shards = 0;     ///< for plan and join
  /// For simdbezier-mpi: how many patches a process works on at a time.
  std::optional<std::size_t> shard_patches;
  bool remove_parts = false;                  ///< for join
  bool sort = false;                          ///< for convert
  PatchFormat written = PatchFormat::by_name; ///< for convert
  /// The options that decide the mesh beside the model, as a shell takes them, each behind a space.
  std::string words;
};

/// Throws Failure where an option, or the kind of output, needs all patches at once.
void expect_local_options(const Arguments& arguments);

/// Returns the word as a shell takes it for the same.
[[nodiscard]] std::string for_shell(const std::string& word);

/// Returns the names of the files that will be read; "-" is standard input.
[[nodiscard]] std::vector<std::string> inputs_of(const Arguments& arguments);

/// Reads the patches, and says on standard error what else than the file's own shape they are.
[[nodiscard]] PatchFile read_input(const Arguments& arguments);

/// Returns nothing where help or the version was asked for, which has then been printed.
/// Throws Failure with exit code 2 on bad usage. of_ranks: whether they are simdbezier-mpi's.
[[nodiscard]] std::optional<Arguments> parse_arguments(int argc, const char* const* argv,
                                                       bool of_ranks = false);

} // namespace simdbezier::tools
