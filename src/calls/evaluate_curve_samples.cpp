// The call for single samples of curves: pieces of them for the kernels.
#include <algorithm>
#include <cmath>

#include <simdbezier/curves.hpp>

#include "src/calls/curve_pieces.hpp"
#include "src/calls/sample_pieces.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are pieces of samples.
template <typename T>
class CurveSamplesWork {
public:
  CurveSamplesWork(const Given<T, CurveSet<T>, CurveSamples<T>>& in,
                   const Request<T>& request) noexcept
      : curves_(*in.set.storage()), table_(*request.table),
        first_component_(request.components.first), samples_(in.where),
        outputs_(plan_outputs(in.out, way_of_samples(in.options.destination))),
        pieces_(samples_.curve.size(), outputs_.staged()) {}

  [[nodiscard]] std::size_t units() const noexcept { return pieces_.count; }
  [[nodiscard]] std::size_t duration() const noexcept {
    return duration_of(samples_.curve.size(), 4);
  }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return Delivery<T>::scratch_bytes(outputs_.staged_planes(), outputs_.streaming(),
                                      pieces_.length);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    Delivery<T> delivery(outputs_, table_, pieces_.length, scratch);
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * pieces_.length;
      executed =
          run_piece(first, std::min(pieces_.length, samples_.curve.size() - first), delivery);
    }
    delivery.finish();
    return executed;
  }

private:
  Isa run_piece(std::size_t first, std::size_t count, Delivery<T>& delivery) const noexcept {
    ScatteredCurveTask<T> task{};
    fill_arrays(task, curves_, 0, outputs_.out(), first, delivery.begin(first), first_component_);
    task.curve = samples_.curve.data() + first;
    task.t = samples_.t.data() + first;
    set_half_centring(samples_.parameters, task);
    task.count = count;
    for (std::size_t k = 0; task.status != nullptr && k < count; ++k) {
      task.status[k] = std::isfinite(task.t[k]) ? SampleStatus::regular : SampleStatus::non_finite;
    }
    table_.curves->scattered(task);
    delivery.end(count);
    return task.executed;
  }

  const CurveStorage<T>& curves_;
  const KernelTable<T>& table_;
  std::size_t first_component_;
  const CurveSamples<T>& samples_;
  OutputPlan<T> outputs_;
  SamplePieces pieces_;
};

template <typename T>
using CurveSamplesCall =
    SamplesCall<T, Given<T, CurveSet<T>, CurveSamples<T>>, CurveSamplesWork<T>>;

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const CurveSet<T>& set, const CurveSamples<T>& samples, const CurveOutputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::CurveSamplesCall<T>(set, samples, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const CurveSet<float>&, const CurveSamples<float>&,
                                        const CurveOutputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const CurveSet<double>&, const CurveSamples<double>&,
                                        const CurveOutputs<double>&, const Options&) noexcept;

} // namespace simdbezier
