// The call for patches with grids of their own: work is divided by samples, in whole rows.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/counted_grids.hpp"
#include "src/calls/piece_evaluator.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Rows of one patch that a kernel takes at once.
constexpr std::size_t kMostRows = 1024;

/// Units are samples, counted without gaps; a share has the rows that begin in it.
template <typename T>
class PatchGridsWork {
public:
  PatchGridsWork(const Given<T, PatchSet<T>, PatchGrids>& in, const Request<T>& request,
                 const CountedGrids& grids, Way way) noexcept
      : kernels_(*in.set.storage(), request, in.out, in.options), first_patch_(request.first),
        grids_(grids), outputs_(in.out, way) {
    kernels_.expect_output(written_bytes(in.out, grids.total()), way);
    outputs_.put_directly(kernels_.direct_rows(grids.least_nu()));
    piece_samples_ = std::min(Delivery<T>::chunk_samples(outputs_), grids.total());
    chunk_samples_ = std::max(piece_samples_, grids.most_nu());
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs_.staged_planes(), outputs_.streaming(), chunk_samples_));
    plan_bytes_ = whole_lines(PlanCache<T>::memory_bytes(grids));
  }

  [[nodiscard]] std::size_t units() const noexcept { return grids_.total(); }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(grids_.total(), 1); }
  [[nodiscard]] std::size_t grain() const noexcept { return 1; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + plan_bytes_ + PieceEvaluator<T>::scratch_bytes(kMostRows);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    PlanCache<T> plans(scratch + delivery_bytes_);
    PieceEvaluator<T> evaluator(kernels_, kMostRows, scratch + delivery_bytes_ + plan_bytes_);
    Delivery<T> delivery(outputs_, *kernels_.table, chunk_samples_, scratch);
    for (std::size_t k = grids_.grid_of(begin); k < grids_.size() && grids_.before(k) < end;) {
      const std::size_t nu = grids_.nu(k);
      const std::size_t nv = grids_.nv(k);
      const GridPlan<T>& plan = plans.find(nu, nv);
      if (const std::size_t alike = alike_from(k, begin, end); alike > 1) {
        const GridPiece piece{first_patch_ + k, alike, 0, nv};
        evaluator.run(plan, piece, {outputs_, delivery, grids_.offset(k)}, nullptr);
        delivery.end(alike * nv * nu);
        k += alike;
        continue;
      }
      const std::size_t before = grids_.before(k);
      const auto rows_before = [&](std::size_t sample) {
        return sample <= before ? 0 : std::min(nv, (sample - before + nu - 1) / nu);
      };
      for (std::size_t row = rows_before(begin), last = rows_before(end); row < last;) {
        const std::size_t most = std::min(std::max<std::size_t>(piece_samples_ / nu, 1), kMostRows);
        const std::size_t rows = std::min(last - row, most);
        const GridPiece piece{first_patch_ + k, 1, row, row + rows};
        const GridPiece next = piece_after(piece, k, last, most);
        evaluator.run(plan, piece, {outputs_, delivery, grids_.offset(k) + row * nu},
                      next == piece ? nullptr : &next);
        delivery.end(rows * nu);
        row += rows;
      }
      ++k;
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  /// How many whole grids from k on one piece takes, as far as staging has room for them.
  [[nodiscard]] std::size_t alike_from(std::size_t k, std::size_t begin,
                                       std::size_t end) const noexcept {
    const std::size_t samples = grids_.nu(k) * grids_.nv(k);
    const std::size_t most = outputs_.staged() ? piece_samples_ / samples : grids_.size();
    return grids_.nv(k) <= kMostRows && grids_.before(k) >= begin ? grids_.alike(k, end, most) : 1;
  }
  /// The next rows of patch k, of which there are `last`, or the first ones of the patch behind it
  /// where its grid is the same; otherwise the piece itself.
  [[nodiscard]] GridPiece piece_after(const GridPiece& piece, std::size_t k, std::size_t last,
                                      std::size_t most) const noexcept {
    const std::size_t row = piece.last_row;
    if (row < last) {
      return {piece.patch, 1, row, std::min(row + most, last)};
    }
    const bool alike = k + 1 < grids_.size() && grids_.nu(k + 1) == grids_.nu(k) &&
                       grids_.nv(k + 1) == grids_.nv(k);
    return alike ? GridPiece{piece.patch + 1, 1, 0, std::min(most, grids_.nv(k))} : piece;
  }

  PatchKernels<T> kernels_;
  std::size_t first_patch_;
  const CountedGrids& grids_;
  OutputPlan<T> outputs_;
  std::size_t piece_samples_ = 0;
  std::size_t chunk_samples_ = 0;
  std::size_t delivery_bytes_ = 0;
  std::size_t plan_bytes_ = 0; ///< parameters of the largest grid
};

template <typename T>
using PatchGridsCall =
    CountedGridsCall<CallName::patch_grids, T, PatchSet, PatchGrids, PatchGridsWork<T>>;

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const PatchSet<T>& set, const PatchGrids& grids, const Outputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::PatchGridsCall<T>(set, grids, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const PatchSet<float>&, const PatchGrids&,
                                        const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const PatchSet<double>&, const PatchGrids&,
                                        const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
