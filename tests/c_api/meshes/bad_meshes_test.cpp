// What a caller of simdbezier.h may get wrong on the way from nets to a mesh.
#include "tests/c_api/support/c_mesh_world.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::bad_meshes_test {
namespace {

/// Makes the patches' common side one of two that are a hundredth apart.
void bring_near(MeshWorld& w) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t c = 0; c < 3; ++c) {
      w.values[48 + 12 * row + c] = w.values[12 * row + 9 + c] + 0.01F;
    }
  }
}

/// Makes the patches a ring that is turned by half.
void close_a_turned_ring(MeshWorld& w) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t c = 0; c < 3; ++c) {
      w.values[48 + 12 * row + c] = w.values[12 * row + 9 + c];
      w.values[48 + 12 * row + 9 + c] = w.values[12 * (3 - row) + c];
    }
  }
}

const Refusal<MeshWorld> kModels[] = {
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "links",
     [](MeshWorld& w) {
       simdbezier_edge_link links[7];
       return simdbezier_find_adjacency(&w.nets, 1, links, 7, nullptr);
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->point_size or snap",
     [](MeshWorld& w) { return w.topology_options.point_size = -1, w.join(); }},
    {SIMDBEZIER_NOT_ORIENTABLE, "options->orient",
     [](MeshWorld& w) {
       close_a_turned_ring(w);
       return w.topology_options.orient = 1, w.join();
     }},
    {SIMDBEZIER_SIZE_OVERFLOW, "length",
     [](MeshWorld& w) {
       return simdbezier_find_topology(&w.nets, SIZE_MAX, nullptr, &w.made_topology);
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](MeshWorld& w) { return w.mesh_options.tolerance = 0, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](MeshWorld& w) { return w.mesh_options.tolerance = 1e-30, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->relative_tolerance",
     [](MeshWorld& w) { return w.mesh_options.relative_tolerance = -1, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->relative_tolerance",
     [](MeshWorld& w) {
       w.mesh_options.tolerance = 0;
       return w.mesh_options.relative_tolerance = 1e-30, w.plan();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerances",
     [](MeshWorld& w) {
       w.mesh_options.tolerances = w.numbers;
       return w.mesh_options.tolerances_length = 2, w.numbers[1] = -1, w.tessellate();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->longest_edge",
     [](MeshWorld& w) { return w.mesh_options.longest_edge = -1, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->longest_edge",
     [](MeshWorld& w) {
       w.mesh_options.tolerance = 0;
       return w.mesh_options.longest_edge = 1e-9, w.tessellate();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->normal_degrees",
     [](MeshWorld& w) {
       w.mesh_options.tolerance = 0;
       return w.mesh_options.normal_degrees = 1e-9, w.plan();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->normal_degrees",
     [](MeshWorld& w) { return w.mesh_options.normal_degrees = kNan, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->point_size",
     [](MeshWorld& w) { return w.mesh_options.point_size = kNan, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->snap",
     [](MeshWorld& w) { return w.mesh_options.snap = -1, w.plan(); }},
    {SIMDBEZIER_SNAP_TOO_LARGE, "options->snap",
     [](MeshWorld& w) {
       bring_near(w);
       w.mesh_options.snap = 0.05;
       return w.mesh_options.tolerance = 0.001, w.plan();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->crease_degrees",
     [](MeshWorld& w) { return w.mesh_options.crease_degrees = -1, w.tessellate(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->crease_degrees",
     [](MeshWorld& w) { return w.mesh_options.crease_degrees = kNan, w.tessellate(); }},
    {SIMDBEZIER_BAD_GRID, "options->nu and nv beside a tolerance",
     [](MeshWorld& w) { return w.mesh_options.nu = 4, w.mesh_options.nv = 4, w.tessellate(); }},
    {SIMDBEZIER_BAD_RATES, "options->nu or nv",
     [](MeshWorld& w) {
       w.mesh_options.tolerance = 0;
       return w.mesh_options.nu = 5000, w.mesh_options.nv = 4, w.tessellate();
     }},
    {SIMDBEZIER_NULL_INPUT, "options",
     [](MeshWorld& w) {
       return simdbezier_tessellate(&w.nets, 1, SIMDBEZIER_F32, nullptr, &w.made_mesh);
     }},
    {SIMDBEZIER_NULL_INPUT, "options->camera",
     [](MeshWorld& w) { return w.mesh_options.pixels = 1, w.tessellate(); }},
    {SIMDBEZIER_BAD_GRID, "options->nu or nv", [](MeshWorld& w) {
       w.mesh_options.tolerance = 0;
       return w.mesh_options.nu = 1, w.mesh_options.nv = 2, w.tessellate();
     }}};

const Refusal<MeshWorld> kRates[] = {
    {SIMDBEZIER_NULL_INPUT, "options",
     [](MeshWorld& w) {
       return simdbezier_choose_rates(&w.nets, 1, w.topology, nullptr, &w.rates);
     }},
    {SIMDBEZIER_NULL_INPUT, "rates",
     [](MeshWorld& w) {
       return simdbezier_choose_rates(&w.nets, 1, w.topology, &w.rate_options, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "topology",
     [](MeshWorld& w) {
       return simdbezier_choose_rates(&w.nets, 1, nullptr, &w.rate_options, &w.rates);
     }},
    {SIMDBEZIER_BAD_RATES, "topology", [](MeshWorld& w) { return w.nets.count = 1, w.choose(); }},
    {SIMDBEZIER_BAD_RATES, "topology", [](MeshWorld& w) { return w.nets.count = 1, w.certify(); }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_u",
     [](MeshWorld& w) { return w.rates.cells_u_length = 1, w.choose(); }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_v",
     [](MeshWorld& w) { return w.rates.cells_v_length = 1, w.certify(); }},
    {SIMDBEZIER_BAD_RATES, "rates->diagonals",
     [](MeshWorld& w) { return w.rates.diagonals_length = 1, w.choose(); }},
    {SIMDBEZIER_BAD_RATES, "rates->deviation",
     [](MeshWorld& w) { return w.rates.deviation_length = 1, w.choose(); }},
    {SIMDBEZIER_BAD_RATES, "options->errors",
     [](MeshWorld& w) {
       w.rate_options.errors = w.numbers;
       return w.rate_options.errors_length = 1, w.choose();
     }},
    {SIMDBEZIER_BAD_RATES, "options->tolerances",
     [](MeshWorld& w) {
       w.rate_options.tolerances = w.numbers;
       return w.rate_options.tolerances_length = 3, w.choose();
     }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](MeshWorld& w) { return w.rate_options.tolerance = -1, w.choose(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->longest_edge",
     [](MeshWorld& w) { return w.rate_options.longest_edge = -1, w.choose(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->normal_degrees",
     [](MeshWorld& w) { return w.rate_options.normal_degrees = -1, w.choose(); }},
    {SIMDBEZIER_UNSUPPORTED_ISA, "options->isa",
     [](MeshWorld& w) {
       w.rate_options.isa = static_cast<simdbezier_isa>(absent_isa());
       return w.choose();
     }},
    {SIMDBEZIER_BAD_VALUE, "options->isa",
     [](MeshWorld& w) { return w.rate_options.isa = -1, w.choose(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->errors",
     [](MeshWorld& w) {
       w.rate_options.errors = w.numbers;
       return w.rate_options.errors_length = 2, w.numbers[1] = -1, w.choose();
     }},
    {SIMDBEZIER_BAD_RATES, "errors", [](MeshWorld& w) { return w.certify(w.numbers, 1); }},
    {SIMDBEZIER_BAD_TOLERANCE, "errors",
     [](MeshWorld& w) { return w.numbers[1] = -1, w.certify(w.numbers, 2); }},
    {SIMDBEZIER_NULL_INPUT, "errors", [](MeshWorld& w) { return w.certify(nullptr, 2); }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_u or cells_v",
     [](MeshWorld& w) { return w.nv[1] = 4097, w.certify(); }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_u or cells_v",
     [](MeshWorld& w) { return w.nu[0] = 0, w.lay_out(); }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_u or cells_v",
     [](MeshWorld& w) {
       w.rates.diagonals = nullptr;
       return w.rates.diagonals_length = 0, w.nu[0] = 0, w.lay_out();
     }},
    {SIMDBEZIER_BAD_RATES, "rates->cells_v",
     [](MeshWorld& w) { return w.rates.cells_v_length = 1, w.lay_out(); }},
    {SIMDBEZIER_NULL_INPUT, "nets",
     [](MeshWorld& w) {
       return simdbezier_certify_grids(nullptr, 1, 2, 2, nullptr, 0, w.deviation, 2, nullptr);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "deviation",
     [](MeshWorld& w) {
       return simdbezier_certify_grids(&w.nets, 1, 2, 2, nullptr, 0, nullptr, 2, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "errors",
     [](MeshWorld& w) {
       return simdbezier_certify_grids(&w.nets, 1, 2, 2, nullptr, 2, w.deviation, 2, nullptr);
     }},
    {SIMDBEZIER_BAD_RATES, "deviation",
     [](MeshWorld& w) { return w.rates.deviation_length = 1, w.certify_grids(2, 2); }},
    {SIMDBEZIER_BAD_RATES, "errors",
     [](MeshWorld& w) { return w.numbers_length = 3, w.certify_grids(2, 2); }},
    {SIMDBEZIER_BAD_RATES, "cells_u or cells_v",
     [](MeshWorld& w) { return w.certify_grids(0, 2); }},
    {SIMDBEZIER_BAD_RATES, "cells_u or cells_v",
     [](MeshWorld& w) { return w.certify_grids(2, kMostGridCells + 1); }},
    {SIMDBEZIER_BAD_TOLERANCE, "errors",
     [](MeshWorld& w) { return w.numbers[0] = kNan, w.certify_grids(2, 2); }},
    {SIMDBEZIER_NON_FINITE_INPUT, "nets[0].points",
     [](MeshWorld& w) { return w.values[50] = kNan, w.certify_grids(2, 2); }},
    {SIMDBEZIER_BAD_VALUE, "options->isa",
     [](MeshWorld& w) { return w.options.isa = 99, w.certify_grids(2, 2); }},
    {SIMDBEZIER_BAD_VALUE, "options->isa",
     [](MeshWorld& w) { return w.options.isa = 99, w.certify(); }},
    {SIMDBEZIER_UNSUPPORTED_ISA, "options->isa",
     [](MeshWorld& w) {
       return w.options.isa = static_cast<simdbezier_isa>(absent_isa()), w.certify_grids(2, 2);
     }},
    {SIMDBEZIER_UNSUPPORTED_ISA, "options->isa",
     [](MeshWorld& w) {
       return w.options.isa = static_cast<simdbezier_isa>(absent_isa()), w.certify();
     }},
    {SIMDBEZIER_BAD_ALIGNMENT, "nets[0].points",
     [](MeshWorld& w) { return between(w.nets.points), w.certify_grids(2, 2); }}};

const Refusal<MeshWorld> kPlans[] = {
    {SIMDBEZIER_NULL_OUTPUT, "plan",
     [](MeshWorld& w) {
       return simdbezier_plan_mesh(&w.nets, 1, SIMDBEZIER_F32, &w.mesh_options, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "options",
     [](MeshWorld& w) {
       return simdbezier_plan_mesh(&w.nets, 1, SIMDBEZIER_F32, nullptr, &w.made_plan);
     }},
    {SIMDBEZIER_NULL_INPUT, "nets",
     [](MeshWorld& w) {
       return simdbezier_plan_mesh(nullptr, 1, SIMDBEZIER_F32, &w.mesh_options, &w.made_plan);
     }},
    {SIMDBEZIER_BAD_SCALAR, "scalar",
     [](MeshWorld& w) {
       return simdbezier_plan_mesh(&w.nets, 1, 0, &w.mesh_options, &w.made_plan);
     }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "options->struct_size",
     [](MeshWorld& w) { return w.mesh_options.struct_size -= 8, w.plan(); }},
    {SIMDBEZIER_BAD_TOLERANCE, "options->tolerance",
     [](MeshWorld& w) { return w.mesh_options.tolerance = 0, w.plan(); }},
    {SIMDBEZIER_BAD_RATES, "options->tolerances",
     [](MeshWorld& w) {
       w.mesh_options.tolerances = w.numbers;
       return w.mesh_options.tolerances_length = 3, w.plan();
     }},
    {SIMDBEZIER_NON_FINITE_INPUT, "nets[0].points",
     [](MeshWorld& w) { return w.values[50] = kNan, w.plan(); }},
    {SIMDBEZIER_NULL_INPUT, "plan",
     [](MeshWorld&) {
       auto parts = sized<simdbezier_mesh_plan_parts>();
       return simdbezier_mesh_plan_look(nullptr, &parts);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "parts",
     [](MeshWorld&) { return simdbezier_mesh_plan_look(nullptr, nullptr); }},
    {SIMDBEZIER_BAD_STRUCT_SIZE, "parts->struct_size",
     [](MeshWorld&) {
       simdbezier_mesh_plan_parts parts{};
       return simdbezier_mesh_plan_look(nullptr, &parts);
     }},
    {SIMDBEZIER_NULL_OUTPUT, "counts",
     [](MeshWorld&) { return simdbezier_mesh_plan_count(nullptr, nullptr); }},
    {SIMDBEZIER_NULL_INPUT, "plan", [](MeshWorld&) {
       auto counts = sized<simdbezier_topology_counts>();
       return simdbezier_mesh_plan_count(nullptr, &counts);
     }}};

TEST(CMeshesOfBadInput, AreRefusedByName) { expect_all_refused(kModels); }
TEST(CRatesOfBadInput, AreRefusedByName) { expect_all_refused(kRates); }
TEST(CMeshPlansOfBadInput, AreRefusedByName) { expect_all_refused(kPlans); }

TEST(CMeshesOfBadInput, AreMadeWhereNothingIsWrong) {
  MeshWorld world;
  EXPECT_C_OK(world.certify(world.numbers, 2));
  EXPECT_C_OK(world.certify_grids(kMostGridCells, 1));
  auto fault = sized<simdbezier_fault>();
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_EQ(fault.point, 0);
}

// These calls find the patch, but not the control point.
TEST(CMeshesOfBadInput, AreFoundByPatch) {
  const Refusal<MeshWorld> calls[] = {
      {SIMDBEZIER_NON_FINITE_INPUT, "", [](MeshWorld& w) { return w.certify_grids(2, 2); }},
      {SIMDBEZIER_NON_FINITE_INPUT, "", [](MeshWorld& w) { return w.certify(w.numbers, 2); }},
      {SIMDBEZIER_NON_FINITE_INPUT, "", [](MeshWorld& w) { return w.plan(); }},
      {SIMDBEZIER_NON_FINITE_INPUT, "", [](MeshWorld& w) { return w.tessellate(); }}};
  for (const Refusal<MeshWorld>& refused : calls) {
    MeshWorld world;
    world.values[50] = kNan;
    EXPECT_EQ(refused.call(world), refused.status);
    auto fault = sized<simdbezier_fault>();
    ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
    EXPECT_EQ(fault.patch, 1U) << fault.function;
    EXPECT_EQ(fault.point, -1) << fault.function;
    EXPECT_EQ(std::string(simdbezier_last_message()).find("(patch"), std::string::npos)
        << simdbezier_last_message();
  }
}

} // namespace
} // namespace simdbezier::tests::bad_meshes_test
