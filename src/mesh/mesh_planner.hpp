// The steps of plan_mesh(), which lead from control nets to a layout.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <simdbezier/mesh.hpp>

#include "src/mesh/mesh_measures.hpp"
#include "src/mesh/net_points.hpp"
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
    for (const auto step : {&MeshPlanner::check, &MeshPlanner::leave_out, &MeshPlanner::split,
                            &MeshPlanner::join, &MeshPlanner::pack_nets, &MeshPlanner::measure,
                            &MeshPlanner::choose, &MeshPlanner::lay_out}) {
      if (const Status status = (this->*step)(); !status) {
        return status;
      }
    }
    return Status::ok;
  }

private:
  [[nodiscard]] bool is_uniform() const { return options_.nu != 0 || options_.nv != 0; }
  /// Names the patch by its number among those given.
  Status fault_at(std::size_t patch, Status status) {
    plan_.fault_patch = patch < plan_.patches.size() ? plan_.patches[patch] : patch;
    return status;
  }

  Status check() {
    const auto is_given = [&](double value) { return value != kUnlimited; };
    const bool toleranced = is_given(options_.tolerance) || is_given(options_.relative_tolerance) ||
                            is_given(options_.pixels) || is_given(options_.longest_edge) ||
                            is_given(options_.normal_angle) || !options_.tolerances.empty();
    if (is_uniform() && (toleranced || options_.nu < 2 || options_.nv < 2)) {
      return Status::bad_grid;
    }
    if (meaningless_measure(options_) != nullptr) {
      return Status::bad_tolerance;
    }
    return toleranced || is_uniform() ? Status::ok : Status::bad_tolerance;
  }

  [[nodiscard]] TopologyOptions topology_options() const {
    TopologyOptions how;
    how.flip = options_.flip;
    how.point_size = options_.point_size;
    how.snap = std::max(options_.snap, split_.snap);
    how.threads = options_.threads;
    return how;
  }

  /// Repeated patches go first: beside them, long edges would have several sides.
  Status leave_out() {
    if (!options_.drop_repeated) {
      return Status::ok;
    }
    Status status = find_topology(nets_, plan_.topology, topology_options());
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
    how.snap = options_.snap;
    how.threads = options_.threads;
    const Status status = split_edges(nets_, split_, how);
    nets_ = status ? split_.nets : nets_;
    plan_.splits = split_.counts;
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
    if (options_.drop_repeated && !left_out && !options_.orient && !options_.split_edges) {
      return Status::ok; // all is known
    }
    TopologyOptions how = topology_options();
    how.orient = options_.orient;
    const Status status = find_topology(nets_, plan_.topology, how);
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
    const PackReport report = pack(nets_, plan_.set, how);
    return report ? Status(Status::ok) : fault_at(report.patch, report.status);
  }

  Status measure() {
    PointBox box;
    for (const ControlNets<S>& nets : given_) {
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        for_points(nets, patch, [&](const Point3& point) { box.include(point); });
      }
    }
    plan_.diagonal = box.diagonal();
    const std::size_t patches = plan_.set.size();
    plan_.nu.resize(patches);
    plan_.nv.resize(patches);
    plan_.deviations.resize(patches);
    diagonals_.resize(patches);
    errors_.resize(patches);
    const Status status =
        position_errors(plan_.set, errors_, {.threads = options_.threads, .isa = options_.isa});
    for (std::size_t patch = 0; patch < plan_.pieces.size(); ++patch) {
      errors_[patch] += plan_.pieces[patch].error;
    }
    for (std::size_t patch = 0; patch < patches && !given_errors_.empty(); ++patch) {
      errors_[patch] += given_errors_[plan_.patches.empty() ? patch : plan_.patches[patch]];
    }
    return status;
  }

  Status choose() {
    const CertifiedRates rates{plan_.nu, plan_.nv, diagonals_, plan_.deviations};
    RateReport report;
    if (is_uniform()) {
      std::fill(plan_.nu.begin(), plan_.nu.end(), options_.nu - 1);
      std::fill(plan_.nv.begin(), plan_.nv.end(), options_.nv - 1);
      std::size_t raised = 0;
      report.status = separate_vertices(plan_.topology, plan_.nu, plan_.nv, raised);
      report = report ? certify_rates<S>(nets_, plan_.topology, errors_, rates,
                                         {.threads = options_.threads, .isa = options_.isa})
                      : report;
    } else {
      RateOptions how;
      how.errors = errors_;
      how.longest_edge = options_.longest_edge;
      how.normal_angle = options_.normal_angle;
      how.threads = options_.threads;
      how.isa = options_.isa;
      if (const Status status = find_tolerances(how); !status) {
        return status;
      }
      report = choose_rates<S>(nets_, plan_.topology, how, rates);
    }
    if (!report) {
      return fault_at(report.patch, report.status);
    }
    plan_.deviation = plan_.deviations.empty()
                          ? 0
                          : *std::max_element(plan_.deviations.begin(), plan_.deviations.end());
    return Status::ok;
  }

  /// The smallest of what is asked of each patch.
  Status find_tolerances(RateOptions& how) {
    // A share of a diagonal of 0 would be a tolerance of 0, which no mesh could keep.
    const double relative =
        plan_.diagonal > 0 ? options_.relative_tolerance * plan_.diagonal : kUnlimited;
    how.tolerance = std::min(options_.tolerance, relative);
    const bool pixels = std::isfinite(options_.pixels);
    if (options_.tolerances.empty() && !pixels) {
      return Status::ok;
    }
    const std::size_t given = patches_of(given_);
    if (!options_.tolerances.empty() && options_.tolerances.size() != given) {
      return Status::bad_rates;
    }
    tolerances_.assign(plan_.set.size(), kUnlimited);
    if (pixels) {
      if (const Status status =
              pixel_tolerances<S>(nets_, options_.camera, options_.pixels, tolerances_);
          !status) {
        return status;
      }
    }
    for (std::size_t patch = 0; patch < tolerances_.size(); ++patch) {
      double& tolerance = tolerances_[patch];
      tolerance = std::min(tolerance, how.tolerance);
      if (!options_.tolerances.empty()) {
        const double own =
            options_.tolerances[plan_.patches.empty() ? patch : plan_.patches[patch]];
        tolerance = own >= tolerance ? tolerance : own; // nan is kept, and refused
      }
    }
    how.tolerances = tolerances_;
    return Status::ok;
  }

  Status lay_out() {
    Status status = lay_out_mesh(plan_.topology, {plan_.nu, plan_.nv, diagonals_}, plan_.layout,
                                 {.threads = options_.threads});
    if (status && options_.crease_angle != kUnlimited) {
      Options how;
      how.threads = options_.threads;
      how.isa = options_.isa;
      status = split_creases(plan_.set, plan_.layout, options_.crease_angle, plan_.layout, how);
    }
    return status && options_.parameters ? split_parameters(plan_.layout, plan_.layout) : status;
  }

  std::span<const ControlNets<S>> given_;
  std::span<const ControlNets<S>> nets_; ///< without what is left out
  std::span<const double> given_errors_;
  SplitNets<S> split_;
  DistinctNets<S> distinct_;
  const MeshOptions& options_;
  MeshPlan<T>& plan_;
  std::vector<double> errors_;
  std::vector<double> tolerances_;
  std::vector<std::uint16_t> diagonals_;
};

} // namespace simdbezier::detail
