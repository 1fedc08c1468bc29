#include <simdbezier/rates.hpp>

#include <new>
#include <numeric>

#include "src/mesh/rates/patch_groups.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Certifies all patches of one view.
template <typename S>
Report certify(const ControlNets<S>& nets, const CellCounts& cells, std::span<double> deviation,
               Isa isa, int threads) {
  if (const Status status = check_in_space(nets); !status) {
    return {status};
  }
  if (const Report checked = find_fault(nets, threads); !checked) {
    return {checked.status, checked.item};
  }
  const auto all_open = [](std::size_t) { return kAllOpen; };
  const auto visit = [&](const PatchGroup& group) {
    const auto bounds = group.bound().rising_bounds(cells);
    group.for_lanes([&](std::size_t lane, std::size_t patch) { deviation[patch] += bounds[lane]; });
  };
  std::vector<std::uint32_t> patches(nets.count);
  std::iota(patches.begin(), patches.end(), 0U);
  return visit_groups<S>(nets, patches, all_open, false, isa, threads, visit);
}

} // namespace
} // namespace detail

template <typename S>
Report certify_grids(std::span<const ControlNets<S>> nets, std::uint32_t cells_u,
                     std::uint32_t cells_v, std::span<const double> errors,
                     std::span<double> deviation, const RunOptions& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  std::size_t patches = 0;
  if (const Status status = detail::count_patches(nets, patches); !status) {
    return {status};
  }
  const auto is_rate = [](std::uint32_t n) { return n >= 1 && n <= kMostGridCells; };
  if (!is_rate(cells_u) || !is_rate(cells_v) || deviation.size() != patches ||
      !(errors.empty() || errors.size() == patches)) {
    return {Status::bad_rates};
  }
  for (std::size_t patch = 0; patch < patches; ++patch) {
    deviation[patch] = errors.empty() ? 0 : errors[patch];
    if (!(deviation[patch] >= 0)) {
      return {Status::bad_tolerance, patch};
    }
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(options.isa, isa); !runs) {
    return {runs};
  }
  std::size_t first = 0;
  for (const ControlNets<S>& view : nets) {
    Report report = detail::certify(view, {cells_u, cells_v}, deviation.subspan(first, view.count),
                                    isa, options.threads);
    if (!report) {
      report.item += first;
      return report;
    }
    first += view.count;
  }
  return {};
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

SIMDBEZIER_EXPORT_BOTH_TYPES(certify_grids);

} // namespace simdbezier
