// What a caller of simdbezier.h may get wrong on the way from nets to a mesh.
#include "tests/c_api/c_refusal.hpp"
#include "tests/c_api/c_world.hpp"

namespace simdbezier::tests::bad_meshes_test {
namespace {

const Refusal<World> kCases[] = {
    {SIMDBEZIER_NULL_INPUT, "layout",
     [](World& w) { return simdbezier_write_triangles_u32(nullptr, w.counts, 2, 0); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "links",
     [](World& w) {
       simdbezier_edge_link links[7];
       return simdbezier_find_adjacency(&w.nets, 1, links, 7, nullptr);
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->point_size or snap",
     [](World& w) {
       auto options = sized<simdbezier_topology_options>();
       options.point_size = -1;
       simdbezier_topology* topology = nullptr;
       return simdbezier_find_topology(&w.nets, 1, &options, &topology);
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](World& w) {
       const auto options = sized<simdbezier_mesh_options>();
       simdbezier_mesh* mesh = nullptr;
       return simdbezier_tessellate(&w.nets, 1, SIMDBEZIER_F32, &options, &mesh);
     }},
    {SIMDBEZIER_NULL_INPUT, "options",
     [](World& w) {
       simdbezier_mesh* mesh = nullptr;
       return simdbezier_tessellate(&w.nets, 1, SIMDBEZIER_F32, nullptr, &mesh);
     }},
    {SIMDBEZIER_NULL_INPUT, "options->camera",
     [](World& w) {
       auto options = sized<simdbezier_mesh_options>();
       options.pixels = 1;
       simdbezier_mesh* mesh = nullptr;
       return simdbezier_tessellate(&w.nets, 1, SIMDBEZIER_F32, &options, &mesh);
     }},
    {SIMDBEZIER_BAD_GRID, "options->nu or nv",
     [](World& w) {
       auto options = sized<simdbezier_mesh_options>();
       options.nu = 1;
       options.nv = 2;
       simdbezier_mesh* mesh = nullptr;
       return simdbezier_tessellate(&w.nets, 1, SIMDBEZIER_F32, &options, &mesh);
     }},
};

TEST(CMeshesOfBadInput, AreRefusedByName) {
  for (const Refusal<World>& one : kCases) {
    World world;
    expect_refused(one, world);
  }
}

} // namespace
} // namespace simdbezier::tests::bad_meshes_test
