// Patches cut at corners of neighbours that lie on their sides, so that one long edge against
// several short ones becomes several pairs of edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

/// How edges are split.
struct SplitOptions {
  /// How near a part of a long edge has to be to the short one, as TopologyOptions::snap measures
  /// it. Roundings are allowed in any case: 64 (n + 1) u of the largest coordinate of all control
  /// points, n being the largest degree and u = 2^-24 (float) or 2^-53 (double).
  double snap = 0;
  /// No cut leads beyond so many patches and pieces. 0: 8 times the patches given, at least 512.
  std::size_t most_pieces = 0;
  int threads = 0; ///< as in Options
};

/// Where a piece of a patch comes from.
struct PatchPiece {
  std::uint32_t patch = 0; ///< among those given
  double u0 = 0;           ///< the piece is the patch over [u0, u1] x [v0, v1]
  double u1 = 1;
  double v0 = 0;
  double v1 = 1;
  double error = 0; ///< how far cutting may have moved any of its points, by roundings

  /// The parameters of the patch at u or v of the piece.
  [[nodiscard]] constexpr double whole_u(double u) const noexcept { return between(u0, u1, u); }
  [[nodiscard]] constexpr double whole_v(double v) const noexcept { return between(v0, v1, v); }

private:
  static constexpr double between(double from, double to, double place) noexcept {
    return place == 1 ? to : from + (to - from) * place;
  }
};

/// What came of short edges along a part of a longer one.
struct SplitCounts {
  std::size_t splits = 0;   ///< those that patches were cut for
  std::size_t unjoined = 0; ///< those that stay open
  double largest_gap = 0;   ///< at least the largest distance of one of these from that part
};

/// Patches of which some are pieces of those given.
template <typename S>
struct SplitNets {
  std::vector<ControlNets<S>> nets; ///< in the memory of those given, and in `memory`
  std::vector<PatchPiece> pieces;   ///< of each patch of `nets`, in the order of the patches given
  std::vector<std::shared_ptr<const std::vector<S>>> memory;
  double snap = 0; ///< for TopologyOptions: joins what was split for
  SplitCounts counts;
};

/// Cuts patches at the corners that lie on their open sides, if the part of the side between two
/// corners is the side of another patch. A cut divides the opposite side as well, and so all
/// patches across it, up to an open side, a side that is a point, or the patch where it began. This
/// is repeated until nothing is found: pieces may be as long as several others. If nothing is cut,
/// SplitNets::nets are those given.
/// nets:    as for find_topology().
/// Gap:     short edges count as unjoined within a 32nd of their size of a part of another, or if a
///          cut would lead to more pieces than allowed.
/// Threads: SplitOptions::threads, for topologies. Allocation: as find_topology(), and the pieces.
///          Determinism: a function of the control points and options.
/// Cost:    a find_topology() each time, and microseconds for each open side in another one's box.
/// Returns: as find_topology(), and the statuses of segment() for patches that are to be cut.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status split_edges(std::span<const ControlNets<S>> nets,
                                                SplitNets<S>& split,
                                                const SplitOptions& options = {}) noexcept;

} // namespace simdbezier
