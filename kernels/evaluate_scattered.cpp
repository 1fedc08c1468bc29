// The scattered call: checks, pieces of samples with converted parameters, kernels.
#include <algorithm>
#include <cmath>

#include <simdbezier/evaluate.hpp>

#include "kernels/batch.hpp"
#include "kernels/delivery.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/grid_plan.hpp"
#include "kernels/normal_fallback.hpp"
#include "kernels/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Samples converted and, where outputs are strided, staged at a time.
constexpr std::size_t kPiece = 512;

template <typename T>
Status check_samples(const PatchSet<T>& set, const Samples<T>& samples) noexcept {
  if (samples.count == 0) {
    return Status::ok;
  }
  if (samples.patch == nullptr || samples.u == nullptr || samples.v == nullptr) {
    return Status::null_input;
  }
  const std::uint32_t highest = *std::max_element(samples.patch, samples.patch + samples.count);
  return highest < set.size() ? Status::ok : Status::bad_patch_index;
}

template <typename T>
struct ScatteredCall {
  const PatchStorage<T>& patches;
  const Samples<T>& samples;
  const OutputPlan<T>& outputs;
  const KernelTable<T>& table;
  Scheme scheme;

  Isa worker(std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    Delivery<T> delivery(outputs, table, kPiece, scratch);
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * kPiece;
      executed = run_piece(first, std::min(kPiece, samples.count - first), delivery);
    }
    delivery.finish();
    return executed;
  }

  Isa run_piece(std::size_t first, std::size_t count, Delivery<T>& delivery) const noexcept {
    T x[kPiece];
    T y[kPiece];
    for (std::size_t k = 0; k < count; ++k) {
      x[k] = half_centred(samples.u[first + k], samples.parameters);
      y[k] = half_centred(samples.v[first + k], samples.parameters);
    }
    ScatteredTask<T> task{};
    task.coefficients = patches.coefficients;
    task.edges = patches.edges;
    task.control_points = patches.control_points;
    task.origins = patches.origins;
    task.normal_floor = patches.normal_floor;
    task.patch = samples.patch + first;
    task.x = x;
    task.y = y;
    task.count = count;
    task.resolve_normal = resolve_normal<T>;
    if (outputs.out().status != nullptr) {
      task.status = outputs.out().status + first;
      for (std::size_t k = 0; k < count; ++k) {
        const bool finite = !std::isnan(x[k]) && !std::isnan(y[k]);
        task.status[k] = finite ? SampleStatus::regular : SampleStatus::non_finite;
      }
    }
    delivery.begin(first, task.out);
    table.scattered[scheme](task);
    delivery.end(count);
    return task.executed;
  }
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_scattered(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
                          const Options& options) noexcept {
  Isa isa = Isa::automatic;
  const Status resolved = resolve_isa(options.isa, isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  const detail::InputRange inputs[] = {{samples.patch, samples.count * sizeof(std::uint32_t)},
                                       {samples.u, samples.count * sizeof(T)},
                                       {samples.v, samples.count * sizeof(T)}};
  const Status writable = detail::check_outputs(out, samples.count, inputs, std::size(inputs));
  if (writable != Status::ok) {
    return writable;
  }
  const Status readable = detail::check_samples(set, samples);
  if (readable != Status::ok || samples.count == 0) {
    return readable;
  }
  const detail::OutputPlan<T> outputs(out, samples.count, options.destination);
  const detail::ScatteredCall<T> call{*set.storage(), samples, outputs,
                                      detail::kernel_table<T>(isa),
                                      detail::scheme(options.watertight, set.has_local_origins())};
  const std::size_t pieces =
      samples.count / detail::kPiece + (samples.count % detail::kPiece != 0 ? 1 : 0);
  const std::size_t scratch = detail::Delivery<T>::scratch_bytes(
      outputs.staged_planes(), outputs.streaming(), detail::kPiece);
  return detail::run_blocks(pieces, options, scratch,
                            [&](int, std::size_t begin, std::size_t end, unsigned char* own) {
                              return call.worker(begin, end, own);
                            });
}

template SIMDBEZIER_API Status evaluate_scattered(const PatchSet<float>&, const Samples<float>&,
                                                  const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_scattered(const PatchSet<double>&, const Samples<double>&,
                                                  const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
