// The calls for derivatives of any order: checks, then pieces of samples for the kernel. Samples of
// a grid become single ones, whose parameters have the grid's bits.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/grid_plan.hpp"
#include "src/calls/sample_pieces.hpp"
#include "src/storage/patch_storage.hpp"
#include "src/tables/derivative_task.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Samples that are handed to a kernel together: enough to fill registers with those that lie on
/// the same edge.
constexpr std::size_t kDerivativePiece = 512;

template <typename T>
using Derivatives = std::span<const PartialDerivative<T>>;

/// Every output by itself, then every pair of them: ok | bad_degree | null_output | bad_stride |
/// output_too_small | overlapping_outputs | size_overflow. inputs[0] is room for the list of
/// derivatives.
template <typename T, std::size_t kInputs>
Status check_derivatives(Derivatives<T> wanted, std::size_t samples, std::size_t dimension,
                         MemoryRange (&inputs)[kInputs]) noexcept {
  inputs[0] = wanted;
  if (wanted.empty() || wanted.data() == nullptr) {
    return Status::null_output;
  }
  for (const PartialDerivative<T>& d : wanted) {
    if (std::min(d.order_u, d.order_v) < 0 ||
        std::max(d.order_u, d.order_v) > kMostDerivativeOrder) {
      return Status::bad_degree;
    }
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Vectors<T>* const out = &wanted[i].out;
    Status status = check_outputs(OutputList<T>(out, nullptr), samples, dimension, inputs);
    for (std::size_t k = 0; k < i && status; ++k) {
      status = check_outputs(OutputList<T>(out, &wanted[k].out), samples, dimension, {});
    }
    if (!status) {
      return status;
    }
  }
  return Status::ok;
}

/// Polynomials need the orders asked for; quotients need all lower ones as well.
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

/// Source: fills in patches (of the set) and half-centred parameters of consecutive samples. Units
/// are pieces of samples.
template <typename T, typename Source>
class DerivativeWork {
public:
  DerivativeWork(const SetStorage<T>& set, const Source& source, std::size_t samples,
                 Derivatives<T> wanted, const Request<T>& request, const Options& options) noexcept
      : set_(set), source_(source), samples_(samples), wanted_(wanted), table_(*request.table),
        first_component_(request.components.first),
        watertight_(options.watertight), orders_{orders_of(wanted, false),
                                                 orders_of(wanted, true)} {}

  [[nodiscard]] std::size_t units() const noexcept {
    return samples_ / kDerivativePiece + (samples_ % kDerivativePiece != 0 ? 1 : 0);
  }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(samples_, 10); }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept { return sizeof(Scratch); }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* memory) const noexcept {
    Isa executed = Isa::automatic;
    Scratch& scratch = *new (memory) Scratch;
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * kDerivativePiece;
      const std::size_t count = std::min(kDerivativePiece, samples_ - first);
      source_.fill(first, count, scratch.patch, scratch.x, scratch.y);
      for_buckets(set_, scratch.patch, scratch.patch, count,
                  [&](const auto& bucket, auto at, auto last) {
                    executed = run_bucket(bucket, scratch, at, last - at, first + at);
                  });
    }
    return executed;
  }

private:
  struct Scratch {
    std::size_t patch[kDerivativePiece]; ///< of the set, then of its bucket
    T x[kDerivativePiece];
    T y[kDerivativePiece];
  };

  Isa run_bucket(const PatchStorage<T>& patches, const Scratch& scratch, std::size_t at,
                 std::size_t count, std::size_t first) const noexcept {
    DerivativeTask<T> task{};
    static_cast<PatchArrays<T>&>(task) = patches.arrays(0);
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
  Source source_;
  std::size_t samples_;
  Derivatives<T> wanted_;
  const KernelTable<T>& table_;
  std::size_t first_component_;
  bool watertight_;
  DerivativeOrders orders_[2]; ///< of polynomials, of quotients
};

template <typename T>
class SampleDerivativesCall {
public:
  SampleDerivativesCall(const PatchSet<T>& set, const Samples<T>& samples,
                        const DerivativeOutputs<T>& out, const Options& options) noexcept
      : set_(set), samples_(samples), out_(out), options_(options) {}

  Status resolve() noexcept { return request_.resolve(set_, {}, out_.first_component, options_); }
  Status check() noexcept {
    const SampleArrays<T> arrays(samples_);
    if (arrays.lengths_differ()) {
      return Status::unequal_lengths;
    }
    MemoryRange inputs[] = {{}, samples_.patch, samples_.u, samples_.v};
    const Status usable = check_derivatives(out_.derivatives, samples_.patch.size(),
                                            request_.components.dimension, inputs);
    return usable ? arrays.check(set_.size(), *request_.table) : usable;
  }
  [[nodiscard]] bool empty() const noexcept { return samples_.patch.empty(); }
  [[nodiscard]] DerivativeWork<T, SampleSource<T>> plan() const noexcept {
    return {*set_.storage(),  {samples_}, samples_.patch.size(),
            out_.derivatives, request_,   options_};
  }

private:
  const PatchSet<T>& set_;
  const Samples<T>& samples_;
  const DerivativeOutputs<T>& out_;
  const Options& options_;
  Request<T> request_;
};

template <typename T>
class GridDerivativesCall {
public:
  GridDerivativesCall(const PatchSet<T>& set, const Grid<T>& grid, const DerivativeOutputs<T>& out,
                      const Options& options) noexcept
      : set_(set), grid_(grid), out_(out), options_(options) {}

  Status resolve() noexcept {
    return request_.resolve(set_, grid_.patches, out_.first_component, options_);
  }
  Status check() noexcept {
    if (!multiply_samples(grid_.nu, grid_.nv, request_.count, samples_)) {
      return Status::size_overflow;
    }
    MemoryRange inputs[] = {{}, {grid_.u, grid_.nu * sizeof(T)}, {grid_.v, grid_.nv * sizeof(T)}};
    const Status usable =
        check_derivatives(out_.derivatives, samples_, request_.components.dimension, inputs);
    return usable ? plan_.build(grid_) : usable;
  }
  [[nodiscard]] bool empty() const noexcept { return request_.count == 0; }
  [[nodiscard]] DerivativeWork<T, GridSource<T>> plan() const noexcept {
    return {*set_.storage(), {plan_.x(), plan_.y(), grid_.nu, grid_.nv, request_.first},
            samples_,        out_.derivatives,
            request_,        options_};
  }

private:
  const PatchSet<T>& set_;
  const Grid<T>& grid_;
  const DerivativeOutputs<T>& out_;
  const Options& options_;
  Request<T> request_;
  GridPlan<T> plan_;
  std::size_t samples_ = 0;
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_derivatives(const PatchSet<T>& set, const Samples<T>& samples,
                            const std::type_identity_t<DerivativeOutputs<T>>& out,
                            const Options& options) noexcept {
  return detail::make_call(detail::SampleDerivativesCall<T>(set, samples, out, options), options);
}

template <typename T>
Status evaluate_derivatives(const PatchSet<T>& set, const Grid<T>& grid,
                            const std::type_identity_t<DerivativeOutputs<T>>& out,
                            const Options& options) noexcept {
  return detail::make_call(detail::GridDerivativesCall<T>(set, grid, out, options), options);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status evaluate_derivatives(                                             \
      const PatchSet<T>&, const Samples<T>&, const std::type_identity_t<DerivativeOutputs<T>>&,    \
      const Options&) noexcept;                                                                    \
  template SIMDBEZIER_API Status evaluate_derivatives(                                             \
      const PatchSet<T>&, const Grid<T>&, const std::type_identity_t<DerivativeOutputs<T>>&,       \
      const Options&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
