// Triangles, polygons, strips and clusters of simdbezier.h.
#include <cstddef>

#include <simdbezier/mesh_layout.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kLayout{"layout"};

static_assert(std::uint32_t{SIMDBEZIER_MOST_CLUSTER_TRIANGLES} == kMostClusterTriangles);
static_assert(std::uint32_t{SIMDBEZIER_MOST_CLUSTER_VERTICES} == kMostClusterVertices);

// Clusters are written in place.
static_assert(sizeof(simdbezier_cluster) == sizeof(MeshCluster) &&
              offsetof(simdbezier_cluster, vertices) == offsetof(MeshCluster, vertices) &&
              offsetof(simdbezier_cluster, triangles) == offsetof(MeshCluster, triangles) &&
              offsetof(simdbezier_cluster, patch) == offsetof(MeshCluster, patch));

/// What a status of a writer is about.
auto about(const char* output) {
  return [output](Status status) -> Path {
    return blamed(status,
                  {{{Status::null_output, Status::output_too_small}, {output}},
                   {{Status::size_overflow}, kLayout},
                   {{Status::bad_patch_range}, kOptions / "first_patch or patch_count"}},
                  {});
  };
}

/// What C++ takes as two arguments.
struct Primitives {
  Options options;
  SetRange patches;
};

Primitives primitives_of(const simdbezier_primitive_options* given) {
  const auto known = read_options(given, kOptions);
  Primitives how{{.threads = known.threads}, range_of(known.first_patch, known.patch_count)};
  how.options.destination = destination_of(known.destination);
  return how;
}

/// write: write_triangles or write_strips.
template <typename Index, typename Write>
simdbezier_status indices_of(const char* function, const char* name, const Write& write,
                             const simdbezier_mesh_layout* layout, Index* indices,
                             std::size_t length,
                             const simdbezier_primitive_options* options) noexcept {
  return answer(function, [&] {
    const std::span<Index> out = span_of(indices, length, {name});
    const Primitives how = primitives_of(options);
    require_ok(write(object_of(layout, kLayout), out, how.options, how.patches), about(name));
  });
}

template <typename Index>
simdbezier_status polygons_of(const char* function, const simdbezier_mesh_layout* layout,
                              Index* indices, std::size_t length, std::uint8_t* sizes,
                              std::size_t sizes_length,
                              const simdbezier_primitive_options* options) noexcept {
  return answer(function, [&] {
    const std::span<Index> out = span_of(indices, length, {"indices"});
    const std::span<std::uint8_t> of = SIMDBEZIER_ARRAY(sizes);
    const Primitives how = primitives_of(options);
    require_ok(write_polygons(object_of(layout, kLayout), out, of, how.options, how.patches),
               about("indices or sizes"));
  });
}

void require_number(const std::size_t* number, const char* name) {
  require(number != nullptr, SIMDBEZIER_NULL_OUTPUT, {name});
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

// What is written as indices of 32 and of 16 bits.
#define SIMDBEZIER_INDICES(suffix, Index)                                                          \
  simdbezier_status simdbezier_write_triangles_##suffix(                                           \
      const simdbezier_mesh_layout* layout, Index* triangles, size_t length,                       \
      const simdbezier_primitive_options* options) {                                               \
    return indices_of(__func__, "triangles", write_triangles<Index>, layout, triangles, length,    \
                      options);                                                                    \
  }                                                                                                \
  simdbezier_status simdbezier_write_polygons_##suffix(                                            \
      const simdbezier_mesh_layout* layout, Index* indices, size_t length, uint8_t* sizes,         \
      size_t sizes_length, const simdbezier_primitive_options* options) {                          \
    return polygons_of(__func__, layout, indices, length, sizes, sizes_length, options);           \
  }                                                                                                \
  simdbezier_status simdbezier_write_strips_##suffix(                                              \
      const simdbezier_mesh_layout* layout, Index* indices, size_t length,                         \
      const simdbezier_primitive_options* options) {                                               \
    return indices_of(__func__, "indices", write_strips<Index>, layout, indices, length, options); \
  }
SIMDBEZIER_INDICES(u32, uint32_t)
SIMDBEZIER_INDICES(u16, uint16_t)

simdbezier_status simdbezier_polygon_size(const simdbezier_mesh_layout* layout, size_t* polygons,
                                          size_t* indices,
                                          const simdbezier_primitive_options* options) {
  return answer(__func__, [&] {
    require_number(polygons, "polygons");
    require_number(indices, "indices");
    const Primitives how = primitives_of(options);
    PolygonSize size;
    require_ok(polygon_size(object_of(layout, kLayout), size, how.options, how.patches), about(""));
    *polygons = size.polygons;
    *indices = size.indices;
  });
}

simdbezier_status simdbezier_strip_size(const simdbezier_mesh_layout* layout, size_t* indices,
                                        const simdbezier_primitive_options* options) {
  return answer(__func__, [&] {
    require_number(indices, "indices");
    std::size_t size = 0;
    const Primitives how = primitives_of(options);
    require_ok(strip_size(object_of(layout, kLayout), size, how.options, how.patches), about(""));
    *indices = size;
  });
}

simdbezier_status simdbezier_cluster_size(const simdbezier_mesh_layout* layout, size_t* clusters,
                                          size_t* vertices, size_t* triangles,
                                          const simdbezier_primitive_options* options) {
  return answer(__func__, [&] {
    require_number(clusters, "clusters");
    require_number(vertices, "vertices");
    require_number(triangles, "triangles");
    ClusterSize size;
    const Primitives how = primitives_of(options);
    require_ok(cluster_size(object_of(layout, kLayout), size, how.options, how.patches), about(""));
    *clusters = size.clusters;
    *vertices = size.vertices;
    *triangles = size.triangles;
  });
}

simdbezier_status simdbezier_write_clusters(const simdbezier_mesh_layout* layout,
                                            simdbezier_cluster* clusters, size_t clusters_length,
                                            uint32_t* vertices, size_t vertices_length,
                                            uint8_t* corners, size_t corners_length,
                                            const simdbezier_primitive_options* options) {
  return answer(__func__, [&] {
    const ClusterOutputs out{in_place<MeshCluster>(SIMDBEZIER_ARRAY(clusters)),
                             SIMDBEZIER_ARRAY(vertices), SIMDBEZIER_ARRAY(corners)};
    const Primitives how = primitives_of(options);
    require_ok(write_clusters(object_of(layout, kLayout), out, how.options, how.patches),
               about("clusters, vertices or corners"));
  });
}
