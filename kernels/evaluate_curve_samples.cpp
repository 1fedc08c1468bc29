// The scattered call for curves: checks, then pieces of samples for the kernels.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <simdbezier/curves.hpp>

#include "kernels/batch.hpp"
#include "kernels/curve_call.hpp"
#include "kernels/dispatch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// As for patches (evaluate_scattered.cpp): fewer where results are staged in a first-level cache.
constexpr std::size_t kPiece = 2048;
constexpr std::size_t kStagedPiece = 512;

template <typename T>
struct CurveSamplesCall {
  const CurveStorage<T>& curves;
  const CurveSamples<T>& samples;
  const CurveOutputs<T>& out;
  const OutputPlan<T>& outputs;
  const KernelTable<T>& table;
  std::size_t first_component;
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
    ScatteredCurveTask<T> task{};
    fill_arrays(task, curves, 0, out, first, delivery.begin(first), first_component);
    task.curve = samples.curve + first;
    task.t = samples.t + first;
    task.shift = samples.parameters == Parameters::unit ? T(0.5) : T(0);
    task.scale = samples.parameters == Parameters::unit ? T(1) : T(0.5);
    task.count = count;
    for (std::size_t k = 0; task.status != nullptr && k < count; ++k) {
      task.status[k] = std::isfinite(task.t[k]) ? SampleStatus::regular : SampleStatus::non_finite;
    }
    table.curves->scattered(task);
    delivery.end(count);
    return task.executed;
  }
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_curves(const CurveSet<T>& set, const CurveSamples<T>& samples,
                       const CurveOutputs<T>& out, const Options& options) noexcept {
  Isa isa = Isa::automatic;
  const Status resolved = resolve_isa(options.isa, isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  detail::Components components;
  if (!components.choose(set.components(), options.first_component)) {
    return Status::bad_components;
  }
  const detail::InputRange inputs[] = {{samples.curve, samples.count * sizeof(std::uint32_t)},
                                       {samples.t, samples.count * sizeof(T)}};
  const Status writable = detail::check_curve_outputs(out, samples.count, set.components(),
                                                      components, inputs, std::size(inputs));
  if (writable != Status::ok || samples.count == 0) {
    return writable;
  }
  if (samples.curve == nullptr || samples.t == nullptr) {
    return Status::null_input;
  }
  const detail::KernelTable<T>& table = detail::kernel_table<T>(isa);
  if (table.highest_index(samples.curve, samples.count) >= set.size()) {
    return Status::bad_patch_index;
  }
  const Outputs<T> groups = detail::as_outputs(out);
  const detail::OutputPlan<T> outputs = detail::plan_outputs(
      out, groups, samples.count,
      options.destination == Destination::memory ? Destination::memory : Destination::cache);
  const std::size_t piece = outputs.staged() ? detail::kStagedPiece : detail::kPiece;
  const detail::CurveSamplesCall<T> call{*set.storage(), samples,          out,  outputs,
                                         table,          components.first, piece};
  const std::size_t pieces = samples.count / piece + (samples.count % piece != 0 ? 1 : 0);
  const std::size_t scratch =
      detail::Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), piece);
  return detail::run_blocks(pieces, options, scratch,
                            [&](int, std::size_t begin, std::size_t end, unsigned char* own) {
                              return call.worker(begin, end, own);
                            });
}

template SIMDBEZIER_API Status evaluate_curves(const CurveSet<float>&, const CurveSamples<float>&,
                                               const CurveOutputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_curves(const CurveSet<double>&, const CurveSamples<double>&,
                                               const CurveOutputs<double>&,
                                               const Options&) noexcept;

} // namespace simdbezier
