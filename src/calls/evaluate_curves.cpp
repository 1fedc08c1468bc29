// The call for curves on common parameters: checks, then curves and strips of long ones.
#include <algorithm>
#include <iterator>

#include <simdbezier/curves.hpp>

#include "src/calls/curve_call.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Every curve on the same parameters.
template <typename T>
Isa run_grid(const CurveCall<T>& call, const GridPlan<T>& plan, std::size_t first_curve,
             std::size_t strips, std::size_t begin, std::size_t end,
             unsigned char* scratch) noexcept {
  Isa executed = Isa::automatic;
  const std::size_t n = plan.nu();
  Delivery<T> delivery(call.outputs, call.table, call.chunk_samples, scratch);
  for (std::size_t unit = begin; unit < end;) {
    const std::size_t curve = unit / strips;
    const std::size_t first = unit % strips * call.chunk_samples;
    const std::size_t together =
        strips > 1 ? 1 : std::min(std::max<std::size_t>(call.chunk_samples / n, 1), end - unit);
    const CurvePiece piece{first_curve + curve, together, first,
                           std::min(n, first + (strips > 1 ? call.chunk_samples : n))};
    executed = call.run(plan, piece, curve * n + first, delivery);
    unit += together;
  }
  delivery.finish();
  return executed;
}

/// Samples from which on planes amortise staging.
constexpr std::size_t kLongRow = 32;

/// Whether kernels are to write rows straight to where they belong. Planes that need no staging and
/// hold whole registers are swept faster one by one.
template <typename T>
bool goes_in_rows(const CurveStorage<T>& curves, const CurveOutputs<T>& out,
                  const OutputPlan<T>& outputs, const KernelTable<T>& table,
                  std::size_t n) noexcept {
  if (n < kLeastRow || n > kMostRow || !may_be_rows(curves.shape, out, table)) {
    return false;
  }
  const bool planes =
      out.position.stride == 1 && (outputs.staged() ? n < kLongRow : n < table.lanes);
  return planes || are_triples(out.position);
}

} // namespace
} // namespace detail

template <typename T>
Status evaluate_curves(const CurveSet<T>& set, const CurveGrid<T>& grid, const CurveOutputs<T>& out,
                       const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  std::size_t samples = 0;
  if (!request.count_samples(grid.n, 1, samples)) {
    return Status::size_overflow;
  }
  const detail::InputRange inputs[] = {{grid.t, grid.n * sizeof(T)}};
  const Status usable = detail::check_curve_outputs(out, samples, set.components(),
                                                    request.components, inputs, std::size(inputs));
  if (usable != Status::ok) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  detail::GridPlan<T> plan;
  const Status planned = detail::build_plan(plan, grid);
  if (planned != Status::ok || request.patches == 0) {
    return planned;
  }
  const Outputs<T> groups = detail::as_outputs(out);
  const detail::KernelTable<T>& table = detail::kernel_table<T>(request.isa);
  detail::OutputPlan<T> outputs = detail::plan_outputs(out, groups, samples, options.destination);
  outputs.arrange(
      {.row = out.curvature == nullptr ? grid.n : 0, .lanes = table.lanes, .streamed = true},
      detail::thread_count(options.threads, request.patches));
  const bool rows = detail::goes_in_rows(*set.storage(), out, outputs, table, grid.n);
  if (rows) {
    outputs.write_directly();
  }
  const detail::CurveCall<T> call{*set.storage(),
                                  table,
                                  out,
                                  outputs,
                                  request.components.first,
                                  rows ? samples : detail::Delivery<T>::chunk_samples(outputs),
                                  rows};
  const std::size_t strips =
      grid.n > call.chunk_samples ? (grid.n - 1) / call.chunk_samples + 1 : 1;
  return detail::run_blocks(request.patches * strips, options, call.delivery_bytes(),
                            [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                              return detail::run_grid(call, plan, request.first_patch, strips,
                                                      begin, end, scratch);
                            });
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status evaluate_curves(const CurveSet<T>&, const CurveGrid<T>&,          \
                                                 const CurveOutputs<T>&, const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
