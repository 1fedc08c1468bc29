// What all functions of simdbezier.h share: statuses, numbers, memory, options.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include <simdbezier/version.hpp>

#ifdef __cplusplus
#define SIMDBEZIER_BEGIN_C extern "C" {
#define SIMDBEZIER_END_C }
#else
#define SIMDBEZIER_BEGIN_C
#define SIMDBEZIER_END_C
#endif

SIMDBEZIER_BEGIN_C

// How a call ended. Those below 100 are the codes of simdbezier::Status (status.hpp).
typedef int32_t simdbezier_status;
enum {
  SIMDBEZIER_OK,
  SIMDBEZIER_NULL_INPUT,
  SIMDBEZIER_NULL_OUTPUT,
  SIMDBEZIER_BAD_DEGREE,
  SIMDBEZIER_BAD_COMPONENTS,
  SIMDBEZIER_BAD_WEIGHT,
  SIMDBEZIER_BAD_STRIDE,
  SIMDBEZIER_OVERLAPPING_OUTPUTS,
  SIMDBEZIER_BAD_OFFSETS,
  SIMDBEZIER_NON_FINITE_INPUT,
  SIMDBEZIER_COEFFICIENT_OVERFLOW,
  SIMDBEZIER_BAD_GRID,
  SIMDBEZIER_BAD_PATCH_RANGE,
  SIMDBEZIER_BAD_PATCH_INDEX,
  SIMDBEZIER_SIZE_OVERFLOW,
  SIMDBEZIER_UNKNOWN_ISA,
  SIMDBEZIER_UNSUPPORTED_ISA,
  SIMDBEZIER_OUT_OF_MEMORY,
  SIMDBEZIER_INPUT_TOO_SMALL,
  SIMDBEZIER_OUTPUT_TOO_SMALL,
  SIMDBEZIER_UNEQUAL_LENGTHS,
  SIMDBEZIER_BAD_TOLERANCE,
  SIMDBEZIER_BAD_RATES,
  SIMDBEZIER_NOT_ORIENTABLE,
  SIMDBEZIER_MISSING_Y,
  SIMDBEZIER_MISSING_Z,
  SIMDBEZIER_EXTRA_Y,
  SIMDBEZIER_EXTRA_Z,
  SIMDBEZIER_SNAP_TOO_LARGE,
  SIMDBEZIER_BAD_KNOTS,
  SIMDBEZIER_BAD_RANGE,
  SIMDBEZIER_BAD_TOPOLOGY,
  SIMDBEZIER_BAD_STRUCT_SIZE = 100, // a wrong struct_size, or unknown members that are not zero
  SIMDBEZIER_BAD_SCALAR,            // neither float nor double, or not what the others are
  SIMDBEZIER_BAD_VALUE,             // a number that stands for no name of its enumeration
  SIMDBEZIER_BAD_ALIGNMENT          // memory that is not aligned to the numbers in it
};

// One line of English; never null, static lifetime.
SIMDBEZIER_API const char* simdbezier_status_text(simdbezier_status status);

// What went wrong in the last call of this thread that returned a status. On ok, `function` names
// that call, and all else is zero or empty.
typedef struct simdbezier_fault {
  size_t struct_size;
  simdbezier_status status;
  int32_t point;        // control point at fault, j*(degree_u+1)+i; -1: none, or not known; of
                        // splines see c/splines.h
  int32_t component;    // its component; the number of components for a weight
  size_t patch;         // the patch, curve or spline at fault, if a single one is
  const char* function; // "simdbezier_pack"
  const char* argument; // "nets[0].points"; empty if no single one is at fault
} simdbezier_fault;

// The strings live until the thread's next call. Returns ok | null_output | bad_struct_size.
SIMDBEZIER_API simdbezier_status simdbezier_last_fault(simdbezier_fault* fault);
// The last fault as one line, such as "simdbezier_pack: nets[0].points: a required input pointer is
// null"; never null, lives until the thread's next call.
SIMDBEZIER_API const char* simdbezier_last_message(void);

// "0.1.0": of the library that runs; SIMDBEZIER_VERSION_MAJOR … are those of the header.
SIMDBEZIER_API const char* simdbezier_version(void);

// The type of the numbers behind void pointers, which are aligned to it.
typedef int32_t simdbezier_scalar;
enum { SIMDBEZIER_F32 = 1, SIMDBEZIER_F64 = 2 };

// Whether points carry a weight, and in which form: Weights of control_nets.hpp.
typedef int32_t simdbezier_weights;
enum { SIMDBEZIER_POLYNOMIAL, SIMDBEZIER_CARTESIAN, SIMDBEZIER_HOMOGENEOUS };

// u in [0,1], or x = 2u-1.
typedef int32_t simdbezier_parameters;
enum { SIMDBEZIER_UNIT, SIMDBEZIER_CENTRED };

// Instruction sets: options.hpp.
typedef int32_t simdbezier_isa;
enum {
  SIMDBEZIER_ISA_AUTOMATIC,
  SIMDBEZIER_ISA_SCALAR,
  SIMDBEZIER_ISA_SSE2,
  SIMDBEZIER_ISA_AVX2,
  SIMDBEZIER_ISA_AVX512,
  SIMDBEZIER_ISA_NEON64,
  SIMDBEZIER_ISA_SIMD128
};
// to_string(Isa), isa_from_name(), available_isas(), fuses_multiply_add(), resolve_isa().
SIMDBEZIER_API const char* simdbezier_isa_name(simdbezier_isa isa); // "unknown" for other numbers
SIMDBEZIER_API simdbezier_status simdbezier_isa_from_name(const char* name, simdbezier_isa* isa);
// Writes at most `length` of them; returns how many there are.
SIMDBEZIER_API size_t simdbezier_available_isas(simdbezier_isa* isas, size_t length);
SIMDBEZIER_API int simdbezier_fuses_multiply_add(simdbezier_isa isa);
SIMDBEZIER_API simdbezier_status simdbezier_resolve_isa(simdbezier_isa requested,
                                                        simdbezier_isa* chosen);

// take_executed_isa(): the instruction set that ran this thread's last call that evaluated samples,
// wrote triangles or made nets; automatic: there was none since the last question.
SIMDBEZIER_API simdbezier_isa simdbezier_take_executed_isa(void);

// Destination of options.hpp.
typedef int32_t simdbezier_destination;
enum { SIMDBEZIER_TO_AUTOMATIC, SIMDBEZIER_TO_CACHE, SIMDBEZIER_TO_MEMORY };

// Options of options.hpp.
typedef struct simdbezier_options {
  size_t struct_size;
  int32_t threads;        // 0: as many as the call is worth; 1: the calling thread alone
  int32_t not_watertight; // not 0: edges come from the interior's formula
  simdbezier_isa isa;
  simdbezier_destination destination;
} simdbezier_options;

// Vectors of outputs.hpp: component c of sample k is the element k * stride behind the c-th
// pointer. All strides are positive. All zero: not asked for.
typedef struct simdbezier_vectors {
  void* x;
  void* y;
  void* z;
  ptrdiff_t stride;
  size_t capacity; // samples that there is room for
  simdbezier_scalar scalar;
} simdbezier_vectors;

// Values of outputs.hpp: one value a sample. All zero: not asked for.
typedef struct simdbezier_values {
  void* first;
  size_t length;
  simdbezier_scalar scalar;
} simdbezier_values;

// In the functions below, `length` counts the elements behind the pointer. This one says for how
// many records they have room; it is 0 if not even one fits.
static inline size_t simdbezier_records(size_t length, size_t members, ptrdiff_t stride) {
  return length < members || stride <= 0 ? 0 : (length - members) / (size_t)stride + 1;
}

// Defines a function for floats, which ends in _f32, and the same for doubles.
#define SIMDBEZIER_FOR_BOTH(DEFINE)                                                                \
  DEFINE(f32, float, SIMDBEZIER_F32)                                                               \
  DEFINE(f64, double, SIMDBEZIER_F64)

// simdbezier_triples_f32(), …_f64(): x y z triples, `stride` elements from one to the next.
#define SIMDBEZIER_TRIPLES(suffix, Number, TYPE)                                                   \
  static inline simdbezier_vectors simdbezier_triples_##suffix(Number* first, size_t length,       \
                                                               ptrdiff_t stride) {                 \
    const simdbezier_vectors triples = {first,                                                     \
                                        length < 2 ? 0 : first + 1,                                \
                                        length < 3 ? 0 : first + 2,                                \
                                        stride,                                                    \
                                        simdbezier_records(length, 3, stride),                     \
                                        TYPE};                                                     \
    return triples;                                                                                \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_TRIPLES)

// simdbezier_pairs_f32(), …: pairs, for sets of two components and the parameters of vertices.
#define SIMDBEZIER_PAIRS(suffix, Number, TYPE)                                                     \
  static inline simdbezier_vectors simdbezier_pairs_##suffix(Number* first, size_t length,         \
                                                             ptrdiff_t stride) {                   \
    const simdbezier_vectors pairs = {first,                                                       \
                                      length < 2 ? 0 : first + 1,                                  \
                                      0,                                                           \
                                      stride,                                                      \
                                      simdbezier_records(length, 2, stride),                       \
                                      TYPE};                                                       \
    return pairs;                                                                                  \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_PAIRS)

// simdbezier_planes_f32(), …: planes of `length` elements each; y and z are null for sets of one or
// two components.
#define SIMDBEZIER_PLANES(suffix, Number, TYPE)                                                    \
  static inline simdbezier_vectors simdbezier_planes_##suffix(Number* x, Number* y, Number* z,     \
                                                              size_t length) {                     \
    const simdbezier_vectors planes = {x, y, z, 1, length, TYPE};                                  \
    return planes;                                                                                 \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_PLANES)

// simdbezier_values_f32(), …: one value a sample.
#define SIMDBEZIER_VALUES(suffix, Number, TYPE)                                                    \
  static inline simdbezier_values simdbezier_values_##suffix(Number* first, size_t length) {       \
    const simdbezier_values values = {first, length, TYPE};                                        \
    return values;                                                                                 \
  }
SIMDBEZIER_FOR_BOTH(SIMDBEZIER_VALUES)

SIMDBEZIER_END_C
