#include <simdbezier/rates.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

#include "src/mesh/rates/rate_call.hpp"
#include "src/mesh/topology/fit.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename S>
Report check(std::span<const ControlNets<S>> nets, const Topology& topology,
             std::span<const double> errors, const CertifiedRates& out, int threads) {
  std::size_t patches = 0;
  if (const Status status = count_patches(nets, patches); !status) {
    return {status};
  }
  std::size_t first = 0;
  for (const ControlNets<S>& view : nets) {
    if (const Status status = check_in_space(view); !status) {
      return {status, first};
    }
    first += view.count;
  }
  const std::size_t joined = topology.counts().patches;
  const auto fits = [&](std::size_t size) { return size == patches; };
  if (joined != patches || !fits(out.cells_u.size()) || !fits(out.cells_v.size()) ||
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
  return misfit < patches ? Report{Status::bad_topology, misfit} : Report{};
}

/// Each patch's own tolerance, or the common one if it is smaller; empty if only one kind is given.
std::vector<double> smaller_tolerances(const RateOptions& options) {
  if (options.tolerance == kUnlimited) {
    return {};
  }
  std::vector<double> smaller(options.tolerances.begin(), options.tolerances.end());
  for (double& tolerance : smaller) {
    const bool is_smaller = tolerance <= options.tolerance || std::isnan(tolerance);
    tolerance = is_smaller ? tolerance : options.tolerance; // nan stays, of both
  }
  return smaller;
}

} // namespace
} // namespace detail

template <typename S>
Report certify_rates(std::span<const ControlNets<S>> nets, const Topology& topology,
                     std::span<const double> errors, const CertifiedRates& rates,
                     const RunOptions& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  const Report checked = detail::check(nets, topology, errors, rates, options.threads);
  if (!checked || rates.cells_u.empty()) {
    return checked;
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(options.isa, isa); !runs) {
    return {runs};
  }
  RateOptions how;
  how.errors = errors;
  return detail::RateCall<S>(nets, topology, how, {options.threads, isa}, rates).certify_given();
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template <typename S>
Report choose_rates(std::span<const ControlNets<S>> nets, const Topology& topology,
                    const RateOptions& options, const CertifiedRates& out,
                    const RunOptions& run) noexcept try {
  const detail::DefaultFpEnvironment environment;
  const Report checked = detail::check(nets, topology, options.errors, out, run.threads);
  if (!checked || out.cells_u.empty()) {
    return checked;
  }
  if (!options.tolerances.empty() && options.tolerances.size() != out.cells_u.size()) {
    return {Status::bad_rates};
  }
  if (!(options.longest_edge > 0) || !(options.normal_degrees > 0)) {
    return {Status::bad_tolerance};
  }
  Isa isa = Isa::automatic;
  if (const Status runs = resolve_isa(run.isa, isa); !runs) {
    return {runs};
  }
  const std::vector<double> smaller = detail::smaller_tolerances(options);
  RateOptions how = options;
  how.tolerances = smaller.empty() ? how.tolerances : smaller;
  detail::RateCall<S> call(nets, topology, how, {run.threads, isa}, out);
  const std::vector<detail::CellCounts> before =
      options.keep >= 1 ? call.rates() : std::vector<detail::CellCounts>();
  // Raising the rates of one patch can make its edges coincide with others, or raise its bound.
  const auto separate = [&](Report report) {
    for (bool changed = true; report && changed;) {
      const std::vector<detail::CellCounts> certified = call.rates();
      std::size_t raised = 0;
      report.status = separate_vertices(topology, out.cells_u, out.cells_v, raised);
      changed = false;
      if (report && raised > 0) {
        report = call.settle(certified, changed);
      }
    }
    return report;
  };
  Report report = separate(call.choose());
  if (report && options.thorough) {
    // Separating few cells can raise them to more than there were before.
    const std::vector<detail::CertifiedCells> usual = call.chosen();
    report = separate(call.choose_fewer());
    if (report && call.take_back(usual, false)) {
      report = separate(report);
    }
    const bool has_memory = report.status != Status::out_of_memory; // all else is of fewer cells
    if (has_memory && (!report || call.take_back(usual, false))) {
      call.take_back(usual, true);
      report = {};
    }
  }
  if (report && !before.empty()) {
    report = separate(call.keep(before));
  }
  for (std::size_t patch = 0; report && patch < out.cells_u.size(); ++patch) {
    if (std::max(out.cells_u[patch], out.cells_v[patch]) > options.most_segments) {
      report = {Status::bad_tolerance, patch};
    }
  }
  return call.with_snapping_blamed(report);
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template SIMDBEZIER_API Report choose_rates(std::span<const ControlNets<float>>, const Topology&,
                                            const RateOptions&, const CertifiedRates&,
                                            const RunOptions&) noexcept;
template SIMDBEZIER_API Report choose_rates(std::span<const ControlNets<double>>, const Topology&,
                                            const RateOptions&, const CertifiedRates&,
                                            const RunOptions&) noexcept;
template SIMDBEZIER_API Report certify_rates(std::span<const ControlNets<float>>, const Topology&,
                                             std::span<const double>, const CertifiedRates&,
                                             const RunOptions&) noexcept;
template SIMDBEZIER_API Report certify_rates(std::span<const ControlNets<double>>, const Topology&,
                                             std::span<const double>, const CertifiedRates&,
                                             const RunOptions&) noexcept;

} // namespace simdbezier
