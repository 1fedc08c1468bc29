// The places of packed patches: buckets of one shape each, and the runs of patches that fill them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <simdbezier/patch_set.hpp>

#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

/// Consecutive patches of one ControlNets, which take consecutive places of one bucket.
struct PackRun {
  std::size_t entry; ///< of the caller's nets
  std::size_t bucket;
  std::size_t place;  ///< of the first patch in its bucket
  std::size_t number; ///< of the first patch in the set
  std::size_t count;
};

/// The first entry that no set can be packed from, as a report that names its first patch; ok
/// where there is none. Points are not looked at.
template <typename S>
Report check_packable(std::span<const ControlNets<S>> nets) noexcept;

/// Allocates a bucket for every shape and form of weights that occurs, in the order in which they
/// do, and says which patch goes where. used: null, or a set whose memory may be taken. Returns ok
/// | size_overflow | out_of_memory; may throw std::bad_alloc.
template <typename T, typename S>
Status lay_out(std::span<const ControlNets<S>> nets, const PackOptions& options,
               SetStorage<T>* used, SetStorage<T>& storage, std::vector<PackRun>& runs);

} // namespace simdbezier::detail
