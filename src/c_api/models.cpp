// Adjacency and topology of simdbezier.h.
#include <simdbezier/topology.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"
#include "src/mesh/topology/fit.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kNets{"nets"};
constexpr Path kTopology{"topology"};

// Links are written in place.
static_assert(sizeof(simdbezier_edge_link) == sizeof(EdgeLink) &&
              offsetof(simdbezier_edge_link, kind) == offsetof(EdgeLink, kind) &&
              offsetof(simdbezier_edge_link, edge) == offsetof(EdgeLink, edge) &&
              offsetof(simdbezier_edge_link, reversed) == offsetof(EdgeLink, reversed) &&
              offsetof(simdbezier_edge_link, patch) == offsetof(EdgeLink, patch));
static_assert(SIMDBEZIER_EDGE_COLLAPSED == static_cast<int>(EdgeKind::collapsed));

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_find_adjacency(const simdbezier_nets* nets, size_t length,
                                            simdbezier_edge_link* links, size_t link_length,
                                            const simdbezier_options* options) {
  return answer(__func__, [&] {
    const std::span<EdgeLink> out = in_place<EdgeLink>(span_of(links, link_length, {"links"}));
    const Options how = call_options_of(options);
    with_net_array(nets, length, [&](const auto& views) {
      require_ok(find_adjacency(views, Values<EdgeLink>(out), how), [&](Status status) {
        return blamed(status, {{kOutputFaults, {"links"}}}, blamed_nets(status, kNets));
      });
    });
  });
}

simdbezier_status simdbezier_find_topology(const simdbezier_nets* nets, size_t length,
                                           const simdbezier_topology_options* options,
                                           simdbezier_topology** topology) {
  return answer(__func__, [&] {
    require_place(topology, kTopology);
    const auto known = read_options(options, kOptions);
    TopologyOptions how;
    how.point_size = known.point_size;
    how.orient = known.orient != 0;
    how.flip = known.flip != 0;
    how.snap = known.snap;
    with_net_array(nets, length, [&](const auto& views) {
      Topology found;
      require_ok(find_topology(views, found, how, {.threads = known.threads}), [&](Status status) {
        return blamed(status,
                      {{{Status::bad_tolerance}, kOptions / "point_size or snap"},
                       {{Status::not_orientable}, kOptions / "orient"}},
                      blamed_nets(status, kNets));
      });
      give(topology, std::move(found));
    });
  });
}

simdbezier_status simdbezier_topology_fits(const simdbezier_topology* topology,
                                           const simdbezier_nets* nets, size_t length,
                                           int32_t threads, int32_t* fits) {
  return answer(__func__, [&] {
    const Topology& joined = object_of(topology, kTopology);
    require(fits != nullptr, SIMDBEZIER_NULL_OUTPUT, {"fits"});
    with_net_array(nets, length, [&](const auto& views) {
      require_ok(detail::check_model(views),
                 [](Status status) { return blamed_nets(status, kNets); });
      *fits = simdbezier::fits(joined, views, {.threads = threads}) ? 1 : 0;
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
  return topology != nullptr && topology->of.is_turned(patch) ? 1 : 0;
}

int32_t simdbezier_topology_is_repeated(const simdbezier_topology* topology, size_t patch) {
  return topology != nullptr && topology->of.is_repeated(patch) ? 1 : 0;
}
