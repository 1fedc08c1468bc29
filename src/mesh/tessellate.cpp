// See mesh.hpp.
#include <simdbezier/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include <simdbezier/mesh_primitives.hpp>

#include "src/mesh/net_points.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Views without the patches that a topology calls repeated.
template <typename S>
std::vector<ControlNets<S>> without_repeated(std::span<const ControlNets<S>> sets,
                                             const Topology& topology,
                                             std::vector<std::uint32_t>& kept) {
  std::vector<ControlNets<S>> parts;
  std::uint32_t number = 0;
  for (const ControlNets<S>& nets : sets) {
    bool open = false;
    for (std::size_t patch = 0; patch < nets.count; ++patch, ++number) {
      if (topology.is_repeated(number)) {
        open = false;
        continue;
      }
      if (!open) {
        parts.push_back(nets);
        parts.back().points += static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
        parts.back().memory = {};
        parts.back().count = 0;
        open = true;
      }
      ++parts.back().count;
      kept.push_back(number);
    }
  }
  return parts;
}

/// One call of plan_mesh(): steps in their order, each of which may refuse.
template <typename T, typename S>
class Planner {
public:
  Planner(std::span<const ControlNets<S>> nets, const MeshOptions& options, MeshPlan<T>& plan)
      : given_(nets), nets_(nets), options_(options), plan_(plan) {}

  Status run() {
    for (const auto step : {&Planner::check, &Planner::join, &Planner::pack_nets, &Planner::measure,
                            &Planner::choose, &Planner::lay_out}) {
      if (const Status status = (this->*step)(); !status) {
        return status;
      }
    }
    return Status::ok;
  }

private:
  [[nodiscard]] bool is_uniform() const { return options_.nu != 0 || options_.nv != 0; }
  /// How often a patch was given, and where the fault is.
  Status fault_at(std::size_t patch, Status status) {
    plan_.fault_patch = patch < plan_.patches.size() ? plan_.patches[patch] : patch;
    return status;
  }

  Status check() {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const auto is_given = [&](double value) { return value != kNone; };
    const bool toleranced = is_given(options_.tolerance) || is_given(options_.relative_tolerance) ||
                            is_given(options_.pixels) || is_given(options_.longest_edge) ||
                            is_given(options_.normal_angle) || !options_.tolerances.empty();
    if (is_uniform()) {
      return toleranced || options_.nu < 2 || options_.nv < 2 ? Status::bad_grid : Status::ok;
    }
    const bool positive = options_.tolerance > 0 && options_.relative_tolerance > 0 &&
                          options_.pixels > 0 && options_.longest_edge > 0 &&
                          options_.normal_angle > 0;
    return toleranced && positive ? Status::ok : Status::bad_tolerance;
  }

  Status join() {
    TopologyOptions how;
    how.orient = options_.orient && !options_.drop_repeated;
    how.flip = options_.flip;
    how.point_size = options_.point_size;
    how.snap = options_.snap;
    how.threads = options_.threads;
    Status status = find_topology(given_, plan_.topology, how);
    plan_.counts = plan_.topology.counts();
    if (status && options_.drop_repeated) {
      if (plan_.counts.repeated_patches > 0) {
        parts_ = without_repeated(given_, plan_.topology, plan_.patches);
        nets_ = parts_;
      }
      how.orient = options_.orient;
      status = find_topology(nets_, plan_.topology, how);
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
    return position_errors(plan_.set, errors_);
  }

  Status choose() {
    const CertifiedRates rates{plan_.nu, plan_.nv, diagonals_, plan_.deviations};
    RateReport report;
    if (is_uniform()) {
      std::fill(plan_.nu.begin(), plan_.nu.end(), options_.nu - 1);
      std::fill(plan_.nv.begin(), plan_.nv.end(), options_.nv - 1);
      std::size_t raised = 0;
      report.status = separate_vertices(plan_.topology, plan_.nu, plan_.nv, raised);
      report = report ? certify_rates<S>(nets_, plan_.topology, errors_, rates, options_.threads)
                      : report;
    } else {
      RateOptions how;
      how.errors = errors_;
      how.longest_edge = options_.longest_edge;
      how.normal_angle = options_.normal_angle;
      how.threads = options_.threads;
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

  /// The smallest of what is asked of each patch; far more than its size where nothing is.
  Status find_tolerances(RateOptions& how) {
    const double all = plan_.diagonal > 0 ? 1e3 * plan_.diagonal : 1;
    how.tolerance =
        std::min({options_.tolerance, options_.relative_tolerance * plan_.diagonal, all});
    const bool pixels = std::isfinite(options_.pixels);
    if (options_.tolerances.empty() && !pixels) {
      return Status::ok;
    }
    std::size_t given = 0;
    for (const ControlNets<S>& nets : given_) {
      given += nets.count;
    }
    if (!options_.tolerances.empty() && options_.tolerances.size() != given) {
      return Status::bad_rates;
    }
    tolerances_.assign(plan_.set.size(), how.tolerance);
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
    const Status status =
        lay_out_mesh(plan_.topology, {plan_.nu, plan_.nv, diagonals_}, plan_.layout);
    if (!status || !(options_.crease_angle < std::numeric_limits<double>::infinity())) {
      return std::isnan(options_.crease_angle) ? Status(Status::bad_tolerance) : status;
    }
    Options how;
    how.threads = options_.threads;
    how.isa = options_.isa;
    return split_creases(plan_.set, plan_.layout, options_.crease_angle, plan_.layout, how);
  }

  std::span<const ControlNets<S>> given_;
  std::span<const ControlNets<S>> nets_; ///< without what is left out
  std::vector<ControlNets<S>> parts_;
  const MeshOptions& options_;
  MeshPlan<T>& plan_;
  std::vector<double> errors_;
  std::vector<double> tolerances_;
  std::vector<std::uint16_t> diagonals_;
};

template <typename T>
Status evaluate_vertices(const MeshPlan<T>& plan, const MeshOptions& options, Mesh<T>& mesh) {
  const std::size_t vertices = plan.layout.size().vertices;
  MeshOutputs<T> out;
  mesh.positions.resize(vertices);
  out.position = Vectors<T>::xyz(mesh.positions);
  if (options.normals) {
    mesh.normals.resize(vertices);
    out.normal = Vectors<T>::xyz(mesh.normals);
  }
  if (options.parameters) {
    mesh.parameters.resize(vertices);
    mesh.patches.resize(vertices);
    T* const first = vertices == 0 ? nullptr : mesh.parameters.front().data();
    out.parameters = Vectors<T>::pairs(std::span<T>(first, 2 * vertices));
    out.patch = mesh.patches;
  }
  Options how;
  how.threads = options.threads;
  how.isa = options.isa;
  if (vertices == 0) {
    return Status::ok;
  }
  const Status status = evaluate_mesh(plan.set, plan.layout, out, how);
  if (!plan.patches.empty()) {
    for (std::uint32_t& patch : mesh.patches) {
      patch = plan.patches[patch];
    }
  }
  return status;
}

template <typename T>
Status write_faces(const MeshPlan<T>& plan, const MeshOptions& options, Mesh<T>& mesh) {
  const MeshSize size = plan.layout.size();
  const auto write = [&]<typename Index>(std::vector<std::array<Index, 3>>& triangles) {
    triangles.resize(size.triangles);
    Index* const first = triangles.empty() ? nullptr : triangles.front().data();
    return write_triangles<Index>(plan.layout, std::span<Index>(first, 3 * size.triangles),
                                  options.threads);
  };
  const bool few = size.vertices <= std::numeric_limits<std::uint16_t>::max();
  return options.short_indices && few ? write(mesh.short_triangles) : write(mesh.triangles);
}

template <typename T>
Status fill_mesh(const MeshPlan<T>& plan, const MeshOptions& options, std::size_t given,
                 Mesh<T>& mesh) {
  if (const Status status = evaluate_vertices(plan, options, mesh); !status) {
    return status;
  }
  mesh.deviation = plan.deviation;
  mesh.counts = plan.counts;
  mesh.deviations.resize(given);
  for (std::size_t patch = 0; patch < plan.deviations.size(); ++patch) {
    mesh.deviations[plan.patches.empty() ? patch : plan.patches[patch]] = plan.deviations[patch];
  }
  return write_faces(plan, options, mesh);
}

/// Runs a step that may throw; an empty result with the status where it does not succeed.
template <typename Result, typename Step>
Result attempt(const Step& step) noexcept {
  Result result;
  try {
    result.status = step(result);
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  } catch (const std::length_error&) {
    result.status = Status::size_overflow;
  }
  if (result) {
    return result;
  }
  Result none;
  none.status = result.status;
  none.fault_patch = result.fault_patch;
  return none;
}

} // namespace
} // namespace detail

template <typename T, typename S>
MeshPlan<T> plan_mesh(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  return detail::attempt<MeshPlan<T>>(
      [&](MeshPlan<T>& plan) { return detail::Planner<T, S>(nets, options, plan).run(); });
}

template <typename T, typename S>
Mesh<T> tessellate(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  return detail::attempt<Mesh<T>>([&](Mesh<T>& mesh) {
    const MeshPlan<T> plan = plan_mesh<T>(nets, options);
    mesh.fault_patch = plan.fault_patch;
    std::size_t given = 0;
    for (const ControlNets<S>& view : nets) {
      given += view.count;
    }
    return plan ? detail::fill_mesh(plan, options, given, mesh) : plan.status;
  });
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API MeshPlan<T> plan_mesh(std::span<const ControlNets<S>>,                   \
                                                const MeshOptions&) noexcept;                      \
  template SIMDBEZIER_API Mesh<T> tessellate(std::span<const ControlNets<S>>,                      \
                                             const MeshOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
