// The call for single samples: pieces of them for the kernels.
#include <algorithm>

#include <simdbezier/evaluate.hpp>

#include "src/calls/call.hpp"
#include "src/calls/few_samples.hpp"
#include "src/calls/sample_evaluator.hpp"
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
    const SampleEvaluator<T> evaluator(kernels_, scratch);
    Delivery<T> delivery(outputs_, *kernels_.table, pieces_.length,
                         scratch == nullptr ? nullptr : scratch + index_bytes());
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * pieces_.length;
      const std::size_t count = std::min(pieces_.length, samples_.patch.size() - first);
      SampleTarget<T> to{delivery.begin(first), outputs_.out().status_at(first)};
      if (to.status != nullptr) {
        std::fill_n(to.status, count, SampleStatus::regular);
      }
      for (std::size_t c = 0; c < kCurvatureKinds; ++c) {
        to.curvature[c] = outputs_.out().curvature_at(c, first);
      }
      executed = evaluator.run({samples_.patch.data() + first, samples_.u.data() + first,
                                samples_.v.data() + first, count, samples_.parameters},
                               to);
      delivery.end(count);
    }
    delivery.finish();
    return executed;
  }

private:
  [[nodiscard]] std::size_t index_bytes() const noexcept {
    return SampleEvaluator<T>::scratch_bytes(*kernels_.set, pieces_.length);
  }

  PatchKernels<T> kernels_;
  const Samples<T>& samples_;
  OutputPlan<T> outputs_;
  SamplePieces pieces_;
};

template <typename T>
using PatchSamplesCall = SamplesCall<T, PatchSet, Samples<T>, SamplesWork<T>>;

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
