// The tiles call: it runs as the grid call, but into each thread's own memory, which then goes to
// the caller's function.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/piece_evaluator.hpp"
#include "src/runtime/both_types.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// The number of values of all wanted vectors of one sample.
std::size_t vector_values(const OutputSelection& wanted, std::size_t dimension) noexcept {
  std::size_t values = 0;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    values += wanted.holds(static_cast<Output>(k)) ? dimension : 0;
  }
  return values;
}

/// The bytes of a tile, half of a common first-level cache: the caller reads what has just been
/// written.
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

  /// Room for every layout, of which planes take the most.
  [[nodiscard]] std::size_t bytes() const noexcept {
    const std::size_t curvatures = format_.outputs.holds(Output::curvature) ? kCurvatureKinds : 0;
    const std::size_t statuses = format_.outputs.holds(Output::status) ? samples_ : 0;
    return (vector_values(format_.outputs, dimension_) + curvatures) * taken(samples_) +
           whole_lines(statuses);
  }

  [[nodiscard]] Outputs<T> place(unsigned char* memory) const noexcept {
    Outputs<T> out;
    out.first_component = format_.first_component;
    const std::size_t members = vector_values(format_.outputs, dimension_);
    std::size_t at = 0;
    std::size_t member = 0;
    for (std::size_t k = 0; k < kVectorOutputs; ++k) {
      const auto output = static_cast<Output>(k);
      if (!format_.outputs.holds(output)) {
        continue;
      }
      if (format_.layout == TileLayout::planes) {
        T* plane[3] = {nullptr, nullptr, nullptr};
        for (std::size_t c = 0; c < dimension_; ++c) {
          plane[c] = take(memory, at, samples_);
        }
        out[output] = Vectors<T>::planes(plane[0], plane[1], plane[2]);
      } else if (format_.layout == TileLayout::xyz) {
        out[output] = records(take(memory, at, dimension_ * samples_), dimension_);
      } else {
        out[output] = records(reinterpret_cast<T*>(memory) + member, members);
        member += dimension_;
      }
    }
    if (member > 0) {
      take(memory, at, member * samples_);
    }
    if (format_.outputs.holds(Output::curvature)) {
      for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
        out.curvature[static_cast<Curvature>(k)] = take(memory, at, samples_);
      }
    }
    if (format_.outputs.holds(Output::status)) {
      out.status = reinterpret_cast<SampleStatus*>(memory + at);
    }
    return out;
  }

private:
  /// The bytes that values take. That is a line more than they need: planes of a round number of
  /// samples would compete for the same sets of the cache.
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

/// Units are patch-major (patch, strip) pairs.
template <typename T>
class TilesWork {
public:
  TilesWork(const PatchKernels<T>& kernels, const Request<T>& request, const GridPlan<T>& plan,
            const TileFormat& format, const TileShape& shape, TileFunction<T> function) noexcept
      : kernels_(kernels), request_(request), plan_(plan), format_(format), shape_(shape),
        function_(function) {
    const std::size_t dimension = request.components.dimension;
    tile_bytes_ = whole_lines(TileMemory<T>(format, dimension, shape.samples).bytes());
    const std::size_t staged =
        format.layout == TileLayout::planes ? 0 : vector_values(format.outputs, dimension);
    staging_bytes_ = whole_lines(Delivery<T>::scratch_bytes(staged, false, shape.samples));
  }

  [[nodiscard]] std::size_t units() const noexcept { return request_.count * shape_.strips; }
  /// The longest duration, for what the consumer does with a tile is not known.
  [[nodiscard]] std::size_t duration() const noexcept { return kLongDuration; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return tile_bytes_ + staging_bytes_ + PieceEvaluator<T>::scratch_bytes(shape_.rows);
  }

  Isa run(int worker, std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    Tile<T> tile;
    tile.nu = plan_.nu();
    tile.worker = worker;
    // A copy: the caller may change what it is given.
    const Outputs<T> places =
        TileMemory<T>(format_, request_.components.dimension, shape_.samples).place(scratch);
    const OutputList<T> out(places);
    OutputPlan<T> outputs(out, Way::cache);
    outputs.put_directly(kernels_.direct_rows(plan_.nu()));
    Delivery<T> delivery(outputs, *kernels_.table, shape_.samples, scratch + tile_bytes_);
    PieceEvaluator<T> evaluator(kernels_, shape_.rows, scratch + tile_bytes_ + staging_bytes_);
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t patches = std::min(shape_.patches, end - unit);
      const std::size_t first_row = unit % shape_.strips * shape_.rows;
      const GridPiece piece{request_.first + unit / shape_.strips, patches, first_row,
                            std::min(plan_.nv(), first_row + shape_.rows)};
      tile.first_patch = piece.patch;
      tile.patch_count = patches;
      tile.first_row = first_row;
      tile.row_count = piece.last_row - first_row;
      tile.samples = patches * tile.row_count * tile.nu;
      tile.out = places;
      evaluator.run(plan_, piece, {outputs, delivery, 0}, nullptr);
      delivery.end(tile.samples);
      delivery.finish();
      function_(tile);
      unit += patches;
    }
    return evaluator.executed();
  }

private:
  PatchKernels<T> kernels_;
  const Request<T>& request_;
  const GridPlan<T>& plan_;
  const TileFormat& format_;
  const TileShape& shape_;
  TileFunction<T> function_;
  std::size_t tile_bytes_ = 0;
  std::size_t staging_bytes_ = 0;
};

template <typename T>
class TilesCall {
public:
  TilesCall(const PatchSet<T>& set, const Grid<T>& grid, const TileFormat& format,
            TileFunction<T> function, const Options& options) noexcept
      : set_(set), grid_(grid), format_(format), function_(function), options_(options) {}

  Status resolve() noexcept {
    return request_.resolve(set_, grid_.patches, format_.first_component, options_);
  }
  /// Checks all but the parameters, which is what needs no memory.
  Status measure() noexcept {
    const std::size_t dimension = request_.components.dimension;
    const bool curvature = format_.outputs.holds(Output::curvature);
    const std::size_t values =
        vector_values(format_.outputs, dimension) + (curvature ? kCurvatureKinds : 0);
    if (values == 0) {
      return Status::null_output;
    }
    if (!request_.components.space() && format_.outputs.holds_any(kSpaceOutputs)) {
      return Status::bad_components;
    }
    const Status valid = GridPlan<T>::check(grid_);
    if (!valid || empty()) {
      return valid;
    }
    return choose_shape<T>(grid_.nu, grid_.nv, request_.count, values, format_, shape_)
               ? Status::ok
               : Status::size_overflow;
  }
  Status check() noexcept {
    const Status measured = measure();
    return measured && !empty() ? plan_.build(grid_) : measured;
  }
  [[nodiscard]] bool empty() const noexcept { return request_.count == 0; }
  [[nodiscard]] TilesWork<T> plan() const noexcept {
    return {{*set_.storage(), request_, format_.outputs, options_},
            request_,
            plan_,
            format_,
            shape_,
            function_};
  }
  /// The most samples of a tile, known after measure().
  [[nodiscard]] std::size_t samples() const noexcept { return shape_.samples; }

private:
  const PatchSet<T>& set_;
  const Grid<T>& grid_;
  const TileFormat& format_;
  TileFunction<T> function_;
  const Options& options_;
  Request<T> request_;
  GridPlan<T> plan_;
  TileShape shape_;
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_tiles(const PatchSet<T>& set, const Grid<T>& grid, const TileFormat& format,
                      std::type_identity_t<TileFunction<T>> function,
                      const Options& options) noexcept {
  return detail::make_call(detail::TilesCall<T>(set, grid, format, function, options), options);
}

template <typename T>
std::size_t largest_tile(const PatchSet<T>& set, const Grid<T>& grid,
                         const TileFormat& format) noexcept {
  const auto nothing = [](const Tile<T>&) {};
  const Options options;
  detail::TilesCall<T> call(set, grid, format, nothing, options);
  return call.resolve() && call.measure() ? call.samples() : 0;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(evaluate_tiles);
SIMDBEZIER_EXPORT_BOTH_TYPES(largest_tile);

} // namespace simdbezier
