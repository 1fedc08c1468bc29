// The per-patch grids call: work divided by samples, rows as its grain.
#include <algorithm>
#include <memory>
#include <new>

#include <simdbezier/patch_grids.hpp>

#include "src/calls/grid_evaluator.hpp"
#include "src/calls/grid_request.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Rows of one patch that a kernel takes at once.
constexpr std::size_t kMostRows = 1024;

/// The sizes of a call, and where each patch's samples begin.
struct Samples {
  std::unique_ptr<std::size_t[]> before; ///< samples in the patches before each one; count + 1
  const std::size_t* offset = nullptr;
  std::size_t extent = 0; ///< one more than the highest index
  std::size_t least_nu = ~std::size_t(0);
  std::size_t most_nu = 0;
  std::size_t most_nv = 0;
};

/// ok | null_input | bad_grid | bad_offsets | size_overflow | out_of_memory
template <typename T>
Status count_samples(const PatchGrids& grids, std::size_t patches, Samples& samples) noexcept {
  if (patches > 0 && (grids.nu == nullptr || grids.nv == nullptr)) {
    return Status::null_input;
  }
  if (patches >= static_cast<std::size_t>(-1) / sizeof(std::size_t)) {
    return Status::size_overflow;
  }
  samples.before.reset(new (std::nothrow) std::size_t[patches + 1]);
  if (samples.before == nullptr) {
    return Status::out_of_memory;
  }
  samples.before[0] = 0;
  for (std::size_t k = 0; k < patches; ++k) {
    const std::size_t nu = grids.nu[k];
    const std::size_t nv = grids.nv[k];
    if (nu < 2 || nv < 2) {
      return Status::bad_grid;
    }
    if (std::max(nu, nv) > GridPlan<T>::kMost) {
      return Status::size_overflow;
    }
    const std::size_t count = nu * nv; // of two 32-bit values
    if (__builtin_add_overflow(samples.before[k], count, &samples.before[k + 1])) {
      return Status::size_overflow;
    }
    samples.least_nu = std::min(samples.least_nu, nu);
    samples.most_nu = std::max(samples.most_nu, nu);
    samples.most_nv = std::max(samples.most_nv, nv);
    if (grids.offset != nullptr) {
      if (grids.offset[k] < samples.extent) {
        return Status::bad_offsets;
      }
      if (__builtin_add_overflow(grids.offset[k], count, &samples.extent)) {
        return Status::size_overflow;
      }
    }
  }
  samples.offset = grids.offset != nullptr ? grids.offset : samples.before.get();
  samples.extent = grids.offset != nullptr ? samples.extent : samples.before[patches];
  return Status::ok;
}

/// Plans by size: neighbours often share theirs. Grids too large for a plan's own room share one
/// piece of memory, so that nothing can fail once samples are being written.
template <typename T>
class PlanCache {
public:
  explicit PlanCache(T* memory) noexcept : memory_(memory) {}

  const GridPlan<T>& find(std::size_t nu, std::size_t nv) noexcept {
    GridPlan<T>& plan =
        GridPlan<T>::fits_inline(nu, nv) ? plan_[(nu * 5 + nv) % kPlans] : large_plan_;
    if (plan.nu() != nu || plan.nv() != nv) {
      [[maybe_unused]] const Status built = plan.build(Grid<T>::uniform(nu, nv), memory_);
    }
    return plan;
  }

private:
  static constexpr std::size_t kPlans = 16;
  T* memory_;
  GridPlan<T> large_plan_;
  GridPlan<T> plan_[kPlans];
};

/// One call after its checks; worker() runs on every thread.
template <typename T>
class PatchGridsCall {
public:
  PatchGridsCall(const GridKernels<T>& kernels, std::size_t first_patch, std::size_t patches,
                 const PatchGrids& grids, const Samples& samples,
                 const OutputPlan<T>& outputs) noexcept
      : kernels_(kernels), first_patch_(first_patch), patches_(patches), grids_(grids),
        samples_(samples), outputs_(outputs), piece_samples_(Delivery<T>::chunk_samples(outputs)),
        chunk_samples_(std::max(piece_samples_, samples.most_nu)) {
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), chunk_samples_));
    plan_bytes_ =
        whole_lines(GridPlan<T>::memory_values(samples.most_nu, samples.most_nv) * sizeof(T));
  }

  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + plan_bytes_ + GridEvaluator<T>::scratch_bytes(kMostRows);
  }

  /// The rows that begin with samples [begin, end), counted without gaps.
  Isa worker(std::size_t begin, std::size_t end, unsigned char* scratch) const noexcept {
    PlanCache<T> plans(reinterpret_cast<T*>(scratch + delivery_bytes_));
    GridEvaluator<T> evaluator(kernels_, kMostRows, scratch + delivery_bytes_ + plan_bytes_);
    Delivery<T> delivery(outputs_, *kernels_.table, chunk_samples_, scratch);
    const std::size_t* const before = samples_.before.get();
    std::size_t k =
        static_cast<std::size_t>(std::upper_bound(before, before + patches_, begin) - before - 1);
    for (; k < patches_ && before[k] < end; ++k) {
      const std::size_t nu = grids_.nu[k];
      const std::size_t nv = grids_.nv[k];
      const auto rows_before = [&](std::size_t sample) {
        return sample <= before[k] ? 0 : std::min(nv, (sample - before[k] + nu - 1) / nu);
      };
      const GridPlan<T>& plan = plans.find(nu, nv);
      for (std::size_t row = rows_before(begin), last = rows_before(end); row < last;) {
        const std::size_t rows =
            std::min({last - row, std::max<std::size_t>(piece_samples_ / nu, 1), kMostRows});
        run_piece(plan, k, row, rows, evaluator, delivery);
        row += rows;
      }
    }
    delivery.finish();
    return evaluator.executed();
  }

private:
  void run_piece(const GridPlan<T>& plan, std::size_t k, std::size_t row, std::size_t rows,
                 GridEvaluator<T>& evaluator, Delivery<T>& delivery) const noexcept {
    const std::size_t sample = samples_.offset[k] + row * plan.nu();
    SampleStatus* const status = outputs_.out().status;
    const Planes<T>* const planes = delivery.begin(sample);
    typename GridEvaluator<T>::Target to{.planes = planes};
    to.status = status == nullptr ? nullptr : status + sample;
    to.set_curvature(outputs_.out().curvature, sample);
    to.drain = delivery.queue();
    to.next = delivery.next();
    to.record = outputs_.record();
    evaluator.run(plan, {first_patch_ + k, 1, row, row + rows}, to);
    delivery.end(rows * plan.nu());
  }

  const GridKernels<T>& kernels_;
  std::size_t first_patch_;
  std::size_t patches_;
  const PatchGrids& grids_;
  const Samples& samples_;
  const OutputPlan<T>& outputs_;
  std::size_t piece_samples_;
  std::size_t chunk_samples_;
  std::size_t delivery_bytes_ = 0;
  std::size_t plan_bytes_ = 0; ///< parameters of the largest grid
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_patch_grids(const PatchSet<T>& set, const PatchGrids& grids, const Outputs<T>& out,
                            const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  detail::Samples samples;
  const Status counted = detail::count_samples<T>(grids, request.patches, samples);
  if (counted != Status::ok) {
    return counted;
  }
  const detail::InputRange inputs[] = {{grids.nu, request.patches * sizeof(std::uint32_t)},
                                       {grids.nv, request.patches * sizeof(std::uint32_t)},
                                       {grids.offset, request.patches * sizeof(std::size_t)}};
  const Status usable = detail::check_outputs(out, samples.extent, request.components.dimension,
                                              request.components.space, inputs, std::size(inputs));
  if (usable != Status::ok || request.patches == 0) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  const detail::GridKernels<T> kernels(*set.storage(), detail::kernel_table<T>(request.isa),
                                       detail::wanted_groups(out), out.curvature.wanted(),
                                       request.components, options.watertight);
  const std::size_t total = samples.before[request.patches];
  detail::OutputPlan<T> outputs(out, total, options.destination);
  outputs.arrange(kernels.direct_rows(samples.least_nu, false),
                  detail::thread_count(options.threads, total));
  const detail::PatchGridsCall<T> call(kernels, request.first_patch, request.patches, grids,
                                       samples, outputs);
  return detail::run_blocks(total, options, call.scratch_bytes(),
                            [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                              return call.worker(begin, end, scratch);
                            });
}

template SIMDBEZIER_API Status evaluate_patch_grids(const PatchSet<float>&, const PatchGrids&,
                                                    const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_patch_grids(const PatchSet<double>&, const PatchGrids&,
                                                    const Outputs<double>&,
                                                    const Options&) noexcept;

} // namespace simdbezier
