// What a tile function is handed through simdbezier.h is what a C++ one is handed, to the last
// member.
#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::tiles_test {
namespace {

/// Everything that tiles say, one number after the other.
using Facts = std::vector<double>;

/// Where a tile lies; the members have the same names in C and C++.
template <typename AnyTile>
Facts place_of(const AnyTile& tile) {
  Facts facts;
  for (const std::size_t size : {tile.first_patch, tile.patch_count, tile.first_row, tile.row_count,
                                 tile.nu, tile.samples}) {
    facts.push_back(static_cast<double>(size));
  }
  facts.push_back(tile.worker);
  return facts;
}

template <typename T>
void add_vectors(Facts& facts, const T* x, const T* y, const T* z, std::ptrdiff_t stride,
                 std::size_t samples) {
  facts.push_back(static_cast<double>(stride));
  for (std::size_t k = 0; k < samples; ++k) {
    const auto at = static_cast<std::ptrdiff_t>(k) * stride;
    facts.insert(facts.end(), {x[at], y[at], z[at]});
  }
}

template <typename T>
Facts facts_of(const Tile<T>& tile) {
  Facts facts = place_of(tile);
  facts.push_back(tile.out.first_component);
  for (std::size_t group = 0; group < kVectorOutputs; ++group) {
    const Vectors<T>& vectors = tile.out[static_cast<Output>(group)];
    facts.push_back(vectors.wanted() ? 1 : 0);
    if (vectors.wanted()) {
      add_vectors(facts, vectors.x, vectors.y, vectors.z, vectors.stride, tile.samples);
    }
  }
  const auto& curvature = tile.out.curvature;
  for (const Values<T>* values :
       {&curvature.gaussian, &curvature.mean, &curvature.minimum, &curvature.maximum}) {
    facts.push_back(values->wanted() ? 1 : 0);
    if (values->wanted()) {
      facts.insert(facts.end(), values->first, values->first + tile.samples);
    }
  }
  facts.push_back(tile.out.status.wanted() ? 1 : 0);
  for (std::size_t k = 0; tile.out.status.wanted() && k < tile.samples; ++k) {
    facts.push_back(static_cast<double>(tile.out.status.first[k]));
  }
  return facts;
}

template <typename T>
Facts facts_of(const simdbezier_tile& tile) {
  EXPECT_EQ(tile.struct_size, sizeof tile);
  const simdbezier_outputs& out = *tile.out;
  EXPECT_EQ(out.struct_size, sizeof out);
  Facts facts = place_of(tile);
  facts.push_back(out.first_component);
  for (const simdbezier_vectors* vectors :
       {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal}) {
    facts.push_back(vectors->x != nullptr ? 1 : 0);
    if (vectors->x != nullptr) {
      EXPECT_EQ(vectors->scalar, kCScalar<T>);
      EXPECT_EQ(vectors->capacity, tile.samples);
      add_vectors(facts, static_cast<const T*>(vectors->x), static_cast<const T*>(vectors->y),
                  static_cast<const T*>(vectors->z), vectors->stride, tile.samples);
    }
  }
  for (const simdbezier_values* values : {&out.gaussian, &out.mean, &out.minimum, &out.maximum}) {
    facts.push_back(values->first != nullptr ? 1 : 0);
    if (values->first != nullptr) {
      EXPECT_EQ(values->scalar, kCScalar<T>);
      EXPECT_EQ(values->length, tile.samples);
      const auto* const first = static_cast<const T*>(values->first);
      facts.insert(facts.end(), first, first + tile.samples);
    }
  }
  facts.push_back(out.status != nullptr ? 1 : 0);
  EXPECT_EQ(out.status_length, out.status != nullptr ? tile.samples : 0);
  for (std::size_t k = 0; k < out.status_length; ++k) {
    facts.push_back(out.status[k]);
  }
  return facts;
}

template <typename T>
void collect(const simdbezier_tile* tile, void* context) {
  static_cast<std::vector<Facts>*>(context)->push_back(facts_of<T>(*tile));
}

struct Case {
  int components;
  std::int32_t first_component;
  std::uint32_t outputs;
  std::size_t samples; // the most in one tile
};
// Patches have 7 x 5 samples: a row, some rows, some patches, all of them a tile. Normals and
// curvatures are of sets with three components.
const Case kCases[] = {
    {3, 0, SIMDBEZIER_OUTPUT_POSITION, 7},
    {5, 2, SIMDBEZIER_OUTPUT_POSITION, 14},
    {5, 1, SIMDBEZIER_OUTPUT_DUU | SIMDBEZIER_OUTPUT_DVV, 100},
    {3, 0, SIMDBEZIER_OUTPUT_DU | SIMDBEZIER_OUTPUT_NORMAL | SIMDBEZIER_OUTPUT_STATUS, 70},
    {3, 0, SIMDBEZIER_OUTPUT_CURVATURE, 0},
    {3, 0, 0x1FF, 35},
    {3, 0, 0x1FF, 0},
};

template <typename T>
class CTiles : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CTiles, Scalars);

TYPED_TEST(CTiles, SayWhatCppTilesSay) {
  using T = TypeParam;
  constexpr std::size_t kPatches = 5;
  const simdbezier_grid c_grid = simdbezier_uniform_grid(7, 5);
  auto options = sized<simdbezier_options>();
  options.threads = 1; // tiles in order
  for (const Case& c : kCases) {
    const std::vector<T> values =
        random_values<T>(kPatches * 12 * static_cast<std::size_t>(c.components), 4);
    PatchSet<T> set;
    ASSERT_TRUE(pack(ControlNets<T>::packed(values, 3, 2, c.components), set));
    const CPatchSet c_set = c_pack<T>(simdbezier_packed_nets_of(
        values.data(), values.size(), 3, 2, c.components, SIMDBEZIER_POLYNOMIAL, kCScalar<T>));
    for (const simdbezier_tile_layout layout :
         {SIMDBEZIER_TILE_PLANES, SIMDBEZIER_TILE_TRIPLES, SIMDBEZIER_TILE_INTERLEAVED}) {
      TileFormat format;
      format.outputs = {};
      for (std::size_t output = 0; output < 9; ++output) {
        if ((c.outputs >> output & 1U) != 0) {
          format.outputs.add(static_cast<Output>(output));
        }
      }
      format.layout = static_cast<TileLayout>(layout);
      format.samples = c.samples;
      format.first_component = c.first_component;
      std::vector<Facts> expected;
      const Status status = evaluate_tiles(set, Grid<T>::uniform(7, 5), format,
                                           [&](const Tile<T>& tile) {
                                             EXPECT_EQ(tile.out.first_component, c.first_component);
                                             expected.push_back(facts_of(tile));
                                           },
                                           {.threads = 1});
      ASSERT_EQ(to_string(status), to_string(Status::ok)) << c.outputs << ' ' << c.first_component;
      auto c_format = sized<simdbezier_tile_format>();
      c_format.outputs = c.outputs;
      c_format.layout = layout;
      c_format.samples = c.samples;
      c_format.first_component = c.first_component;
      std::vector<Facts> got;
      EXPECT_C_OK(
          simdbezier_evaluate_tiles(c_set.get(), &c_grid, &c_format, &collect<T>, &got, &options));
      ASSERT_FALSE(expected.empty());
      EXPECT_EQ(got, expected) << "outputs " << c.outputs << " of component " << c.first_component
                               << ", layout " << layout << ", samples " << c.samples;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::tiles_test
