// The scattered call: checks, then pieces of samples for the kernels.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "kernels/batch.hpp"
#include "kernels/delivery.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/normal_fallback.hpp"
#include "kernels/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Samples that a kernel evaluates at a time. Fewer where it stages its outputs, which then stay in
/// the first-level cache; otherwise so many that preparing a task does not show.
constexpr std::size_t kPiece = 2048;
constexpr std::size_t kStagedPiece = 512;

template <typename T>
Status check_samples(const PatchSet<T>& set, const Samples<T>& samples,
                     const KernelTable<T>& table) noexcept {
  if (samples.count == 0) {
    return Status::ok;
  }
  if (samples.patch == nullptr || samples.u == nullptr || samples.v == nullptr) {
    return Status::null_input;
  }
  const std::uint32_t highest = table.highest_index(samples.patch, samples.count);
  return highest < set.size() ? Status::ok : Status::bad_patch_index;
}

template <typename T>
struct ScatteredCall {
  const PatchStorage<T>& patches;
  const Samples<T>& samples;
  const OutputPlan<T>& outputs;
  const KernelTable<T>& table;
  Scheme scheme;
  std::size_t piece_samples;

  Isa worker(std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    Delivery<T> delivery(outputs, table, piece_samples, scratch);
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * piece_samples;
      executed = run_piece(first, std::min(piece_samples, samples.count - first), delivery);
    }
    delivery.finish();
    return executed;
  }

  Isa run_piece(std::size_t first, std::size_t count, Delivery<T>& delivery) const noexcept {
    ScatteredTask<T> task{};
    task.shape = &patches.shape;
    task.coefficients = patches.coefficients;
    task.edges = patches.edges;
    task.control_points = patches.control_points;
    task.origins = patches.origins;
    task.normal_floor = patches.normal_floor;
    task.patch = samples.patch + first;
    task.u = samples.u + first;
    task.v = samples.v + first;
    task.shift = samples.parameters == Parameters::unit ? T(0.5) : T(0);
    task.scale = samples.parameters == Parameters::unit ? T(1) : T(0.5);
    task.count = count;
    task.patches_known = samples.count - first;
    task.prefetch = patches.count > second_level_cache() / (kCoefficients * sizeof(T));
    task.resolve_normal = resolve_normal<T>;
    if (outputs.out().status != nullptr) {
      task.status = outputs.out().status + first;
      std::fill_n(task.status, count, SampleStatus::regular);
    }
    std::copy_n(delivery.begin(first), kGroups, task.out);
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
  const detail::KernelTable<T>& table = detail::kernel_table<T>(isa);
  const Status readable = detail::check_samples(set, samples, table);
  if (readable != Status::ok || samples.count == 0) {
    return readable;
  }
  const detail::OutputPlan<T> outputs(
      out, samples.count,
      options.destination == Destination::memory ? Destination::memory : Destination::cache);
  const std::size_t piece = outputs.staged() ? detail::kStagedPiece : detail::kPiece;
  const detail::ScatteredCall<T> call{set.storage()->buckets[0],
                                      samples,
                                      outputs,
                                      table,
                                      detail::scheme(options.watertight, set.has_local_origins()),
                                      piece};
  const std::size_t pieces = samples.count / piece + (samples.count % piece != 0 ? 1 : 0);
  const std::size_t scratch =
      detail::Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), piece);
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
