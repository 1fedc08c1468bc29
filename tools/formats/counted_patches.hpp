// Files that begin with the number of their patches: .bez and .bpt.
#pragma once

#include <cstddef>
#include <string>

#include <tools/formats/input/lexer.hpp>
#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Reads the count, the patches' coordinates and the end of the file. Counts of real files are
/// often wrong, so every message about too few or too many patches says what was declared, and
/// where.
class CountedPatches {
public:
  /// `each` goes into messages, between "N patches" and "as declared".
  CountedPatches(TextInput& input, std::string each);

  /// Whether another patch is due.
  [[nodiscard]] bool more() const noexcept { return file_.count < count_; }
  /// Reads the next word as a degree.
  [[nodiscard]] int degree(const std::string& where);
  /// Reads the coordinates of the next patch.
  void patch(int degree_u, int degree_v);
  /// Reads what follows the last patch. It is called after that.
  [[nodiscard]] PatchFile finish();

private:
  void expect_more();
  [[nodiscard]] std::string declared() const;

  Lexer lexer_;
  std::string each_;
  std::size_t count_ = 0;
  std::size_t count_line_ = 0;
  std::size_t coordinates_ = 0; // of the patch that is due, those that have been read
  PatchFile file_;
};

} // namespace simdbezier::tools
