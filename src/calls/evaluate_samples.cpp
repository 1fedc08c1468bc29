// The call for single samples: pieces of them for the kernels.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/kernel_choice.hpp"
#include "src/calls/sample_pieces.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/output/delivery.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are pieces of samples.
template <typename T>
class SamplesWork {
public:
  SamplesWork(const SetStorage<T>& set, const Request<T>& request, const Samples<T>& samples,
              const OutputList<T>& out, const Options& options) noexcept
      : kernels_(set, request, out, options), samples_(samples),
        outputs_(out, samples.patch.size(), sample_destination(options.destination)),
        pieces_(samples.patch.size(), outputs_.staged()) {}

  [[nodiscard]] std::size_t units() const noexcept { return pieces_.count; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return index_bytes() + Delivery<T>::scratch_bytes(outputs_.staged_planes(),
                                                      outputs_.streaming(), pieces_.length);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    auto* const index = reinterpret_cast<std::uint32_t*>(scratch);
    Delivery<T> delivery(outputs_, *kernels_.table, pieces_.length,
                         scratch == nullptr ? nullptr : scratch + index_bytes());
    const SetStorage<T>& set = *kernels_.set;
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * pieces_.length;
      const std::size_t count = std::min(pieces_.length, samples_.patch.size() - first);
      if (SampleStatus* const status = outputs_.out().status_at(first); status != nullptr) {
        std::fill_n(status, count, SampleStatus::regular);
      }
      const Planes<T>* const planes = delivery.begin(first);
      executed = set.places == nullptr ? run_bucket(set.buckets[0], samples_.patch.data() + first,
                                                    first, count, planes, 0)
                                       : run_mixed(first, count, planes, index);
      delivery.end(count);
    }
    delivery.finish();
    return executed;
  }

private:
  /// Room for the indices of a piece's patches in their buckets.
  [[nodiscard]] std::size_t index_bytes() const noexcept {
    return kernels_.set->places == nullptr ? 0
                                           : whole_lines(pieces_.length * sizeof(std::uint32_t));
  }

  /// Consecutive samples on patches of one shape go to a kernel together.
  Isa run_mixed(std::size_t first, std::size_t count, const Planes<T>* planes,
                std::uint32_t* index) const noexcept {
    Isa executed = Isa::automatic;
    const SetStorage<T>& set = *kernels_.set;
    for (std::size_t k = 0; k < count;) {
      const std::uint32_t bucket = set.places[samples_.patch[first + k]].bucket;
      std::size_t last = k;
      for (; last < count; ++last) {
        const PatchPlace place = set.places[samples_.patch[first + last]];
        if (place.bucket != bucket) {
          break;
        }
        index[last] = static_cast<std::uint32_t>(place.index);
      }
      executed = run_bucket(set.buckets[bucket], index + k, first + k, last - k, planes, k);
      k = last;
    }
    return executed;
  }

  /// Samples [first, first + count) of the call on the bucket's patches `patch`; their results go
  /// to the planes from `at` on.
  Isa run_bucket(const PatchStorage<T>& patches, const std::uint32_t* patch, std::size_t first,
                 std::size_t count, const Planes<T>* planes, std::size_t at) const noexcept {
    ScatteredTask<T> task{};
    task.shape = &patches.shape;
    task.coefficients = patches.coefficients;
    task.edges = patches.edges;
    task.given = patches.given;
    task.origins = patches.origins;
    task.normal_floor = patches.normal_floor;
    task.common_floor = patches.common_floor;
    task.patch = patch;
    task.u = samples_.u.data() + first;
    task.v = samples_.v.data() + first;
    set_half_centring(samples_.parameters, task);
    task.count = count;
    task.patches_known = kernels_.set->places == nullptr ? samples_.patch.size() - first : count;
    task.prefetch = patches.count > second_level_cache() / (kCoefficients * sizeof(T));
    task.resolve_normal = resolve_normal<T>;
    task.watertight = kernels_.watertight;
    for (std::size_t g = 0; g < kGroups; ++g) {
      for (std::size_t c = 0; c < 3; ++c) {
        T* const plane = planes[g].component[c];
        task.out[g].component[c] = plane == nullptr ? nullptr : plane + at;
      }
    }
    for (std::size_t c = 0; c < kCurvatures; ++c) {
      task.curvature[c] = outputs_.out().curvature_at(c, first);
    }
    task.first_component = kernels_.first_component;
    task.status = outputs_.out().status_at(first);
    kernels_.run(task);
    return task.executed;
  }

  PatchKernels<T> kernels_;
  const Samples<T>& samples_;
  OutputPlan<T> outputs_;
  SamplePieces pieces_;
};

template <typename T>
class SamplesCall {
public:
  SamplesCall(const PatchSet<T>& set, const Samples<T>& where, const Outputs<T>& out,
              const Options& options) noexcept
      : in_(set, where, out, options) {}

  Status resolve() noexcept {
    return request_.resolve(in_.set, {}, in_.first_component, in_.options);
  }
  Status check() noexcept {
    if (lengths_differ(in_.where)) {
      return Status::unequal_lengths;
    }
    const MemoryRange inputs[] = {in_.where.patch, in_.where.u, in_.where.v};
    const Status usable =
        check_patch_outputs(in_.out, in_.where.patch.size(), request_.components, inputs);
    return usable ? check_samples(in_.set, in_.where, *request_.table) : usable;
  }
  [[nodiscard]] bool empty() const noexcept { return in_.where.patch.empty(); }
  [[nodiscard]] SamplesWork<T> plan() const noexcept {
    return {*in_.set.storage(), request_, in_.where, in_.out, in_.options};
  }

private:
  Given<T, PatchSet<T>, Samples<T>> in_;
  Request<T> request_;
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
                const Options& options) noexcept {
  return detail::make_call(detail::SamplesCall<T>(set, samples, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const PatchSet<float>&, const Samples<float>&,
                                        const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const PatchSet<double>&, const Samples<double>&,
                                        const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
