// Adjacency, topology, rates and numbering of simdbezier.h.
#include <limits>

#include <simdbezier/adjacency.hpp>
#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/topology.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kTopology{"topology"};
constexpr Path kRates{"rates"};

// Links are written in place.
static_assert(sizeof(simdbezier_edge_link) == sizeof(EdgeLink) &&
              offsetof(simdbezier_edge_link, kind) == offsetof(EdgeLink, kind) &&
              offsetof(simdbezier_edge_link, edge) == offsetof(EdgeLink, edge) &&
              offsetof(simdbezier_edge_link, reversed) == offsetof(EdgeLink, reversed) &&
              offsetof(simdbezier_edge_link, patch) == offsetof(EdgeLink, patch));
static_assert(SIMDBEZIER_EDGE_COLLAPSED == static_cast<int>(EdgeKind::collapsed));

struct RateSpans {
  std::span<std::uint32_t> nu;
  std::span<std::uint32_t> nv;
  std::span<std::uint16_t> diagonals;
  std::span<double> deviation;
};

RateSpans rates_of(const simdbezier_rates* given) {
  const simdbezier_rates known = read(given, kRates);
  return {span_of(known.nu, known.nu_length, kRates / "nu"),
          span_of(known.nv, known.nv_length, kRates / "nv"),
          span_of(known.diagonals, known.diagonals_length, kRates / "diagonals"),
          span_of(known.deviation, known.deviation_length, kRates / "deviation")};
}

CertifiedRates certified(const RateSpans& rates) {
  return {rates.nu, rates.nv, rates.diagonals, rates.deviation};
}

RateOptions rate_options_of(const simdbezier_rate_options* given) {
  const simdbezier_rate_options known = read(given, kOptions);
  RateOptions options;
  options.tolerance = known.tolerance;
  options.tolerances = span_of(known.tolerances, known.tolerances_length, kOptions / "tolerances");
  options.errors = span_of(known.errors, known.errors_length, kOptions / "errors");
  if (known.longest_edge != 0) {
    options.longest_edge = known.longest_edge;
  }
  if (known.most_segments != 0) {
    options.most_segments = known.most_segments;
  }
  if (known.normal_angle != 0) {
    options.normal_angle = known.normal_angle;
  }
  options.threads = known.threads;
  return options;
}

template <typename S>
void require_rates(const RateReport& report, std::span<const ControlNets<S>> nets) {
  if (report) {
    return;
  }
  Fault fault{code_of(report.status), {}, report.patch};
  switch (report.status.code()) {
  case Status::bad_tolerance:
    fault.path = kOptions / "tolerance";
    break;
  case Status::bad_rates:
    fault.path = kRates;
    break;
  default:
    fault.path = blamed_nets(report.status, nets_with_patch(nets, report.patch));
  }
  throw fault;
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_find_adjacency(const simdbezier_nets* nets, size_t length,
                                            simdbezier_edge_link* links, size_t link_length,
                                            const simdbezier_options* options) {
  return answer(__func__, [&] {
    const std::span<simdbezier_edge_link> out = span_of(links, link_length, {"links"});
    const CallOptions how(options);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      const std::span places(reinterpret_cast<EdgeLink*>(out.data()), out.size());
      require_ok(find_adjacency(views, Values<EdgeLink>(places), *how), [&](Status status) {
        const bool output = status == Status::null_output || status == Status::output_too_small ||
                            status == Status::overlapping_outputs;
        return output ? Path{"links"} : blamed_nets(status, {"nets"});
      });
    });
  });
}

simdbezier_status simdbezier_find_topology(const simdbezier_nets* nets, size_t length,
                                           const simdbezier_topology_options* options,
                                           simdbezier_topology** topology) {
  return answer(__func__, [&] {
    require_place(topology, kTopology);
    const simdbezier_topology_options known = read_options(options, kOptions);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      Topology found;
      TopologyOptions how;
      how.point_size = known.point_size;
      how.orient = known.orient != 0;
      how.flip = known.flip != 0;
      how.snap = known.snap;
      how.threads = known.threads;
      require_ok(find_topology(views, found, how), [&](Status status) {
        return status == Status::bad_tolerance ? kOptions / "point_size or snap"
                                               : blamed_nets(status, {"nets"});
      });
      give(topology, std::move(found));
    });
  });
}

void simdbezier_topology_free(simdbezier_topology* topology) { delete topology; }

simdbezier_status simdbezier_topology_count(const simdbezier_topology* topology,
                                            simdbezier_topology_counts* counts) {
  return answer(__func__, [&] {
    require_writable(counts, {"counts"});
    write(counts, counts_of(object_of(topology, kTopology).counts()));
  });
}

int32_t simdbezier_topology_is_turned(const simdbezier_topology* topology, size_t patch) {
  return topology != nullptr && patch < topology->of.counts().patches &&
                 topology->of.is_turned(patch)
             ? 1
             : 0;
}

int32_t simdbezier_topology_is_repeated(const simdbezier_topology* topology, size_t patch) {
  return topology != nullptr && patch < topology->of.counts().patches &&
                 topology->of.is_repeated(patch)
             ? 1
             : 0;
}

simdbezier_status simdbezier_choose_rates(const simdbezier_nets* nets, size_t length,
                                          const simdbezier_topology* topology,
                                          const simdbezier_rate_options* options,
                                          const simdbezier_rates* rates) {
  return answer(__func__, [&] {
    const RateSpans out = rates_of(rates);
    const RateOptions how = rate_options_of(options);
    const Topology& joined = object_of(topology, kTopology);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      require_rates(choose_rates(views, joined, how, certified(out)), views);
    });
  });
}

simdbezier_status simdbezier_certify_rates(const simdbezier_nets* nets, size_t length,
                                           const simdbezier_topology* topology,
                                           const double* errors, size_t errors_length,
                                           const simdbezier_rates* rates, int32_t threads) {
  return answer(__func__, [&] {
    const RateSpans out = rates_of(rates);
    const std::span<const double> known = span_of(errors, errors_length, {"errors"});
    const Topology& joined = object_of(topology, kTopology);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      require_rates(certify_rates(views, joined, known, certified(out), threads), views);
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

simdbezier_status simdbezier_separate_vertices(const simdbezier_topology* topology, uint32_t* nu,
                                               size_t nu_length, uint32_t* nv, size_t nv_length,
                                               size_t* raised) {
  return answer(__func__, [&] {
    std::size_t changed = 0;
    require_ok(separate_vertices(object_of(topology, kTopology), span_of(nu, nu_length, {"nu"}),
                                 span_of(nv, nv_length, {"nv"}), changed),
               [](Status) { return Path{"nu or nv"}; });
    if (raised != nullptr) {
      *raised = changed;
    }
  });
}

simdbezier_status simdbezier_lay_out_mesh(const simdbezier_topology* topology,
                                          const simdbezier_rates* rates,
                                          simdbezier_mesh_layout** layout) {
  return answer(__func__, [&] {
    require_place(layout, {"layout"});
    const RateSpans of = rates_of(rates);
    MeshLayout made;
    require_ok(lay_out_mesh(object_of(topology, kTopology), {of.nu, of.nv, of.diagonals}, made),
               [](Status status) { return status == Status::out_of_memory ? Path{} : kRates; });
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
