// The call for single samples: pieces of them for the kernels.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/few_samples.hpp"
#include "src/calls/sample_pieces.hpp"
#include "src/choice/kernel_choice.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/output/delivery.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Units are pieces of samples.
template <typename T>
class SamplesWork {
public:
  SamplesWork(const Given<T, PatchSet<T>, Samples<T>>& in, const Request<T>& request) noexcept
      : kernels_(*in.set.storage(), request, in.out, in.options), samples_(in.where),
        outputs_(in.out, way_of_samples(in.options.destination)),
        pieces_(samples_.patch.size(), outputs_.staged()) {}

  [[nodiscard]] std::size_t units() const noexcept { return pieces_.count; }
  [[nodiscard]] std::size_t duration() const noexcept {
    return duration_of(samples_.patch.size(), 4);
  }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return index_bytes() + Delivery<T>::scratch_bytes(outputs_.staged_planes(),
                                                      outputs_.streaming(), pieces_.length);
  }

  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    Isa executed = Isa::automatic;
    Delivery<T> delivery(outputs_, *kernels_.table, pieces_.length,
                         scratch == nullptr ? nullptr : scratch + index_bytes());
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * pieces_.length;
      const std::size_t count = std::min(pieces_.length, samples_.patch.size() - first);
      const Planes<T>* const planes = delivery.begin(first);
      if (SampleStatus* const status = outputs_.out().status_at(first)) {
        std::fill_n(status, count, SampleStatus::regular);
      }
      const SetStorage<T>& set = *kernels_.set;
      const std::uint32_t* const patch = samples_.patch.data() + first;
      if (set.places == nullptr) {
        executed = run_bucket(set.buckets[0], patch, {first, 0, count}, planes);
      } else {
        auto* const index = reinterpret_cast<std::uint32_t*>(scratch);
        for_buckets(set, patch, index, count, [&](const auto& bucket, auto begins, auto ends) {
          executed = run_bucket(bucket, index + begins, {first, begins, ends - begins}, planes);
        });
      }
      delivery.end(count);
    }
    delivery.finish();
    return executed;
  }

private:
  /// Samples of a piece that begins with sample `first` of the call.
  struct Part {
    std::size_t first;
    std::size_t at; ///< in the piece
    std::size_t count;
  };

  /// The indices of patches in a set's buckets.
  [[nodiscard]] std::size_t index_bytes() const noexcept {
    return kernels_.set->places == nullptr ? 0
                                           : whole_lines(pieces_.length * sizeof(std::uint32_t));
  }

  /// Runs the kernel on samples of one bucket. patch: of each; planes: those of the piece. Returns
  /// the instruction set that ran.
  Isa run_bucket(const PatchStorage<T>& patches, const std::uint32_t* patch, const Part& part,
                 const Planes<T>* planes) const noexcept {
    const std::size_t sample = part.first + part.at;
    ScatteredTask<T> task{};
    static_cast<PatchArrays<T>&>(task) = patches.arrays(0);
    task.common_floor = patches.common_floor;
    task.patch = patch;
    task.u = samples_.u.data() + sample;
    task.v = samples_.v.data() + sample;
    set_half_centring(samples_.parameters, task);
    task.count = part.count;
    task.prefetch = pays_to_prefetch(patches, false);
    task.resolve_normal = resolve_normal<T>;
    task.watertight = kernels_.watertight;
    for (std::size_t g = 0; g < kVectorOutputs; ++g) {
      for (std::size_t c = 0; c < 3; ++c) {
        T* const plane = planes[g].component[c];
        task.out[g].component[c] = plane == nullptr ? nullptr : plane + part.at;
      }
    }
    for (std::size_t c = 0; c < kCurvatureKinds; ++c) {
      task.curvature[c] = outputs_.out().curvature_at(c, sample);
    }
    task.first_component = kernels_.first_component;
    task.status = outputs_.out().status_at(sample);
    kernels_.run(task);
    return task.executed;
  }

  PatchKernels<T> kernels_;
  const Samples<T>& samples_;
  OutputPlan<T> outputs_;
  SamplePieces pieces_;
};

template <typename T>
using PatchSamplesCall = SamplesCall<T, Given<T, PatchSet<T>, Samples<T>>, SamplesWork<T>>;

} // namespace
} // namespace detail

template <typename T>
Status evaluate(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
                const Options& options) noexcept {
  if (samples.patch.size() <= detail::FewSamples<T>::kMost &&
      detail::FewSamples<T>(set, samples, out, options).run()) {
    return Status::ok;
  }
  return detail::make_call(detail::PatchSamplesCall<T>(set, samples, out, options), options);
}

template SIMDBEZIER_API Status evaluate(const PatchSet<float>&, const Samples<float>&,
                                        const Outputs<float>&, const Options&) noexcept;
template SIMDBEZIER_API Status evaluate(const PatchSet<double>&, const Samples<double>&,
                                        const Outputs<double>&, const Options&) noexcept;

} // namespace simdbezier
