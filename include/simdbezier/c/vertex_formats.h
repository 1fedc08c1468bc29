// evaluate_mesh.hpp: vertices of a mesh in the formats that graphics processors and glTF read.
#pragma once

#include <simdbezier/c/models.h>

SIMDBEZIER_BEGIN_C

// VertexFormat, which says how far what is stored is from the vertex's own value.
typedef int32_t simdbezier_vertex_format;
enum {
  SIMDBEZIER_FORMAT_FLOAT32,
  SIMDBEZIER_FORMAT_HALF,
  SIMDBEZIER_FORMAT_UNORM16,
  SIMDBEZIER_FORMAT_SNORM16,
  SIMDBEZIER_FORMAT_OCTAHEDRAL16,
  SIMDBEZIER_FORMAT_OCTAHEDRAL8
};
// format_bytes(); 0 for other numbers.
SIMDBEZIER_API size_t simdbezier_format_bytes(simdbezier_vertex_format format, size_t components);

// FormattedOutput: the output of vertex k goes to the bytes from first + k * stride on, which may
// have any alignment. All zero: not asked for.
typedef struct simdbezier_formatted_output {
  void* first;
  size_t capacity;  // vertices that there is room for
  ptrdiff_t stride; // in bytes; 0: packed
  simdbezier_vertex_format format;
} simdbezier_formatted_output;

// QuantisationBox: position = low + step q.
typedef struct simdbezier_quantisation_box {
  double low[3];
  double step;
} simdbezier_quantisation_box;

// quantisation_box(): of all control points, for unorm16 or snorm16.
SIMDBEZIER_API simdbezier_status simdbezier_find_quantisation_box(const simdbezier_nets* nets,
                                                                  size_t length,
                                                                  simdbezier_vertex_format format,
                                                                  simdbezier_quantisation_box* box);

// FormattedOutputs.
typedef struct simdbezier_formatted_outputs {
  size_t struct_size;
  simdbezier_formatted_output position;
  simdbezier_formatted_output normal;
  simdbezier_formatted_output parameters;
  simdbezier_quantisation_box box; // of positions as unorm16 or snorm16
} simdbezier_formatted_outputs;

// evaluate_mesh() into formats, from first_patch on; patch_count 0: to the end.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_formatted_mesh(
    const simdbezier_patch_set* set, const simdbezier_mesh_layout* layout,
    const simdbezier_formatted_outputs* out, const simdbezier_options* options, size_t first_patch,
    size_t patch_count);

SIMDBEZIER_END_C
