// Parts of a model through simdbezier.h: the values of the C++ calls.
#include <cstring>

#include <simdbezier/mesh_layout.hpp>

#include "tests/c_api/support/c_mesh_world.hpp"
#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::mesh_parts_test {
namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CMesh, Scalars);

constexpr std::size_t kPatches = 20;

template <typename C, typename Cpp>
void expect_same_keys(const C& found, const Cpp& expected) {
  EXPECT_EQ(std::memcmp(found.corners, expected.corners, sizeof expected.corners), 0);
  EXPECT_EQ(std::memcmp(found.edges, expected.edges, sizeof expected.edges), 0);
}

TYPED_TEST(CMesh, HasKeys) {
  using T = TypeParam;
  const ControlNets<T> nets = ControlNets<T>::packed(this->values_);
  std::vector<PatchKeys> expected(kPatches);
  ASSERT_TRUE(find_patch_keys<T>({&nets, 1}, expected));
  std::vector<simdbezier_patch_keys> keys(kPatches);
  EXPECT_C_OK(simdbezier_find_patch_keys(&this->c_nets_, 1, keys.data(), keys.size(), nullptr));
  for (std::size_t p = 0; p < kPatches; ++p) {
    expect_same_keys(keys[p], expected[p]);
    EXPECT_EQ(keys[p].points, expected[p].points);
    EXPECT_EQ(simdbezier_topology_is_entangled(this->c_topology_, p) != 0,
              this->topology_.is_entangled(p));
  }
  EXPECT_EQ(simdbezier_topology_is_entangled(this->c_topology_, kPatches), 0);
  EXPECT_EQ(simdbezier_topology_is_entangled(nullptr, 0), 0);
}

// The first half of the model tells the second one.
TYPED_TEST(CMesh, NumbersParts) {
  constexpr std::size_t kHalf = kPatches / 2;
  std::vector<PatchVertices> expected(kHalf);
  ASSERT_TRUE(owned_vertices(this->layout_, {0, kHalf}, 1000, expected));
  std::vector<simdbezier_patch_vertices> owned(kHalf);
  EXPECT_C_OK(
      simdbezier_owned_vertices(this->c_layout_, 0, kHalf, 1000, owned.data(), owned.size()));
  for (std::size_t p = 0; p < kHalf; ++p) {
    expect_same_keys(owned[p], expected[p]);
  }
  std::vector<std::uint64_t> numbers(this->layout_.size().vertices);
  std::vector<std::uint64_t> c_numbers(numbers.size());
  const SetRange own{kHalf, kPatches - kHalf};
  ASSERT_TRUE(number_part(this->layout_, own, 5000, expected, numbers));
  EXPECT_C_OK(simdbezier_number_part(this->c_layout_, own.first, own.count, 5000, owned.data(),
                                     owned.size(), c_numbers.data(), c_numbers.size()));
  EXPECT_EQ(c_numbers, numbers);
  EXPECT_C_OK(simdbezier_owned_vertices(this->c_layout_, 7, 0, 0, nullptr, 0)); // of no patch
}

TYPED_TEST(CMesh, HasSingleVertices) {
  const MeshLayout& layout = this->layout_;
  const simdbezier_mesh_layout* const c_layout = this->c_layout_;
  for (std::size_t p = 0; p <= kPatches; ++p) { // one that does not exist as well
    for (std::size_t corner = 0; corner < 5; ++corner) {
      EXPECT_EQ(simdbezier_mesh_layout_corner(c_layout, p, corner), layout.corner(p, corner));
    }
    for (int side = 0; side < 4; ++side) {
      const auto edge = static_cast<PatchEdge>(side);
      const std::uint32_t segments = layout.segments(p, edge);
      EXPECT_EQ(simdbezier_mesh_layout_segments(c_layout, p, side), segments);
      for (std::uint32_t k = 0; k <= segments + 1; ++k) {
        EXPECT_EQ(simdbezier_mesh_layout_along(c_layout, p, side, k), layout.along(p, edge, k));
      }
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
      EXPECT_EQ(simdbezier_mesh_layout_inner(c_layout, p, i, 1), layout.inner(p, i, 1));
    }
  }
  for (const int edge : {-1, 4, 256}) {
    EXPECT_EQ(simdbezier_mesh_layout_segments(c_layout, 0, edge), 0U);
    EXPECT_EQ(simdbezier_mesh_layout_along(c_layout, 0, edge, 0), UINT32_MAX);
  }
  EXPECT_EQ(simdbezier_mesh_layout_corner(nullptr, 0, 0), UINT32_MAX);
  EXPECT_EQ(simdbezier_mesh_layout_segments(nullptr, 0, 0), 0U);
  EXPECT_EQ(simdbezier_mesh_layout_along(nullptr, 0, 0, 0), UINT32_MAX);
  EXPECT_EQ(simdbezier_mesh_layout_inner(nullptr, 0, 1, 1), UINT32_MAX);
}

simdbezier_patch_keys keys[2];
simdbezier_patch_vertices vertices[2];
std::uint64_t numbers[4096];

const Refusal<MeshWorld> kRefusals[] = {
    {SIMDBEZIER_NULL_OUTPUT, "keys",
     [](MeshWorld& w) { return simdbezier_find_patch_keys(&w.nets, 1, nullptr, 2, nullptr); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "keys",
     [](MeshWorld& w) { return simdbezier_find_patch_keys(&w.nets, 1, keys, 1, nullptr); }},
    {SIMDBEZIER_BAD_DEGREE, "nets->degree_u or degree_v",
     [](MeshWorld& w) {
       w.nets.degree_u = 0;
       return simdbezier_find_patch_keys(&w.nets, 1, keys, 2, nullptr);
     }},
    {SIMDBEZIER_NULL_INPUT, "part",
     [](MeshWorld&) { return simdbezier_owned_vertices(nullptr, 0, 1, 0, vertices, 2); }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "own_first or own_count",
     [](MeshWorld& w) { return simdbezier_owned_vertices(w.layout, 1, 2, 0, vertices, 2); }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "out",
     [](MeshWorld& w) { return simdbezier_owned_vertices(w.layout, 0, 2, 0, vertices, 1); }},
    {SIMDBEZIER_NULL_INPUT, "part",
     [](MeshWorld&) {
       return simdbezier_number_part(nullptr, 1, 1, 0, vertices, 1, numbers, 4096);
     }},
    {SIMDBEZIER_NULL_INPUT, "ghosts",
     [](MeshWorld& w) {
       return simdbezier_number_part(w.layout, 1, 1, 0, nullptr, 1, numbers, 4096);
     }},
    {SIMDBEZIER_UNEQUAL_LENGTHS, "ghosts_length",
     [](MeshWorld& w) {
       return simdbezier_number_part(w.layout, 1, 1, 0, vertices, 2, numbers, 4096);
     }},
    {SIMDBEZIER_BAD_PATCH_RANGE, "own_first or own_count",
     [](MeshWorld& w) {
       return simdbezier_number_part(w.layout, 2, 1, 0, vertices, 2, numbers, 4096);
     }},
    {SIMDBEZIER_OUTPUT_TOO_SMALL, "numbers", [](MeshWorld& w) {
       return simdbezier_number_part(w.layout, 1, 1, 0, vertices, 1, numbers, 1);
     }}};

TEST(CMeshParts, RefuseWhatMakesNoSense) { expect_all_refused(kRefusals); }

} // namespace
} // namespace simdbezier::tests::mesh_parts_test
