// IGES files in their fixed ASCII form: lines of 80 columns, which belong to the sections start
// (S), global (G), directory (D), parameters (P) and terminate (T) by column 73. Source: Initial
// Graphics Exchange Specification, version 5.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tools/formats/input/text_input.hpp>

namespace simdbezier::tools {

/// What an entity's two lines of the directory say.
struct IgesEntity {
  std::uint32_t type = 0;
  std::int32_t form = 0;
  std::uint32_t first_line = 0; ///< of its parameters, which begin with 1
  std::uint32_t lines = 0;
  std::uint32_t matrix = 0; ///< the directory's number of a transformation, 0: there is none
  std::uint32_t status = 0; ///< eight digits, of which each pair is one thing

  [[nodiscard]] bool blanked() const noexcept { return status / 1000000 == 1; }
  /// Returns whether it is there only as a part of another entity.
  [[nodiscard]] bool dependent() const noexcept { return status / 10000 % 2 == 1; }
};

struct IgesRecords {
  static constexpr std::size_t kColumns = 64; ///< that a line of parameters has

  std::string name; ///< for messages
  char separator = ',';
  char terminator = ';';
  std::vector<IgesEntity> entities;
  std::string parameters; ///< kColumns characters of every line of parameters
  std::size_t directory_line = 0;
  std::size_t parameter_line = 0; ///< the lines of the file where these two sections begin
  std::size_t lines_read = 0;     ///< of parameters; more than once where several entities name one

  /// Returns the line where the directory has the entity.
  [[nodiscard]] std::size_t line_of(std::size_t entity) const noexcept {
    return directory_line + 2 * entity;
  }
  /// Throws "FILE:LINE: expected …, found …" with that line.
  [[noreturn]] void fail(std::size_t entity, const std::string& expected,
                         const std::string& found) const;
};

/// Reads all sections. Throws Failure where they are not as they should be.
[[nodiscard]] IgesRecords read_iges_records(TextInput& input);

} // namespace simdbezier::tools
