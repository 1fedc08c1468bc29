// See rates.hpp.
#include <simdbezier/rates.hpp>

#include <algorithm>
#include <new>
#include <vector>

#include "src/mesh/rates/rate_call.hpp"
#include "src/mesh/topology/fit.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename S>
RateReport check(std::span<const ControlNets<S>> nets, const Topology& topology,
                 std::span<const double> errors, const CertifiedRates& out, int threads) {
  if (is_missing(nets)) {
    return {Status::null_input};
  }
  std::size_t patches = 0;
  for (const ControlNets<S>& view : nets) {
    if (const Status status = check_in_space(view); !status) {
      return {status, patches};
    }
    patches += view.count;
  }
  const std::size_t joined = topology.counts().patches;
  const auto fits = [&](std::size_t size) { return size == patches; };
  if (joined != patches || !fits(out.nu.size()) || !fits(out.nv.size()) ||
      !fits(out.diagonals.size()) || !(out.deviation.empty() || fits(out.deviation.size())) ||
      !(errors.empty() || fits(errors.size()))) {
    return {Status::bad_rates};
  }
  for (std::size_t patch = 0; patch < errors.size(); ++patch) {
    if (!(errors[patch] >= 0)) {
      return {Status::bad_tolerance, patch};
    }
  }
  const std::size_t misfit = patches == 0 ? 0 : first_misfit(*topology.data(), nets, threads);
  return misfit < patches ? RateReport{Status::bad_topology, misfit} : RateReport{};
}

} // namespace
} // namespace detail

template <typename S>
RateReport certify_rates(std::span<const ControlNets<S>> nets, const Topology& topology,
                         std::span<const double> errors, const CertifiedRates& rates,
                         const Options& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  const RateReport checked = detail::check(nets, topology, errors, rates, options.threads);
  if (!checked || rates.nu.empty()) {
    return checked;
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(options.isa, isa); !runs) {
    return {runs};
  }
  RateOptions how;
  how.errors = errors;
  how.tolerance = kUnlimited; // whatever the certificate is, it is what was asked for
  how.threads = options.threads;
  return detail::RateCall<S>(nets, topology, how, isa, rates).certify_given();
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template <typename S>
RateReport choose_rates(std::span<const ControlNets<S>> nets, const Topology& topology,
                        const RateOptions& options, const CertifiedRates& out) noexcept try {
  const detail::DefaultFpEnvironment environment;
  const RateReport checked = detail::check(nets, topology, options.errors, out, options.threads);
  if (!checked || out.nu.empty()) {
    return checked;
  }
  if (!options.tolerances.empty() && options.tolerances.size() != out.nu.size()) {
    return {Status::bad_rates};
  }
  if (!(options.longest_edge > 0) || !(options.normal_angle > 0)) {
    return {Status::bad_tolerance};
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(options.isa, isa); !runs) {
    return {runs};
  }
  detail::RateCall<S> call(nets, topology, options, isa, out);
  const std::vector<detail::CellCounts> before =
      options.keep >= 1 ? call.rates() : std::vector<detail::CellCounts>();
  RateReport report = call.choose();
  if (report && !before.empty()) {
    report = call.keep(before);
  }
  // Raising the rates of one patch can make its edges coincide with others, or raise its bound.
  for (bool changed = true; report && changed;) {
    const std::vector<detail::CellCounts> certified = call.rates();
    std::size_t raised = 0;
    report.status = separate_vertices(topology, out.nu, out.nv, raised);
    changed = false;
    if (report && raised > 0) {
      report = call.settle(certified, changed);
    }
  }
  for (std::size_t patch = 0; report && patch < out.nu.size(); ++patch) {
    if (std::max(out.nu[patch], out.nv[patch]) > options.most_segments) {
      report = {Status::bad_tolerance, patch};
    }
  }
  return call.with_snapping_blamed(report);
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template SIMDBEZIER_API RateReport choose_rates(std::span<const ControlNets<float>>,
                                                const Topology&, const RateOptions&,
                                                const CertifiedRates&) noexcept;
template SIMDBEZIER_API RateReport choose_rates(std::span<const ControlNets<double>>,
                                                const Topology&, const RateOptions&,
                                                const CertifiedRates&) noexcept;
template SIMDBEZIER_API RateReport certify_rates(std::span<const ControlNets<float>>,
                                                 const Topology&, std::span<const double>,
                                                 const CertifiedRates&, const Options&) noexcept;
template SIMDBEZIER_API RateReport certify_rates(std::span<const ControlNets<double>>,
                                                 const Topology&, std::span<const double>,
                                                 const CertifiedRates&, const Options&) noexcept;

} // namespace simdbezier
