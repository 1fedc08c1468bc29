// Control points from files: .bez, .bpt and the built-in teapot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/text_input.hpp>

namespace simdbezier::tools {

/// Bicubic patches as they stand in a file: 16 points x y z each, u fastest.
struct PatchFile {
  static constexpr std::size_t kPoints = 16;
  static constexpr std::size_t kCoordinates = 48;

  std::string name; ///< for messages
  int degree_u = 3;
  int degree_v = 3;
  std::size_t count = 0;
  std::vector<double> points;       ///< count * 48 finite values
  std::vector<std::uint32_t> lines; ///< of every point's first coordinate; empty: not from a file

  [[nodiscard]] ControlNets<double> nets() const noexcept { return {points.data(), count}; }
  /// "FILE:LINE" of a point, or the bare name.
  [[nodiscard]] std::string place(std::size_t patch, std::size_t point) const;
};

enum class PatchFormat : std::uint8_t { by_name, bez, bpt };

/// Reads "builtin:teapot", a file, or standard input ("-", which needs a format).
/// Throws Failure: exit code 2 where the name or format is not one of ours, otherwise 1.
[[nodiscard]] PatchFile read_patches(const std::string& in, PatchFormat format);

/// Berkeley .bez: a count, then 48 coordinates a patch.
[[nodiscard]] PatchFile read_bez(TextInput& input);
/// Holmes3D .bpt: a count, then per patch two degrees and 48 coordinates.
[[nodiscard]] PatchFile read_bpt(TextInput& input);

/// Packs for evaluation in T. For float the control points are rounded to float first.
/// Throws Failure naming the place of a control point that T cannot hold.
template <typename T>
[[nodiscard]] PatchSet<T> pack_patches(const PatchFile& file);

namespace detail {
/// Reads one patch's coordinates and the end of the file, for both formats.
class PatchReader {
public:
  explicit PatchReader(TextInput& input);
  [[nodiscard]] Tokenizer& tokens() noexcept { return tokens_; }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  void coordinates();
  /// Reports that the file ended inside or before the patch that is due.
  [[noreturn]] void ended_early() const;
  [[nodiscard]] PatchFile finish();

private:
  [[nodiscard]] std::string declared() const;
  Tokenizer tokens_;
  std::size_t count_;
  std::size_t count_line_;
  PatchFile file_;
};
} // namespace detail

} // namespace simdbezier::tools
