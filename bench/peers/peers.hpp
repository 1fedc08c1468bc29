// Other libraries on the library's own grids: each prepares its objects outside of the clock and
// returns the call that is timed, which fills job.out. Those that make meshes do likewise. Only
// those that were found are linked.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

/// Prepares a call on the control points nets[patch][j][i][xyz]. Outputs are the position, or the
/// position, du and dv.
template <typename T>
using PreparePeer = std::function<void()> (*)(const GridJob<T>& job, const T* nets);

std::function<void()> prepare_opensubdiv(const GridJob<float>& job, const float* nets); // triples
std::function<void()> prepare_opencascade(const GridJob<double>& job,
                                          const double* nets);                      // triples
std::function<void()> prepare_sisl(const GridJob<double>& job, const double* nets); // triples

/// A clamped bicubic NURBS surface, and where it is to be evaluated: at all pairs of some
/// parameters.
struct SplineJob {
  const double* net = nullptr; ///< [row][column][wx wy wz w], points x points of them
  std::size_t points = 0;
  const double* knots = nullptr; ///< points + 4, the same in both directions
  const double* at = nullptr;    ///< ascending
  std::size_t samples = 0;       ///< parameters
  Results<double> out;           ///< planes
};

/// Prepares the evaluation of a job.
std::function<void()> prepare_opencascade_spline(const SplineJob& job);
/// Prepares the conversion to Bézier surfaces.
std::function<void()> prepare_opencascade_patches(const SplineJob& job);

struct MeshCounts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// A tessellator of another library, for bicubic patches whose common edges it knows.
class PeerMesher {
public:
  virtual ~PeerMesher() = default;
  /// Makes all triangles anew, with at most this distance from the patches.
  virtual void run(double tolerance) = 0;
  /// Counts what the last run made, which takes its time.
  [[nodiscard]] virtual MeshCounts counts() const = 0;
};

/// Takes the control points nets[patch][j][i][xyz].
std::unique_ptr<PeerMesher> make_opencascade_mesher(std::span<const double> nets);

// Eigen is compiled once per instruction set, as the baselines are, and writes planes.
#define SIMDBEZIER_BENCH_DECLARE_EIGEN(isa)                                                        \
  namespace isa {                                                                                  \
  void eigen(const GridJob<float>& job);                                                           \
  void eigen(const GridJob<double>& job);                                                          \
  }

} // namespace simdbezier_bench
