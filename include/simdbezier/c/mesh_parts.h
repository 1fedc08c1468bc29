// mesh_layout.hpp: parts of a model that several processes work on; single vertices of a layout.
#pragma once

#include <simdbezier/c/curves.h> // names of edges
#include <simdbezier/c/models.h>

SIMDBEZIER_BEGIN_C

// PatchKeys.
typedef struct simdbezier_patch_keys {
  uint64_t corners[4];
  uint64_t edges[4];
  uint8_t points; // bits: 1 << SIMDBEZIER_EDGE_V0 …
} simdbezier_patch_keys;

// find_patch_keys(): one element a patch.
SIMDBEZIER_API simdbezier_status simdbezier_find_patch_keys(const simdbezier_nets* nets,
                                                            size_t length,
                                                            simdbezier_patch_keys* keys,
                                                            size_t keys_length,
                                                            const simdbezier_options* options);

// PatchVertices. kUnknownVertex is UINT64_MAX.
typedef struct simdbezier_patch_vertices {
  uint64_t corners[4];
  uint64_t edges[4];
} simdbezier_patch_vertices;

// owned_vertices(), number_part(): own patches are own_count from own_first on; here, 0 means none.
SIMDBEZIER_API simdbezier_status simdbezier_owned_vertices(const simdbezier_mesh_layout* part,
                                                           size_t own_first, size_t own_count,
                                                           uint64_t first_vertex,
                                                           simdbezier_patch_vertices* out,
                                                           size_t length);
SIMDBEZIER_API simdbezier_status simdbezier_number_part(const simdbezier_mesh_layout* part,
                                                        size_t own_first, size_t own_count,
                                                        uint64_t first_vertex,
                                                        const simdbezier_patch_vertices* ghosts,
                                                        size_t ghosts_length, uint64_t* numbers,
                                                        size_t numbers_length);

// Topology::is_entangled(); 0 outside of the model.
SIMDBEZIER_API int32_t simdbezier_topology_is_entangled(const simdbezier_topology* topology,
                                                        size_t patch);

// MeshLayout::corner(), segments(), along(), inner(); UINT32_MAX if there is no such vertex.
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_corner(const simdbezier_mesh_layout* layout,
                                                      size_t patch, size_t corner);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_segments(const simdbezier_mesh_layout* layout,
                                                        size_t patch, simdbezier_edge edge);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_along(const simdbezier_mesh_layout* layout,
                                                     size_t patch, simdbezier_edge edge,
                                                     uint32_t k);
SIMDBEZIER_API uint32_t simdbezier_mesh_layout_inner(const simdbezier_mesh_layout* layout,
                                                     size_t patch, uint32_t i, uint32_t j);

SIMDBEZIER_END_C
