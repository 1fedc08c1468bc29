// The tiles call: as the grid call, but into each thread's own memory, and then to the caller.
#include <algorithm>

#include <simdbezier/tiles.hpp>

#include "src/calls/grid_evaluator.hpp"
#include "src/calls/grid_request.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

WantedGroups groups_of(const TileFormat& format) noexcept {
  return {
      {format.position, format.du, format.dv, format.duu, format.duv, format.dvv, format.normal}};
}

/// Half of a common first-level cache: the caller reads what has just been written.
constexpr std::size_t kTileBytes = std::size_t{24} << 10;

/// Which samples one tile holds.
struct TileShape {
  std::size_t rows = 0;    ///< of one patch
  std::size_t strips = 0;  ///< tiles that one patch takes
  std::size_t patches = 1; ///< in one tile, where one strip is all of a patch
  std::size_t samples = 0; ///< the most
};

template <typename T>
bool choose_shape(std::size_t nu, std::size_t nv, std::size_t patches, std::size_t values,
                  const TileFormat& format, TileShape& shape) noexcept {
  const std::size_t bytes = values * sizeof(T);
  const std::size_t most =
      std::max<std::size_t>(format.samples != 0 ? format.samples : kTileBytes / bytes, 1);
  shape.rows = std::clamp<std::size_t>(most / nu, 1, nv);
  shape.strips = (nv + shape.rows - 1) / shape.rows;
  shape.rows = (nv + shape.strips - 1) / shape.strips; // even strips
  shape.strips = (nv + shape.rows - 1) / shape.rows;
  shape.patches = shape.strips > 1 ? 1
                                   : std::clamp<std::size_t>(most / (nu * nv), 1,
                                                             std::max<std::size_t>(patches, 1));
  return !__builtin_mul_overflow(shape.rows * nu, shape.patches, &shape.samples) &&
         shape.samples <= static_cast<std::size_t>(-1) / 4 / bytes;
}

/// The places of one tile's samples.
template <typename T>
class TileMemory {
public:
  TileMemory(const TileFormat& format, std::size_t dimension, std::size_t samples) noexcept
      : format_(format), dimension_(dimension), samples_(samples) {}

  [[nodiscard]] std::size_t bytes() const noexcept {
    const std::size_t values = vector_values(groups_of(format_), dimension_);
    const std::size_t bytes = (format_.status ? whole_lines(samples_) : 0) +
                              (format_.curvature ? kCurvatures * taken(samples_) : 0);
    switch (format_.layout) {
    case TileLayout::planes:
      return bytes + values * taken(samples_);
    case TileLayout::xyz:
      return bytes + values / dimension_ * taken(dimension_ * samples_);
    default:
      return bytes + taken(values * samples_);
    }
  }

  [[nodiscard]] Outputs<T> place(unsigned char* memory) const noexcept {
    Outputs<T> out;
    const WantedGroups wanted = groups_of(format_);
    Vectors<T>* const group[kGroups] = {&out.position, &out.du,  &out.dv,    &out.duu,
                                        &out.duv,      &out.dvv, &out.normal};
    const std::size_t members = vector_values(wanted, dimension_);
    std::size_t at = 0;
    std::size_t member = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (!wanted.group[g]) {
        continue;
      }
      if (format_.layout == TileLayout::planes) {
        T* plane[3] = {nullptr, nullptr, nullptr};
        for (std::size_t c = 0; c < dimension_; ++c) {
          plane[c] = take(memory, at, samples_);
        }
        *group[g] = Vectors<T>::planes(plane[0], plane[1], plane[2]);
      } else if (format_.layout == TileLayout::xyz) {
        *group[g] = records(take(memory, at, dimension_ * samples_), dimension_);
      } else {
        *group[g] = records(reinterpret_cast<T*>(memory) + member, members);
        member += dimension_;
      }
    }
    if (member > 0) {
      take(memory, at, member * samples_);
    }
    if (format_.curvature) {
      for (T** const plane : {&out.curvature.gaussian, &out.curvature.mean, &out.curvature.minimum,
                              &out.curvature.maximum}) {
        *plane = take(memory, at, samples_);
      }
    }
    if (format_.status) {
      out.status = reinterpret_cast<SampleStatus*>(memory + at);
    }
    return out;
  }

private:
  /// A line more than needed: planes of a round number of samples would compete for the same sets
  /// of the cache.
  static std::size_t taken(std::size_t values) noexcept {
    return whole_lines(values * sizeof(T)) + 64;
  }
  static T* take(unsigned char* memory, std::size_t& at, std::size_t values) noexcept {
    T* const place = reinterpret_cast<T*>(memory + at);
    at += taken(values);
    return place;
  }

  [[nodiscard]] Vectors<T> records(T* first, std::size_t stride) const noexcept {
    return {first, dimension_ > 1 ? first + 1 : nullptr, dimension_ > 2 ? first + 2 : nullptr,
            static_cast<std::ptrdiff_t>(stride)};
  }

  const TileFormat& format_;
  std::size_t dimension_;
  std::size_t samples_;
};

/// One tiles call after its checks; worker() runs on every thread.
template <typename T>
struct TilesCall {
  const GridKernels<T>& kernels;
  std::size_t first_patch;
  const GridPlan<T>& plan;
  const TileFormat& format;
  std::size_t dimension;
  TileShape shape;
  TileFunction<T> function;
  std::size_t tile_bytes;
  std::size_t staging_bytes;

  /// Units [begin, end) of patch-major (patch, strip) pairs.
  Isa worker(int number, std::size_t begin, std::size_t end,
             unsigned char* scratch) const noexcept {
    Tile<T> tile;
    tile.nu = plan.nu();
    tile.worker = number;
    // A copy: the caller may change what it is given.
    const Outputs<T> places = TileMemory<T>(format, dimension, shape.samples).place(scratch);
    OutputPlan<T> outputs(places, shape.samples, Destination::cache);
    outputs.arrange(kernels.direct_rows(plan.nu(), false), 1);
    Delivery<T> delivery(outputs, *kernels.table, shape.samples, scratch + tile_bytes);
    GridEvaluator<T> evaluator(kernels, shape.rows, scratch + tile_bytes + staging_bytes);
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t patches = std::min(shape.patches, end - unit);
      const std::size_t first_row = unit % shape.strips * shape.rows;
      const GridPiece piece{first_patch + unit / shape.strips, patches, first_row,
                            std::min(plan.nv(), first_row + shape.rows)};
      tile.first_patch = piece.patch;
      tile.patch_count = patches;
      tile.first_row = first_row;
      tile.row_count = piece.last_row - first_row;
      tile.samples = patches * tile.row_count * tile.nu;
      tile.out = places;
      const Planes<T>* const planes = delivery.begin(0);
      typename GridEvaluator<T>::Target to{.planes = planes, .status = places.status};
      to.set_curvature(places.curvature, 0);
      to.record = outputs.record();
      evaluator.run(plan, piece, to);
      delivery.end(tile.samples);
      delivery.finish();
      function(tile);
      unit += patches;
    }
    return evaluator.executed();
  }
};

template <typename T>
Status run_tiles(const GridKernels<T>& kernels, const GridRequest& request, const GridPlan<T>& plan,
                 const TileFormat& format, const TileShape& shape, TileFunction<T> function,
                 const Options& options) noexcept {
  const std::size_t dimension = request.components.dimension;
  const std::size_t tile_bytes =
      whole_lines(TileMemory<T>(format, dimension, shape.samples).bytes());
  const std::size_t staged =
      format.layout == TileLayout::planes ? 0 : vector_values(groups_of(format), dimension);
  const std::size_t staging_bytes =
      whole_lines(Delivery<T>::scratch_bytes(staged, false, shape.samples));
  const TilesCall<T> call{kernels,  request.first_patch, plan,         format, dimension, shape,
                          function, tile_bytes,          staging_bytes};
  const std::size_t scratch =
      tile_bytes + staging_bytes + GridEvaluator<T>::scratch_bytes(shape.rows);
  return run_blocks(request.patches * shape.strips, options, scratch,
                    [&](int worker, std::size_t begin, std::size_t end, unsigned char* own) {
                      return call.worker(worker, begin, end, own);
                    });
}

} // namespace
} // namespace detail

template <typename T>
Status evaluate_tiles(const PatchSet<T>& set, const Grid<T>& grid, const TileFormat& format,
                      std::type_identity_t<TileFunction<T>> function,
                      const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  const detail::Components& components = request.components;
  const std::size_t values =
      detail::vector_values(detail::groups_of(format), components.dimension) +
      (format.curvature ? detail::kCurvatures : 0);
  if (values == 0) {
    return Status::null_output;
  }
  if (!components.space && (format.normal || format.curvature)) {
    return Status::bad_components;
  }
  const detail::DefaultFpEnvironment environment;
  detail::GridPlan<T> plan;
  const Status planned = plan.build(grid);
  if (planned != Status::ok || request.patches == 0) {
    return planned;
  }
  detail::TileShape shape;
  if (!detail::choose_shape<T>(grid.nu, grid.nv, request.patches, values, format, shape)) {
    return Status::size_overflow;
  }
  const detail::GridKernels<T> kernels(*set.storage(), detail::kernel_table<T>(request.isa),
                                       detail::groups_of(format), format.curvature, components,
                                       options.watertight);
  return detail::run_tiles<T>(kernels, request, plan, format, shape, function, options);
}

template SIMDBEZIER_API Status evaluate_tiles(const PatchSet<float>&, const Grid<float>&,
                                              const TileFormat&,
                                              std::type_identity_t<TileFunction<float>>,
                                              const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_tiles(const PatchSet<double>&, const Grid<double>&,
                                              const TileFormat&,
                                              std::type_identity_t<TileFunction<double>>,
                                              const Options&) noexcept;

} // namespace simdbezier
