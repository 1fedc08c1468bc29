// Rates and numbering of simdbezier.h.
#include <tuple>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/rates.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kTopology{"topology"};
constexpr Path kRates{"rates"};
constexpr Path kErrors{"errors"};

static_assert(std::uint32_t{SIMDBEZIER_MOST_SEGMENTS} == kMostSegments);
static_assert(std::uint32_t{SIMDBEZIER_MOST_GRID_CELLS} == kMostGridCells);

struct RateSpans {
  std::span<std::uint32_t> cells_u;
  std::span<std::uint32_t> cells_v;
  std::span<std::uint16_t> diagonals;
  std::span<double> deviation;
};

RateSpans rates_of(const simdbezier_rates* given) {
  const simdbezier_rates known = read(given, kRates);
  return {span_of(known.cells_u, known.cells_u_length, kRates / "cells_u"),
          span_of(known.cells_v, known.cells_v_length, kRates / "cells_v"),
          span_of(known.diagonals, known.diagonals_length, kRates / "diagonals"),
          span_of(known.deviation, known.deviation_length, kRates / "deviation")};
}

CertifiedRates certified(const RateSpans& rates) {
  return {rates.cells_u, rates.cells_v, rates.diagonals, rates.deviation};
}

RateOptions rate_options_of(const simdbezier_rate_options* given) {
  const simdbezier_rate_options known = read(given, kOptions);
  RateOptions options;
  options.tolerance = limit_of(known.tolerance);
  options.tolerances = span_of(known.tolerances, known.tolerances_length, kOptions / "tolerances");
  options.errors = span_of(known.errors, known.errors_length, kOptions / "errors");
  options.longest_edge = limit_of(known.longest_edge);
  if (known.most_segments != 0) {
    options.most_segments = known.most_segments;
  }
  options.normal_degrees = limit_of(known.normal_degrees);
  options.keep = known.keep;
  return options;
}

/// What bad_rates is about: the first span that is not one value a patch, else rates themselves.
Path blamed_rates(const RateSpans& rates, std::size_t patches, bool without_diagonals) {
  const std::tuple<const char*, std::size_t, bool> members[] = {
      {"cells_u", rates.cells_u.size(), false},
      {"cells_v", rates.cells_v.size(), false},
      {"diagonals", rates.diagonals.size(), without_diagonals},
      {"deviation", rates.deviation.size(), rates.deviation.empty()}};
  for (const auto& [name, length, is_left_out] : members) {
    if (length != patches && !is_left_out) {
      return kRates / name;
    }
  }
  return kRates / "cells_u or cells_v";
}

/// The rates that a call with a topology is about, which may be that of another model.
Path blamed_rates(const RateSpans& rates, std::size_t patches, const Topology& topology) {
  return topology.counts().patches == patches ? blamed_rates(rates, patches, false) : kTopology;
}

/// What bad_tolerance is about.
Path blamed_limit(const RateOptions& options, std::size_t patch) {
  if (!(options.longest_edge > 0)) {
    return kOptions / "longest_edge";
  }
  return options.normal_degrees > 0 ? blamed_tolerance(options, patch)
                                    : kOptions / "normal_degrees";
}

/// Refuses the call as C++ did. blamed(status) names what bad_tolerance and bad_rates are about.
/// Only options name an instruction set.
template <typename S, typename Blamed>
void require_rates(const Report& report, std::span<const ControlNets<S>> nets, Blamed blamed) {
  if (report) {
    return;
  }
  const auto blamed_here = [&]() -> Path {
    switch (report.status.code()) {
    case Status::bad_tolerance:
    case Status::bad_rates:
      return blamed(report.status);
    case Status::snap_too_large:
    case Status::bad_topology:
      return kTopology;
    case Status::unsupported_isa:
      return kOptions / "isa";
    default:
      return blamed_nets(report.status, nets_with_patch(nets, report.item));
    }
  };
  throw Fault{code_of(report.status), blamed_here(), report.item};
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_choose_rates(const simdbezier_nets* nets, size_t length,
                                          const simdbezier_topology* topology,
                                          const simdbezier_rate_options* options,
                                          const simdbezier_rates* rates) {
  return answer(__func__, [&] {
    const RateSpans out = rates_of(rates);
    const RateOptions how = rate_options_of(options);
    const simdbezier_rate_options known = read(options, kOptions);
    const RunOptions run{known.threads, isa_of(known.isa, kOptions / "isa")};
    const Topology& joined = object_of(topology, kTopology);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      const Report report = choose_rates(views, joined, how, certified(out), run);
      require_rates(report, views, [&](Status status) {
        const std::size_t patches = detail::patches_of(views);
        if (status == Status::bad_tolerance) {
          return blamed_limit(how, report.item);
        }
        if (!is_one_each(how.errors, patches)) {
          return kOptions / "errors";
        }
        return is_one_each(how.tolerances, patches) ? blamed_rates(out, patches, joined)
                                                    : kOptions / "tolerances";
      });
    });
  });
}

simdbezier_status simdbezier_certify_rates(const simdbezier_nets* nets, size_t length,
                                           const simdbezier_topology* topology,
                                           const double* errors, size_t errors_length,
                                           const simdbezier_rates* rates, int32_t threads) {
  return answer(__func__, [&] {
    const RateSpans out = rates_of(rates);
    const std::span<const double> known = span_of(errors, errors_length, kErrors);
    const Topology& joined = object_of(topology, kTopology);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      const Report report =
          certify_rates(views, joined, known, certified(out), {.threads = threads});
      require_rates(report, views, [&](Status status) {
        const std::size_t patches = detail::patches_of(views);
        const bool of_errors = status == Status::bad_tolerance || !is_one_each(known, patches);
        return of_errors ? kErrors : blamed_rates(out, patches, joined);
      });
    });
  });
}

simdbezier_status simdbezier_certify_grids(const simdbezier_nets* nets, size_t length,
                                           uint32_t cells_u, uint32_t cells_v, const double* errors,
                                           size_t errors_length, double* deviation,
                                           size_t deviation_length, int32_t threads) {
  return answer(__func__, [&] {
    const std::span<const double> known = span_of(errors, errors_length, kErrors);
    const std::span<double> out = span_of(deviation, deviation_length, {"deviation"});
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      const Report report =
          certify_grids(views, cells_u, cells_v, known, out, {.threads = threads});
      require_rates(report, views, [&](Status status) -> Path {
        const std::size_t patches = detail::patches_of(views);
        if (status == Status::bad_tolerance || !is_one_each(known, patches)) {
          return kErrors;
        }
        return {out.size() == patches ? "cells_u or cells_v" : "deviation"};
      });
    });
  });
}

simdbezier_status simdbezier_pixel_tolerances(const simdbezier_nets* nets, size_t length,
                                              const simdbezier_camera* camera, double pixels,
                                              double* tolerances, size_t tolerances_length) {
  return answer(__func__, [&] {
    const Camera seen_by = camera_of(camera, {"camera"});
    const std::span<double> out = span_of(tolerances, tolerances_length, {"tolerances"});
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      require_ok(pixel_tolerances(views, seen_by, pixels, out), [&](Status status) -> Path {
        switch (status.code()) {
        case Status::bad_tolerance:
          return {"pixels or camera"};
        case Status::output_too_small:
          return {"tolerances"};
        default:
          return blamed_nets(status, {"nets"});
        }
      });
    });
  });
}

simdbezier_status simdbezier_separate_vertices(const simdbezier_topology* topology,
                                               uint32_t* cells_u, size_t cells_u_length,
                                               uint32_t* cells_v, size_t cells_v_length,
                                               size_t* raised) {
  return answer(__func__, [&] {
    std::size_t changed = 0;
    require_ok(separate_vertices(object_of(topology, kTopology),
                                 span_of(cells_u, cells_u_length, {"cells_u"}),
                                 span_of(cells_v, cells_v_length, {"cells_v"}), changed),
               [](Status) { return Path{"cells_u or cells_v"}; });
    if (raised != nullptr) {
      *raised = changed;
    }
  });
}

simdbezier_status simdbezier_lay_out_mesh(const simdbezier_topology* topology,
                                          const simdbezier_rates* rates,
                                          const simdbezier_options* options,
                                          simdbezier_mesh_layout** layout) {
  return answer(__func__, [&] {
    require_place(layout, {"layout"});
    const RateSpans of = rates_of(rates);
    const Topology& joined = object_of(topology, kTopology);
    const Options how = call_options_of(options);
    MeshLayout made;
    require_ok(lay_out_mesh(joined, {of.cells_u, of.cells_v, of.diagonals}, made, how),
               [&](Status status) {
                 if (status == Status::bad_rates) {
                   return blamed_rates(of, joined.counts().patches, of.diagonals.empty());
                 }
                 return status == Status::out_of_memory ? Path{} : kRates;
               });
    give(layout, std::move(made));
  });
}

void simdbezier_mesh_layout_free(simdbezier_mesh_layout* layout) { delete layout; }

size_t simdbezier_mesh_layout_vertices(const simdbezier_mesh_layout* layout) {
  return layout == nullptr ? 0 : layout->of.size().vertices;
}

size_t simdbezier_mesh_layout_triangles(const simdbezier_mesh_layout* layout) {
  return layout == nullptr ? 0 : layout->of.size().triangles;
}

size_t simdbezier_mesh_layout_first_vertex(const simdbezier_mesh_layout* layout, size_t patch) {
  return layout == nullptr ? 0 : layout->of.first_vertex(patch);
}

size_t simdbezier_mesh_layout_first_triangle(const simdbezier_mesh_layout* layout, size_t patch) {
  return layout == nullptr ? 0 : layout->of.first_triangle(patch);
}
