// tessellate(nets, options): from control nets to a closed mesh in std::vectors.
//
//     const auto mesh = tessellate<float>(nets, {.rates = {.tolerance = 1e-3}});
//     if (mesh) { use(mesh.positions, mesh.triangles, mesh.deviation); }
//
// plan_mesh() stops before vertices are computed: its layout goes to the calls of evaluate_mesh.hpp
// and mesh_layout.hpp, piece by piece if a mesh is larger than memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/evaluate_mesh.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/topology.hpp>

namespace simdbezier {

/// What a mesh shall be like. The members up to nv say how fine it is. At least one of them is
/// needed. If several are given, the mesh satisfies all of them. A grid (nu, nv) must be given
/// alone (else bad_grid).
struct MeshOptions {
  RateOptions rates = {}; ///< a tolerance, a longest edge, an angle; `keep` is ignored
  /// The tolerance as a share of the diagonal of the box of all control points.
  double relative_tolerance = kUnlimited;
  /// The most pixels that the mesh may be off in a picture; needs a camera.
  double pixels = kUnlimited;
  Camera camera = {};
  /// Every patch gets nu x nv samples, from 2 to kMostSegments + 1 each (else bad_grid, bad_rates).
  std::uint32_t nu = 0;
  std::uint32_t nv = 0;

  TopologyOptions topology = {}; ///< which edges are one, and which way patches face
  /// Cuts patches at corners of others that lie on their open sides, as split_edges() does with
  /// topology.snap. Edges are then joined within SplitNets::snap, if that is larger.
  bool split_edges = false;
  /// Leaves out patches that repeat an earlier one (Topology::is_repeated()).
  bool drop_repeated = false;
  /// Edges of this angle or more stay sharp, see split_creases(). 0: patches share no vertices.
  double crease_degrees = kUnlimited;

  bool normals = true;
  /// u, v and the patch's number for every vertex. Patches then share positions and normals, but no
  /// vertices: see split_parameters().
  bool parameters = false;
  bool short_indices = false; ///< 16-bit ones, if vertices are few enough
  bool local_origin = false;  ///< see PackOptions
  int threads = 0;            ///< as in RunOptions, to which this converts
  Isa isa = Isa::automatic;   ///< whose roundings are certified, and whose kernels run

  constexpr operator RunOptions() const noexcept { return {threads, isa}; } // NOLINT: it is one
};

/// What keeps a patch from its tolerance if a plan's report is bad_tolerance or snap_too_large.
enum class RateLimit : std::uint8_t {
  none,   ///< no single patch is at fault
  errors, ///< its vertices' own errors, which leave nothing of the tolerance or have no bound
  angle,  ///< RateOptions::normal_degrees, which needs too many cells; the tolerance could be kept
  snap,   ///< moved edges, which leave too little of the tolerance
  cells,  ///< the tolerance, which needs more than RateOptions::most_segments cells a direction
  length  ///< RateOptions::longest_edge, which needs too many cells; the tolerance could be kept
};

/// A limit, and the numbers of the patch that Report::item names.
struct RateFault {
  RateLimit limit = RateLimit::none;
  double tolerance = kUnlimited; ///< the smallest of those asked of it
  double error = 0;              ///< how far its vertices may be off
};

/// Wall time of the stages of a plan; plan_again() adds its own to them. 0 in WebAssembly, which
/// has no clock of its own.
struct PlanSeconds {
  double topology = 0; ///< edges, and the layout
  double pack = 0;     ///< and errors of positions
  double rates = 0;
};

/// A mesh that is laid out but not evaluated yet.
template <typename T>
struct MeshPlan {
  Report report;   ///< names the patch at fault by its number among those given
  RateFault fault; ///< why rates were refused
  PatchSet<T> set;
  /// Counts all patches given, or their pieces, including repeated ones that were left out.
  TopologyCounts counts;
  SplitCounts splits; ///< what came of MeshOptions::split_edges
  Topology topology;  ///< how the patches of the set are connected
  MeshLayout layout;
  /// The number of each patch of the set among those given. Empty: the same numbers.
  std::vector<std::uint32_t> patches;
  /// Which part of a patch given each patch of the set is; empty if MeshOptions::split_edges is not
  /// set, or nothing was cut.
  std::vector<PatchPiece> pieces;
  std::vector<std::uint32_t> cells_u; ///< of each patch of the set
  std::vector<std::uint32_t> cells_v;
  std::vector<double> errors;     ///< how far vertices of each patch of the set may be off
  std::vector<double> deviations; ///< certified, of each patch of the set, errors included
  double deviation = 0;           ///< the largest of them
  double diagonal = 0;            ///< of the box of all control points
  PlanSeconds seconds;

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(report); }
};

/// Vertices and triangles; all vectors are empty on an error.
template <typename T>
struct Mesh {
  Report report; ///< as in MeshPlan
  std::vector<std::array<T, 3>> positions;
  std::vector<std::array<T, 3>> normals;
  std::vector<std::array<T, 2>> parameters;
  std::vector<std::uint32_t> patches; ///< each vertex's patch, by its number among those given
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Instead of `triangles`, if MeshOptions::short_indices asks for them and the numbers fit.
  std::vector<std::array<std::uint16_t, 3>> short_triangles;
  /// The certified largest distance between mesh and surface, rounding included.
  double deviation = 0;
  /// The certified distance for each of the patches given; 0 for those left out.
  std::vector<double> deviations;
  TopologyCounts counts;
  SplitCounts splits;

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(report); }
};

/// Packs patches, joins edges, chooses rates, and numbers vertices; evaluates nothing.
/// nets:    any views with three components, see find_topology(). They are read only here.
/// Returns: in MeshPlan::report, what the calls of these steps return; bad_tolerance also if
///          nothing says how fine the mesh is to be; bad_grid if a grid has fewer than 2 samples or
///          tolerances are given as well; out_of_memory.
/// Memory:  what the plan holds, and working memory for edges and rates. A mesh is planned whole;
///          vertices and triangles can then be had range by range.
/// Threads: MeshOptions::threads. Cost: find_topology() and choose_rates(), see there.
template <typename T, typename S>
[[nodiscard]] MeshPlan<T> plan_mesh(std::span<const ControlNets<S>> nets,
                                    const MeshOptions& options) noexcept;

/// Chooses rates and lays out again, for a model whose set and topology a plan contains already.
/// The tolerance, grid, crease or view may be another one. This suits a camera, or a slider that
/// changes how fine a mesh is.
/// nets:    those that the plan was made of, unchanged.
/// plan:    its set, topology, errors and diagonal are read, so that a caller may fill them in as
///          well. MeshPlan::patches has to be empty: no patches may have been left out or cut.
/// options: topology, RateOptions::errors, drop_repeated, split_edges and local_origin are ignored,
///          because the plan was made with values of its own.
/// Returns: as choose_rates(), lay_out_mesh(), split_creases() and split_parameters(); bad_grid and
///          bad_tolerance as plan_mesh(); null_input without a list of nets; bad_topology for
///          another number of patches or other nets, or if MeshPlan::patches is not empty;
///          bad_rates if errors are not one value a patch. On an error the plan keeps what is read,
///          with the report and the fault.
/// Memory, threads and cost: those of choose_rates() and lay_out_mesh().
template <typename T, typename S>
SIMDBEZIER_API Report plan_again(std::span<const ControlNets<S>> nets, const MeshOptions& options,
                                 MeshPlan<T>& plan) noexcept;

/// Plans and evaluates a mesh. Neither threads nor the instruction set within a class change a bit.
/// Returns: in Mesh::report, as plan_mesh(); size_overflow also if vertices exceed 2^32 - 1.
/// Memory:  allocates the plan, which is freed at the end, and the mesh.
/// Threads: MeshOptions::threads. Cost: plan_mesh(), evaluate_mesh() and write_triangles().
template <typename T, typename S>
[[nodiscard]] Mesh<T> tessellate(std::span<const ControlNets<S>> nets,
                                 const MeshOptions& options) noexcept;

template <typename T, typename S>
[[nodiscard]] MeshPlan<T> plan_mesh(const ControlNets<S>& nets,
                                    const MeshOptions& options) noexcept {
  return plan_mesh<T>(std::span<const ControlNets<S>>(&nets, 1), options);
}
template <typename T, typename S>
[[nodiscard]] Mesh<T> tessellate(const ControlNets<S>& nets, const MeshOptions& options) noexcept {
  return tessellate<T>(std::span<const ControlNets<S>>(&nets, 1), options);
}

template <typename T, typename S>
Report plan_again(const ControlNets<S>& nets, const MeshOptions& options,
                  MeshPlan<T>& plan) noexcept {
  return plan_again<T>(std::span<const ControlNets<S>>(&nets, 1), options, plan);
}

/// The same if no type is named: the mesh has the number type of the nets. The integer has no
/// meaning; it excludes these overloads if a type is named.
template <int = 0, typename S>
[[nodiscard]] MeshPlan<S> plan_mesh(std::span<const ControlNets<S>> nets,
                                    const MeshOptions& options) noexcept {
  return plan_mesh<S>(nets, options);
}
template <int = 0, typename S>
[[nodiscard]] MeshPlan<S> plan_mesh(const ControlNets<S>& nets,
                                    const MeshOptions& options) noexcept {
  return plan_mesh<S>(nets, options);
}
template <int = 0, typename S>
[[nodiscard]] Mesh<S> tessellate(std::span<const ControlNets<S>> nets,
                                 const MeshOptions& options) noexcept {
  return tessellate<S>(nets, options);
}
template <int = 0, typename S>
[[nodiscard]] Mesh<S> tessellate(const ControlNets<S>& nets, const MeshOptions& options) noexcept {
  return tessellate<S>(nets, options);
}

} // namespace simdbezier
