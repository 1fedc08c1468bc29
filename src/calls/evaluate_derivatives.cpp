// The calls for derivatives of any order: checks, then pieces of samples for the kernel. Samples of
// a grid become single ones, whose parameters have the grid's bits.
#include <algorithm>

#include <simdbezier/derivatives.hpp>

#include "src/calls/grid_plan.hpp"
#include "src/calls/grid_request.hpp"
#include "src/calls/sample_request.hpp"
#include "src/output/output_plan.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/patch_storage.hpp"
#include "src/tables/derivative_task.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Samples that are handed to a kernel together: enough to fill registers with those that lie on
/// the same edge.
constexpr std::size_t kPiece = 512;

template <typename T>
using Derivatives = std::span<const PartialDerivative<T>>;

/// Every output by itself, then every pair of them: ok | bad_degree | null_output | bad_stride |
/// overlapping_outputs | size_overflow. inputs[0] is room for the list of derivatives.
template <typename T, std::size_t kInputs>
Status check_derivatives(Derivatives<T> wanted, std::size_t samples, std::size_t dimension,
                         InputRange (&inputs)[kInputs]) noexcept {
  inputs[0] = {wanted.data(), wanted.size_bytes()};
  if (wanted.empty()) {
    return Status::null_output;
  }
  for (const PartialDerivative<T>& d : wanted) {
    if (std::min(d.order_u, d.order_v) < 0 ||
        std::max(d.order_u, d.order_v) > kMostDerivativeOrder) {
      return Status::bad_degree;
    }
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Outputs<T> out;
    out.position = wanted[i].out;
    Status status = check_outputs(out, samples, dimension, false, inputs, kInputs);
    for (std::size_t k = 0; k < i && status == Status::ok; ++k) {
      out.du = wanted[k].out;
      status = check_outputs(out, samples, dimension, false, nullptr, 0);
    }
    if (status != Status::ok) {
      return status;
    }
  }
  return Status::ok;
}

/// Polynomials need the orders asked for; quotients all lower ones as well.
template <typename T>
DerivativeOrders orders_of(Derivatives<T> wanted, bool rational) noexcept {
  DerivativeOrders orders;
  std::fill_n(orders.highest_v, kMostDerivatives, -1);
  for (const PartialDerivative<T>& d : wanted) {
    orders.highest_u = std::max(orders.highest_u, d.order_u);
    for (int a = rational ? 0 : d.order_u; a <= d.order_u; ++a) {
      orders.highest_v[a] = std::max(orders.highest_v[a], d.order_v);
    }
  }
  return orders;
}

template <typename T>
struct SampleSource {
  const Samples<T>& samples;

  void fill(std::size_t first, std::size_t count, std::size_t* patch, T* x, T* y) const noexcept {
    for (std::size_t k = 0; k < count; ++k) {
      patch[k] = samples.patch[first + k];
      x[k] = half_centred(samples.u[first + k], samples.parameters);
      y[k] = half_centred(samples.v[first + k], samples.parameters);
    }
  }
};

template <typename T>
struct GridSource {
  const T* x;
  const T* y;
  std::size_t nu;
  std::size_t nv;
  std::size_t first_patch;

  void fill(std::size_t first, std::size_t count, std::size_t* patch, T* to_x,
            T* to_y) const noexcept {
    std::size_t i = first % nu;
    std::size_t j = first / nu % nv;
    std::size_t p = first / nu / nv;
    for (std::size_t k = 0; k < count; ++k) {
      patch[k] = first_patch + p;
      to_x[k] = x[i];
      to_y[k] = y[j];
      if (++i == nu) {
        i = 0;
        if (++j == nv) {
          j = 0;
          ++p;
        }
      }
    }
  }
};

/// Source: fills in patches (of the set) and half-centred parameters of consecutive samples.
template <typename T, typename Source>
class DerivativeCall {
public:
  DerivativeCall(const SetStorage<T>& set, const Source& source, std::size_t samples,
                 Derivatives<T> wanted, const KernelTable<T>& table, std::size_t first_component,
                 bool watertight) noexcept
      : set_(set), source_(source), samples_(samples), wanted_(wanted), table_(table),
        first_component_(first_component),
        watertight_(watertight), orders_{orders_of(wanted, false), orders_of(wanted, true)} {}

  Status run(const Options& options) const noexcept {
    const std::size_t pieces = samples_ / kPiece + (samples_ % kPiece != 0 ? 1 : 0);
    return run_blocks(pieces, options, sizeof(Scratch),
                      [&](int, std::size_t begin, std::size_t end, unsigned char* scratch) {
                        return worker(begin, end, *new (scratch) Scratch);
                      });
  }

private:
  struct Scratch {
    std::size_t patch[kPiece]; ///< of the set, then of its bucket
    T x[kPiece];
    T y[kPiece];
  };

  Isa worker(std::size_t begin, std::size_t end, Scratch& scratch) const noexcept {
    Isa executed = Isa::automatic;
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * kPiece;
      const std::size_t count = std::min(kPiece, samples_ - first);
      source_.fill(first, count, scratch.patch, scratch.x, scratch.y);
      for (std::size_t k = 0; k < count;) {
        const std::uint32_t bucket = set_.place(scratch.patch[k]).bucket;
        std::size_t last = k;
        for (; last < count; ++last) {
          const PatchPlace place = set_.place(scratch.patch[last]);
          if (place.bucket != bucket) {
            break;
          }
          scratch.patch[last] = place.index;
        }
        executed = run_bucket(set_.buckets[bucket], scratch, k, last - k, first + k);
        k = last;
      }
    }
    return executed;
  }

  Isa run_bucket(const PatchStorage<T>& patches, const Scratch& scratch, std::size_t at,
                 std::size_t count, std::size_t first) const noexcept {
    DerivativeTask<T> task{};
    task.shape = &patches.shape;
    task.coefficients = patches.coefficients;
    task.edges = patches.edges;
    task.origins = patches.origins;
    task.patch = scratch.patch + at;
    task.x = scratch.x + at;
    task.y = scratch.y + at;
    task.first = first;
    task.count = count;
    task.derivatives = wanted_.data();
    task.derivative_count = wanted_.size();
    task.orders = &orders_[patches.shape.rational ? 1 : 0];
    task.first_component = first_component_;
    task.watertight = watertight_;
    table_.shapes->derivatives(task);
    return task.executed;
  }

  const SetStorage<T>& set_;
  const Source& source_;
  std::size_t samples_;
  Derivatives<T> wanted_;
  const KernelTable<T>& table_;
  std::size_t first_component_;
  bool watertight_;
  DerivativeOrders orders_[2]; ///< of polynomials, of quotients
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_derivatives(const PatchSet<T>& set, const Samples<T>& samples,
                            std::span<const PartialDerivative<T>> derivatives,
                            const Options& options) noexcept {
  detail::SampleRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  detail::InputRange inputs[] = {{},
                                 {samples.patch, samples.count * sizeof(std::uint32_t)},
                                 {samples.u, samples.count * sizeof(T)},
                                 {samples.v, samples.count * sizeof(T)}};
  const Status writable =
      detail::check_derivatives(derivatives, samples.count, request.components.dimension, inputs);
  if (writable != Status::ok) {
    return writable;
  }
  const detail::KernelTable<T>& table = detail::kernel_table<T>(request.isa);
  const Status readable = detail::check_samples(set, samples, table);
  if (readable != Status::ok || samples.count == 0) {
    return readable;
  }
  const detail::SampleSource<T> source{samples};
  const detail::DerivativeCall<T, detail::SampleSource<T>> call(
      *set.storage(), source, samples.count, derivatives, table, request.components.first,
      options.watertight);
  return call.run(options);
}

template <typename T>
Status evaluate_derivatives(const PatchSet<T>& set, const Grid<T>& grid,
                            std::span<const PartialDerivative<T>> derivatives,
                            const Options& options) noexcept {
  detail::GridRequest request;
  const Status resolved = detail::resolve_request(set, options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  std::size_t samples = 0;
  if (!request.count_samples(grid.nu, grid.nv, samples)) {
    return Status::size_overflow;
  }
  detail::InputRange inputs[] = {{}, {grid.u, grid.nu * sizeof(T)}, {grid.v, grid.nv * sizeof(T)}};
  const Status usable =
      detail::check_derivatives(derivatives, samples, request.components.dimension, inputs);
  if (usable != Status::ok) {
    return usable;
  }
  const detail::DefaultFpEnvironment environment;
  detail::GridPlan<T> plan;
  const Status planned = plan.build(grid);
  if (planned != Status::ok || request.patches == 0) {
    return planned;
  }
  const detail::GridSource<T> source{plan.x(), plan.y(), grid.nu, grid.nv, request.first_patch};
  const detail::DerivativeCall<T, detail::GridSource<T>> call(
      *set.storage(), source, samples, derivatives, detail::kernel_table<T>(request.isa),
      request.components.first, options.watertight);
  return call.run(options);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status evaluate_derivatives(const PatchSet<T>&, const Samples<T>&,       \
                                                      std::span<const PartialDerivative<T>>,       \
                                                      const Options&) noexcept;                    \
  template SIMDBEZIER_API Status evaluate_derivatives(const PatchSet<T>&, const Grid<T>&,          \
                                                      std::span<const PartialDerivative<T>>,       \
                                                      const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
