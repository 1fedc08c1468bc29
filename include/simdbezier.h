// simdbezier for C (C99) and every language that can call C: many Bézier patches at many parameters
// in one call. Each function names the C++ function that it runs. That one's header says what is
// computed, how accurately, and at what cost. The rules below are what the C form adds.
//
//     simdbezier_nets nets = simdbezier_packed_nets_f32(points, 48 * patches, 3, 3, 3, 0);
//     simdbezier_patch_set *set = NULL;
//     if (simdbezier_pack(&nets, 1, SIMDBEZIER_F32, NULL, &set) != SIMDBEZIER_OK) { … }
//     simdbezier_grid grid = simdbezier_uniform_grid(17, 17);
//     simdbezier_outputs out = {.struct_size = sizeof out};
//     out.position = simdbezier_triples_f32(xyz, 3 * 17 * 17 * patches, 3);
//     if (simdbezier_evaluate_grid(set, &grid, &out, NULL) != SIMDBEZIER_OK) {
//       puts(simdbezier_last_message());
//     }
//     simdbezier_patch_set_free(set);
//
//   Statuses   Every function that can fail returns one: those of the C++ function, and null_input
//              | null_output | bad_struct_size | bad_scalar | bad_value | bad_alignment.
//              simdbezier_last_fault() then says which argument was at fault. Nothing prints,
//              aborts or lets an exception through. On an error nothing has been written, except to
//              outputs that the C++ header calls undefined then.
//   Structs    begin with struct_size, which the caller sets to sizeof. They may grow at their end:
//              programs that were compiled for a smaller struct go on working. Programs that were
//              compiled for a larger one work if the members that this library does not know are
//              zero. Zero is every member's usual value: set struct_size, and what differs. Small
//              structs without a struct_size never change. The elements of an array of structs all
//              have the struct_size of the first.
//   Pointers   come with the number of elements that they point to, and a call that would go beyond
//              is refused. A null pointer to options means that all members are zero.
//   Strides    count elements; only those of formatted vertices count bytes.
//   Numbers    are float or double: a struct says which by its `scalar`. Functions that end in _f32
//              or _f64 fill in structs, so that the compiler checks the pointers.
//   Handles    are made by one function and given back to one …_free(), which accepts null. They
//              are immutable: any number of threads may use one at once.
//   C++ alone  has results.hpp, PackOptions::reuse_memory, split_edges(), plan_again(), the fault,
//              errors and seconds of plans, RateOptions::errors and most_segments of meshes,
//              find_distinct_nets(), counts of a part of a topology, spline_error(),
//              extraction_error(), merged_knots(), and what takes a line or two in C: nets the
//              other way round (by `first` and strides), iso_u() and iso_v() from nets to sets (by
//              points), samples of spline curves (by places), grids of splines without a set,
//              meets_tolerance(), derivative_divisor().
#pragma once

#include <simdbezier/c/curves.h>   // IWYU pragma: export
#include <simdbezier/c/evaluate.h> // IWYU pragma: export
#include <simdbezier/c/meshes.h>   // IWYU pragma: export
#include <simdbezier/c/models.h>   // IWYU pragma: export
#include <simdbezier/c/nets.h>     // IWYU pragma: export
#include <simdbezier/c/sets.h>     // IWYU pragma: export
#include <simdbezier/c/splines.h>  // IWYU pragma: export
#include <simdbezier/c/types.h>    // IWYU pragma: export
