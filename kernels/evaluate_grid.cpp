// The grid call: checks, the plan, work cut into (patch, strip of rows), kernels.
#include <algorithm>
#include <cmath>

#include <simdbezier/evaluate.hpp>

#include "kernels/batch.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/fp_environment.hpp"
#include "kernels/grid_plan.hpp"
#include "kernels/normal_fallback.hpp"
#include "kernels/patch_storage.hpp"
#include "kernels/staging.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Staged strips stay in L1; direct ones only bound how much one thread takes of a huge grid.
constexpr std::size_t kStagedSamples = 1024;
constexpr std::size_t kDirectSamples = 65536;

/// One grid call after its checks; worker() runs on every thread.
template <typename T>
class GridCall {
public:
  GridCall(const PatchStorage<T>& patches, std::size_t first_patch, const GridPlan<T>& plan,
           const Outputs<T>& out, bool watertight, const KernelTable<T>& table) noexcept
      : patches_(patches), first_patch_(first_patch), plan_(plan), out_(out),
        choice_(choose_kernels(out)), table_(table),
        scheme_(scheme(watertight, patches.origins != nullptr)), staging_(out, std::max(kStagedSamples, plan.nu())) {
    const std::size_t samples = staging_.staged() ? kStagedSamples : kDirectSamples;
    strip_rows_ = std::clamp<std::size_t>(samples / plan.nu(), 1, plan.nv());
    strips_ = (plan.nv() + strip_rows_ - 1) / strip_rows_;
  }

  [[nodiscard]] std::size_t strips() const noexcept { return strips_; }
  [[nodiscard]] std::size_t scratch_size() const noexcept { return staging_.scratch_size(); }
  [[nodiscard]] std::size_t strip_rows() const noexcept { return strip_rows_; }

  /// Units [begin, end) of patch-major (patch, strip) pairs. runs: room for strip_rows().
  Isa worker(std::size_t begin, std::size_t end, T* scratch, RowRun<T>* runs) const noexcept {
    Isa executed = Isa::automatic;
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t patch = unit / strips_;
      const std::size_t strip = unit % strips_;
      // Whole patches without staging go to the kernel in one call.
      const bool together = strips_ == 1 && !staging_.staged();
      const std::size_t count = together ? end - unit : 1;
      executed = run_strip(patch, count, strip, scratch, runs);
      unit += count;
    }
    return executed;
  }

private:
  Isa run_strip(std::size_t patch, std::size_t count, std::size_t strip, T* scratch,
                RowRun<T>* runs) const noexcept {
    const std::size_t first_row = strip * strip_rows_;
    const std::size_t last_row = std::min(plan_.nv(), first_row + strip_rows_);
    const std::size_t sample = (patch * plan_.nv() + first_row) * plan_.nu();
    const std::size_t at = first_patch_ + patch;
    GridTask<T> task{};
    task.coefficients = patches_.coefficients + at * kCoefficients;
    task.edges = patches_.edges + at * kEdgeBlock;
    task.control_points = patches_.control_points + at * kCoefficients;
    task.origins = patches_.origins == nullptr ? nullptr : patches_.origins + at * kOriginBlock;
    task.normal_floor = patches_.normal_floor + at;
    task.patch_count = count;
    task.x = plan_.x();
    task.nu = plan_.nu();
    task.runs = runs;
    task.run_count = plan_.fill_runs(first_row, last_row, runs);
    task.patch_step = plan_.nv() * plan_.nu();
    task.resolve_normal = resolve_normal<T>;
    if (out_.status != nullptr) {
      task.status = out_.status + sample;
      for (std::size_t p = 0; p < count; ++p) {
        prefill_status(task, task.status + p * task.patch_step);
      }
    }
    staging_.bind(task, sample, scratch);
    if (choice_.first) {
      table_.grid[choice_.outputs][scheme_](task);
    }
    if (choice_.second) {
      table_.grid[kSecondDerivatives][scheme_](task);
    }
    staging_.flush(sample, (last_row - first_row) * task.nu, scratch);
    return task.executed;
  }

  static void prefill_status(const GridTask<T>& task, SampleStatus* status) noexcept {
    for (std::size_t r = 0; r < task.run_count; ++r) {
      const RowRun<T>& run = task.runs[r];
      for (std::size_t j = 0; j < run.rows; ++j, status += task.nu) {
        for (std::size_t i = 0; i < task.nu; ++i) {
          const bool finite = !std::isnan(task.x[i]) && !std::isnan(run.y[j]);
          status[i] = finite ? SampleStatus::regular : SampleStatus::non_finite;
        }
      }
    }
  }

  const PatchStorage<T>& patches_;
  std::size_t first_patch_;
  const GridPlan<T>& plan_;
  const Outputs<T>& out_;
  KernelChoice choice_;
  const KernelTable<T>& table_;
  Scheme scheme_;
  Staging<T> staging_;
  std::size_t strip_rows_ = 1;
  std::size_t strips_ = 1;
};

/// The runs of a small grid live on the stack.
constexpr std::size_t kInlineRows = 128;

template <typename T>
Status run_grid(const GridCall<T>& call, std::size_t patches, const Options& options) noexcept {
  // A thread's planes, and behind them its list of runs where the stack is too small for it.
  const std::size_t planes = (call.scratch_size() * sizeof(T) + 63) / 64 * 64;
  const std::size_t runs =
      call.strip_rows() > kInlineRows ? call.strip_rows() * sizeof(RowRun<T>) : 0;
  return run_blocks(patches * call.strips(), options, planes + runs,
                    [&](std::size_t begin, std::size_t end, unsigned char* scratch) {
                      RowRun<T> inline_runs[kInlineRows];
                      auto* const own_runs =
                          runs > 0 ? reinterpret_cast<RowRun<T>*>(scratch + planes) : inline_runs;
                      return call.worker(begin, end, reinterpret_cast<T*>(scratch), own_runs);
                    });
}

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
  Isa isa = Isa::automatic;
  const Status resolved = resolve_isa(options.isa, isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  constexpr auto kAll = static_cast<std::size_t>(-1);
  if (options.first_patch > set.size()) {
    return Status::bad_patch_range;
  }
  const std::size_t rest = set.size() - options.first_patch;
  const std::size_t patches = options.patch_count == kAll ? rest : options.patch_count;
  if (patches > rest) {
    return Status::bad_patch_range;
  }
  std::size_t samples = 0;
  if (__builtin_mul_overflow(grid.nu, grid.nv, &samples) ||
      __builtin_mul_overflow(samples, patches, &samples)) {
    return Status::size_overflow;
  }
  const Status usable = detail::check_outputs(out, samples);
  if (usable != Status::ok) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  detail::GridPlan<T> plan;
  const Status planned = plan.build(grid);
  if (planned != Status::ok || patches == 0) {
    return planned;
  }
  const detail::GridCall<T> call(*set.storage(), options.first_patch, plan, out, options.watertight,
                                 detail::kernel_table<T>(isa));
  return detail::run_grid(call, patches, options);
}

template SIMDBEZIER_API float to_centred<float>(double) noexcept;
template SIMDBEZIER_API double to_centred<double>(double) noexcept;
template SIMDBEZIER_API Status evaluate_grid(const PatchSet<float>&, const Grid<float>&,
                                             const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate_grid(const PatchSet<double>&, const Grid<double>&,
                                             const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
