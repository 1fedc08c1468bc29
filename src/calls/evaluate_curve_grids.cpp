// The call for curves that each have a number of samples of their own: work divided by samples.
#include <algorithm>

#include <simdbezier/curves.hpp>

#include "src/calls/counted_grids.hpp"
#include "src/calls/curve_pieces.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are samples, counted without gaps.
template <typename T>
class CurveGridsWork {
public:
  CurveGridsWork(const Given<T, CurveSet<T>, CurveGrids>& in, const Request<T>& request,
                 const CountedGrids& grids, Way way) noexcept
      : first_curve_(request.first), grids_(grids),
        outputs_(plan_outputs(in.out, way)), kernels_{*in.set.storage(), *request.table,
                                                      request.components.first, 0} {
    kernels_.chunk_samples = staged_samples(outputs_, grids.total());
  }

  [[nodiscard]] std::size_t units() const noexcept { return grids_.total(); }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(grids_.total(), 1); }
  [[nodiscard]] std::size_t grain() const noexcept { return 1; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return kernels_.delivery_bytes(outputs_) + PlanCache<T>::memory_bytes(grids_);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    PlanCache<T> plans(scratch + kernels_.delivery_bytes(outputs_));
    Delivery<T> delivery(outputs_, kernels_.table, kernels_.chunk_samples, scratch);
    std::size_t k = grids_.grid_of(begin);
    while (k < grids_.size() && grids_.before(k) < end) {
      const std::size_t before = grids_.before(k);
      const std::size_t last = std::min(end, grids_.before(k + 1)) - before;
      std::size_t first = std::max(begin, before) - before;
      const std::size_t most = kernels_.chunk_samples / grids_.nu(k);
      const std::size_t together = first == 0 ? grids_.alike(k, end, most) : 1;
      const GridPlan<T>& plan = plans.find(grids_.nu(k), 1);
      while (first < last) {
        const std::size_t stop = std::min(last, first + kernels_.chunk_samples);
        executed = kernels_.run(plan, {first_curve_ + k, together, first, stop},
                                grids_.offset(k) + first, outputs_, delivery);
        first = stop;
      }
      k += together;
    }
    delivery.finish();
    return executed;
  }

private:
  std::size_t first_curve_;
  const CountedGrids& grids_;
  OutputPlan<T> outputs_;
  CurveKernels<T> kernels_;
};

template <typename T>
using CurveGridsCall =
    CountedGridsCall<CallName::curve_grids, T, CurveSet, CurveGrids, CurveGridsWork<T>>;

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const CurveSet<T>& set, const CurveGrids& grids, const CurveOutputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::CurveGridsCall<T>(set, grids, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const CurveSet<float>&, const CurveGrids&,
                                        const CurveOutputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const CurveSet<double>&, const CurveGrids&,
                                        const CurveOutputs<double>&, const Options&) noexcept;

} // namespace simdbezier
