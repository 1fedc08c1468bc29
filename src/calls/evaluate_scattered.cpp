// The scattered call: checks, then pieces of samples for the kernels.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/sample_request.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename T>
struct ScatteredCall {
  const SetStorage<T>& set;
  const Samples<T>& samples;
  const OutputPlan<T>& outputs;
  const KernelTable<T>& table;
  bool watertight;
  std::size_t first_component;
  bool any_shape; ///< bicubic patches take the kernels of any shape, too
  std::size_t piece_samples;

  /// Room for the indices of a piece's patches in their buckets.
  [[nodiscard]] std::size_t index_bytes() const noexcept {
    return set.places == nullptr ? 0 : whole_lines(piece_samples * sizeof(std::uint32_t));
  }

  Isa worker(std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    auto* const index = reinterpret_cast<std::uint32_t*>(scratch);
    Delivery<T> delivery(outputs, table, piece_samples,
                         scratch == nullptr ? nullptr : scratch + index_bytes());
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * piece_samples;
      const std::size_t count = std::min(piece_samples, samples.count - first);
      if (outputs.out().status != nullptr) {
        std::fill_n(outputs.out().status + first, count, SampleStatus::regular);
      }
      const Planes<T>* const planes = delivery.begin(first);
      executed = set.places == nullptr
                     ? run_bucket(set.buckets[0], samples.patch + first, first, count, planes, 0)
                     : run_mixed(first, count, planes, index);
      delivery.end(count);
    }
    delivery.finish();
    return executed;
  }

  /// Consecutive samples on patches of one shape go to a kernel together.
  Isa run_mixed(std::size_t first, std::size_t count, const Planes<T>* planes,
                std::uint32_t* index) const noexcept {
    Isa executed = Isa::automatic;
    for (std::size_t k = 0; k < count;) {
      const std::uint32_t bucket = set.places[samples.patch[first + k]].bucket;
      std::size_t last = k;
      for (; last < count; ++last) {
        const PatchPlace place = set.places[samples.patch[first + last]];
        if (place.bucket != bucket) {
          break;
        }
        index[last] = static_cast<std::uint32_t>(place.index);
      }
      executed = run_bucket(set.buckets[bucket], index + k, first + k, last - k, planes, k);
      k = last;
    }
    return executed;
  }

  /// Samples [first, first + count) of the call on the bucket's patches `patch`; their results go
  /// to the planes from `at` on.
  Isa run_bucket(const PatchStorage<T>& patches, const std::uint32_t* patch, std::size_t first,
                 std::size_t count, const Planes<T>* planes, std::size_t at) const noexcept {
    ScatteredTask<T> task{};
    task.shape = &patches.shape;
    task.coefficients = patches.coefficients;
    task.edges = patches.edges;
    task.given = patches.given;
    task.origins = patches.origins;
    task.normal_floor = patches.normal_floor;
    task.common_floor = patches.common_floor;
    task.patch = patch;
    task.u = samples.u + first;
    task.v = samples.v + first;
    set_half_centring(samples.parameters, task);
    task.count = count;
    task.patches_known = set.places == nullptr ? samples.count - first : count;
    task.prefetch = patches.count > second_level_cache() / (kCoefficients * sizeof(T));
    task.resolve_normal = resolve_normal<T>;
    task.watertight = watertight;
    for (std::size_t g = 0; g < kGroups; ++g) {
      for (std::size_t c = 0; c < 3; ++c) {
        T* const plane = planes[g].component[c];
        task.out[g].component[c] = plane == nullptr ? nullptr : plane + at;
      }
    }
    const CurvaturePlanes<T> curvature(outputs.out().curvature);
    for (std::size_t c = 0; c < kCurvatures; ++c) {
      task.curvature[c] = curvature.plane[c] == nullptr ? nullptr : curvature.plane[c] + first;
    }
    task.first_component = first_component;
    task.status = outputs.out().status == nullptr ? nullptr : outputs.out().status + first;
    if (any_shape || !patches.shape.is_bicubic()) {
      table.shapes->scattered(task);
    } else {
      table.scattered[task.origins != nullptr](task);
    }
    return task.executed;
  }
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_scattered(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
                          const Options& options) noexcept {
  detail::SampleRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  const detail::Components& components = request.components;
  const detail::InputRange inputs[] = {{samples.patch, samples.count * sizeof(std::uint32_t)},
                                       {samples.u, samples.count * sizeof(T)},
                                       {samples.v, samples.count * sizeof(T)}};
  const Status writable = detail::check_outputs(out, samples.count, components.dimension,
                                                components.space, inputs, std::size(inputs));
  if (writable != Status::ok) {
    return writable;
  }
  const detail::KernelTable<T>& table = detail::kernel_table<T>(request.isa);
  const Status readable = detail::check_samples(set, samples, table);
  if (readable != Status::ok || samples.count == 0) {
    return readable;
  }
  const detail::OutputPlan<T> outputs(out, samples.count,
                                      detail::sample_destination(options.destination));
  const detail::SamplePieces pieces(samples.count, outputs.staged());
  const detail::ScatteredCall<T> call{*set.storage(),
                                      samples,
                                      outputs,
                                      table,
                                      options.watertight,
                                      components.first,
                                      out.curvature.wanted() || !components.space,
                                      pieces.length};
  const std::size_t scratch =
      call.index_bytes() + detail::Delivery<T>::scratch_bytes(outputs.staged_planes(),
                                                              outputs.streaming(), pieces.length);
  return detail::run_blocks(pieces.count, options, scratch,
                            [&](int, std::size_t begin, std::size_t end, unsigned char* own) {
                              return call.worker(begin, end, own);
                            });
}

template SIMDBEZIER_API Status evaluate_scattered(const PatchSet<float>&, const Samples<float>&,
                                                  const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_scattered(const PatchSet<double>&, const Samples<double>&,
                                                  const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
