// See mesh.hpp, and splines.hpp for meshes of splines.
#include <simdbezier/mesh.hpp>

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/splines.hpp>

#include "src/mesh/mesh_planner.hpp"
#include "src/runtime/attempt.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/splines/spline_knots.hpp"

namespace simdbezier {
namespace detail {
namespace {

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
  if (vertices == 0) {
    return Status::ok;
  }
  const Status status =
      evaluate_mesh(plan.set, plan.layout, out, {.threads = options.threads, .isa = options.isa});
  for (std::size_t k = 0; k < mesh.patches.size() && !plan.pieces.empty(); ++k) {
    const PatchPiece& piece = plan.pieces[mesh.patches[k]];
    const auto [u, v] = mesh.parameters[k];
    mesh.parameters[k] = {static_cast<T>(piece.whole_u(static_cast<double>(u))),
                          static_cast<T>(piece.whole_v(static_cast<double>(v)))};
  }
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
                                  {.threads = options.threads, .isa = options.isa});
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
  mesh.splits = plan.splits;
  mesh.deviations.resize(given);
  for (std::size_t patch = 0; patch < plan.deviations.size(); ++patch) {
    double& deviation = mesh.deviations[plan.patches.empty() ? patch : plan.patches[patch]];
    deviation = std::max(deviation, plan.deviations[patch]);
  }
  return write_faces(plan, options, mesh);
}

/// The plan that `make(plan)` makes, and its mesh.
template <typename T, typename Make>
MeshPlan<T> planned(const Make& make) noexcept {
  const DefaultFpEnvironment environment;
  RateFault fault; // which is all that a plan has beside its report if it is refused
  MeshPlan<T> plan = attempt<MeshPlan<T>>([&](MeshPlan<T>& made) {
    const Status status = make(made);
    fault = made.fault;
    return status;
  });
  plan.fault = fault;
  return plan;
}
template <typename T, typename Make>
Mesh<T> tessellated(const MeshOptions& options, const Make& make) noexcept {
  const DefaultFpEnvironment environment; // comparisons would lose tiny deviations
  return attempt<Mesh<T>>([&](Mesh<T>& mesh) {
    std::size_t given = 0;
    const MeshPlan<T> plan = make(given);
    mesh.report = plan.report;
    return plan ? fill_mesh(plan, options, given, mesh) : plan.report.status;
  });
}

/// The nets of splines, and how far they may be from them.
template <typename S>
class CutSplines {
public:
  Report cut(std::span<const SplineSurface<S>> surfaces, const RunOptions& how) {
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      if (surfaces[k].components != 3) { // of all, before the first of them is cut
        return {Status::bad_components, k};
      }
    }
    for (std::size_t first = 0, end = 0; first < surfaces.size(); first = end) {
      for (end = first + 1; end < surfaces.size() && are_alike(surfaces[first], surfaces[end]);) {
        ++end;
      }
      if (Report report = cut_alike(surfaces.subspan(first, end - first), how); !report) {
        report.item += first;
        return report;
      }
    }
    return {};
  }
  [[nodiscard]] std::span<const ControlNets<S>> nets() const noexcept { return nets_; }
  [[nodiscard]] std::span<const double> errors() const noexcept { return errors_; }

private:
  static bool are_alike(const SplineSurface<S>& a, const SplineSurface<S>& b) noexcept {
    return a.degree_u == b.degree_u && a.degree_v == b.degree_v &&
           (a.weights == Weights::none) == (b.weights == Weights::none);
  }

  Report cut_alike(std::span<const SplineSurface<S>> surfaces, const RunOptions& how) {
    std::vector<std::size_t> counts;
    for (const SplineSurface<S>& surface : surfaces) {
      counts.push_back(spans_of(surface).patches()); // none where it is refused
    }
    const std::size_t patches = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    const SplineSurface<S>& like = surfaces.front();
    MutableNets<S> out = MutableNets<S>::packed(
        nullptr, patches, like.degree_u, like.degree_v, 3,
        like.weights == Weights::none ? Weights::none : Weights::homogeneous);
    values_.emplace_back(patches * static_cast<std::size_t>(std::max<std::ptrdiff_t>(
                                       out.patch_stride, 0))); // of degrees that are refused
    out.points = values_.back().data();
    if (const Report report = to_bezier(surfaces, out, {}, how); !report) {
      return report;
    }
    nets_.push_back(out);
    for (std::size_t k = 0; k < counts.size(); ++k) {
      errors_.insert(errors_.end(), counts[k], extraction_error(surfaces[k]));
    }
    return {};
  }

  std::vector<std::vector<S>> values_;
  std::vector<ControlNets<S>> nets_;
  std::vector<double> errors_;
};

/// given: the number of patches that the splines have.
template <typename T, typename S>
MeshPlan<T> planned_splines(std::span<const SplineSurface<S>> surfaces, const MeshOptions& options,
                            Report* report, std::size_t& given) noexcept {
  Report unasked;
  Report& found = report == nullptr ? unasked : *report;
  found = {};
  return planned<T>([&](MeshPlan<T>& plan) -> Status {
    if (surfaces.data() == nullptr && !surfaces.empty()) {
      found = {Status::null_input};
      return found.status;
    }
    CutSplines<S> splines;
    found = splines.cut(surfaces, options);
    given = splines.errors().size();
    return found ? MeshPlanner<T, S>(splines.nets(), splines.errors(), options, plan).run()
                 : found.status;
  });
}

} // namespace
} // namespace detail

template <typename T, typename S>
MeshPlan<T> plan_mesh(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  return detail::planned<T>(
      [&](MeshPlan<T>& plan) { return detail::MeshPlanner<T, S>(nets, {}, options, plan).run(); });
}

template <typename T, typename S>
Report plan_again(std::span<const ControlNets<S>> nets, const MeshOptions& options,
                  MeshPlan<T>& plan) noexcept try {
  const detail::DefaultFpEnvironment environment;
  plan.report = {};
  plan.fault = {};
  plan.layout = {};
  plan.deviation = 0;
  if (detail::is_missing(nets)) {
    plan.report.status = Status::null_input;
  } else if (!plan.patches.empty() || detail::patches_of(nets) != plan.set.size()) {
    plan.report.status = Status::bad_topology;
  } else if (plan.errors.size() != plan.set.size()) {
    plan.report.status = Status::bad_rates;
  } else {
    plan.report.status = detail::MeshPlanner<T, S>(nets, {}, options, plan).run_again();
  }
  return plan.report;
} catch (const std::bad_alloc&) {
  return plan.report = {Status::out_of_memory};
} catch (const std::length_error&) {
  return plan.report = {Status::size_overflow};
}

template <typename T, typename S>
Mesh<T> tessellate(std::span<const ControlNets<S>> nets, const MeshOptions& options) noexcept {
  return detail::tessellated<T>(options, [&](std::size_t& given) {
    MeshPlan<T> plan = plan_mesh<T>(nets, options);
    given = plan ? detail::patches_of(nets) : 0;
    return plan;
  });
}

template <typename T, typename S>
MeshPlan<T> plan_mesh(std::span<const SplineSurface<S>> surfaces, const MeshOptions& options,
                      Report* report) noexcept {
  std::size_t given = 0;
  return detail::planned_splines<T, S>(surfaces, options, report, given);
}

template <typename T, typename S>
Mesh<T> tessellate(std::span<const SplineSurface<S>> surfaces, const MeshOptions& options,
                   Report* report) noexcept {
  return detail::tessellated<T>(options, [&](std::size_t& given) {
    return detail::planned_splines<T, S>(surfaces, options, report, given);
  });
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API MeshPlan<T> plan_mesh<T, S>(std::span<const ControlNets<S>>,             \
                                                      const MeshOptions&) noexcept;                \
  template SIMDBEZIER_API Report plan_again<T, S>(std::span<const ControlNets<S>>,                 \
                                                  const MeshOptions&, MeshPlan<T>&) noexcept;      \
  template SIMDBEZIER_API Mesh<T> tessellate<T, S>(std::span<const ControlNets<S>>,                \
                                                   const MeshOptions&) noexcept;                   \
  template SIMDBEZIER_API MeshPlan<T> plan_mesh<T, S>(std::span<const SplineSurface<S>>,           \
                                                      const MeshOptions&, Report*) noexcept;       \
  template SIMDBEZIER_API Mesh<T> tessellate<T, S>(std::span<const SplineSurface<S>>,              \
                                                   const MeshOptions&, Report*) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
