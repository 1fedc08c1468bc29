// Sets of the patches of splines: nets of a few rows of spans at a time are cut and packed.
#include <simdbezier/splines.hpp>

#include <algorithm>
#include <memory>

#include "src/nets/net_call.hpp"
#include "src/pack/run_packer.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/splines/spline_knots.hpp"
#include "src/splines/spline_nets.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Patches that are packed at once, where rows of spans are not longer: fewer fill registers less.
constexpr std::size_t kPatchesTogether = 64;

/// The nets of one spline as pack() takes them. They have no memory yet.
template <typename S>
ControlNets<S> nets_of(const PreparedSpline<S>& spline) noexcept {
  const SplineSurface<S>& surface = spline.surface;
  return ControlNets<S>::packed(
      nullptr, spline.patches(), surface.degree_u, surface.degree_v, surface.components,
      surface.weights == Weights::none ? Weights::none : Weights::homogeneous);
}

template <typename S>
bool have_one_shape(const ControlNets<S>& a, const ControlNets<S>& b) noexcept {
  return a.degree_u == b.degree_u && a.degree_v == b.degree_v && a.weights == b.weights;
}

/// Views of all nets: consecutive splines of one shape are one.
template <typename S>
std::vector<ControlNets<S>> views_of(const SplineList<S>& list) {
  std::vector<ControlNets<S>> views;
  for (const PreparedSpline<S>& spline : list.splines()) {
    const ControlNets<S> nets = nets_of(spline);
    if (!views.empty() && have_one_shape(views.back(), nets)) {
      views.back().count += nets.count;
    } else {
      views.push_back(nets);
    }
  }
  return views;
}

/// Cuts and packs rows of spans.
template <typename T, typename S>
class SplinePacker {
public:
  SplinePacker(const SplineList<S>& list, std::span<const ControlNets<S>> views,
               std::span<const PackRun> runs, const PackOptions& options, Isa isa,
               const SetStorage<T>& storage)
      : list_(list), views_(views), runs_(runs), options_(options), table_(kernel_table<T>(isa)),
        storage_(storage) {
    for (const PreparedSpline<S>& spline : list.splines()) {
      const std::size_t together = std::max(spline.u->spans(), kPatchesTogether);
      most_values_ = std::max(
          most_values_, 2 * together * static_cast<std::size_t>(nets_of(spline).patch_stride));
    }
  }

  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return whole_lines(list_.scratch_bytes()) + most_values_ * sizeof(S);
  }

  /// Packs rows [begin, end) up to the first fault.
  Report pack(std::size_t begin, std::size_t end, unsigned char* scratch) const {
    SplineCutter<S> cutter(list_, table_.nets->means, scratch);
    S* const nets = reinterpret_cast<S*>(scratch + whole_lines(list_.scratch_bytes()));
    Report report;
    for (std::size_t row = begin; row < end && report;) {
      const std::size_t first = list_.patch_of(row);
      const PackRun& run = run_of(first);
      ControlNets<S> block = views_[run.entry];
      block.points = nets;
      block.count = 0;
      for (; row < end && block.count < kPatchesTogether &&
             list_.patch_of(row) < run.number + run.count;
           ++row) {
        MutableNets<S> to = MutableNets<S>::packed(nets, 0, block.degree_u, block.degree_v,
                                                   block.components, block.weights);
        to.points += static_cast<std::ptrdiff_t>(block.count) * block.patch_stride;
        cutter.cut(row, view_of(to));
        block.count += list_.spline_of(row).u->spans();
      }
      const PackRun part{run.entry, run.bucket, run.place + (first - run.number), first,
                         block.count};
      report = RunPacker<T, S>(block, part, options_, table_, storage_.buckets[run.bucket])
                   .pack(0, block.count);
    }
    return report;
  }

private:
  [[nodiscard]] const PackRun& run_of(std::size_t patch) const noexcept {
    const auto after =
        std::upper_bound(runs_.begin(), runs_.end(), patch,
                         [](std::size_t at, const PackRun& run) { return at < run.number; });
    return *std::prev(after);
  }

  const SplineList<S>& list_;
  std::span<const ControlNets<S>> views_;
  std::span<const PackRun> runs_;
  const PackOptions& options_;
  const KernelTable<T>& table_;
  const SetStorage<T>& storage_;
  std::size_t most_values_ = 0;
};

/// The report of a patch as one of its spline.
template <typename S>
Report report_of(const Report& report, const SplineList<S>& list) noexcept {
  std::size_t surface = 0;
  while (surface + 1 < list.splines().size() &&
         list.splines()[surface + 1].first_patch <= report.item) {
    ++surface;
  }
  return {report.status, surface, 0, report.component};
}

template <typename T, typename S>
Report pack_list(const SplineList<S>& list, PatchSet<T>& set, const PackOptions& options) {
  const int components = list.splines().empty() ? 3 : list.splines()[0].surface.components;
  Isa isa = Isa::automatic;
  if (const Report report = resolve_packing(options, components, isa); !report) {
    return report;
  }
  const std::vector<ControlNets<S>> views = views_of(list);
  auto storage = std::make_shared<SetStorage<T>>();
  std::vector<PackRun> runs;
  const auto used = options.reuse_memory ? set.take() : nullptr;
  if (const Status status = lay_out<T, S>(views, options, used.get(), *storage, runs); !status) {
    return {status};
  }
  const SplinePacker<T, S> packer(list, views, runs, options, isa, *storage);
  const int threads = thread_count(options.threads, list.rows(), duration_of(list.patches(), 100));
  ThreadScratch scratch;
  if (!scratch.allocate(packer.scratch_bytes(), threads)) {
    return {Status::out_of_memory};
  }
  LowestFault fault;
  auto body = [&](int worker, std::size_t begin, std::size_t end) {
    fault.add(packer.pack(begin, end, scratch.of(worker)));
  };
  for_blocks(list.rows(), threads, BlockBody(body));
  if (!fault.report()) {
    return report_of(fault.report(), list);
  }
  find_common_floors(*storage);
  set = PatchSet<T>(std::move(storage));
  return {};
}

template <typename S>
Report check_components(std::span<const SplineSurface<S>> surfaces) noexcept {
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (surfaces[k].components != surfaces.front().components) {
      return {Status::bad_components, k};
    }
  }
  return {};
}

} // namespace
} // namespace detail

template <typename T, typename S>
Report pack(std::span<const SplineSurface<S>> surfaces, PatchSet<T>& set,
            std::span<PatchInterval> intervals, const PackOptions& options) noexcept {
  if (surfaces.data() == nullptr && !surfaces.empty()) {
    return {Status::null_input};
  }
  return detail::guarded([&]() -> Report {
    if (const Report report = detail::check_components(surfaces); !report) {
      return report;
    }
    detail::SplineList<S> list;
    if (const Report report = list.prepare(surfaces); !report) {
      return report;
    }
    if (!intervals.empty() && intervals.size() != list.patches()) {
      return {Status::unequal_lengths};
    }
    const Report report = detail::pack_list(list, set, options);
    if (report) {
      list.write_intervals(intervals);
    }
    return report;
  });
}

template <typename T, typename S>
Report pack(const SplineSurface<S>& surface, PatchSet<T>& set, std::span<PatchInterval> intervals,
            const PackOptions& options) noexcept {
  return pack(std::span<const SplineSurface<S>>(&surface, 1), set, intervals, options);
}

#define SIMDBEZIER_INSTANTIATE(T, S)                                                               \
  template SIMDBEZIER_API Report pack(std::span<const SplineSurface<S>>, PatchSet<T>&,             \
                                      std::span<PatchInterval>, const PackOptions&) noexcept;      \
  template SIMDBEZIER_API Report pack(const SplineSurface<S>&, PatchSet<T>&,                       \
                                      std::span<PatchInterval>, const PackOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float, float)
SIMDBEZIER_INSTANTIATE(float, double)
SIMDBEZIER_INSTANTIATE(double, float)
SIMDBEZIER_INSTANTIATE(double, double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
