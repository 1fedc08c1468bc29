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
  GridWork(const Given<T, PatchSet<T>, Grid<T>>& in, const Request<T>& request,
           const GridPlan<T>& plan, Way way) noexcept
      : kernels_(*in.set.storage(), request, in.out, in.options), first_patch_(request.first),
        patches_(request.count), plan_(plan), outputs_(in.out, way) {
    kernels_.expect_output(written_bytes(in.out, plan.nu() * plan.nv() * request.count), way);
    if (outputs_.staged()) {
      outputs_.put_directly(kernels_.direct_rows(plan));
    }
    divide(std::min(Delivery<T>::chunk_samples(outputs_), plan.nu() * plan.nv() * request.count));
    chunk_samples_ = (strips_ > 1 ? strip_rows_ : together_ * plan.nv()) * plan.nu();
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs_.staged_planes(), outputs_.streaming(), chunk_samples_));
  }

  [[nodiscard]] std::size_t units() const noexcept { return patches_ * strips_; }
  [[nodiscard]] std::size_t duration() const noexcept {
    return duration_of(patches_ * plan_.nu() * plan_.nv(), 1);
  }
  [[nodiscard]] std::size_t grain() const noexcept { return strips_; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + PieceEvaluator<T>::scratch_bytes(strip_rows_);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    if (begin < end && strips_ == 1 && PieceEvaluator<T>::runs_at_once(kernels_, outputs_, plan_)) {
      return PieceEvaluator<T>::run_at_once(kernels_, plan_, piece_at(begin, end), outputs_,
                                            begin * plan_.nu() * plan_.nv());
    }
    PieceEvaluator<T> evaluator(kernels_, strip_rows_,
                                scratch == nullptr ? nullptr : scratch + delivery_bytes_);
    Delivery<T> delivery(outputs_, *kernels_.table, chunk_samples_, scratch);
    for (std::size_t unit = begin; unit < end;) {
      const GridPiece piece = piece_at(unit, end);
      const std::size_t after = unit + piece.patches;
      const GridPiece next = piece_at(after, end);
      const std::size_t sample = (patch_of(unit) * plan_.nv() + piece.first_row) * plan_.nu();
      evaluator.run(plan_, piece, {outputs_, delivery, sample}, after < end ? &next : nullptr);
      delivery.end(piece.patches * (piece.last_row - piece.first_row) * plan_.nu());
      unit = after;
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  /// Strips of equal size, or whole patches, of about `samples` samples. Chunks that are streamed
  /// may have half as many again, since a strip of a few rows costs as much as one of many.
  void divide(std::size_t samples) noexcept {
    const std::size_t patch_samples = plan_.nu() * plan_.nv();
    if (!outputs_.staged() && patch_samples <= samples) { // without a division
      strip_rows_ = plan_.nv();
      together_ = ~std::size_t(0);
      return;
    }
    const bool rounds = outputs_.staged() && outputs_.streaming();
    const std::size_t rows = std::clamp<std::size_t>(samples / plan_.nu(), 1, plan_.nv());
    strips_ = std::max<std::size_t>((plan_.nv() + (rounds ? rows / 2 : rows - 1)) / rows, 1);
    strip_rows_ = (plan_.nv() + strips_ - 1) / strips_;
    strips_ = (plan_.nv() + strip_rows_ - 1) / strip_rows_;
    together_ = !outputs_.staged() ? ~std::size_t(0)
                                   : (samples + (rounds ? patch_samples / 2 : 0)) / patch_samples;
    together_ = strips_ > 1 ? 1 : std::max<std::size_t>(together_, 1);
  }

  /// The patch of a unit, without a division where there is none to be made, since small calls feel
  /// them.
  [[nodiscard]] std::size_t patch_of(std::size_t unit) const noexcept {
    return strips_ == 1 ? unit : unit / strips_;
  }
  [[nodiscard]] GridPiece piece_at(std::size_t unit, std::size_t end) const noexcept {
    const std::size_t patch = patch_of(unit);
    const std::size_t first_row = (unit - patch * strips_) * strip_rows_;
    return {first_patch_ + patch, std::min(together_, end - unit), first_row,
            std::min(plan_.nv(), first_row + strip_rows_)};
  }

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
class GridCall : public CommonGridCall<CallName::grid, T, PatchSet, Grid<T>, GridWork<T>> {
  using Base = CommonGridCall<CallName::grid, T, PatchSet, Grid<T>, GridWork<T>>;
  using Base::in_;
  using Base::plan_;
  using Base::request_;

public:
  using Base::Base;

  [[nodiscard]] bool may_narrow() const noexcept {
    return narrower_choice(in_.options.isa) != Isa::automatic && this->samples() >= kLeastMeasured;
  }
  [[nodiscard]] CallKind width_kind() const noexcept {
    return kind_of_call(CallName::grid, in_, request_, true).add(plan_.nu()).add(plan_.nv());
  }
  [[nodiscard]] GridWork<T> plan_narrower() const noexcept {
    Request<T> request = request_;
    request.table = &kernel_table<T>(narrower_choice(in_.options.isa));
    return {in_, request, plan_, Way::cache};
  }
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
