// Keys of corners and edges; see mesh_layout.hpp.
#include <simdbezier/mesh_layout.hpp>

#include <new>

#include "src/nets/edge_keys.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

std::uint64_t mixed_key(std::uint64_t key) noexcept {
  key = (key ^ key >> 31) * 0x7fb5d329728ea185ULL;
  key = (key ^ key >> 27) * 0x81dadef4bc2dd44dULL;
  return key ^ key >> 33;
}

/// The corner's place in space; -0 is 0.
template <typename S>
std::uint64_t corner_key(const ControlNets<S>& nets, const S* net, std::size_t corner) noexcept {
  const S* const point = net + (corner % 2 != 0 ? nets.degree_u * nets.point_stride : 0) +
                         (corner >= 2 ? nets.degree_v * nets.row_stride : 0);
  const S divisor =
      nets.weights == Weights::homogeneous ? point[nets.components * nets.component_stride] : S(1);
  std::uint64_t key = 0;
  for (std::ptrdiff_t c = 0; c < nets.components; ++c) {
    key = mixed_key(key + 0x9e3779b97f4a7c15ULL +
                    compared_bits(point[c * nets.component_stride] / divisor));
  }
  return key;
}

template <typename Keys, typename S>
void find_keys(const NetViews<S>& views, const ControlNets<S>& nets, std::size_t view, Keys edges,
               std::size_t first, std::span<PatchKeys> keys) noexcept {
  for (PatchKeys& to : keys) {
    const S* const net = views.net(view, first++);
    edges.read(net);
    to.points = 0;
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      const auto edge = static_cast<PatchEdge>(k);
      const EdgeForm form(nets, edge);
      to.corners[k] = corner_key(nets, net, k);
      to.edges[k] = edges.hash(k);
      const bool may_be_point = nets.weights != Weights::none || edges.may_be_closed(k);
      to.points |= static_cast<std::uint8_t>(
          may_be_point && EdgeValues<S>(form, net).collapsed() ? 1U << k : 0U);
    }
  }
}

} // namespace
} // namespace detail

template <typename S>
Status find_patch_keys(std::span<const ControlNets<S>> nets, std::span<PatchKeys> keys,
                       const RunOptions& options) noexcept try {
  if (const Status status = detail::check_views(nets); !status) {
    return status;
  }
  if (keys.size() < detail::patches_of(nets)) {
    return Status::output_too_small;
  }
  const detail::DefaultFpEnvironment environment;
  const detail::NetViews<S> views(nets);
  auto body = [&](int, std::size_t begin, std::size_t end) {
    views.for_views(begin, end, [&](const auto& view, auto number, auto first, auto last) {
      const auto own = keys.subspan(first, last - first);
      detail::with_keys(view, [&](const auto& edges) {
        detail::find_keys(views, view, number, edges, first, own);
      });
    });
  };
  detail::divide_work(views.patches(), 60, options.threads, body);
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(find_patch_keys);

} // namespace simdbezier
