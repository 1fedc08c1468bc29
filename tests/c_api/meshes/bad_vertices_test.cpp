// What a caller of simdbezier.h may get wrong about the vertices and primitives of a mesh.
#include "tests/c_api/support/c_mesh_world.hpp"

namespace simdbezier::tests::bad_vertices_test {
namespace {

const Refusal<MeshWorld> kPrimitives[] = {
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](MeshWorld& w) { return simdbezier_write_triangles_u32(nullptr, w.nu, 2, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](MeshWorld& w) {
       return simdbezier_polygon_size(nullptr, &w.polygons, &w.corners, nullptr);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "triangles",
     [](MeshWorld& w) { return simdbezier_write_triangles_u16(w.layout, nullptr, 300, nullptr); }},
    {SIMDBEZIER_NULL_OUTPUT, "triangles",
     [](MeshWorld& w) { return simdbezier_write_triangles_u16(w.layout, nullptr, 0, nullptr); }},
    {SIMDBEZIER_NULL_OUTPUT, "polygons",
     [](MeshWorld& w) { return simdbezier_polygon_size(w.layout, nullptr, &w.corners, nullptr); }},
    {SIMDBEZIER_NULL_OUTPUT, "sizes",
     [](MeshWorld& w) {
       return simdbezier_write_polygons_u32(w.layout, w.indices.data(), w.indices.size(), nullptr,
                                            300, nullptr);
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "triangles",
     [](MeshWorld& w) { return w.indices.resize(2), w.write_triangles(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "indices or sizes",
     [](MeshWorld& w) { return w.sizes.resize(1), w.write_polygons(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](MeshWorld& w) { return w.primitives.struct_size = 0, w.write_triangles(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](MeshWorld& w) { return w.primitives.struct_size -= 8, w.count_polygons(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](MeshWorld& w) {
       const Later later(w.primitives);
       return simdbezier_write_triangles_u32(w.layout, w.indices.data(), w.indices.size(),
                                             &later.known);
     }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "options->first_patch or patch_count",
     [](MeshWorld& w) { return w.primitives.patch_count = 3, w.write_triangles(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "options->first_patch or patch_count",
     [](MeshWorld& w) { return w.primitives.first_patch = 3, w.write_polygons(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "options->first_patch or patch_count",
     [](MeshWorld& w) {
       w.primitives.first_patch = 1;
       return w.primitives.patch_count = 2, w.count_polygons();
     }},
    {SIMDBEZIER_BAD_VALUE, "options->destination",
     [](MeshWorld& w) { return w.primitives.destination = 3, w.write_triangles(); }},
    {SIMDBEZIER_BAD_VALUE, "options->destination",
     [](MeshWorld& w) { return w.primitives.destination = -1, w.write_polygons(); }}};

const Refusal<MeshWorld> kVertices[] = {
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](MeshWorld& w) {
       return simdbezier_evaluate_mesh(w.set.get(), nullptr, &w.mesh_out, nullptr, 0, 0);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "out",
     [](MeshWorld& w) { return w.mesh_out.position = {}, w.evaluate_vertices(); }},
    {SIMDBEZIER_MISSING_Y, "out->position.y",
     [](MeshWorld& w) { return w.mesh_out.position.y = nullptr, w.evaluate_vertices(); }},
    {SIMDBEZIER_EXTRA_Z, "out->parameters.z",
     [](MeshWorld& w) { // which have no z
       w.mesh_out.parameters = w.mesh_out.position;
       return w.mesh_out.position = {}, w.evaluate_vertices();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->position",
     [](MeshWorld& w) {
       return w.mesh_out.position.capacity = w.vertices - 1, w.evaluate_vertices();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->normal",
     [](MeshWorld& w) {
       w.mesh_out.normal = c_triples(w.room);
       return w.mesh_out.normal.capacity = w.vertices - 1, w.evaluate_vertices();
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->patch",
     [](MeshWorld& w) {
       w.mesh_out.patch = w.indices.data();
       return w.mesh_out.patch_length = w.vertices - 1, w.evaluate_vertices();
     }},
    {SIMDBEZIER_BAD_STRIDE, "out->position",
     [](MeshWorld& w) { return w.mesh_out.position.stride = 2, w.evaluate_vertices(); }},
    {SIMDBEZIER_BAD_STRIDE, "out->position.stride",
     [](MeshWorld& w) { return w.mesh_out.position.stride = -3, w.evaluate_vertices(); }},
    {SIMDBEZIER_BAD_ALIGNMENT, "out->position.y",
     [](MeshWorld& w) { return between(w.mesh_out.position.y), w.evaluate_vertices(); }},
    {SIMDBEZIER_BAD_SCALAR, "out->position.scalar",
     [](MeshWorld& w) {
       return w.mesh_out.position.scalar = SIMDBEZIER_F64, w.evaluate_vertices();
     }},
    {SIMDBEZIER_OVERLAPPING_OUTPUTS, "out",
     [](MeshWorld& w) { return w.mesh_out.normal = w.mesh_out.position, w.evaluate_vertices(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "first_patch or patch_count",
     [](MeshWorld& w) { return w.evaluate_vertices(0, 3); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "set",
     [](MeshWorld& w) {
       w.nets.count = 1;
       return w.set = c_pack<float>(w.nets), w.evaluate_vertices();
     }},
    {SIMDBEZIER_BAD_COMPONENTS, "first_component",
     [](MeshWorld& w) { return w.evaluate_attributes(3); }},
    {SIMDBEZIER_NULL_OUTPUT, "out",
     [](MeshWorld& w) {
       return simdbezier_evaluate_mesh_attributes(w.set.get(), w.layout, nullptr, 0, nullptr, 0, 0);
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "degrees",
     [](MeshWorld& w) {
       return simdbezier_split_creases(w.set.get(), w.layout, -1, nullptr, &w.made_layout);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "split",
     [](MeshWorld& w) {
       return simdbezier_split_creases(w.set.get(), w.layout, 0, nullptr, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](MeshWorld& w) { return simdbezier_split_parameters(nullptr, &w.made_layout); }},
    {SIMDBEZIER_NULL_OUTPUT, "split",
     [](MeshWorld& w) { return simdbezier_split_parameters(w.layout, nullptr); }}};

const Refusal<MeshWorld> kFormats[] = {
    {SIMDBEZIER_NULL_INPUT, "set",
     [](MeshWorld& w) {
       return simdbezier_evaluate_formatted_mesh(nullptr, w.layout, &w.formatted, nullptr, 0, 0);
     }},
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](MeshWorld& w) {
       return simdbezier_evaluate_formatted_mesh(w.set.get(), nullptr, &w.formatted, nullptr, 0, 0);
     }},
    {SIMDBEZIER_NULL_INPUT, "out",
     [](MeshWorld& w) {
       return simdbezier_evaluate_formatted_mesh(w.set.get(), w.layout, nullptr, nullptr, 0, 0);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "out",
     [](MeshWorld& w) {
       return w.formatted.position = w.formatted.normal = w.formatted.parameters = {},
              w.format_vertices();
     }},
    {SIMDBEZIER_NULL_OUTPUT, "out->parameters.first",
     [](MeshWorld& w) { return w.formatted.parameters.first = nullptr, w.format_vertices(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "out->struct_size",
     [](MeshWorld& w) { return w.formatted.struct_size -= 8, w.format_vertices(); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "out->struct_size",
     [](MeshWorld& w) {
       const Later later(w.formatted);
       return simdbezier_evaluate_formatted_mesh(w.set.get(), w.layout, &later.known, nullptr, 0,
                                                 0);
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->position",
     [](MeshWorld& w) { return w.formatted.position.capacity -= 1, w.format_vertices(); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out->parameters",
     [](MeshWorld& w) { return w.formatted.parameters.capacity = 0, w.format_vertices(); }},
    {SIMDBEZIER_BAD_STRIDE, "out->normal.stride",
     [](MeshWorld& w) { return w.formatted.normal.stride = -12, w.format_vertices(); }},
    {SIMDBEZIER_BAD_STRIDE, "out->position.stride",
     [](MeshWorld& w) { return w.formatted.position.stride = 5, w.format_vertices(); }},
    {SIMDBEZIER_SIZE_OVERFLOW, "out->parameters",
     [](MeshWorld& w) {
       w.formatted.parameters.stride = std::numeric_limits<std::ptrdiff_t>::max();
       return w.format_vertices();
     }},
    {SIMDBEZIER_OVERLAPPING_OUTPUTS, "out",
     [](MeshWorld& w) {
       return w.formatted.normal.first = w.memory.data() + 5, w.format_vertices();
     }},
    {SIMDBEZIER_BAD_VALUE, "out->normal.format",
     [](MeshWorld& w) { return w.formatted.normal.format = 6, w.format_vertices(); }},
    {SIMDBEZIER_BAD_VALUE, "out->position.format",
     [](MeshWorld& w) { return w.formatted.position.format = -1, w.format_vertices(); }},
    {SIMDBEZIER_BAD_COMPONENTS, "out->normal.format",
     [](MeshWorld& w) {
       return w.formatted.normal.format = SIMDBEZIER_FORMAT_UNORM16, w.format_vertices();
     }},
    {SIMDBEZIER_BAD_COMPONENTS, "out->parameters.format",
     [](MeshWorld& w) {
       return w.formatted.parameters.format = SIMDBEZIER_FORMAT_SNORM16, w.format_vertices();
     }},
    {SIMDBEZIER_BAD_COMPONENTS, "set",
     [](MeshWorld& w) {
       // Two components: 32 values a patch.
       w.nets = simdbezier_packed_nets_f32(w.values.data(), 64, 3, 3, 2, SIMDBEZIER_POLYNOMIAL);
       w.set = c_pack<float>(w.nets);
       return w.format_vertices();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "out->box",
     [](MeshWorld& w) { return w.formatted.box.step = 0, w.format_vertices(); }},
    {SIMDBEZIER_BAD_VALUE, "options->isa",
     [](MeshWorld& w) { return w.options.isa = SIMDBEZIER_ISA_SIMD128 + 1, w.format_vertices(); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "first_patch or patch_count",
     [](MeshWorld& w) { return w.format_vertices(1, 2); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "first_patch or patch_count",
     [](MeshWorld& w) { return w.format_vertices(3, 0); }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "set",
     [](MeshWorld& w) {
       w.nets.count = 1;
       return w.set = c_pack<float>(w.nets), w.format_vertices();
     }},
    {SIMDBEZIER_NULL_OUTPUT, "box",
     [](MeshWorld& w) {
       return simdbezier_find_quantisation_box(&w.nets, 1, SIMDBEZIER_FORMAT_UNORM16, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "nets",
     [](MeshWorld& w) {
       return simdbezier_find_quantisation_box(nullptr, 1, SIMDBEZIER_FORMAT_UNORM16, &w.box);
     }},
    {SIMDBEZIER_BAD_VALUE, "format", [](MeshWorld& w) { return w.find_box(6); }},
    {SIMDBEZIER_BAD_TOLERANCE, "format",
     [](MeshWorld& w) { return w.find_box(SIMDBEZIER_FORMAT_HALF); }},
    {SIMDBEZIER_BAD_TOLERANCE, "nets",
     [](MeshWorld& w) { return std::fill(w.values.begin(), w.values.end(), 1.0F), w.find_box(); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "nets->points",
     [](MeshWorld& w) { return w.values[50] = kNan, w.find_box(); }}};

TEST(CPrimitivesOfBadInput, AreRefusedByName) { expect_all_refused(kPrimitives); }
TEST(CVerticesOfBadInput, AreRefusedByName) { expect_all_refused(kVertices); }
TEST(CVertexFormatsOfBadInput, AreRefusedByName) { expect_all_refused(kFormats); }

TEST(CVertexFormatsOfBadInput, AreWrittenWhereNothingIsWrong) {
  MeshWorld world;
  EXPECT_C_OK(world.evaluate_vertices());
  EXPECT_C_OK(world.evaluate_attributes(0));
  EXPECT_C_OK(world.format_vertices());
  EXPECT_C_OK(world.format_vertices(2, 0));
  EXPECT_C_OK(world.find_box());
  EXPECT_C_OK(world.write_triangles());
  EXPECT_C_OK(world.count_polygons());
  EXPECT_C_OK(world.write_polygons());
}

} // namespace
} // namespace simdbezier::tests::bad_vertices_test
