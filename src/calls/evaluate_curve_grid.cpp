// The call for curves on common parameters: work cut into curves, and strips of long ones.
#include <algorithm>

#include <simdbezier/curves.hpp>

#include "src/calls/curve_pieces.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Whether kernels are to write rows straight to where they belong, which they can only do with
/// positions of three components.
template <typename T>
bool can_go_in_rows(const CurveShape& shape, const OutputList<T>& out,
                    const KernelTable<T>& table) noexcept {
  const Vectors<T>& position = out[CurveOutput::position];
  const bool alone = !out.holds(CurveOutput::d1) && !out.holds(CurveOutput::d2) &&
                     !out.holds(CurveOutput::tangent) && !out.wants_curvature() &&
                     position.z != nullptr;
  return alone && !shape.rational && shape.cells() == 1 && !table.compact &&
         (position.stride == 1 || are_triples(position));
}

/// Whether kernels write rows of n samples. They stream them from registers: as whole lines, or as
/// the end of one curve and the beginning of the next. That pays with registers of 32 bytes and
/// more, since in smaller ones most of what it costs serves few samples; other rows that go past
/// the caches are staged. Planes that stay in the caches go one by one, unless a register holds
/// several curves.
template <typename T>
bool pays_in_rows(const CurveShape& shape, const OutputPlan<T>& outputs,
                  const KernelTable<T>& table, std::size_t n) noexcept {
  const bool lines = rows_fill_lines<T>(shape, n);
  if (outputs.streaming()) {
    const bool joined = shape.degree == 3 && !shape.origins && n >= table.lanes && n <= kMostJoined;
    return table.lanes * sizeof(T) >= 32 && (lines || joined);
  }
  return are_triples(outputs.out()[CurveOutput::position]) ? n >= kLeastRow && n <= kMostRow
                                                           : lines && n < table.lanes;
}

/// Units are curve-major (curve, strip) pairs.
template <typename T>
class CurveGridWork {
public:
  CurveGridWork(const Given<T, CurveSet<T>, CurveGrid<T>>& in, const Request<T>& request,
                const GridPlan<T>& plan, Way way) noexcept
      : first_curve_(request.first), curves_(request.count), plan_(plan),
        outputs_(plan_outputs(in.out, way)), kernels_{*in.set.storage(), *request.table,
                                                      request.components.first, 0} {
    const OutputList<T>& out = in.out;
    const std::size_t n = plan.nu();
    const bool one_pass = out.holds(CurveOutput::position) && !out.holds(CurveOutput::d1) &&
                          !out.holds(CurveOutput::d2) && !out.wants_curvature();
    outputs_.put_directly({.row = one_pass ? n : 0,
                           .lanes = kernels_.table.lanes,
                           .streamed = kernels_.table.lanes * sizeof(T) == 64});
    kernels_.rows = can_go_in_rows(kernels_.curves.shape, out, kernels_.table) &&
                    pays_in_rows(kernels_.curves.shape, outputs_, kernels_.table, n);
    if (kernels_.rows) {
      outputs_.write_directly();
    }
    kernels_.chunk_samples = kernels_.rows ? n * curves_ : staged_samples(outputs_, n * curves_);
    strips_ = n > kernels_.chunk_samples ? (n - 1) / kernels_.chunk_samples + 1 : 1;
  }

  [[nodiscard]] std::size_t units() const noexcept { return curves_ * strips_; }
  [[nodiscard]] std::size_t duration() const noexcept {
    return duration_of(curves_ * plan_.nu(), 1);
  }
  [[nodiscard]] std::size_t grain() const noexcept { return strips_; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return kernels_.delivery_bytes(outputs_);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    const std::size_t n = plan_.nu();
    const std::size_t chunk = kernels_.chunk_samples;
    Delivery<T> delivery(outputs_, kernels_.table, chunk, scratch);
    for (std::size_t unit = begin; unit < end;) {
      const std::size_t curve = unit / strips_;
      const std::size_t first = unit % strips_ * chunk;
      const std::size_t together =
          strips_ > 1 ? 1 : std::min(std::max<std::size_t>(chunk / n, 1), end - unit);
      const CurvePiece piece{first_curve_ + curve, together, first,
                             std::min(n, first + (strips_ > 1 ? chunk : n))};
      executed = kernels_.run(plan_, piece, curve * n + first, outputs_, delivery);
      unit += together;
    }
    delivery.finish();
    return executed;
  }

private:
  std::size_t first_curve_;
  std::size_t curves_;
  const GridPlan<T>& plan_;
  OutputPlan<T> outputs_;
  CurveKernels<T> kernels_;
  std::size_t strips_ = 1;
};

template <typename T>
using CurveGridCall =
    CommonGridCall<CallName::curve_grid, T, CurveSet, CurveGrid<T>, CurveGridWork<T>>;

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const CurveSet<T>& set, const CurveGrid<T>& grid, const CurveOutputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::CurveGridCall<T>(set, grid, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const CurveSet<float>&, const CurveGrid<float>&,
                                        const CurveOutputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const CurveSet<double>&, const CurveGrid<double>&,
                                        const CurveOutputs<double>&, const Options&) noexcept;

} // namespace simdbezier
