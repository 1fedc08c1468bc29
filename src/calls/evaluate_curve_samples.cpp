// The scattered call for curves: checks, then pieces of samples for the kernels.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <simdbezier/curves.hpp>

#include "src/calls/curve_call.hpp"
#include "src/calls/sample_request.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier {
namespace detail {
namespace {

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
    set_half_centring(samples.parameters, task);
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
  detail::SampleRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  const detail::InputRange inputs[] = {{samples.curve, samples.count * sizeof(std::uint32_t)},
                                       {samples.t, samples.count * sizeof(T)}};
  const Status writable = detail::check_curve_outputs(
      out, samples.count, set.components(), request.components, inputs, std::size(inputs));
  if (writable != Status::ok || samples.count == 0) {
    return writable;
  }
  if (samples.curve == nullptr || samples.t == nullptr) {
    return Status::null_input;
  }
  const detail::KernelTable<T>& table = detail::kernel_table<T>(request.isa);
  if (table.highest_index(samples.curve, samples.count) >= set.size()) {
    return Status::bad_patch_index;
  }
  const Outputs<T> groups = detail::as_outputs(out);
  const detail::OutputPlan<T> outputs = detail::plan_outputs(
      out, groups, samples.count, detail::sample_destination(options.destination));
  const detail::SamplePieces pieces(samples.count, outputs.staged());
  const detail::CurveSamplesCall<T> call{
      *set.storage(), samples, out, outputs, table, request.components.first, pieces.length};
  const std::size_t scratch = detail::Delivery<T>::scratch_bytes(
      outputs.staged_planes(), outputs.streaming(), pieces.length);
  return detail::run_blocks(pieces.count, options, scratch,
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
