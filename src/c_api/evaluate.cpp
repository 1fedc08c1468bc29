// Patches and curves at samples: evaluations of simdbezier.h.
#include <simdbezier/evaluate.hpp>

#include "src/c_api/samples.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kSet{"set"};
constexpr Path kGrid{"grid"};
constexpr Path kSamples{"samples"};

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

/// evaluate() of patches or curves at any kind of samples.
template <typename Handle, typename Where, typename Out>
simdbezier_status evaluate_at(const char* function, const Handle* set, const Where* where,
                              const Path& path, const Out* out,
                              const simdbezier_options* options) noexcept {
  return answer(function, [&] {
    with_object(set, kSet,
                [&]<template <typename> typename Set, typename T>(const Set<T>& members) {
                  const auto at = where_of<T>(read(where, path));
                  const auto to = outputs_of<T>(out);
                  const Options how = call_options_of(options);
                  require_ok(evaluate(members, at, to, how), [&](Status status) {
                    return blamed_in_evaluation<Out>(status, path, to, sample_count(members, at),
                                                     members.components());
                  });
                });
  });
}

/// How many samples a set has; 0 where something is wrong.
template <typename Handle, typename Where>
std::size_t samples_at(const Handle* set, const Where* where) noexcept {
  return size_or_zero([&] {
    return with_object(set, kSet,
                       [&]<template <typename> typename Set, typename T>(const Set<T>& members) {
                         return sample_count(members, where_of<T>(read(where, {})));
                       });
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
      const auto where = where_of<T>(read(given, path));
      std::vector<PartialDerivative<T>> wanted;
      reserve(wanted, length);
      for (std::size_t k = 0; k < length; ++k) {
        const auto one = read_element(derivatives, k, "derivatives");
        wanted.push_back(
            {one.order_u, one.order_v, output_of<T>(one.out, Path{"derivatives", k} / "out")});
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
  const auto known = read_options(given, path);
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

/// The outputs of a tile as structs.
template <typename T>
void give_back(simdbezier_vectors& known, const Vectors<T>& out, std::size_t samples) noexcept {
  known = {out.x, out.y, out.z, out.stride, samples, kScalar<T>};
}
template <typename T>
void give_back(simdbezier_values& known, const Values<T>& out, std::size_t samples) noexcept {
  known = {out.first, samples, kScalar<T>};
}
template <typename T>
simdbezier_outputs given_back(const Outputs<T>& out, std::size_t samples) noexcept {
  simdbezier_outputs known{};
  known.struct_size = sizeof known;
  for_outputs(known, out, [&](auto& to, const auto& from, const char*) {
    if (from.wanted()) {
      give_back(to, from, samples);
    }
  });
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

// evaluate() at each kind of samples.
#define SIMDBEZIER_EVALUATE(set_type, out_type, where_type, where)                                 \
  simdbezier_status simdbezier_evaluate_##where_type(                                              \
      const simdbezier_##set_type* set, const simdbezier_##where_type* where,                      \
      const simdbezier_##out_type* out, const simdbezier_options* options) {                       \
    return evaluate_at(__func__, set, where, {#where}, out, options);                              \
  }
SIMDBEZIER_EVALUATE(patch_set, outputs, grid, grid)
SIMDBEZIER_EVALUATE(patch_set, outputs, patch_grids, grids)
SIMDBEZIER_EVALUATE(patch_set, outputs, samples, samples)
SIMDBEZIER_EVALUATE(curve_set, curve_outputs, curve_grid, grid)
SIMDBEZIER_EVALUATE(curve_set, curve_outputs, curve_grids, grids)
SIMDBEZIER_EVALUATE(curve_set, curve_outputs, curve_samples, samples)

// sample_count() of those whose sizes do not say it.
#define SIMDBEZIER_SAMPLE_COUNT(set_type, where_type)                                              \
  size_t simdbezier_##where_type##_sample_count(const simdbezier_##set_type* set,                  \
                                                const simdbezier_##where_type* where) {            \
    return samples_at(set, where);                                                                 \
  }
SIMDBEZIER_SAMPLE_COUNT(patch_set, grid)
SIMDBEZIER_SAMPLE_COUNT(patch_set, patch_grids)
SIMDBEZIER_SAMPLE_COUNT(curve_set, curve_grid)
SIMDBEZIER_SAMPLE_COUNT(curve_set, curve_grids)

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
      const Grid<T> where = where_of<T>(read(grid, kGrid));
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
      return largest_tile(patches, where_of<T>(read(grid, kGrid)), format_of(format));
    });
  });
}
