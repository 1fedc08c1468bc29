// Samples as kernels put them together for the vertices of meshes.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

/// The values of a sample: position and normal, each with a fourth one behind it that may be
/// anything. A GridTask asks for such records only where closed grids of at least a register of
/// patches have them (kernels/fast/small_jets_across.hpp), of both outputs.
inline constexpr std::size_t kSampleRecord = 8;

/// A whole vertex: x y z, the normal, u v. Kernels that put records together write them
/// (kernels/fast/record_rows.hpp), but not past the caches.
inline constexpr std::size_t kVertexRecord = 8;

} // namespace simdbezier::detail
