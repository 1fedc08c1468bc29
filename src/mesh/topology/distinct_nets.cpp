// find_distinct_nets(), see topology.hpp.
#include <simdbezier/topology.hpp>

#include <new>
#include <utility>

#include "src/nets/net_call.hpp"

namespace simdbezier {

template <typename S>
Status find_distinct_nets(std::span<const ControlNets<S>> nets, const Topology& topology,
                          DistinctNets<S>& distinct) noexcept try {
  if (detail::is_missing(nets)) {
    return Status::null_input;
  }
  if (detail::patches_of(nets) != topology.counts().patches) {
    return Status::unequal_lengths;
  }
  DistinctNets<S> found;
  std::uint32_t number = 0;
  for (const ControlNets<S>& view : nets) {
    bool open = false;
    for (std::size_t patch = 0; patch < view.count; ++patch, ++number) {
      if (topology.is_repeated(number)) {
        open = false;
        continue;
      }
      if (!open) {
        ControlNets<S>& part = found.nets.emplace_back(view);
        part.points += static_cast<std::ptrdiff_t>(patch) * view.patch_stride;
        part.count = 0;
        open = true;
      }
      ++found.nets.back().count;
      found.patches.push_back(number);
    }
  }
  distinct = std::move(found);
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template SIMDBEZIER_API Status find_distinct_nets(std::span<const ControlNets<float>>,
                                                  const Topology&, DistinctNets<float>&) noexcept;
template SIMDBEZIER_API Status find_distinct_nets(std::span<const ControlNets<double>>,
                                                  const Topology&, DistinctNets<double>&) noexcept;

} // namespace simdbezier
