// The call for curves that each have a number of samples of their own: work divided by samples.
#include <algorithm>
#include <iterator>
#include <memory>
#include <new>

#include <simdbezier/curves.hpp>

#include "src/calls/curve_call.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// The sizes of a call with a number of samples for each curve.
struct CountedSamples {
  std::unique_ptr<std::size_t[]> before; ///< samples in the curves before each one; count + 1
  const std::size_t* offset = nullptr;
  std::size_t extent = 0; ///< one more than the highest index
  std::size_t most = 0;
};

/// ok | null_input | bad_grid | bad_offsets | size_overflow | out_of_memory
template <typename T>
Status count_samples(const CurveCounts& counts, std::size_t curves,
                     CountedSamples& samples) noexcept {
  if (curves > 0 && counts.n == nullptr) {
    return Status::null_input;
  }
  if (curves >= static_cast<std::size_t>(-1) / sizeof(std::size_t)) {
    return Status::size_overflow;
  }
  samples.before.reset(new (std::nothrow) std::size_t[curves + 1]);
  if (samples.before == nullptr) {
    return Status::out_of_memory;
  }
  samples.before[0] = 0;
  for (std::size_t k = 0; k < curves; ++k) {
    const std::size_t n = counts.n[k];
    if (n < 2) {
      return Status::bad_grid;
    }
    if (n > GridPlan<T>::kMost ||
        __builtin_add_overflow(samples.before[k], n, &samples.before[k + 1])) {
      return Status::size_overflow;
    }
    samples.most = std::max(samples.most, n);
    if (counts.offset != nullptr) {
      if (counts.offset[k] < samples.extent) {
        return Status::bad_offsets;
      }
      if (__builtin_add_overflow(counts.offset[k], n, &samples.extent)) {
        return Status::size_overflow;
      }
    }
  }
  samples.offset = counts.offset != nullptr ? counts.offset : samples.before.get();
  samples.extent = counts.offset != nullptr ? samples.extent : samples.before[curves];
  return Status::ok;
}

/// Plans by size: neighbours often share theirs. Those that are too large for a plan's own room
/// share one piece of memory, so that nothing can fail once samples are being written.
template <typename T>
class CurvePlans {
public:
  explicit CurvePlans(T* memory) noexcept : memory_(memory) {}

  const GridPlan<T>& find(std::size_t n) noexcept {
    GridPlan<T>& plan = GridPlan<T>::fits_inline(n, 1) ? plan_[n % kPlans] : large_plan_;
    if (plan.nu() != n) {
      [[maybe_unused]] const Status built = build_plan(plan, CurveGrid<T>::uniform(n), memory_);
    }
    return plan;
  }

private:
  static constexpr std::size_t kPlans = 8;
  T* memory_;
  GridPlan<T> large_plan_;
  GridPlan<T> plan_[kPlans];
};

/// Samples [begin, end) of all curves', counted without gaps; neighbours of equal size that leave
/// no gap between them go together.
template <typename T>
Isa run_counted(const CurveCall<T>& call, const CurveCounts& counts, const CountedSamples& samples,
                std::size_t first_curve, std::size_t curves, std::size_t begin, std::size_t end,
                unsigned char* scratch) noexcept {
  Isa executed = Isa::automatic;
  CurvePlans<T> plans(reinterpret_cast<T*>(scratch + call.delivery_bytes()));
  Delivery<T> delivery(call.outputs, call.table, call.chunk_samples, scratch);
  const std::size_t* const before = samples.before.get();
  auto k = static_cast<std::size_t>(std::upper_bound(before, before + curves, begin) - before - 1);
  while (k < curves && before[k] < end) {
    const std::size_t n = counts.n[k];
    std::size_t first = std::max(begin, before[k]) - before[k];
    const std::size_t last = std::min(end, before[k + 1]) - before[k];
    std::size_t together = 1;
    if (first == 0 && last == n && n <= call.chunk_samples) {
      while (k + together < curves && counts.n[k + together] == n &&
             before[k + together + 1] <= end && (together + 1) * n <= call.chunk_samples &&
             samples.offset[k + together] == samples.offset[k] + together * n) {
        ++together;
      }
    }
    const GridPlan<T>& plan = plans.find(n);
    while (first < last) {
      const std::size_t stop = std::min(last, first + call.chunk_samples);
      executed = call.run(plan, {first_curve + k, together, first, stop}, samples.offset[k] + first,
                          delivery);
      first = stop;
    }
    k += together;
  }
  delivery.finish();
  return executed;
}

} // namespace
} // namespace detail

template <typename T>
Status evaluate_curves(const CurveSet<T>& set, const CurveCounts& counts,
                       const CurveOutputs<T>& out, const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  detail::CountedSamples samples;
  const Status counted = detail::count_samples<T>(counts, request.patches, samples);
  if (counted != Status::ok) {
    return counted;
  }
  const detail::InputRange inputs[] = {{counts.n, request.patches * sizeof(std::uint32_t)},
                                       {counts.offset, request.patches * sizeof(std::size_t)}};
  const Status usable = detail::check_curve_outputs(out, samples.extent, set.components(),
                                                    request.components, inputs, std::size(inputs));
  if (usable != Status::ok || request.patches == 0) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  const std::size_t total = samples.before[request.patches];
  const Outputs<T> groups = detail::as_outputs(out);
  detail::OutputPlan<T> outputs = detail::plan_outputs(out, groups, total, options.destination);
  outputs.arrange({}, detail::thread_count(options.threads, total));
  const detail::CurveCall<T> call{
      *set.storage(),           detail::kernel_table<T>(request.isa),       out, outputs,
      request.components.first, detail::Delivery<T>::chunk_samples(outputs)};
  const std::size_t plan_bytes = detail::GridPlan<T>::memory_values(samples.most, 1) * sizeof(T);
  return detail::run_blocks(total, options, call.delivery_bytes() + plan_bytes,
                            [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                              return detail::run_counted(call, counts, samples, request.first_patch,
                                                         request.patches, begin, end, scratch);
                            });
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status evaluate_curves(const CurveSet<T>&, const CurveCounts&,           \
                                                 const CurveOutputs<T>&, const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
