// mesh_primitives.hpp: the cells of a mesh as triangles, polygons, strips or clusters.
#pragma once

#include <simdbezier/c/models.h>

SIMDBEZIER_BEGIN_C

// write_triangles(): three numbers a triangle. `length` counts elements, as everywhere.
SIMDBEZIER_API simdbezier_status simdbezier_write_triangles_u32(
    const simdbezier_mesh_layout* layout, uint32_t* triangles, size_t length, int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_triangles_u16(
    const simdbezier_mesh_layout* layout, uint16_t* triangles, size_t length, int32_t threads);

// polygon_size(), write_polygons(): quads and triangles; sizes has 3 or 4 a polygon.
SIMDBEZIER_API simdbezier_status simdbezier_polygon_size(const simdbezier_mesh_layout* layout,
                                                         size_t* polygons, size_t* indices,
                                                         int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_polygons_u32(const simdbezier_mesh_layout* layout,
                                                               uint32_t* indices, size_t length,
                                                               uint8_t* sizes, size_t sizes_length,
                                                               int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_polygons_u16(const simdbezier_mesh_layout* layout,
                                                               uint16_t* indices, size_t length,
                                                               uint8_t* sizes, size_t sizes_length,
                                                               int32_t threads);

// strip_size(), write_strips(): the largest index ends a strip.
SIMDBEZIER_API simdbezier_status simdbezier_strip_size(const simdbezier_mesh_layout* layout,
                                                       size_t* indices, int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_strips_u32(const simdbezier_mesh_layout* layout,
                                                             uint32_t* indices, size_t length,
                                                             int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_strips_u16(const simdbezier_mesh_layout* layout,
                                                             uint16_t* indices, size_t length,
                                                             int32_t threads);

// MeshCluster.
typedef struct simdbezier_cluster {
  uint32_t first_vertex;
  uint32_t first_triangle;
  uint32_t vertices;
  uint32_t triangles;
  uint32_t patch;
} simdbezier_cluster;

// cluster_size(), write_clusters(): corners has three values a triangle.
SIMDBEZIER_API simdbezier_status simdbezier_cluster_size(const simdbezier_mesh_layout* layout,
                                                         size_t* clusters, size_t* vertices,
                                                         size_t* triangles, int32_t threads);
SIMDBEZIER_API simdbezier_status simdbezier_write_clusters(const simdbezier_mesh_layout* layout,
                                                           simdbezier_cluster* clusters,
                                                           size_t clusters_length,
                                                           uint32_t* vertices,
                                                           size_t vertices_length, uint8_t* corners,
                                                           size_t corners_length, int32_t threads);

SIMDBEZIER_END_C
