// Evaluations through simdbezier.h give the bits of the C++ calls.
#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::evaluate_test {
namespace {

template <typename T>
class CEvaluation : public ::testing::Test {
protected:
  static constexpr std::size_t kPatches = 5;

  /// Rational patches of degree 4 x 2, so that nothing hides behind the bicubic kernels.
  void SetUp() override {
    values_ = random_values<T>(kPatches * 15 * 4, 3);
    const auto nets = ControlNets<T>::packed(values_, 4, 2, 3, Weights::cartesian);
    ASSERT_TRUE(pack(nets, set_));
    c_set_ = c_pack<T>(c_nets(values_, 4, 2, SIMDBEZIER_CARTESIAN));
    ASSERT_EQ(simdbezier_patch_set_size(c_set_.get()), kPatches);
  }

  /// Memory of all outputs, for both calls.
  struct Room {
    explicit Room(std::size_t samples)
        : vertices(7, std::vector<T>(3 * samples)), numbers(4, std::vector<T>(samples)),
          status(samples) {}
    std::vector<std::vector<T>> vertices;
    std::vector<std::vector<T>> numbers;
    std::vector<std::uint8_t> status;

    Outputs<T> outputs() {
      Outputs<T> out;
      for (std::size_t k = 0; k < kVectorOutputs; ++k) {
        out[static_cast<Output>(k)] = Vectors<T>::xyz(vertices[k]);
      }
      out.curvature = {numbers[0], numbers[1], numbers[2], numbers[3]};
      out.status = std::span(reinterpret_cast<SampleStatus*>(status.data()), status.size());
      return out;
    }
    simdbezier_outputs c_outputs() {
      auto out = sized<simdbezier_outputs>();
      out.position = c_triples(vertices[0]);
      out.du = c_triples(vertices[1]);
      out.dv = c_triples(vertices[2]);
      out.duu = c_triples(vertices[3]);
      out.duv = c_triples(vertices[4]);
      out.dvv = c_triples(vertices[5]);
      out.normal = c_triples(vertices[6]);
      out.gaussian = c_values(numbers[0]);
      out.mean = c_values(numbers[1]);
      out.minimum = c_values(numbers[2]);
      out.maximum = c_values(numbers[3]);
      out.status = status.data();
      out.status_length = status.size();
      return out;
    }
    void expect_same(const Room& other) const {
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        expect_same_bits(vertices[k], other.vertices[k], "a vector");
      }
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        expect_same_bits(numbers[k], other.numbers[k], "a curvature");
      }
      expect_same_bits(status, other.status, "the status");
    }
  };

  /// The C++ call and the C call, each into memory of its own.
  template <typename Where, typename CCall>
  void expect_same(const Where& where, std::size_t samples, CCall c_call) {
    ASSERT_EQ(sample_count(set_, where), samples);
    Room expected(samples);
    Room got(samples);
    ASSERT_TRUE(evaluate(set_, where, expected.outputs()));
    const simdbezier_outputs out = got.c_outputs();
    EXPECT_C_OK(c_call(&out));
    got.expect_same(expected);
  }

  std::vector<T> values_;
  PatchSet<T> set_;
  CPatchSet c_set_;
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CEvaluation, Scalars);

TYPED_TEST(CEvaluation, OfUniformGrids) {
  using T = TypeParam;
  const simdbezier_grid grid = simdbezier_uniform_grid(7, 4);
  EXPECT_EQ(simdbezier_grid_sample_count(this->c_set_.get(), &grid), 5U * 28U);
  this->expect_same(Grid<T>::uniform(7, 4), 5 * 28, [&](const simdbezier_outputs* out) {
    return simdbezier_evaluate_grid(this->c_set_.get(), &grid, out, nullptr);
  });
}

TYPED_TEST(CEvaluation, OfGivenParametersAndARange) {
  using T = TypeParam;
  const std::vector<T> u = {T(0.25), T(1), T(0.3)};
  const std::vector<T> v = {T(-0.5), T(0.1)};
  auto grid = simdbezier_uniform_grid(3, 2);
  grid.u = u.data();
  grid.v = v.data();
  grid.u_length = 3;
  grid.v_length = 2;
  grid.scalar = kCScalar<T>;
  grid.parameters = SIMDBEZIER_CENTRED;
  grid.first_patch = 1;
  grid.patch_count = 2;
  this->expect_same(Grid<T>::at(u, v, Parameters::centred, {1, 2}), 12,
                    [&](const simdbezier_outputs* out) {
                      return simdbezier_evaluate_grid(this->c_set_.get(), &grid, out, nullptr);
                    });
}

TYPED_TEST(CEvaluation, OfAGridForEachPatch) {
  const std::vector<std::uint32_t> nu = {3, 2, 9};
  const std::vector<std::uint32_t> nv = {2, 5, 3};
  auto grids = sized<simdbezier_patch_grids>();
  grids.nu = nu.data();
  grids.nv = nv.data();
  grids.nu_length = grids.nv_length = 3;
  grids.first_patch = 2;
  EXPECT_EQ(simdbezier_patch_grids_sample_count(this->c_set_.get(), &grids), 43U);
  this->expect_same(PatchGrids{nu, nv, {}, 2}, 43, [&](const simdbezier_outputs* out) {
    return simdbezier_evaluate_patch_grids(this->c_set_.get(), &grids, out, nullptr);
  });
}

template <typename T>
simdbezier_samples c_samples(const std::vector<std::uint32_t>& patch, const std::vector<T>& u,
                             const std::vector<T>& v) {
  if constexpr (sizeof(T) == 4) {
    return simdbezier_samples_f32(patch.data(), u.data(), v.data(), patch.size());
  } else {
    return simdbezier_samples_f64(patch.data(), u.data(), v.data(), patch.size());
  }
}

TYPED_TEST(CEvaluation, OfSingleSamples) {
  using T = TypeParam;
  const std::vector<std::uint32_t> patch = {4, 0, 0, 3};
  const std::vector<T> u = {T(0), T(0.3), T(1), T(0.75)};
  const std::vector<T> v = {T(0.5), T(0.9), T(1), T(0.1)};
  const simdbezier_samples samples = c_samples(patch, u, v);
  this->expect_same(Samples<T>{patch, u, v}, 4, [&](const simdbezier_outputs* out) {
    return simdbezier_evaluate_samples(this->c_set_.get(), &samples, out, nullptr);
  });
}

TYPED_TEST(CEvaluation, OfDerivativesOfAnyOrder) {
  using T = TypeParam;
  std::vector<T> expected(6 * 5 * 12);
  std::vector<T> got(expected.size());
  const std::vector<PartialDerivative<T>> derivatives = {
      {3, 1, Vectors<T>::xyz(std::span(expected), 6)},
      {0, 2, Vectors<T>::xyz(std::span(expected).subspan(3), 6)}};
  ASSERT_TRUE(evaluate_derivatives(this->set_, Grid<T>::uniform(4, 3), derivatives));
  simdbezier_partial_derivative c_derivatives[2] = {sized<simdbezier_partial_derivative>(),
                                                    sized<simdbezier_partial_derivative>()};
  c_derivatives[0].order_u = 3;
  c_derivatives[0].order_v = 1;
  c_derivatives[0].out = c_triples(got, 6);
  c_derivatives[1].order_v = 2;
  c_derivatives[1].out = c_derivatives[0].out;
  for (void** const member :
       {&c_derivatives[1].out.x, &c_derivatives[1].out.y, &c_derivatives[1].out.z}) {
    *member = static_cast<T*>(*member) + 3;
  }
  const simdbezier_grid grid = simdbezier_uniform_grid(4, 3);
  EXPECT_C_OK(simdbezier_evaluate_grid_derivatives(this->c_set_.get(), &grid, c_derivatives, 2, 0,
                                                   nullptr));
  expect_same_bits(got, expected, "derivatives");

  const std::vector<std::uint32_t> patch = {0};
  const std::vector<T> zero = {T(0)};
  const simdbezier_samples samples = c_samples(patch, zero, zero);
  std::fill(got.begin(), got.end(), T(0));
  EXPECT_C_OK(simdbezier_evaluate_sample_derivatives(this->c_set_.get(), &samples, c_derivatives, 2,
                                                     0, nullptr));
  EXPECT_TRUE(std::equal(got.begin(), got.begin() + 6, expected.begin()));
}

/// Collects what a tile function is handed.
template <typename T>
struct Collected {
  std::vector<T> positions;
  std::size_t samples = 0;
  static void collect(const simdbezier_tile* tile, void* context) {
    auto& self = *static_cast<Collected*>(context);
    EXPECT_EQ(tile->samples, tile->patch_count * tile->row_count * tile->nu);
    EXPECT_EQ(tile->out->position.scalar, kCScalar<T>);
    EXPECT_EQ(tile->out->normal.x, nullptr);
    for (std::size_t k = 0; k < tile->samples; ++k) {
      const auto at = static_cast<std::ptrdiff_t>(k) * tile->out->position.stride;
      for (const void* const plane :
           {tile->out->position.x, tile->out->position.y, tile->out->position.z}) {
        self.positions.push_back(static_cast<const T*>(plane)[at]);
      }
    }
    self.samples += tile->samples;
  }
};

TYPED_TEST(CEvaluation, OfTiles) {
  using T = TypeParam;
  std::vector<T> expected(3 * 5 * 35);
  Outputs<T> out;
  out.position = Vectors<T>::xyz(expected);
  ASSERT_TRUE(evaluate(this->set_, Grid<T>::uniform(7, 5), out));
  const simdbezier_grid grid = simdbezier_uniform_grid(7, 5);
  auto format = sized<simdbezier_tile_format>();
  format.outputs = SIMDBEZIER_OUTPUT_POSITION;
  format.layout = SIMDBEZIER_TILE_TRIPLES;
  format.samples = 14;
  EXPECT_EQ(simdbezier_largest_tile(this->c_set_.get(), &grid, &format), 14U);
  auto options = sized<simdbezier_options>();
  options.threads = 1;
  Collected<T> tiles;
  EXPECT_C_OK(simdbezier_evaluate_tiles(this->c_set_.get(), &grid, &format, &Collected<T>::collect,
                                        &tiles, &options));
  expect_same_bits(tiles.positions, expected, "tiles");
}

TYPED_TEST(CEvaluation, BoundsErrors) {
  const ErrorBounds expected = error_bounds(this->set_, 2);
  auto bounds = sized<simdbezier_error_bounds_of_patch>();
  EXPECT_C_OK(
      simdbezier_patch_error_bounds(this->c_set_.get(), 2, SIMDBEZIER_ISA_AUTOMATIC, &bounds));
  EXPECT_EQ(std::memcmp(bounds.position, expected.position, sizeof expected.position), 0);
  EXPECT_EQ(std::memcmp(bounds.du, expected.du, sizeof expected.du), 0);
  EXPECT_EQ(std::memcmp(bounds.dv, expected.dv, sizeof expected.dv), 0);
  double largest = 0;
  EXPECT_C_OK(
      simdbezier_largest_position_bound(this->c_set_.get(), SIMDBEZIER_ISA_AUTOMATIC, &largest));
  EXPECT_EQ(largest, largest_position_bound(this->set_));
}

TYPED_TEST(CEvaluation, SaysWhatASetIs) {
  auto shape = sized<simdbezier_patch_shape>();
  EXPECT_C_OK(simdbezier_patch_set_shape(this->c_set_.get(), 4, &shape));
  EXPECT_EQ(shape.degree_u, 4);
  EXPECT_EQ(shape.degree_v, 2);
  EXPECT_EQ(shape.components, 3);
  EXPECT_EQ(shape.rational, 1);
  EXPECT_EQ(simdbezier_patch_set_scalar(this->c_set_.get()), kCScalar<TypeParam>);
  EXPECT_EQ(simdbezier_patch_set_components(this->c_set_.get()), 3);
  EXPECT_EQ(simdbezier_patch_set_size(nullptr), 0U);
}

TYPED_TEST(CEvaluation, TellsWhichKernelRan) {
  using T = TypeParam;
  std::vector<T> room(3 * 5 * 4);
  auto out = sized<simdbezier_outputs>();
  out.position = c_triples(room);
  const simdbezier_grid grid = simdbezier_uniform_grid(2, 2);
  std::vector<simdbezier_isa> isas(8);
  isas.resize(simdbezier_available_isas(isas.data(), isas.size()));
  ASSERT_EQ(isas.size(), available_isas().size());
  for (const simdbezier_isa isa : isas) {
    auto options = sized<simdbezier_options>();
    options.isa = isa;
    EXPECT_C_OK(simdbezier_evaluate_grid(this->c_set_.get(), &grid, &out, &options));
    EXPECT_EQ(simdbezier_take_executed_isa(), isa) << simdbezier_isa_name(isa);
    EXPECT_EQ(simdbezier_take_executed_isa(), SIMDBEZIER_ISA_AUTOMATIC) << "no call since then";
    simdbezier_isa named = SIMDBEZIER_ISA_AUTOMATIC;
    EXPECT_C_OK(simdbezier_isa_from_name(simdbezier_isa_name(isa), &named));
    EXPECT_EQ(named, isa);
  }
}

TEST(CParameters, AreCentredAsInCpp) {
  for (const double u : {0.0, 0.1, 1.0 / 3, 0.5, 0.75 + 0x1p-30, 1.0}) {
    EXPECT_EQ(simdbezier_to_centred_f32(u), to_centred<float>(u)) << u;
    EXPECT_EQ(simdbezier_to_centred_f64(u), to_centred<double>(u)) << u;
  }
}

} // namespace
} // namespace simdbezier::tests::evaluate_test
