// Adjacency, topology, and parts of a model of simdbezier.h.
#include <cstddef>

#include <simdbezier/mesh_layout.hpp>
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

constexpr Path kPart{"part"};

// Keys and numbers are read and written in place.
static_assert(sizeof(simdbezier_patch_keys) == sizeof(PatchKeys) &&
              offsetof(simdbezier_patch_keys, corners) == offsetof(PatchKeys, corners) &&
              offsetof(simdbezier_patch_keys, edges) == offsetof(PatchKeys, edges) &&
              offsetof(simdbezier_patch_keys, points) == offsetof(PatchKeys, points));
static_assert(sizeof(simdbezier_patch_vertices) == sizeof(PatchVertices) &&
              offsetof(simdbezier_patch_vertices, corners) == offsetof(PatchVertices, corners) &&
              offsetof(simdbezier_patch_vertices, edges) == offsetof(PatchVertices, edges));
static_assert(kUnknownVertex == UINT64_MAX && kNoLayoutVertex == UINT32_MAX);

/// What a status of a call about a part is about.
auto about(const char* output) {
  return [output](Status status) -> Path {
    return blamed(status,
                  {{{Status::bad_patch_range}, {"own_first or own_count"}},
                   {{Status::unequal_lengths}, {"ghosts_length"}}},
                  {output});
  };
}

bool is_edge(simdbezier_edge edge) { return edge >= 0 && edge <= SIMDBEZIER_EDGE_U1; }

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

simdbezier_status simdbezier_find_patch_keys(const simdbezier_nets* nets, size_t length,
                                             simdbezier_patch_keys* keys, size_t keys_length,
                                             const simdbezier_options* options) {
  return answer(__func__, [&] {
    const std::span<PatchKeys> out = in_place<PatchKeys>(SIMDBEZIER_ARRAY(keys));
    const Options how = call_options_of(options);
    with_net_array(nets, length, [&](const auto& views) {
      require_ok(find_patch_keys(views, out, how), [](Status status) {
        return status == Status::output_too_small ? Path{"keys"} : blamed_nets(status, {"nets"});
      });
    });
  });
}

simdbezier_status simdbezier_owned_vertices(const simdbezier_mesh_layout* part, size_t own_first,
                                            size_t own_count, uint64_t first_vertex,
                                            simdbezier_patch_vertices* out, size_t length) {
  return answer(__func__, [&] {
    const auto places = in_place<PatchVertices>(span_of(out, length, {"out"}));
    require_ok(owned_vertices(object_of(part, kPart), {own_first, own_count}, first_vertex, places),
               about("out"));
  });
}

simdbezier_status simdbezier_number_part(const simdbezier_mesh_layout* part, size_t own_first,
                                         size_t own_count, uint64_t first_vertex,
                                         const simdbezier_patch_vertices* ghosts,
                                         size_t ghosts_length, uint64_t* numbers,
                                         size_t numbers_length) {
  return answer(__func__, [&] {
    const auto told = in_place<const PatchVertices>(SIMDBEZIER_ARRAY(ghosts));
    const std::span<std::uint64_t> out = SIMDBEZIER_ARRAY(numbers);
    require_ok(number_part(object_of(part, kPart), {own_first, own_count}, first_vertex, told, out),
               about("numbers"));
  });
}

int32_t simdbezier_topology_is_entangled(const simdbezier_topology* topology, size_t patch) {
  return topology != nullptr && topology->of.is_entangled(patch) ? 1 : 0;
}

uint32_t simdbezier_mesh_layout_corner(const simdbezier_mesh_layout* layout, size_t patch,
                                       size_t corner) {
  return layout == nullptr ? kNoLayoutVertex : layout->of.corner(patch, corner);
}

uint32_t simdbezier_mesh_layout_segments(const simdbezier_mesh_layout* layout, size_t patch,
                                         simdbezier_edge edge) {
  return layout == nullptr || !is_edge(edge)
             ? 0
             : layout->of.segments(patch, static_cast<PatchEdge>(edge));
}

uint32_t simdbezier_mesh_layout_along(const simdbezier_mesh_layout* layout, size_t patch,
                                      simdbezier_edge edge, uint32_t k) {
  return layout == nullptr || !is_edge(edge)
             ? kNoLayoutVertex
             : layout->of.along(patch, static_cast<PatchEdge>(edge), k);
}

uint32_t simdbezier_mesh_layout_inner(const simdbezier_mesh_layout* layout, size_t patch,
                                      uint32_t i, uint32_t j) {
  return layout == nullptr ? kNoLayoutVertex : layout->of.inner(patch, i, j);
}
