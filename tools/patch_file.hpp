// Control points from files, as they stand there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/text_input.hpp>

namespace simdbezier::tools {

/// Consecutive patches of a file with equal degrees and kind of weights.
struct PatchRun {
  int degree_u = 3;
  int degree_v = 3;
  Weights weights = Weights::none;
  std::size_t count = 0;
  std::size_t first_patch = 0; ///< its number in the file
  std::size_t first_point = 0; ///< index into PatchFile::lines
  std::size_t first_value = 0; ///< index into PatchFile::points

  [[nodiscard]] bool rational() const noexcept { return weights != Weights::none; }
  /// x y z, and w.
  [[nodiscard]] std::size_t values_per_point() const noexcept { return rational() ? 4 : 3; }
  [[nodiscard]] std::size_t points_per_patch() const noexcept {
    return static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
  }
};

/// Patches of any degrees, polynomial and rational, in the order of the file; points of a patch
/// with u fastest. Weights stay in the form in which the format has them.
struct PatchFile {
  std::string name;                 ///< for messages
  std::size_t count = 0;            ///< patches
  std::vector<PatchRun> runs;       ///< cover all patches, none is empty
  std::vector<double> points;       ///< x y z or x y z w of every point; finite, weights above 0
  std::vector<std::uint32_t> lines; ///< of every point's first coordinate; empty: not from a file

  /// Readers append a point's values, say where it stands, and close the patch after its last one.
  void add_line(std::size_t line);
  void close_patch(int degree_u, int degree_v, Weights weights);

  [[nodiscard]] const PatchRun& run_of(std::size_t patch) const;
  /// The values of one point.
  [[nodiscard]] std::span<const double> point(std::size_t patch, std::size_t point) const;
  /// "FILE:LINE" of a point, or the bare name.
  [[nodiscard]] std::string place(std::size_t patch, std::size_t point) const;

  /// One entry a run, for pack() and its like, over `values` that correspond to `points`.
  template <typename S>
  [[nodiscard]] std::vector<ControlNets<S>> nets(std::span<const S> values) const;
  [[nodiscard]] std::vector<ControlNets<double>> nets() const {
    return nets(std::span<const double>(points));
  }
};

enum class PatchFormat : std::uint8_t { by_name, bez, bpt, bv, itd, obj, rib };

/// "bez, bpt, … or rib", every name behind `prefix`.
[[nodiscard]] std::string patch_format_names(const std::string& prefix);
/// The format of that name. Throws Failure (bad usage) that begins with `option` for others.
[[nodiscard]] PatchFormat parse_patch_format(const std::string& option, const std::string& name);

/// Reads "builtin:teapot", a file, or standard input ("-", which needs a format).
/// Throws Failure: exit code 2 where the name or format is not one of ours, otherwise 1.
[[nodiscard]] PatchFile read_patches(const std::string& in, PatchFormat format);

/// Berkeley .bez: a count, then 48 coordinates a patch.
[[nodiscard]] PatchFile read_bez(TextInput& input);
/// Holmes3D .bpt: a count, then per patch two degrees and its coordinates.
[[nodiscard]] PatchFile read_bpt(TextInput& input);
/// BezierView .bv: kinds 4 and 5, and 8 with homogeneous weights.
[[nodiscard]] PatchFile read_bv(TextInput& input);
/// IRIT .itd: SURFACE BEZIER of point types E3, and P3 with homogeneous weights.
[[nodiscard]] PatchFile read_itd(TextInput& input);
/// Wavefront .obj: surfaces of cstype bezier, and rat bezier with Cartesian weights.
[[nodiscard]] PatchFile read_obj(TextInput& input);
/// RenderMan .rib: Patch and PatchMesh with "P", or "Pw" with homogeneous weights.
[[nodiscard]] PatchFile read_rib(TextInput& input);

/// Packs for evaluation in T. For float the control points are rounded to float first.
/// Throws Failure naming the place of a control point that T cannot hold.
template <typename T>
[[nodiscard]] PatchSet<T> pack_patches(const PatchFile& file);

} // namespace simdbezier::tools
