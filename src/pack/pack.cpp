// Packing: threads and kernels; src/pack/set_layout.cpp has arguments and memory,
// src/storage/net_faults.hpp what is wrong with a patch, and the arithmetic is in
// pack/bicubic_pack_kernel.hpp and pack/shape_pack_kernel.hpp.
#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include <simdbezier/patch_set.hpp>

#include "src/pack/run_packer.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Packs all patches; reports the fault of the lowest patch, whichever thread finds it.
template <typename T, typename S>
Report pack_runs(std::span<const ControlNets<S>> nets, std::span<const PackRun> runs,
                 const PackOptions& options, Isa isa, const SetStorage<T>& storage) {
  const KernelTable<T>& table = kernel_table<T>(isa);
  std::size_t groups = 0;
  for (const PackRun& run : runs) {
    groups += lane_groups(run.count);
  }
  LowestFault fault;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    std::size_t before = 0; // groups of the runs that came before
    Report report;
    for (const PackRun& run : runs) {
      const std::size_t own = lane_groups(run.count);
      const std::size_t from = std::max(begin, before) - before;
      const std::size_t to = std::min(end, before + own) - std::min(end, before);
      if (report && from < to) {
        const RunPacker<T, S> packer(nets[run.entry], run, options, table,
                                     storage.buckets[run.bucket]);
        report = packer.pack(from * kMaxLanes, std::min(to * kMaxLanes, run.count));
      }
      before += own;
    }
    fault.add(report);
  };
  divide_work(groups, 50 * kMaxLanes, options.threads, body);
  return fault.report();
}

} // namespace
} // namespace detail

template <typename T>
std::size_t PatchSet<T>::size() const noexcept {
  return storage_ == nullptr ? 0 : storage_->count;
}

template <typename T>
int PatchSet<T>::components() const noexcept {
  return empty() ? 3 : storage_->buckets[0].shape.components;
}

template <typename T>
PatchShape PatchSet<T>::shape(std::size_t patch) const noexcept {
  if (patch >= size()) {
    return {0, 0, 0, false};
  }
  const detail::NetShape& shape = storage_->buckets[storage_->place(patch).bucket].shape;
  return {shape.degree_u, shape.degree_v, shape.components, shape.rational};
}

template <typename T>
bool PatchSet<T>::has_local_origins() const noexcept {
  return storage_ != nullptr && storage_->buckets[0].origins != nullptr;
}

template <typename T, typename S>
Report pack(std::span<const ControlNets<S>> nets, PatchSet<T>& set,
            const PackOptions& options) noexcept try {
  Report report = detail::check_packable(nets);
  if (!report) {
    return report;
  }
  Isa isa = Isa::automatic;
  report = detail::resolve_packing(options, nets.empty() ? 3 : nets.front().components, isa);
  if (!report) {
    return report;
  }
  auto storage = std::make_shared<detail::SetStorage<T>>();
  std::vector<detail::PackRun> runs;
  const auto used = options.reuse_memory ? set.take() : nullptr;
  const Status laid_out = detail::lay_out(nets, options, used.get(), *storage, runs);
  if (laid_out != Status::ok) {
    return {laid_out};
  }
  report = detail::pack_runs<T, S>(nets, runs, options, isa, *storage);
  if (report) {
    detail::find_common_floors(*storage);
    set = PatchSet<T>(std::move(storage));
  }
  return report;
} catch (const std::bad_alloc&) {
  return {Status::out_of_memory};
}

template <typename T, typename S>
Report pack(const ControlNets<S>& nets, PatchSet<T>& set, const PackOptions& options) noexcept {
  return pack(std::span<const ControlNets<S>>(&nets, 1), set, options);
}

template class PatchSet<float>;
template class PatchSet<double>;
#define SIMDBEZIER_INSTANTIATE_PACK(T, S)                                                          \
  template SIMDBEZIER_API Report pack(std::span<const ControlNets<S>>, PatchSet<T>&,               \
                                      const PackOptions&) noexcept;                                \
  template SIMDBEZIER_API Report pack(const ControlNets<S>&, PatchSet<T>&,                         \
                                      const PackOptions&) noexcept;
SIMDBEZIER_INSTANTIATE_PACK(float, float)
SIMDBEZIER_INSTANTIATE_PACK(float, double)
SIMDBEZIER_INSTANTIATE_PACK(double, float)
SIMDBEZIER_INSTANTIATE_PACK(double, double)
#undef SIMDBEZIER_INSTANTIATE_PACK

} // namespace simdbezier
