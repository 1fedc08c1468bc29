// Control points from files, as they stand there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/input/large_pages.hpp>
#include <tools/formats/input/text_input.hpp>
#include <tools/formats/surfaces/file_spline.hpp>
#include <tools/formats/surfaces/segment_mesh.hpp>

namespace simdbezier::tools {

/// Consecutive patches of a file with equal degrees and kind of weights. Their points are those of
/// a mesh, row after row. Patches that share no points are a mesh of one column, whose rows are
/// those of all patches.
struct PatchRun {
  int degree_u = 3;
  int degree_v = 3;
  Weights weights = Weights::none;
  std::size_t count = 0;       ///< u.patches * v.patches
  std::size_t first_patch = 0; ///< its number in the file
  std::size_t first_point = 0; ///< index into PatchFile::lines
  std::size_t first_value = 0; ///< index into PatchFile::points
  /// Its first value, where that is in PatchFile::memory; at most one of these is not null.
  const float* floats = nullptr;
  const double* doubles = nullptr;
  MeshDirection u = {};
  MeshDirection v = {};
  /// The points of the mesh are those that PatchFile::vertices names from here on. Without a value,
  /// they stand one after the other.
  std::optional<std::size_t> first_vertex = std::nullopt;
  std::size_t stride = 3; ///< the step from point to point among the values

  [[nodiscard]] bool rational() const noexcept { return weights != Weights::none; }
  /// Returns 3 for x y z, 4 with w.
  [[nodiscard]] std::size_t values_per_point() const noexcept { return rational() ? 4 : 3; }
  [[nodiscard]] std::size_t points_per_patch() const noexcept {
    return static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
  }
  /// Returns whether all of its points are those of one patch.
  [[nodiscard]] bool is_patch() const noexcept;
  /// Returns whether it is patches below each other that share nothing.
  [[nodiscard]] bool is_column() const noexcept;
  /// Returns how many values the points of the mesh have.
  [[nodiscard]] std::size_t values() const noexcept { return u.points * v.points * stride; }
  /// Returns whether it is such patches and `patch` could be the next one.
  [[nodiscard]] bool is_column_like(const PatchRun& patch) const noexcept;
  /// Returns the number of the mesh's point that is (i, j) of a patch; the run's first one has 0.
  [[nodiscard]] std::size_t mesh_point(std::size_t patch, std::size_t i,
                                       std::size_t j) const noexcept {
    return v.point(patch / u.patches, j) * u.points + u.point(patch % u.patches, i);
  }
};

/// Patches side by side, as pack() and its like take them.
template <typename S>
struct PatchNets {
  /// The values that had to be copied, point after point, u fastest, patch after patch. Others are
  /// read where the file has them.
  LargeVector<S> values;
  std::vector<ControlNets<S>> nets;
  bool in_file = false; ///< whether some are read where the file has them
};

/// Patches of any degrees, polynomial and rational ones, in the order of the file. Points that a
/// file shares between patches are shared here as well, so memory depends on the file's size and
/// not on the number of patches. Weights stay in the form in which the format has them. Numbers of
/// text are in `points`; binary ones stay where and as they are.
struct PatchFile {
  static constexpr std::size_t kAll = static_cast<std::size_t>(-1);

  std::string name;           ///< for messages
  std::size_t count = 0;      ///< patches
  std::vector<PatchRun> runs; ///< cover all patches, none is empty
  LargeVector<double> points; ///< x y z or x y z w; finite, weights that count above 0
  LargeVector<std::uint32_t>
      lines; ///< of every point's first coordinate; empty where there is no file
  std::vector<std::shared_ptr<const std::byte[]>> memory; ///< of values as files store them
  std::vector<std::uint32_t> vertices; ///< where meshes name their points: numbers of points
  double moved_error = 0;              ///< how far points may be from where they were moved to
  bool has_origin = false;             ///< whether they count from --origin
  double knot_tolerance = 0;           ///< that of close_spline()
  double cut_error = 0; ///< how far those of splines may be from their surfaces besides
  std::vector<SplineRecord> splines; ///< those whose patches are among these
  std::size_t merged_splines = 0;    ///< those of which knot_tolerance made different knots one
  std::size_t ignored_trims = 0; ///< surfaces that are here as a whole, and of which a part counts

  /// Makes room for what an input of so many bytes usually has. Memory that turns out not to be
  /// needed is never touched.
  void expect(std::uint64_t bytes);
  /// Readers append a point's values, say where it stands …
  void add_line(std::size_t line);
  /// … and, where that is homogeneous, whether it can be divided by its weight, …
  void check_quotients() const;
  /// … and close a patch after its last point, …
  void close_patch(int degree_u, int degree_v, Weights weights);
  /// … or a mesh, of all the points that have been appended for it, …
  void close_mesh(int degree_u, int degree_v, Weights weights, const MeshDirection& u,
                  const MeshDirection& v);
  /// … or one of the u.points * v.points points that `vertices` ends with. Then all points have
  /// four values, of which the last one counts only if there are weights.
  void close_indexed_mesh(int degree_u, int degree_v, Weights weights, const MeshDirection& u,
                          const MeshDirection& v);
  /// Or they hand over stored patches of one shape. A value is a float or a double.
  template <typename S>
  void close_stored(PatchRun shape, std::size_t patches, const S* values);
  /// Or they hand over a spline surface, whose patches are added one by one. Its patches and points
  /// have the spline's line. Throws Failure where knots, ranges or numbers of points do not fit.
  void close_spline(const FileSpline& spline);

  [[nodiscard]] const PatchRun& run_of(std::size_t patch) const;
  /// Returns the values of one point.
  [[nodiscard]] std::vector<double> point(std::size_t patch, std::size_t point) const;
  /// Returns "FILE:LINE" of a point, or the bare name.
  [[nodiscard]] std::string place(std::size_t patch, std::size_t point) const;

  /// Calls visit() with the first value of a run, which is a float or a double.
  template <typename Visit>
  auto visit_values(const PatchRun& run, const Visit& visit) const {
    return run.floats != nullptr    ? visit(run.floats)
           : run.doubles != nullptr ? visit(run.doubles)
                                    : visit(points.data() + run.first_value);
  }
  /// Calls visit() with all values, as some spans of floats or doubles.
  template <typename Visit>
  void visit_all_values(const Visit& visit) const {
    visit(std::span<const double>(points));
    for (const PatchRun& run : runs) {
      if (run.floats != nullptr || run.doubles != nullptr) {
        visit_values(run, [&](const auto* values) { visit(std::span(values, run.values())); });
      }
    }
  }
  /// Makes stored values doubles in `points`, which can be changed.
  void take_values();

  /// Returns some of the patches, in S, to be used while the file is there. The library's results
  /// do not depend on which ones.
  template <typename S>
  [[nodiscard]] PatchNets<S> nets(std::size_t first = 0, std::size_t patches = kAll) const;
  /// The same for any of them, in any order.
  template <typename S>
  [[nodiscard]] PatchNets<S> nets(std::span<const std::uint32_t> patches) const;
  /// Returns a file of these patches alone, in this order, with all that is known of them.
  [[nodiscard]] PatchFile of(std::span<const std::uint32_t> patches) const;

private:
  struct RunPoint {
    const PatchRun& run;
    std::size_t index; // the point's; the run's first one has 0
  };
  void add(PatchRun run);
  [[nodiscard]] RunPoint find(std::size_t patch, std::size_t point) const;
  [[nodiscard]] std::size_t point_index(const PatchRun& run,
                                        std::size_t mesh_point) const noexcept {
    return run.first_vertex ? vertices[*run.first_vertex + mesh_point] : mesh_point;
  }
  template <typename S, typename Number>
  [[nodiscard]] PatchNets<S> gather(std::size_t patches, const Number& number) const;
  template <typename S>
  void append(const PatchRun& run, std::size_t patch, LargeVector<S>& values) const;
  /// Returns a patch's values where they stand as S already; null where they do not.
  template <typename S>
  [[nodiscard]] const S* in_place(const PatchRun& run, std::size_t patch) const;
};

/// The formats that can be read. Each row has a name, which is also the extension of files, and
/// says what the reader in read_NAME.cpp takes. Help and messages list these rows. Files of iges
/// may be called .igs as well.
// clang-format off
#define SIMDBEZIER_EACH_PATCH_FORMAT(X)                                                            \
  X(bez) /* Berkeley: a count, then 48 coordinates a patch */                                      \
  X(bpt) /* Holmes3D: a count, then per patch two degrees and its coordinates */                   \
  X(bv)  /* BezierView: kinds 4 and 5, and 8 with homogeneous weights */                           \
  X(iges) /* IGES 5.3: entities 128 and 114, untrimmed, with Cartesian weights */                  \
  X(itd) /* IRIT: SURFACE BEZIER of point types E3, and P3 with homogeneous weights */             \
  X(obj) /* Wavefront: surfaces of every cstype, and rat with Cartesian weights */                 \
  X(rib) /* RenderMan: Patch, PatchMesh and NuPatch, with "P" or homogeneous "Pw" */               \
  X(sbp) /* binary patches of any shapes, which tessellate can read piece by piece */
// clang-format on

#define SIMDBEZIER_DECLARE_PATCH_FORMAT(NAME) NAME,
enum class PatchFormat : std::uint8_t {
  by_name,
  SIMDBEZIER_EACH_PATCH_FORMAT(SIMDBEZIER_DECLARE_PATCH_FORMAT)
};
#undef SIMDBEZIER_DECLARE_PATCH_FORMAT

/// What may be asked of readers.
struct ReadOptions {
  bool ignore_trims = false; ///< read surfaces as a whole of which the file shows a part
  double knot_tolerance = 0; ///< knots that are no further apart count as equal
};

#define SIMDBEZIER_DECLARE_PATCH_READER(NAME)                                                      \
  [[nodiscard]] PatchFile read_##NAME(TextInput& input, const ReadOptions& options);
SIMDBEZIER_EACH_PATCH_FORMAT(SIMDBEZIER_DECLARE_PATCH_READER)
#undef SIMDBEZIER_DECLARE_PATCH_READER

/// Returns "bez, bpt, … or rib", every name behind `prefix`.
[[nodiscard]] std::string patch_format_names(const std::string& prefix);
/// Returns the format of that name. Throws Failure (bad usage) that begins with `option` for
/// others.
[[nodiscard]] PatchFormat parse_patch_format(const std::string& option, const std::string& name);

/// Reads "builtin:teapot", a file, or standard input ("-", which needs a format).
/// Throws Failure: exit code 2 where the name or format is not one of ours, otherwise 1.
[[nodiscard]] PatchFile read_patches(const std::string& in, PatchFormat format,
                                     const ReadOptions& options = {});
/// Reads the bytes of a file of that name, whose extension says the format.
[[nodiscard]] PatchFile read_patches(const std::string& name, std::span<const char> bytes,
                                     const ReadOptions& options = {});

} // namespace simdbezier::tools
