// See rates.hpp.
#include <simdbezier/rates.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include <simdbezier/bounds.hpp>
#include <simdbezier/certificate.hpp>

#include "src/mesh/patch_bound.hpp"
#include "src/mesh/topology_data.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Visits every patch of all views with a bound of its own, in parallel: visit(patch, bound)
/// returns a status. The report names the lowest patch at fault.
template <typename S, typename Visit>
RateReport for_patches(std::span<const ControlNets<S>> sets, const TopologyData& topology,
                       int threads, const Visit& visit) noexcept {
  std::size_t first = 0;
  for (const ControlNets<S>& nets : sets) {
    std::atomic<std::size_t> fault = nets.count;
    std::atomic<bool> memory = false;
    std::atomic<Status> status = Status::ok;
    auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
      try {
        PatchBound bound;
        for (std::size_t patch = begin; patch < end && patch < fault; ++patch) {
          const Status found = bound.read(nets, patch, topology.flags[first + patch])
                                   ? visit(first + patch, bound)
                                   : Status::non_finite_input;
          if (found != Status::ok) {
            std::size_t lowest = fault;
            while (patch < lowest && !fault.compare_exchange_weak(lowest, patch)) {
            }
            status = found;
            return;
          }
        }
      } catch (const std::bad_alloc&) {
        memory = true;
      }
    };
    for_blocks(nets.count, thread_count(threads, nets.count), BlockBody(body));
    if (memory) {
      return {Status::out_of_memory};
    }
    if (fault < nets.count) {
      return {status, first + fault};
    }
    first += nets.count;
  }
  return {};
}

template <typename S>
RateReport check(std::span<const ControlNets<S>> sets, const Topology& topology,
                 std::span<const double> errors, const CertifiedRates& out) noexcept {
  std::size_t patches = 0;
  for (const ControlNets<S>& nets : sets) {
    const Status status = check_input(nets);
    if (status != Status::ok) {
      return {status, patches};
    }
    if (nets.components != 3) {
      return {Status::bad_components, patches};
    }
    patches += nets.count;
  }
  const std::size_t joined = topology.counts().patches;
  const auto fits = [&](std::size_t size) { return size == patches; };
  if (joined != patches || !fits(out.nu.size()) || !fits(out.nv.size()) ||
      !fits(out.diagonals.size()) || !(out.deviation.empty() || fits(out.deviation.size())) ||
      !(errors.empty() || fits(errors.size()))) {
    return {Status::bad_rates};
  }
  return {};
}

double error_of(std::span<const double> errors, std::size_t patch) {
  return errors.empty() ? 0 : errors[patch];
}

/// Rates for the lengths of control polygons.
CellCounts at_least(const CellCounts& cells, const std::array<double, 2>& lengths, double edge) {
  const auto segments = [&](std::uint32_t n, double length) {
    const double wanted = std::ceil(length / edge);
    return wanted > n ? static_cast<std::uint32_t>(std::min(wanted, 1e9)) : n;
  };
  return {segments(cells.nu, lengths[0]), segments(cells.nv, lengths[1])};
}

std::uint32_t most_segments(const RateOptions& options) {
  return std::clamp(options.most_segments, 1U, kMostSegments);
}

/// The bound does not fall with every step, so that rates that were raised are looked at again.
Status raise_until(const PatchBound& bound, double t, const RateOptions& options,
                   CellCounts& cells) {
  const std::uint32_t most = most_segments(options);
  while (cells.nu <= most && cells.nv <= most && !(bound.bound(cells) <= t)) {
    ++cells.nu;
    ++cells.nv;
  }
  return cells.nu <= most && cells.nv <= most ? Status::ok : Status::bad_tolerance;
}

Status choose(const PatchBound& bound, double t, const RateOptions& options, CellCounts& cells) {
  if (!(t > 0) || !(options.longest_edge > 0)) {
    return Status::bad_tolerance;
  }
  const CellCounts least = bound.choose(t, most_segments(options));
  cells = at_least(least, bound.lengths(), options.longest_edge);
  return raise_until(bound, t, options, cells);
}

} // namespace
} // namespace detail

template <typename T>
Status position_errors(const PatchSet<T>& set, std::span<double> out) noexcept {
  if (out.size() < set.size()) {
    return Status::output_too_small;
  }
  for (std::size_t patch = 0; patch < set.size(); ++patch) {
    const auto& error = error_bounds(set, patch).position;
    out[patch] =
        std::sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2]) * (1 + 0x1p-40);
  }
  return Status::ok;
}
template SIMDBEZIER_API Status position_errors(const PatchSet<float>&, std::span<double>) noexcept;
template SIMDBEZIER_API Status position_errors(const PatchSet<double>&, std::span<double>) noexcept;

template <typename S>
RateReport certify_rates(std::span<const ControlNets<S>> sets, const Topology& topology,
                         std::span<const double> errors, const CertifiedRates& rates,
                         int threads) noexcept {
  const RateReport checked = detail::check(sets, topology, errors, rates);
  if (!checked || rates.nu.empty()) {
    return checked;
  }
  return detail::for_patches(
      sets, *topology.data(), threads, [&](std::size_t patch, const detail::PatchBound& bound) {
        const detail::CellCounts cells{rates.nu[patch], rates.nv[patch]};
        if (cells.nu < 1 || cells.nu > kMostSegments || cells.nv < 1 || cells.nv > kMostSegments) {
          return Status::bad_rates;
        }
        const double deviation = bound.bound(cells, &rates.diagonals[patch]);
        if (!rates.deviation.empty()) {
          rates.deviation[patch] = deviation + detail::error_of(errors, patch);
        }
        return Status::ok;
      });
}

template <typename S>
RateReport choose_rates(std::span<const ControlNets<S>> sets, const Topology& topology,
                        const RateOptions& options, const CertifiedRates& out) noexcept {
  const RateReport checked = detail::check(sets, topology, options.errors, out);
  if (!checked || out.nu.empty()) {
    return checked;
  }
  if (!options.tolerances.empty() && options.tolerances.size() != out.nu.size()) {
    return {Status::bad_rates};
  }
  const auto tolerance = [&](std::size_t patch) {
    return (options.tolerances.empty() ? options.tolerance : options.tolerances[patch]) -
           detail::error_of(options.errors, patch);
  };
  const auto one = [&](std::size_t patch, const detail::PatchBound& bound) {
    detail::CellCounts cells{};
    const Status status = detail::choose(bound, tolerance(patch), options, cells);
    out.nu[patch] = cells.nu;
    out.nv[patch] = cells.nv;
    return status;
  };
  const RateReport chosen = detail::for_patches(sets, *topology.data(), options.threads, one);
  if (!chosen) {
    return chosen;
  }
  // Raising rates of one patch can bring it next to another in the same way, or its bound up.
  for (;;) {
    std::size_t raised = 0;
    const Status separated = separate_vertices(topology, out.nu, out.nv, raised);
    if (separated != Status::ok) {
      return {separated};
    }
    std::atomic<bool> changed = false;
    const auto settle = [&](std::size_t patch, const detail::PatchBound& bound) {
      detail::CellCounts cells{out.nu[patch], out.nv[patch]};
      const Status status = detail::raise_until(bound, tolerance(patch), options, cells);
      changed = changed || cells.nu != out.nu[patch] || cells.nv != out.nv[patch];
      out.nu[patch] = cells.nu;
      out.nv[patch] = cells.nv;
      return status;
    };
    if (raised > 0) {
      const RateReport settled =
          detail::for_patches(sets, *topology.data(), options.threads, settle);
      if (!settled) {
        return settled;
      }
    }
    if (!changed) {
      break;
    }
  }
  return certify_rates(sets, topology, options.errors, out, options.threads);
}

template SIMDBEZIER_API RateReport choose_rates(std::span<const ControlNets<float>>,
                                                const Topology&, const RateOptions&,
                                                const CertifiedRates&) noexcept;
template SIMDBEZIER_API RateReport choose_rates(std::span<const ControlNets<double>>,
                                                const Topology&, const RateOptions&,
                                                const CertifiedRates&) noexcept;
template SIMDBEZIER_API RateReport certify_rates(std::span<const ControlNets<float>>,
                                                 const Topology&, std::span<const double>,
                                                 const CertifiedRates&, int) noexcept;
template SIMDBEZIER_API RateReport certify_rates(std::span<const ControlNets<double>>,
                                                 const Topology&, std::span<const double>,
                                                 const CertifiedRates&, int) noexcept;

} // namespace simdbezier
