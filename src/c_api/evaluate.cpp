// Patches at samples: evaluations of simdbezier.h.
#include <simdbezier/evaluate.hpp>

#include "src/c_api/evaluate_set.hpp"
#include "src/c_api/outputs.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kSet{"set"};
constexpr Path kGrid{"grid"};
constexpr Path kGrids{"grids"};
constexpr Path kSamples{"samples"};
constexpr Path kOut{"out"};

static_assert(SIMDBEZIER_SAMPLE_NON_FINITE == static_cast<int>(SampleStatus::non_finite));

/// The bits of simdbezier_tile_format::outputs. They stay what they are where outputs are added,
/// whose bits follow the last one here, wherever Output has them.
struct OutputBit {
  std::uint32_t bit;
  Output output;
};
constexpr OutputBit kOutputBits[] = {{SIMDBEZIER_OUTPUT_POSITION, Output::position},
                                     {SIMDBEZIER_OUTPUT_DU, Output::du},
                                     {SIMDBEZIER_OUTPUT_DV, Output::dv},
                                     {SIMDBEZIER_OUTPUT_DUU, Output::duu},
                                     {SIMDBEZIER_OUTPUT_DUV, Output::duv},
                                     {SIMDBEZIER_OUTPUT_DVV, Output::dvv},
                                     {SIMDBEZIER_OUTPUT_NORMAL, Output::normal},
                                     {SIMDBEZIER_OUTPUT_CURVATURE, Output::curvature},
                                     {SIMDBEZIER_OUTPUT_STATUS, Output::status}};
static_assert(std::size(kOutputBits) == kOutputs, "every output has its bit");

template <typename T>
Grid<T> where_of(const simdbezier_grid* given) {
  const simdbezier_grid known = read(given, kGrid);
  return {
      known.nu,
      known.nv,
      grid_parameters<T>(known.u, known.u_length, known.nu, known.scalar, kGrid, {"u", "u_length"}),
      grid_parameters<T>(known.v, known.v_length, known.nv, known.scalar, kGrid, {"v", "v_length"}),
      parameters_of(known.parameters, kGrid),
      range_of(known.first_patch, known.patch_count)};
}

template <typename T>
PatchGrids where_of(const simdbezier_patch_grids* given) {
  const simdbezier_patch_grids known = read(given, kGrids);
  return {span_of(known.nu, known.nu_length, kGrids / "nu"),
          span_of(known.nv, known.nv_length, kGrids / "nv"),
          span_of(known.offset, known.offset_length, kGrids / "offset"),
          {known.first_patch, SetRange::kToTheEnd}};
}

template <typename T>
Samples<T> where_of(const simdbezier_samples* given) {
  const simdbezier_samples known = read(given, kSamples);
  return {span_of(known.patch, known.patch_length, kSamples / "patch"),
          sample_parameters<T>(known.u, known.u_length, known.scalar, kSamples, "u"),
          sample_parameters<T>(known.v, known.v_length, known.scalar, kSamples, "v"),
          parameters_of(known.parameters, kSamples)};
}

/// evaluate() of any kind of samples.
template <typename Where>
simdbezier_status evaluate_at(const char* function, const simdbezier_patch_set* set,
                              const Where* given, const Path& path, const simdbezier_outputs* out,
                              const simdbezier_options* options) noexcept {
  return evaluate_set(function, set, path, options, [&]<typename T>(std::type_identity<T>) {
    return SetCall{where_of<T>(given), outputs_of<T>(out)};
  });
}

/// evaluate_derivatives() of grids and samples.
template <typename Where>
simdbezier_status derivatives_at(const char* function, const simdbezier_patch_set* set,
                                 const Where* given, const Path& path,
                                 const simdbezier_partial_derivative* derivatives,
                                 std::size_t length, int first_component,
                                 const simdbezier_options* options) noexcept {
  return answer(function, [&] {
    with_object(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const auto where = where_of<T>(given);
      std::vector<PartialDerivative<T>> wanted;
      reserve(wanted, length);
      for (std::size_t k = 0; k < length; ++k) {
        const auto one = read_element(derivatives, k, "derivatives");
        wanted.push_back(
            {one.order_u, one.order_v, vectors_of<T>(one.out, Path{"derivatives", k} / "out")});
      }
      const Options how = call_options_of(options);
      const DerivativeOutputs<T> out(wanted, first_component);
      require_ok(evaluate_derivatives(patches, where, out, how), [&](Status status) -> Path {
        if (status == Status::bad_components) {
          return {"first_component"};
        }
        const bool about_orders = status == Status::bad_degree;
        const Path blamed = about_orders ? Path{"derivatives"} : blamed_in_call(status, path);
        return blamed.is_of(kOut) ? Path{"derivatives"} : blamed;
      });
    });
  });
}

TileFormat format_of(const simdbezier_tile_format* given) {
  const Path path{"format"};
  const simdbezier_tile_format known = read_options(given, path);
  TileFormat format;
  if (known.outputs != 0) {
    format.outputs = {};
    std::uint32_t rest = known.outputs;
    for (const auto& [bit, output] : kOutputBits) {
      if ((rest & bit) != 0) {
        format.outputs.add(output);
        rest -= bit;
      }
    }
    require(rest == 0, SIMDBEZIER_BAD_VALUE, path / "outputs");
  }
  format.layout = choice(known.layout, TileLayout::interleaved, path / "layout");
  format.samples = known.samples;
  format.first_component = known.first_component;
  return format;
}

template <typename T>
simdbezier_outputs given_back(const Outputs<T>& out, std::size_t samples) noexcept {
  simdbezier_outputs known{};
  known.struct_size = sizeof known;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    const Vectors<T>& vectors = out[static_cast<Output>(k)];
    if (vectors.wanted()) {
      known.*kVectorMembers[k] = {vectors.x,      vectors.y, vectors.z,
                                  vectors.stride, samples,   kScalar<T>};
    }
  }
  const auto values = [&](const Values<T>& of) {
    return of.wanted() ? simdbezier_values{of.first, samples, kScalar<T>} : simdbezier_values{};
  };
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    known.*kCurvatureMembers[k] = values(out.curvature[static_cast<Curvature>(k)]);
  }
  if (out.status.wanted()) {
    known.status = reinterpret_cast<std::uint8_t*>(out.status.first);
    known.status_length = samples;
  }
  known.first_component = out.first_component;
  return known;
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

float simdbezier_to_centred_f32(double u) { return to_centred<float>(u); }

double simdbezier_to_centred_f64(double u) { return to_centred<double>(u); }

simdbezier_status simdbezier_evaluate_grid(const simdbezier_patch_set* set,
                                           const simdbezier_grid* grid,
                                           const simdbezier_outputs* out,
                                           const simdbezier_options* options) {
  return evaluate_at(__func__, set, grid, kGrid, out, options);
}

simdbezier_status simdbezier_evaluate_patch_grids(const simdbezier_patch_set* set,
                                                  const simdbezier_patch_grids* grids,
                                                  const simdbezier_outputs* out,
                                                  const simdbezier_options* options) {
  return evaluate_at(__func__, set, grids, kGrids, out, options);
}

simdbezier_status simdbezier_evaluate_samples(const simdbezier_patch_set* set,
                                              const simdbezier_samples* samples,
                                              const simdbezier_outputs* out,
                                              const simdbezier_options* options) {
  return evaluate_at(__func__, set, samples, kSamples, out, options);
}

size_t simdbezier_grid_sample_count(const simdbezier_patch_set* set, const simdbezier_grid* grid) {
  return samples_at(set, [&]<typename T>(std::type_identity<T>) { return where_of<T>(grid); });
}

size_t simdbezier_patch_grids_sample_count(const simdbezier_patch_set* set,
                                           const simdbezier_patch_grids* grids) {
  return samples_at(set, [&]<typename T>(std::type_identity<T>) { return where_of<T>(grids); });
}

simdbezier_status
simdbezier_evaluate_grid_derivatives(const simdbezier_patch_set* set, const simdbezier_grid* grid,
                                     const simdbezier_partial_derivative* derivatives,
                                     size_t length, int32_t first_component,
                                     const simdbezier_options* options) {
  return derivatives_at(__func__, set, grid, kGrid, derivatives, length, first_component, options);
}

simdbezier_status simdbezier_evaluate_sample_derivatives(
    const simdbezier_patch_set* set, const simdbezier_samples* samples,
    const simdbezier_partial_derivative* derivatives, size_t length, int32_t first_component,
    const simdbezier_options* options) {
  return derivatives_at(__func__, set, samples, kSamples, derivatives, length, first_component,
                        options);
}

simdbezier_status simdbezier_evaluate_tiles(const simdbezier_patch_set* set,
                                            const simdbezier_grid* grid,
                                            const simdbezier_tile_format* format,
                                            simdbezier_tile_function function, void* context,
                                            const simdbezier_options* options) {
  return answer(__func__, [&] {
    require(function != nullptr, SIMDBEZIER_NULL_INPUT, {"function"});
    with_object(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const Grid<T> where = where_of<T>(grid);
      const TileFormat as = format_of(format);
      const Options how = call_options_of(options);
      const auto hand_over = [&](const Tile<T>& tile) {
        const simdbezier_outputs out = given_back(tile.out, tile.samples);
        const simdbezier_tile known{
            sizeof known,   tile.first_patch, tile.patch_count, tile.first_row,
            tile.row_count, tile.nu,          tile.samples,     &out,
            tile.worker};
        function(&known, context);
      };
      require_ok(evaluate_tiles(patches, where, as, hand_over, how), [](Status status) {
        const Path blamed = blamed_in_call(status, kGrid);
        return blamed.is_of(kOut) ? Path{"format"} : blamed;
      });
    });
  });
}

size_t simdbezier_largest_tile(const simdbezier_patch_set* set, const simdbezier_grid* grid,
                               const simdbezier_tile_format* format) {
  return size_or_zero([&] {
    return with_object(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      return largest_tile(patches, where_of<T>(grid), format_of(format));
    });
  });
}
