// The grid call: checks, the plan, work cut into (patch, strip of rows), kernels.
#include <algorithm>
#include <cmath>

#include <simdbezier/evaluate.hpp>

#include "src/calls/grid_evaluator.hpp"
#include "src/calls/grid_request.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// One grid call after its checks; worker() runs on every thread.
template <typename T>
class GridCall {
public:
  GridCall(const GridKernels<T>& kernels, std::size_t first_patch, const GridPlan<T>& plan,
           const OutputPlan<T>& outputs) noexcept
      : kernels_(kernels), first_patch_(first_patch), plan_(plan), outputs_(outputs) {
    const std::size_t samples = Delivery<T>::chunk_samples(outputs);
    strip_rows_ = std::clamp<std::size_t>(samples / plan.nu(), 1, plan.nv());
    strips_ = (plan.nv() + strip_rows_ - 1) / strip_rows_;
    const std::size_t patch_samples = plan.nu() * plan.nv();
    together_ = strips_ > 1        ? 1
                : outputs.staged() ? std::max<std::size_t>(samples / patch_samples, 1)
                                   : ~std::size_t(0);
    chunk_samples_ = strips_ > 1 ? strip_rows_ * plan.nu() : together_ * patch_samples;
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), chunk_samples_));
  }

  /// Pieces of work in each patch.
  [[nodiscard]] std::size_t strips() const noexcept { return strips_; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + GridEvaluator<T>::scratch_bytes(strip_rows_);
  }

  /// Units [begin, end) of patch-major (patch, strip) pairs.
  Isa worker(std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    GridEvaluator<T> evaluator(kernels_, strip_rows_,
                               scratch == nullptr ? nullptr : scratch + delivery_bytes_);
    Delivery<T> delivery(outputs_, *kernels_.table, chunk_samples_, scratch);
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t patch = unit / strips_;
      const std::size_t first_row = unit % strips_ * strip_rows_;
      const std::size_t patches = std::min(together_, end - unit);
      const GridPiece piece{first_patch_ + patch, patches, first_row,
                            std::min(plan_.nv(), first_row + strip_rows_)};
      const std::size_t sample = (patch * plan_.nv() + first_row) * plan_.nu();
      SampleStatus* const status =
          outputs_.out().status == nullptr ? nullptr : outputs_.out().status + sample;
      const Planes<T>* const planes = delivery.begin(sample);
      typename GridEvaluator<T>::Target to{.planes = planes, .status = status};
      to.set_curvature(outputs_.out().curvature, sample);
      to.drain = delivery.queue();
      to.streaming = outputs_.streaming() && !outputs_.staged();
      to.record = outputs_.record();
      to.next = delivery.next();
      evaluator.run(plan_, piece, to);
      delivery.end(patches * (piece.last_row - piece.first_row) * plan_.nu());
      unit += patches;
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  const GridKernels<T>& kernels_;
  std::size_t first_patch_;
  const GridPlan<T>& plan_;
  const OutputPlan<T>& outputs_;
  std::size_t strip_rows_ = 1;
  std::size_t strips_ = 1;
  std::size_t together_ = 1; ///< patches in a piece
  std::size_t chunk_samples_ = 0;
  std::size_t delivery_bytes_ = 0;
};

} // namespace
} // namespace detail

template <typename T>
T to_centred(double u) noexcept {
  const detail::DefaultFpEnvironment environment;
  return static_cast<T>(std::fma(2.0, u, -1.0));
}

template <typename T>
Status evaluate_grid(const PatchSet<T>& set, const Grid<T>& grid, const Outputs<T>& out,
                     const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  std::size_t samples = 0;
  if (!request.count_samples(grid.nu, grid.nv, samples)) {
    return Status::size_overflow;
  }
  const detail::InputRange inputs[] = {{grid.u, grid.nu * sizeof(T)},
                                       {grid.v, grid.nv * sizeof(T)}};
  const Status usable = detail::check_outputs(out, samples, request.components.dimension,
                                              request.components.space, inputs, std::size(inputs));
  if (usable != Status::ok) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  detail::GridPlan<T> plan;
  const Status planned = plan.build(grid);
  if (planned != Status::ok || request.patches == 0) {
    return planned;
  }
  const detail::GridKernels<T> kernels(*set.storage(), detail::kernel_table<T>(request.isa),
                                       detail::wanted_groups(out), out.curvature.wanted(),
                                       request.components, options.watertight);
  detail::OutputPlan<T> outputs(out, samples, options.destination);
  outputs.arrange(kernels.direct_rows(grid.nu, true),
                  detail::thread_count(options.threads, request.patches));
  const detail::GridCall<T> call(kernels, request.first_patch, plan, outputs);
  return detail::run_blocks(request.patches * call.strips(), options, call.scratch_bytes(),
                            [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                              return call.worker(begin, end, scratch);
                            });
}

template SIMDBEZIER_API float to_centred<float>(double) noexcept;
template SIMDBEZIER_API double to_centred<double>(double) noexcept;
template SIMDBEZIER_API Status evaluate_grid(const PatchSet<float>&, const Grid<float>&,
                                             const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_grid(const PatchSet<double>&, const Grid<double>&,
                                             const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
