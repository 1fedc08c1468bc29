// See rates.hpp.
#include <simdbezier/rates.hpp>

#include <atomic>
#include <new>

#include "src/mesh/rates/group_bound.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Certifies all patches of one view.
template <typename S>
RateReport certify(const ControlNets<S>& nets, const CellCounts& cells, std::span<double> deviation,
                   Isa isa, int threads) noexcept {
  if (const Status status = check_in_space(nets); !status) {
    return {status};
  }
  if (const NetReport checked = find_fault(nets, threads); !checked) {
    return {checked.status, checked.patch};
  }
  std::atomic<bool> failed = false;
  std::atomic<std::size_t> unreadable = nets.count; // the first patch that is
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    try {
      GroupBound group(isa);
      for (std::size_t first = begin; first < end; first += group.lanes()) {
        const std::size_t last = std::min(end, first + group.lanes());
        group.begin();
        for (std::size_t patch = first; patch < last; ++patch) {
          if (!group.read(nets, patch, 0)) { // a quotient of values without faults is out of range
            lower(unreadable, patch);
          }
        }
        group.form();
        const auto bounds = group.rising_bounds(cells);
        for (std::size_t patch = first; patch < last; ++patch) {
          deviation[patch] += bounds[patch - first];
        }
      }
    } catch (const std::bad_alloc&) {
      failed = true;
    }
  };
  divide_work(nets.count, 5000, threads, body);
  if (failed) {
    return {Status::out_of_memory};
  }
  if (const std::size_t patch = unreadable; patch < nets.count) {
    return {Status::non_finite_input, patch};
  }
  return {};
}

} // namespace
} // namespace detail

template <typename S>
RateReport certify_grids(std::span<const ControlNets<S>> nets, std::uint32_t nu, std::uint32_t nv,
                         std::span<const double> errors, std::span<double> deviation,
                         const Options& options) noexcept {
  if (detail::is_missing(nets)) {
    return {Status::null_input};
  }
  const std::size_t patches = detail::patches_of(nets);
  const auto is_rate = [](std::uint32_t n) { return n >= 1 && n <= kMostGridCells; };
  if (!is_rate(nu) || !is_rate(nv) || deviation.size() != patches ||
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
    RateReport report =
        detail::certify(view, {nu, nv}, deviation.subspan(first, view.count), isa, options.threads);
    if (!report) {
      report.patch += first;
      return report;
    }
    first += view.count;
  }
  return {};
}

template SIMDBEZIER_API RateReport certify_grids(std::span<const ControlNets<float>>, std::uint32_t,
                                                 std::uint32_t, std::span<const double>,
                                                 std::span<double>, const Options&) noexcept;
template SIMDBEZIER_API RateReport certify_grids(std::span<const ControlNets<double>>,
                                                 std::uint32_t, std::uint32_t,
                                                 std::span<const double>, std::span<double>,
                                                 const Options&) noexcept;

} // namespace simdbezier
