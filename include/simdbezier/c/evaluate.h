// evaluate.hpp: a set's patches at samples.
#pragma once

#include <simdbezier/c/sets.h>

SIMDBEZIER_BEGIN_C

// Grid: nu x nv parameters of every patch; sample (patch, iu, iv) has the index
// (patch - first_patch) * nu * nv + iv * nu + iu.
typedef struct simdbezier_grid {
  size_t struct_size;
  size_t nu;
  size_t nv;
  const void* u;   // null: uniform, ends included; else nu values
  size_t u_length; // elements behind u
  const void* v;
  size_t v_length;
  simdbezier_scalar scalar; // of u and v, if there are any: that of the set
  simdbezier_parameters parameters;
  size_t first_patch;
  size_t patch_count; // 0: all from first_patch on
} simdbezier_grid;

static inline simdbezier_grid simdbezier_uniform_grid(size_t nu, size_t nv) {
  const simdbezier_grid grid = {sizeof grid, nu, nv, 0, 0, 0, 0, 0, 0, 0, 0};
  return grid;
}

// PatchGrids: a uniform grid for each of the patches from first_patch on.
typedef struct simdbezier_patch_grids {
  size_t struct_size;
  const uint32_t* nu;
  size_t nu_length;
  const uint32_t* nv;
  size_t nv_length;     // that of nu
  const size_t* offset; // where each patch's samples begin; null: packed without gaps
  size_t offset_length;
  size_t first_patch;
} simdbezier_patch_grids;

// Samples: sample k lies on patch[k] at (u[k], v[k]).
typedef struct simdbezier_samples {
  size_t struct_size;
  const uint32_t* patch;
  size_t patch_length; // the number of samples
  const void* u;
  size_t u_length; // that of patch
  const void* v;
  size_t v_length;
  simdbezier_scalar scalar;
  simdbezier_parameters parameters;
} simdbezier_samples;

// simdbezier_samples_f32(), …_f64().
#define SIMDBEZIER_SAMPLES(suffix, Number, TYPE)                                                   \
  static inline simdbezier_samples simdbezier_samples_##suffix(                                    \
      const uint32_t* patch, const Number* u, const Number* v, size_t length) {                    \
    const simdbezier_samples samples = {sizeof samples, patch, length,         u, length, v,       \
                                        length,         TYPE,  SIMDBEZIER_UNIT};                   \
    return samples;                                                                                \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_SAMPLES)

// to_centred(): x = 2u - 1, rounded once.
SIMDBEZIER_API float simdbezier_to_centred_f32(double u);
SIMDBEZIER_API double simdbezier_to_centred_f64(double u);

// SampleStatus, one byte a sample.
enum {
  SIMDBEZIER_SAMPLE_REGULAR,
  SIMDBEZIER_SAMPLE_LIMIT,
  SIMDBEZIER_SAMPLE_DEGENERATE,
  SIMDBEZIER_SAMPLE_NON_FINITE
};

// Outputs.
typedef struct simdbezier_outputs {
  size_t struct_size;
  simdbezier_vectors position;
  simdbezier_vectors du;
  simdbezier_vectors dv;
  simdbezier_vectors duu;
  simdbezier_vectors duv;
  simdbezier_vectors dvv;
  simdbezier_vectors normal;
  simdbezier_values gaussian;
  simdbezier_values mean;
  simdbezier_values minimum;
  simdbezier_values maximum;
  uint8_t* status;
  size_t status_length;
  int32_t first_component;
} simdbezier_outputs;

// evaluate() on one grid, on a grid for each patch, and at single samples. input_too_small also for
// fewer u or v than nu or nv.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_grid(const simdbezier_patch_set* set,
                                                          const simdbezier_grid* grid,
                                                          const simdbezier_outputs* out,
                                                          const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_patch_grids(
    const simdbezier_patch_set* set, const simdbezier_patch_grids* grids,
    const simdbezier_outputs* out, const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_samples(const simdbezier_patch_set* set,
                                                             const simdbezier_samples* samples,
                                                             const simdbezier_outputs* out,
                                                             const simdbezier_options* options);

// sample_count(): the number of samples of a call; 0, which simdbezier_last_fault() does not
// explain, if patches are not in the set or grids of patches are refused.
SIMDBEZIER_API size_t simdbezier_grid_sample_count(const simdbezier_patch_set* set,
                                                   const simdbezier_grid* grid);
SIMDBEZIER_API size_t simdbezier_patch_grids_sample_count(const simdbezier_patch_set* set,
                                                          const simdbezier_patch_grids* grids);

// PartialDerivative: d^(a+b) S / du^a dv^b.
typedef struct simdbezier_partial_derivative {
  size_t struct_size;
  int32_t order_u;
  int32_t order_v;
  simdbezier_vectors out;
} simdbezier_partial_derivative;

// evaluate_derivatives(): `length` derivatives, which share memory only as members of one vertex.
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_grid_derivatives(
    const simdbezier_patch_set* set, const simdbezier_grid* grid,
    const simdbezier_partial_derivative* derivatives, size_t length, int32_t first_component,
    const simdbezier_options* options);
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_sample_derivatives(
    const simdbezier_patch_set* set, const simdbezier_samples* samples,
    const simdbezier_partial_derivative* derivatives, size_t length, int32_t first_component,
    const simdbezier_options* options);

// Sets of outputs: OutputSelection.
enum {
  SIMDBEZIER_OUTPUT_POSITION = 1 << 0,
  SIMDBEZIER_OUTPUT_DU = 1 << 1,
  SIMDBEZIER_OUTPUT_DV = 1 << 2,
  SIMDBEZIER_OUTPUT_DUU = 1 << 3,
  SIMDBEZIER_OUTPUT_DUV = 1 << 4,
  SIMDBEZIER_OUTPUT_DVV = 1 << 5,
  SIMDBEZIER_OUTPUT_NORMAL = 1 << 6,
  SIMDBEZIER_OUTPUT_CURVATURE = 1 << 7,
  SIMDBEZIER_OUTPUT_STATUS = 1 << 8
};

typedef int32_t simdbezier_tile_layout;
enum { SIMDBEZIER_TILE_PLANES, SIMDBEZIER_TILE_TRIPLES, SIMDBEZIER_TILE_INTERLEAVED };

// TileFormat.
typedef struct simdbezier_tile_format {
  size_t struct_size;
  uint32_t outputs; // SIMDBEZIER_OUTPUT_POSITION | …; 0: positions
  simdbezier_tile_layout layout;
  size_t samples; // the most in one tile; 0: what fits 24 KiB
  int32_t first_component;
} simdbezier_tile_format;

// Tile: rows [first_row, first_row + row_count) of patches [first_patch, first_patch +
// patch_count). It and its outputs are the library's own memory and end with the function.
typedef struct simdbezier_tile {
  size_t struct_size;
  size_t first_patch;
  size_t patch_count;
  size_t first_row;
  size_t row_count;
  size_t nu;
  size_t samples;
  const simdbezier_outputs* out;
  int32_t worker;
} simdbezier_tile;

// Called on several threads at once; it must return, neither by longjmp() nor by an exception.
typedef void (*simdbezier_tile_function)(const simdbezier_tile* tile, void* context);

// evaluate_tiles(), largest_tile().
SIMDBEZIER_API simdbezier_status simdbezier_evaluate_tiles(const simdbezier_patch_set* set,
                                                           const simdbezier_grid* grid,
                                                           const simdbezier_tile_format* format,
                                                           simdbezier_tile_function function,
                                                           void* context,
                                                           const simdbezier_options* options);
SIMDBEZIER_API size_t simdbezier_largest_tile(const simdbezier_patch_set* set,
                                              const simdbezier_grid* grid,
                                              const simdbezier_tile_format* format);

SIMDBEZIER_END_C
