// How simdbezier.h describes faults, how its structs grow, and its statuses.
#include "tests/c_api/support/c_refusal.hpp"
#include "tests/c_api/support/c_world.hpp"

namespace simdbezier::tests::faults_test {
namespace {

TEST(CFaults, AreDescribedInOneLine) {
  World world;
  world.values[50] = kNan;
  EXPECT_EQ(world.pack(), SIMDBEZIER_NON_FINITE_INPUT);
  EXPECT_STREQ(simdbezier_last_message(),
               "simdbezier_pack: nets[0].points: a control point or a parameter of the whole call "
               "is nan or infinite (patch 1, point 0, component 2)");
  auto fault = sized<simdbezier_fault>();
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_EQ(fault.patch, 1U);
  EXPECT_EQ(fault.component, 2);
  EXPECT_STREQ(fault.function, "simdbezier_pack");
  EXPECT_EQ(simdbezier_last_fault(nullptr), SIMDBEZIER_NULL_OUTPUT);
  EXPECT_EQ(world.evaluate(), SIMDBEZIER_OK);
  EXPECT_STREQ(simdbezier_last_message(), "simdbezier_evaluate_grid: ok");
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_STREQ(fault.function, "simdbezier_evaluate_grid");
  EXPECT_STREQ(fault.argument, "");
  EXPECT_EQ(fault.status, SIMDBEZIER_OK);
  EXPECT_EQ(fault.point, 0);
  EXPECT_EQ(fault.patch + static_cast<std::size_t>(fault.component), 0U);
}

TEST(CFaults, OfOneNetAmongSeveralAreFound) {
  World world;
  simdbezier_nets several[2] = {world.nets, world.nets};
  several[0].count = several[1].count = 1;
  several[1].points = world.values.data() + 48;
  world.values[50] = kNan;
  EXPECT_EQ(simdbezier_pack(several, 2, SIMDBEZIER_F64, nullptr, &world.made),
            SIMDBEZIER_NON_FINITE_INPUT);
  auto fault = sized<simdbezier_fault>();
  ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
  EXPECT_STREQ(fault.argument, "nets[1].points");
  several[1].scalar = SIMDBEZIER_F64;
  EXPECT_EQ(simdbezier_pack(several, 2, SIMDBEZIER_F64, nullptr, &world.made),
            SIMDBEZIER_BAD_SCALAR);
}

TEST(CStructs, GrowAtTheirEnd) {
  World world;
  Later later(world.grid, 0);
  EXPECT_EQ(simdbezier_evaluate_grid(world.set.get(), &later.known, &world.out, nullptr),
            SIMDBEZIER_OK);
  later.unknown = 1;
  EXPECT_EQ(simdbezier_evaluate_grid(world.set.get(), &later.known, &world.out, nullptr),
            SIMDBEZIER_BAD_STRUCT_SIZE);
  struct {
    simdbezier_patch_shape shape;
    std::size_t unknown;
  } result{};
  result.unknown = 5;
  result.shape.struct_size = sizeof result;
  EXPECT_EQ(simdbezier_patch_set_shape(world.set.get(), 0, &result.shape), SIMDBEZIER_OK);
  EXPECT_EQ(result.unknown, 0U);
  EXPECT_EQ(result.shape.struct_size, sizeof result);
}

TEST(CStatuses, AreThoseOfCppAndFourMore) {
  // A Status that has no name in types.h shows here.
  int codes = 0;
  while (to_string(static_cast<Status::Code>(codes)) != "unknown status") {
    EXPECT_EQ(simdbezier_status_text(codes), to_string(static_cast<Status::Code>(codes)));
    ++codes;
  }
  EXPECT_EQ(codes, SIMDBEZIER_BAD_TOPOLOGY + 1);
  for (const simdbezier_status status : {SIMDBEZIER_BAD_STRUCT_SIZE, SIMDBEZIER_BAD_SCALAR,
                                         SIMDBEZIER_BAD_VALUE, SIMDBEZIER_BAD_ALIGNMENT}) {
    EXPECT_STRNE(simdbezier_status_text(status), "unknown status");
  }
  for (const simdbezier_status status : {-1, 99, 256, 1000}) {
    EXPECT_STREQ(simdbezier_status_text(status), "unknown status");
  }
}

} // namespace
} // namespace simdbezier::tests::faults_test
