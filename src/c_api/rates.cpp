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

CertifiedRates rates_of(const simdbezier_rates* given) {
  const auto rates = read(given, kRates);
  return {SIMDBEZIER_SPAN(rates, cells_u), SIMDBEZIER_SPAN(rates, cells_v),
          SIMDBEZIER_SPAN(rates, diagonals), SIMDBEZIER_SPAN(rates, deviation)};
}

RateOptions rate_options_of(const Given<simdbezier_rate_options>& known) {
  RateOptions options;
  set_limits(options, known);
  options.errors = SIMDBEZIER_SPAN(known, errors);
  if (known.most_segments != 0) {
    options.most_segments = known.most_segments;
  }
  options.keep = known.keep;
  return options;
}

/// What bad_rates is about: the first span that is not one value a patch, else rates themselves.
Path blamed_rates(const CertifiedRates& rates, std::size_t patches, bool without_diagonals) {
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
Path blamed_rates(const CertifiedRates& rates, std::size_t patches, const Topology& topology) {
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

/// Refuses the call as C++ did. tolerances(), rates(patches): what bad_tolerance and bad_rates are
/// about. Only options name an instruction set.
template <typename S, typename Tolerances, typename Rates>
void require_rates(const Report& report, std::span<const ControlNets<S>> nets,
                   Tolerances tolerances, Rates rates) {
  require_item(report, [&](Status status) {
    return blamed(status,
                  {{{Status::bad_tolerance}, tolerances()},
                   {{Status::bad_rates}, rates(detail::patches_of(nets))},
                   {{Status::snap_too_large, Status::bad_topology}, kTopology},
                   {{Status::unsupported_isa}, kOptions / "isa"}},
                  blamed_nets(status, nets, report.item));
  });
}

Path blamed_errors() { return kErrors; }

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_choose_rates(const simdbezier_nets* nets, size_t length,
                                          const simdbezier_topology* topology,
                                          const simdbezier_rate_options* options,
                                          const simdbezier_rates* rates) {
  return answer(__func__, [&] {
    const CertifiedRates out = rates_of(rates);
    const auto known = read(options, kOptions);
    const RateOptions how = rate_options_of(known);
    const RunOptions run{known.threads, isa_of(known.isa, kOptions / "isa")};
    const Topology& joined = object_of(topology, kTopology);
    with_net_array(nets, length, [&](const auto& views) {
      const Report report = choose_rates(views, joined, how, out, run);
      require_rates(
          report, views, [&] { return blamed_limit(how, report.item); },
          [&](std::size_t patches) {
            return !is_one_each(how.errors, patches)       ? kOptions / "errors"
                   : !is_one_each(how.tolerances, patches) ? kOptions / "tolerances"
                                                           : blamed_rates(out, patches, joined);
          });
    });
  });
}

simdbezier_status simdbezier_certify_rates(const simdbezier_nets* nets, size_t length,
                                           const simdbezier_topology* topology,
                                           const double* errors, size_t errors_length,
                                           const simdbezier_rates* rates,
                                           const simdbezier_options* options) {
  return answer(__func__, [&] {
    const CertifiedRates out = rates_of(rates);
    const std::span<const double> known = SIMDBEZIER_ARRAY(errors);
    const Topology& joined = object_of(topology, kTopology);
    const RunOptions run = call_options_of(options);
    with_net_array(nets, length, [&](const auto& views) {
      require_rates(certify_rates(views, joined, known, out, run), views, blamed_errors,
                    [&](std::size_t patches) {
                      return is_one_each(known, patches) ? blamed_rates(out, patches, joined)
                                                         : kErrors;
                    });
    });
  });
}

simdbezier_status simdbezier_certify_grids(const simdbezier_nets* nets, size_t length,
                                           uint32_t cells_u, uint32_t cells_v, const double* errors,
                                           size_t errors_length, double* deviation,
                                           size_t deviation_length,
                                           const simdbezier_options* options) {
  return answer(__func__, [&] {
    const std::span<const double> known = SIMDBEZIER_ARRAY(errors);
    const std::span<double> out = SIMDBEZIER_ARRAY(deviation);
    const RunOptions run = call_options_of(options);
    with_net_array(nets, length, [&](const auto& views) {
      require_rates(certify_grids(views, cells_u, cells_v, known, out, run), views, blamed_errors,
                    [&](std::size_t patches) -> Path {
                      return !is_one_each(known, patches) ? kErrors
                             : out.size() == patches      ? Path{"cells_u or cells_v"}
                                                          : Path{"deviation"};
                    });
    });
  });
}

simdbezier_status simdbezier_pixel_tolerances(const simdbezier_nets* nets, size_t length,
                                              const simdbezier_camera* camera, double pixels,
                                              double* tolerances, size_t tolerances_length) {
  return answer(__func__, [&] {
    const Camera seen_by = camera_of(camera, {"camera"});
    const std::span<double> out = SIMDBEZIER_ARRAY(tolerances);
    with_net_array(nets, length, [&](const auto& views) {
      require_ok(pixel_tolerances(views, seen_by, pixels, out), [&](Status status) {
        return blamed(status,
                      {{{Status::bad_tolerance}, {"pixels or camera"}},
                       {{Status::output_too_small}, {"tolerances"}}},
                      blamed_nets(status, {"nets"}));
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
    require_ok(separate_vertices(object_of(topology, kTopology), SIMDBEZIER_ARRAY(cells_u),
                                 SIMDBEZIER_ARRAY(cells_v), changed),
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
    const CertifiedRates of = rates_of(rates);
    const Topology& joined = object_of(topology, kTopology);
    const Options how = call_options_of(options);
    MeshLayout made;
    require_ok(lay_out_mesh(joined, {of.cells_u, of.cells_v, of.diagonals}, made, how),
               [&](Status status) {
                 const std::size_t patches = joined.counts().patches;
                 return blamed(
                     status,
                     {{{Status::bad_rates}, blamed_rates(of, patches, of.diagonals.empty())},
                      {{Status::out_of_memory}, {}}},
                     kRates);
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
