// The grid call: work cut into (patch, strip of rows).
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/piece_evaluator.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are patch-major (patch, strip) pairs.
template <typename T>
class GridWork {
public:
  GridWork(const SetStorage<T>& set, const Request<T>& request, const GridPlan<T>& plan,
           const OutputList<T>& out, const Options& options) noexcept
      : kernels_(set, request, out, options), first_patch_(request.first), patches_(request.count),
        plan_(plan), outputs_(out, plan.nu() * plan.nv() * patches_, options.destination) {
    outputs_.arrange(kernels_.direct_rows(plan.nu(), true),
                     thread_count(options.threads, patches_));
    const std::size_t samples = Delivery<T>::chunk_samples(outputs_);
    strip_rows_ = std::clamp<std::size_t>(samples / plan.nu(), 1, plan.nv());
    strips_ = (plan.nv() + strip_rows_ - 1) / strip_rows_;
    const std::size_t patch_samples = plan.nu() * plan.nv();
    together_ = strips_ > 1         ? 1
                : outputs_.staged() ? std::max<std::size_t>(samples / patch_samples, 1)
                                    : ~std::size_t(0);
    chunk_samples_ = strips_ > 1 ? strip_rows_ * plan.nu() : together_ * patch_samples;
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs_.staged_planes(), outputs_.streaming(), chunk_samples_));
  }

  [[nodiscard]] std::size_t units() const noexcept { return patches_ * strips_; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + PieceEvaluator<T>::scratch_bytes(strip_rows_);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    PieceEvaluator<T> evaluator(kernels_, strip_rows_,
                                scratch == nullptr ? nullptr : scratch + delivery_bytes_);
    Delivery<T> delivery(outputs_, *kernels_.table, chunk_samples_, scratch);
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t patch = unit / strips_;
      const std::size_t first_row = unit % strips_ * strip_rows_;
      const std::size_t patches = std::min(together_, end - unit);
      const GridPiece piece{first_patch_ + patch, patches, first_row,
                            std::min(plan_.nv(), first_row + strip_rows_)};
      const std::size_t sample = (patch * plan_.nv() + first_row) * plan_.nu();
      evaluator.run(plan_, piece, {outputs_, delivery, sample});
      delivery.end(patches * (piece.last_row - piece.first_row) * plan_.nu());
      unit += patches;
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  PatchKernels<T> kernels_;
  std::size_t first_patch_;
  std::size_t patches_;
  const GridPlan<T>& plan_;
  OutputPlan<T> outputs_;
  std::size_t strip_rows_ = 1;
  std::size_t strips_ = 1;
  std::size_t together_ = 1; ///< patches in a piece
  std::size_t chunk_samples_ = 0;
  std::size_t delivery_bytes_ = 0;
};

template <typename T>
class GridCall {
public:
  GridCall(const PatchSet<T>& set, const Grid<T>& where, const Outputs<T>& out,
           const Options& options) noexcept
      : in_(set, where, out, options) {}

  Status resolve() noexcept {
    return request_.resolve(in_.set, in_.where.patches, in_.first_component, in_.options);
  }
  Status check() noexcept {
    std::size_t samples = 0;
    if (!multiply_samples(in_.where.nu, in_.where.nv, request_.count, samples)) {
      return Status::size_overflow;
    }
    const MemoryRange inputs[] = {{in_.where.u, in_.where.nu * sizeof(T)},
                                  {in_.where.v, in_.where.nv * sizeof(T)}};
    const Status usable = check_patch_outputs(in_.out, samples, request_.components, inputs);
    return usable ? plan_.build(in_.where) : usable;
  }
  [[nodiscard]] bool empty() const noexcept { return request_.count == 0; }
  [[nodiscard]] GridWork<T> plan() const noexcept {
    return {*in_.set.storage(), request_, plan_, in_.out, in_.options};
  }

private:
  Given<T, PatchSet<T>, Grid<T>> in_;
  Request<T> request_;
  GridPlan<T> plan_;
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const PatchSet<T>& set, const Grid<T>& grid, const Outputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::GridCall<T>(set, grid, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const PatchSet<float>&, const Grid<float>&,
                                        const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const PatchSet<double>&, const Grid<double>&,
                                        const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
