// The steps of plan_mesh(), which lead from control nets to a layout.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include <simdbezier/mesh.hpp>

#include "src/choice/clock.hpp"
#include "src/mesh/mesh_measures.hpp"
#include "src/mesh/net_points.hpp"
#include "src/mesh/rates/pixels.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier::detail {

/// One call of plan_mesh(): steps in their order, each of which may refuse.
template <typename T, typename S>
class MeshPlanner {
public:
  /// errors: how far each of the patches given may be from what it stands for; or empty.
  MeshPlanner(std::span<const ControlNets<S>> nets, std::span<const double> errors,
              const MeshOptions& options, MeshPlan<T>& plan)
      : given_(nets), nets_(nets), given_errors_(errors), options_(options), plan_(plan) {}

  Status run() {
    return run({{&MeshPlanner::check, nullptr},
                {&MeshPlanner::leave_out, &PlanSeconds::topology},
                {&MeshPlanner::split, &PlanSeconds::topology},
                {&MeshPlanner::join, &PlanSeconds::topology},
                {&MeshPlanner::pack_nets, &PlanSeconds::pack},
                {&MeshPlanner::measure, &PlanSeconds::pack},
                {&MeshPlanner::choose, &PlanSeconds::rates},
                {&MeshPlanner::lay_out, &PlanSeconds::topology}});
  }
  /// The steps that come after the set and the topology, which the plan has.
  Status run_again() {
    return run({{&MeshPlanner::check, nullptr},
                {&MeshPlanner::choose, &PlanSeconds::rates},
                {&MeshPlanner::lay_out, &PlanSeconds::topology}});
  }

private:
  struct Step {
    Status (MeshPlanner::*take)();
    double PlanSeconds::*seconds; ///< where its time counts; null: nowhere
  };
  Status run(std::initializer_list<Step> steps) {
    for (const Step& step : steps) {
      const std::int64_t begin = clock_now();
      const Status status = (this->*step.take)();
      if (step.seconds != nullptr) {
        plan_.seconds.*step.seconds += static_cast<double>(clock_now() - begin) * 1e-9;
      }
      if (!status) {
        return status;
      }
    }
    return Status::ok;
  }

  [[nodiscard]] bool is_uniform() const { return options_.nu != 0 || options_.nv != 0; }
  /// The number of a patch of the set among those given.
  [[nodiscard]] std::size_t given_patch(std::size_t patch) const {
    return plan_.patches.empty() ? patch : plan_.patches[patch];
  }
  /// Names the patch by its number among those given.
  Status fault_at(std::size_t patch, Status status) {
    plan_.report.item = patch < plan_.patches.size() ? plan_.patches[patch] : patch;
    return status;
  }

  Status check() {
    const auto is_given = [&](double value) { return value != kUnlimited; };
    const RateOptions& rates = options_.rates;
    const bool toleranced = is_given(rates.tolerance) || is_given(options_.relative_tolerance) ||
                            is_given(options_.pixels) || is_given(rates.longest_edge) ||
                            is_given(rates.normal_degrees) || !rates.tolerances.empty();
    if (is_uniform() && (toleranced || options_.nu < 2 || options_.nv < 2)) {
      return Status::bad_grid;
    }
    if (meaningless_measure(options_) != nullptr) {
      return Status::bad_tolerance;
    }
    return toleranced || is_uniform() ? Status::ok : Status::bad_tolerance;
  }

  [[nodiscard]] TopologyOptions topology_options() const {
    TopologyOptions how = options_.topology;
    how.snap = std::max(how.snap, split_.snap);
    return how;
  }

  /// Repeated patches go first: beside them, long edges would have several sides.
  Status leave_out() {
    if (!options_.drop_repeated) {
      return Status::ok;
    }
    TopologyOptions how = topology_options();
    how.orient = false; // of patches that stay
    Status status = find_topology(nets_, plan_.topology, how, options_);
    plan_.counts = plan_.topology.counts();
    if (status && plan_.counts.repeated_patches > 0) {
      status = find_distinct_nets(nets_, plan_.topology, distinct_);
      nets_ = distinct_.nets;
      plan_.patches = std::move(distinct_.patches);
    }
    return status;
  }

  Status split() {
    if (!options_.split_edges) {
      return Status::ok;
    }
    SplitOptions how;
    how.snap = options_.topology.snap;
    const Status status = split_edges(nets_, split_, how, options_);
    plan_.splits = split_.counts;
    if (!status || split_.pieces.size() == patches_of(nets_)) { // all of them are whole
      return status;
    }
    nets_ = split_.nets;
    std::vector<std::uint32_t> patches;
    for (PatchPiece& piece : split_.pieces) {
      piece.patch = plan_.patches.empty() ? piece.patch : plan_.patches[piece.patch];
      patches.push_back(piece.patch);
    }
    plan_.patches = std::move(patches);
    plan_.pieces = std::move(split_.pieces);
    return status;
  }

  Status join() {
    const bool left_out = options_.drop_repeated && plan_.counts.repeated_patches > 0;
    if (options_.drop_repeated && !left_out && !options_.topology.orient && !options_.split_edges) {
      return Status::ok; // all is known
    }
    const Status status = find_topology(nets_, plan_.topology, topology_options(), options_);
    if (!options_.drop_repeated || options_.split_edges) {
      const std::size_t repeated = plan_.counts.repeated_patches;
      plan_.counts = plan_.topology.counts();
      plan_.counts.repeated_patches =
          options_.drop_repeated ? repeated : plan_.counts.repeated_patches;
    }
    return status;
  }

  Status pack_nets() {
    PackOptions how;
    how.local_origin = options_.local_origin;
    how.threads = options_.threads;
    how.isa = options_.isa;
    const Report report = pack(nets_, plan_.set, how);
    plan_.report = report; // which says more than the patch
    return report ? Status(Status::ok) : fault_at(report.item, report.status);
  }

  Status measure() {
    if (!is_one_a_patch(options_.rates.errors)) {
      return Status::bad_rates;
    }
    for (const double& error : options_.rates.errors) {
      if (!(error >= 0)) { // a sum with the vertices' own errors would hide it
        plan_.report.item = static_cast<std::size_t>(&error - options_.rates.errors.data());
        return Status::bad_tolerance;
      }
    }
    PointBox box;
    for (const ControlNets<S>& nets : given_) {
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        for_points(nets, patch, [&](const Point3& point) { box.include(point); });
      }
    }
    plan_.diagonal = box.diagonal();
    const std::size_t patches = plan_.set.size();
    plan_.errors.resize(patches);
    const Status status = position_errors(plan_.set, plan_.errors, options_);
    for (std::size_t patch = 0; patch < plan_.pieces.size(); ++patch) {
      plan_.errors[patch] += plan_.pieces[patch].error;
    }
    for (const std::span<const double> known : {given_errors_, options_.rates.errors}) {
      for (std::size_t patch = 0; patch < patches && !known.empty(); ++patch) {
        plan_.errors[patch] += known[given_patch(patch)];
      }
    }
    return status;
  }

  [[nodiscard]] bool is_one_a_patch(std::span<const double> values) const {
    return values.empty() || values.size() == patches_of(given_);
  }

  Status choose() {
    if (!is_one_a_patch(options_.rates.tolerances)) {
      return Status::bad_rates;
    }
    const std::size_t patches = plan_.set.size();
    plan_.cells_u.resize(patches);
    plan_.cells_v.resize(patches);
    plan_.deviations.resize(patches);
    diagonals_.resize(patches);
    const CertifiedRates rates{plan_.cells_u, plan_.cells_v, diagonals_, plan_.deviations};
    Report report;
    if (is_uniform()) {
      std::fill(plan_.cells_u.begin(), plan_.cells_u.end(), options_.nu - 1);
      std::fill(plan_.cells_v.begin(), plan_.cells_v.end(), options_.nv - 1);
      std::size_t raised = 0;
      report.status = separate_vertices(plan_.topology, plan_.cells_u, plan_.cells_v, raised);
      report =
          report ? certify_rates<S>(nets_, plan_.topology, plan_.errors, rates, options_) : report;
    } else {
      RateOptions how = options_.rates;
      how.errors = plan_.errors;
      how.keep = 0;
      if (const Status status = find_tolerances(how); !status) {
        return status;
      }
      report = choose_rates<S>(nets_, plan_.topology, how, rates, options_);
      find_fault(report, how, rates);
    }
    if (!report) {
      return fault_at(report.item, report.status);
    }
    plan_.deviation = plan_.deviations.empty()
                          ? 0
                          : *std::max_element(plan_.deviations.begin(), plan_.deviations.end());
    return Status::ok;
  }

  static bool is_too_fine(Status status) {
    return status == Status::bad_tolerance || status == Status::snap_too_large;
  }
  /// What kept the patch at fault from its tolerance.
  void find_fault(const Report& report, RateOptions how, const CertifiedRates& rates) {
    RateFault& fault = plan_.fault;
    fault = {};
    if (!is_too_fine(report.status)) {
      return;
    }
    const std::size_t patch = report.item;
    fault.tolerance =
        how.tolerances.empty() ? how.tolerance : std::min(how.tolerance, how.tolerances[patch]);
    fault.error = plan_.errors[patch];
    // Would it have its rates without the angle, or without the length as well?
    for (const auto& [measure, limit] : {std::pair(&RateOptions::normal_degrees, RateLimit::angle),
                                         {&RateOptions::longest_edge, RateLimit::length}}) {
      if (how.*measure != kUnlimited) {
        how.*measure = kUnlimited;
        fault.limit = limit;
        const Report wider = choose_rates<S>(nets_, plan_.topology, how, rates, options_);
        if (!is_too_fine(wider.status) || wider.item != patch) {
          return;
        }
      }
    }
    const bool has_room = std::isfinite(fault.error) && fault.tolerance != kUnlimited &&
                          fault.tolerance > fault.error;
    fault.limit = !has_room                                 ? RateLimit::errors
                  : report.status == Status::snap_too_large ? RateLimit::snap
                                                            : RateLimit::cells;
  }

  /// The smallest of what is asked of each patch.
  Status find_tolerances(RateOptions& how) {
    // A share of a diagonal of 0 would be a tolerance of 0, which no mesh could keep.
    const double relative =
        plan_.diagonal > 0 ? options_.relative_tolerance * plan_.diagonal : kUnlimited;
    how.tolerance = std::min(how.tolerance, relative);
    const bool pixels = std::isfinite(options_.pixels);
    if (how.tolerances.empty() && !pixels) {
      return Status::ok;
    }
    tolerances_.assign(plan_.set.size(), kUnlimited);
    if (pixels) {
      if (const Status status = view_tolerances<S>(nets_, plan_.topology, options_.camera,
                                                   options_.pixels, tolerances_, options_);
          !status) {
        return status;
      }
    }
    for (std::size_t patch = 0; patch < tolerances_.size() && !how.tolerances.empty(); ++patch) {
      const double own = how.tolerances[given_patch(patch)];
      tolerances_[patch] = own >= tolerances_[patch] ? tolerances_[patch] : own; // nan is refused
    }
    how.tolerances = tolerances_;
    return Status::ok;
  }

  Status lay_out() {
    Status status = lay_out_mesh(plan_.topology, {plan_.cells_u, plan_.cells_v, diagonals_},
                                 plan_.layout, options_);
    if (status && options_.crease_degrees != kUnlimited) {
      status = split_creases(plan_.set, plan_.layout, options_.crease_degrees, plan_.layout,
                             {.threads = options_.threads, .isa = options_.isa});
    }
    return status && options_.parameters ? split_parameters(plan_.layout, plan_.layout) : status;
  }

  std::span<const ControlNets<S>> given_;
  std::span<const ControlNets<S>> nets_; ///< without what is left out
  std::span<const double> given_errors_; ///< in addition to those among the options
  SplitNets<S> split_;
  DistinctNets<S> distinct_;
  const MeshOptions& options_;
  MeshPlan<T>& plan_;
  std::vector<double> tolerances_;
  std::vector<std::uint16_t> diagonals_;
};

} // namespace simdbezier::detail
