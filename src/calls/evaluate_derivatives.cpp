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

/// The arguments of a call; references to them.
template <typename T, typename Where>
struct DerivativesGiven {
  const PatchSet<T>& set;
  const Where& where;
  Derivatives<T> wanted;
  int first_component;
  const Options& options;

  DerivativesGiven(const PatchSet<T>& patches, const Where& samples,
                   const DerivativeOutputs<T>& out, const Options& how) noexcept
      : set(patches), where(samples), wanted(out.derivatives), first_component(out.first_component),
        options(how) {}

  /// Every output by itself, then every pair of them: ok | bad_degree | null_output | bad_stride |
  /// output_too_small | overlapping_outputs | size_overflow.
  [[nodiscard]] Status check(std::size_t samples, const Components& components,
                             std::span<const MemoryRange> inputs) const noexcept {
    if (wanted.empty() || wanted.data() == nullptr) {
      return Status::null_output;
    }
    for (const PartialDerivative<T>& d : wanted) {
      if (std::min(d.order_u, d.order_v) < 0 ||
          std::max(d.order_u, d.order_v) > kMostDerivativeOrder) {
        return Status::bad_degree;
      }
    }
    MemoryRange ranges[4] = {wanted}; // of inputs there are three at most
    std::copy(inputs.begin(), inputs.end(), ranges + 1);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      Status status = check_outputs(OutputList<T>(&wanted[i].out, 1), samples, components.dimension,
                                    {ranges, inputs.size() + 1});
      for (std::size_t k = 0; k < i && status; ++k) {
        const Vectors<T> both[] = {wanted[i].out, wanted[k].out};
        status = check_outputs(OutputList<T>(both, 2), samples, components.dimension, {});
      }
      if (!status) {
        return status;
      }
    }
    return Status::ok;
  }
};

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
  template <typename Where>
  DerivativeWork(const DerivativesGiven<T, Where>& in, const Request<T>& request,
                 const Source& source, std::size_t samples) noexcept
      : set_(*in.set.storage()), source_(source), samples_(samples), wanted_(in.wanted),
        table_(*request.table), first_component_(request.components.first),
        watertight_(in.options.watertight), orders_{orders_of(wanted_, false),
                                                    orders_of(wanted_, true)} {}
  DerivativeWork(const DerivativesGiven<T, Samples<T>>& in, const Request<T>& request) noexcept
      : DerivativeWork(in, request, {in.where}, in.where.patch.size()) {}

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
using SampleDerivativesCall =
    SamplesCall<T, DerivativesGiven<T, Samples<T>>, DerivativeWork<T, SampleSource<T>>>;

template <typename T>
class GridDerivativesCall : public OneGridCall<T, DerivativesGiven<T, Grid<T>>> {
public:
  using OneGridCall<T, DerivativesGiven<T, Grid<T>>>::OneGridCall;

  [[nodiscard]] DerivativeWork<T, GridSource<T>> plan() const noexcept {
    const GridPlan<T>& grid = this->plan_;
    const GridSource<T> source{grid.x(), grid.y(), grid.nu(), grid.nv(), this->request_.first};
    return {this->in_, this->request_, source, this->samples()};
  }
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
