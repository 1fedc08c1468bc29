// The contract between the base code and the kernels for meshes.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// The points between the ends of an edge that one or two bicubic patches have.
template <typename T>
struct EdgeJob {
  /// One of the sides that the edge consists of.
  struct Member {
    std::size_t patch;
    std::size_t side; ///< as in src/storage/bicubic_layout.hpp: v = 0, v = 1, u = 0, u = 1
    T direction;      ///< 1, or -1 where the side runs against the edge
    T sign;           ///< of its normals
  };

  const T* along; ///< half-centred, strictly between -1/2 and 1/2; kMaxLanes more are readable
  std::size_t points;
  std::size_t place; ///< where the first point goes; the next ones follow
  std::size_t members;
  Member member[2]; ///< the first one gives the positions
};

/// Edges of watertight sets. Positions or normals may be unwanted. Place k of a plane is
/// plane[k * step].
template <typename T>
struct EdgeTask : SampleTask<T> {
  const EdgeJob<T>* jobs;
  std::size_t count;
  std::size_t step;
  DrainQueue<T>* drain; ///< see GridTask
};

template <typename T>
struct MeshTable {
  void (*edges)(EdgeTask<T>& task);
};

/// A sum of unit normals has no direction where it is shorter than so much of what it could be: the
/// first one stays.
template <typename T>
inline constexpr T kLeastSum = T(1e-3);

} // namespace simdbezier::detail
