// What tessellate tells about its work.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tools {

/// Seconds that the stages of a run took.
struct StageSeconds {
  double read = 0;
  double pack = 0;
  double rates = 0;
  double topology = 0;
  double evaluate = 0;
  double write = 0;
};

struct MeshStats {
  std::size_t patches = 0;
  std::size_t ignored_trims = 0;  ///< surfaces that were read as a whole, of which a part counts
  std::size_t merged_splines = 0; ///< those of which --knot-tolerance made different knots one
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0; ///< quads count as two
  double deviation = 0;        ///< certified, as the file states it
  bool was_there = false;      ///< of a part that was made before: nothing that follows is known
  double diagonal = 0;         ///< the diagonal of the box of all control points
  std::optional<std::array<double, 3>> origin; ///< where positions count from, if that is not 0
  std::size_t open_edges = 0;                  ///< edges of patches that no other patch has
  std::size_t non_manifold_edges = 0;
  /// Of one mesh without gaps: what its topology found; repeated patches also where they are left
  /// out.
  std::optional<TopologyCounts> joined;
  std::optional<SplitCounts> splits; ///< what came of splitting edges, where that was asked for
  std::uint64_t samples = 0;         ///< how many were evaluated for vertices
  StageSeconds seconds;
};

/// Adds the time that it lives to a stage's.
class Stopwatch {
public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

[[nodiscard]] std::string stats_as_text(const MeshStats& stats);
/// Writes one object, with the names of MeshStats.
[[nodiscard]] std::string stats_as_json(const MeshStats& stats);

} // namespace simdbezier::tools
