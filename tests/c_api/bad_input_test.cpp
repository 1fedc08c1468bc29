// What a caller of simdbezier.h may get wrong: the status, the argument that is named, and nothing
// written.
#include <cmath>

#include "tests/c_api/support/c_refusal.hpp"
#include "tests/c_api/support/c_world.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::bad_input_test {
namespace {

void ignore(const simdbezier_tile* /*tile*/, void* /*context*/) {}

// Each lambda spoils one argument and returns the call's status.
const Refusal<World> kCases[] = {
    // Nothing where something is needed.
    {SIMDBEZIER_NULL_INPUT, "nets",
     [](World& w) { return simdbezier_pack(nullptr, 1, SIMDBEZIER_F32, nullptr, &w.made); }},
    {SIMDBEZIER_NULL_OUTPUT, "set",
     [](World& w) { return simdbezier_pack(&w.nets, 1, SIMDBEZIER_F32, nullptr, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "nets[0].points",
     [](World& w) { return w.nets.points = nullptr, w.pack(); }},
    {SIMDBEZIER_NULL_INPUT, "set",
     [](World& w) { return simdbezier_evaluate_grid(nullptr, &w.grid, &w.out, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "grid",
     [](World& w) { return simdbezier_evaluate_grid(w.set.get(), nullptr, &w.out, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "out",
     [](World& w) { return simdbezier_evaluate_grid(w.set.get(), &w.grid, nullptr, nullptr); }},
    {SIMDBEZIER_NULL_OUTPUT, "out", [](World& w) { return w.out.position = {}, w.evaluate(); }},
    {SIMDBEZIER_MISSING_Z, "out->position.z",
     [](World& w) { return w.out.position.z = nullptr, w.evaluate(); }},
    {SIMDBEZIER_NULL_OUTPUT, "out->position.x",
     [](World& w) { return w.out.position.x = nullptr, w.evaluate(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "v0",
     [](World& w) {
       double points[24];
       return simdbezier_iso_v_points(&w.nets, kNan, points, 24, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "samples->u",
     [](World& w) { return w.samples.u = nullptr, w.evaluate_samples(); }},
    {SIMDBEZIER_NULL_INPUT, "grids->nu",
     [](World& w) { return w.grids.nu = nullptr, w.evaluate_grids(); }},
    {SIMDBEZIER_NULL_INPUT, "function",
     [](World& w) {
       return simdbezier_evaluate_tiles(w.set.get(), &w.grid, &w.format, nullptr, nullptr, nullptr);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "high",
     [](World& w) {
       return simdbezier_split_u(&w.nets, simdbezier_at(0.5), &w.low, nullptr, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "derivatives",
     [](World& w) {
       return simdbezier_evaluate_grid_derivatives(w.set.get(), &w.grid, nullptr, 1, 0, nullptr);
     }},

    // Sizes of structs.
    {SIMDBEZIER_BAD_STRUCT_SIZE, "nets[0].struct_size",
     [](World& w) { return w.nets.struct_size = 0, w.pack(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "grid->struct_size",
     [](World& w) { return w.grid.struct_size -= 8, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "out->struct_size",
     [](World& w) { return w.out.struct_size = std::size_t(1) << 40, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "grid->struct_size",
     [](World& w) { return w.grid.struct_size += 4, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](World& w) { return w.options.struct_size = 1, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "derivatives[0].struct_size",
     [](World& w) { return w.derivative.struct_size = 3, w.differentiate(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "shape->struct_size",
     [](World& w) {
       simdbezier_patch_shape shape{};
       return simdbezier_patch_set_shape(w.set.get(), 0, &shape);
     }},

    // Spans that are too short.
    {SIMDBEZIER_INPUT_TOO_SMALL, "nets[0].length",
     [](World& w) { return w.nets.length -= 1, w.pack(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "nets[0].length",
     [](World& w) { return w.nets.length = 0, w.pack(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "nets[0].first",
     [](World& w) { return w.nets.first = -1, w.pack(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->position",
     [](World& w) {
       w.out.position = simdbezier_triples_f32(w.positions.data(), 53, 3);
       return w.evaluate();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->normal",
     [](World& w) {
       w.out.normal = simdbezier_triples_f32(w.room.data(), 2, 3);
       return w.out.normal.z = w.room.data() + 2, w.evaluate();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->mean",
     [](World& w) {
       w.out.mean = simdbezier_values_f32(w.room.data(), 17);
       return w.evaluate();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->status",
     [](World& w) {
       w.out.status = reinterpret_cast<std::uint8_t*>(w.room.data());
       return w.out.status_length = 1, w.evaluate();
     }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "grid->v_length",
     [](World& w) {
       w.grid.v = w.parameters;
       w.grid.scalar = SIMDBEZIER_F32;
       return w.grid.v_length = 2, w.evaluate();
     }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "samples",
     [](World& w) { return w.samples.v_length = 1, w.evaluate_samples(); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "grids",
     [](World& w) { return w.grids.nv_length = 1, w.evaluate_grids(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "low or high->length",
     [](World& w) { return w.high.length -= 1, w.split(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "low or high->length",
     [](World& w) {
       return simdbezier_control_boxes(&w.nets, simdbezier_values_f32(w.room.data(), 1),
                                       simdbezier_values_f32(w.room.data() + 6, 6), nullptr);
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "length",
     [](World& w) {
       double error = 0;
       return simdbezier_position_errors(w.set.get(), &error, 1, nullptr);
     }},
    {SIMDBEZIER_UNSUPPORTED_ISA, "options->isa",
     [](World& w) {
       double errors[8] = {};
       w.options.isa = static_cast<simdbezier_isa>(absent_isa());
       return simdbezier_position_errors(w.set.get(), errors, 8, &w.options);
     }},

    // Strides.
    {SIMDBEZIER_BAD_STRIDE, "out->position.stride",
     [](World& w) { return w.out.position.stride = -3, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRIDE, "out->position.stride",
     [](World& w) { return w.out.position.stride = 0, w.evaluate(); }},
    {SIMDBEZIER_BAD_STRIDE, "out->position",
     [](World& w) { return w.out.position.stride = 2, w.evaluate(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "nets[0].length",
     [](World& w) { return w.nets.point_stride = -3, w.pack(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "curves->length",
     [](World& w) {
       w.curves.curve_stride = -12;
       return simdbezier_pack_curves(&w.curves, SIMDBEZIER_F32, nullptr, &w.made_curves);
     }},

    // Memory between two numbers.
    {SIMDBEZIER_BAD_ALIGNMENT, "out->position.x",
     [](World& w) { return between(w.out.position.x), w.evaluate(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "out->position.z",
     [](World& w) { return between(w.out.position.z), w.evaluate_samples(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "out->position.y",
     [](World& w) { return between(w.curve_out.position.y), w.evaluate_curves(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "derivatives[0].out.x",
     [](World& w) { return between(w.derivative.out.x), w.differentiate(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "out->mean.first",
     [](World& w) {
       w.out.mean = simdbezier_values_f32(w.room.data(), 18);
       return between(w.out.mean.first), w.evaluate();
     }},
    {SIMDBEZIER_BAD_ALIGNMENT, "low->points",
     [](World& w) { return between(w.low.points), w.split(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "nets[0].points",
     [](World& w) { return between(w.nets.points), w.pack(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "samples->v",
     [](World& w) { return between(w.samples.v), w.evaluate_samples(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "grid->u",
     [](World& w) {
       w.grid.u = w.parameters;
       w.grid.u_length = 3;
       w.grid.scalar = SIMDBEZIER_F32;
       return between(w.grid.u), w.evaluate();
     }},

    // Types and names.
    {SIMDBEZIER_BAD_SCALAR, "nets[0].scalar", [](World& w) { return w.nets.scalar = 0, w.pack(); }},
    {SIMDBEZIER_BAD_SCALAR, "scalar",
     [](World& w) { return simdbezier_pack(&w.nets, 1, 3, nullptr, &w.made); }},
    {SIMDBEZIER_BAD_SCALAR, "out->position.scalar",
     [](World& w) { return w.out.position.scalar = SIMDBEZIER_F64, w.evaluate(); }},
    {SIMDBEZIER_BAD_SCALAR, "samples->scalar",
     [](World& w) { return w.samples.scalar = SIMDBEZIER_F64, w.evaluate_samples(); }},
    {SIMDBEZIER_BAD_SCALAR, "low->scalar",
     [](World& w) { return w.low.scalar = SIMDBEZIER_F64, w.split(); }},
    {SIMDBEZIER_BAD_VALUE, "options->isa",
     [](World& w) { return w.options.isa = 99, w.evaluate(); }},
    {SIMDBEZIER_BAD_VALUE, "options->destination",
     [](World& w) { return w.options.destination = -1, w.evaluate(); }},
    {SIMDBEZIER_BAD_VALUE, "nets[0].weights",
     [](World& w) { return w.nets.weights = 3, w.pack(); }},
    {SIMDBEZIER_BAD_VALUE, "grid->parameters",
     [](World& w) { return w.grid.parameters = 2, w.evaluate(); }},
    {SIMDBEZIER_BAD_VALUE, "format->outputs",
     [](World& w) {
       w.format.outputs = 1U << 9;
       return simdbezier_evaluate_tiles(w.set.get(), &w.grid, &w.format, &ignore, nullptr, nullptr);
     }},
    {SIMDBEZIER_BAD_VALUE, "u",
     [](World& w) {
       return simdbezier_split_u(&w.nets, simdbezier_fraction(1, -2), &w.low, &w.high, nullptr);
     }},
    {SIMDBEZIER_NON_FINITE_INPUT, "u",
     [](World& w) {
       return simdbezier_split_u(&w.nets, simdbezier_at(kNan), &w.low, &w.high, nullptr);
     }},
    {SIMDBEZIER_NON_FINITE_INPUT, "v1",
     [](World& w) {
       return simdbezier_segment(&w.nets, simdbezier_at(0), simdbezier_at(1), simdbezier_at(0),
                                 simdbezier_at(HUGE_VAL), &w.low, nullptr);
     }},
    {SIMDBEZIER_BAD_DEGREE, "low or high->degree_u or degree_v",
     [](World& w) { return w.low.degree_u = 2, w.split(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "low or high->components or weights",
     [](World& w) { return w.high.weights = SIMDBEZIER_HOMOGENEOUS, w.split(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "out->components or weights",
     [](World& w) { return w.low.components = 2, simdbezier_reverse_u(&w.nets, &w.low, nullptr); }},
    {SIMDBEZIER_BAD_STRIDE, "out",
     [](World& w) { return w.low.row_stride = 3, simdbezier_reverse_u(&w.nets, &w.low, nullptr); }},
    {SIMDBEZIER_BAD_STRIDE, "low or high",
     [](World& w) { return w.low.net_stride = 0, w.split(); }},
    {SIMDBEZIER_BAD_STRIDE, "nets", [](World& w) { return w.nets.point_stride = 0, w.split(); }},
    {SIMDBEZIER_BAD_DEGREE, "out->degree_u or degree_v",
     [](World& w) { return w.low.degree_v = 2, simdbezier_elevate(&w.nets, &w.low, nullptr); }},
    {SIMDBEZIER_BAD_DEGREE, "nets->degree_u or degree_v",
     [](World& w) { return w.nets.degree_u = 16, simdbezier_elevate(&w.nets, &w.low, nullptr); }},
    {SIMDBEZIER_BAD_DEGREE, "nets->degree_u or degree_v",
     [](World& w) {
       w.nets = simdbezier_packed_nets_f32(w.values.data(), w.values.size(), 1, 3, 3, 0);
       w.low = simdbezier_packed_mutable_nets_f32(w.room.data(), w.room.size(), 1, 3, 3, 0);
       w.low.count = w.nets.count;
       return simdbezier_to_bezier(SIMDBEZIER_BASIS_B_SPLINE, &w.nets, &w.low, nullptr);
     }},
    {SIMDBEZIER_BAD_DEGREE, "out->degree_u or degree_v",
     [](World& w) {
       w.low.degree_u = 2;
       return simdbezier_to_bezier(SIMDBEZIER_BASIS_B_SPLINE, &w.nets, &w.low, nullptr);
     }},
    {SIMDBEZIER_BAD_VALUE, "basis",
     [](World& w) { return simdbezier_to_bezier(5, &w.nets, &w.low, nullptr); }},
    {SIMDBEZIER_UNKNOWN_ISA, "name",
     [](World& w) { return simdbezier_isa_from_name("sse9", &w.options.isa); }},

    // What C++ finds, named.
    {SIMDBEZIER_BAD_DEGREE, "nets[0].degree_u or degree_v",
     [](World& w) { return w.nets.degree_u = 16, w.pack(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "nets[0].components",
     [](World& w) { return w.nets.components = 0, w.pack(); }},
    {SIMDBEZIER_BAD_DEGREE, "nets->degree_u or degree_v",
     [](World& w) { return w.nets.degree_u = -7, w.nets.degree_v = 99, w.take_edge(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "nets->components",
     [](World& w) { return w.nets.components = 0, w.take_edge(); }},
    {SIMDBEZIER_SIZE_OVERFLOW, "nets->count",
     [](World& w) { return w.nets.row_stride = std::ptrdiff_t(1) << 62, w.take_edge(); }},
    {SIMDBEZIER_BAD_STRIDE, "nets",
     [](World& w) { return w.nets.point_stride = 0, w.take_edge(); }},
    {SIMDBEZIER_INPUT_TOO_SMALL, "nets->length",
     [](World& w) { return w.nets.length -= 1, w.take_edge(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "nets[0].points",
     [](World& w) { return w.values[50] = kNan, w.pack(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "options->relative_to",
     [](World& w) { return w.pack_options.relative_to[1] = kNan, w.pack(); }},
    {SIMDBEZIER_BAD_GRID, "grid", [](World& w) { return w.grid.nu = 1, w.evaluate(); }},
    {SIMDBEZIER_BAD_GRID, "grid", [](World& w) { return w.curve_grid.n = 0, w.evaluate_curves(); }},
    {SIMDBEZIER_BAD_GRID, "levels",
     [](World& w) {
       return simdbezier_tight_boxes(&w.nets, 7, simdbezier_values_f32(w.room.data(), 6),
                                     simdbezier_values_f32(w.room.data() + 6, 6), nullptr);
     }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "grid",
     [](World& w) { return w.grid.patch_count = 3, w.evaluate(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "grid",
     [](World& w) { return w.grid.patch_count = SIZE_MAX, w.evaluate(); }},
    {SIMDBEZIER_BAD_PATCH_INDEX, "samples",
     [](World& w) { return w.patch[1] = 2, w.evaluate_samples(); }},
    {SIMDBEZIER_OVERLAPPING_OUTPUTS, "out",
     [](World& w) { return w.out.du = w.out.position, w.evaluate(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "out->first_component",
     [](World& w) { return w.out.first_component = 3, w.evaluate(); }},
    {SIMDBEZIER_BAD_DEGREE, "derivatives",
     [](World& w) { return w.derivative.order_u = -1, w.differentiate(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "patch",
     [](World& w) {
       auto bounds = sized<simdbezier_error_bounds_of_patch>();
       return simdbezier_patch_error_bounds(w.set.get(), 2, 0, &bounds);
     }},
};

TEST(CBadInput, IsRefusedByName) {
  for (const Refusal<World>& one : kCases) {
    World world;
    ASSERT_NE(world.set, nullptr);
    expect_refused(one, world);
    EXPECT_EQ(world.made, nullptr);
    EXPECT_EQ(world.edge.points, nullptr);
    for (const auto* const memory : {&world.positions, &world.room}) {
      for (const float value : *memory) {
        ASSERT_EQ(value, -7.0F) << one.argument << ": something was written";
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::bad_input_test
