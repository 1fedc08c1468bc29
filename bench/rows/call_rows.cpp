// call/<outputs>/f64/<isa>/<n>x1/cache/threads:1: calls of one sample and of eight, on any of 64
// bicubic patches, as closest points and scripts make them. Items are samples.
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/place.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using simdbezier::Samples;

class CallRow {
public:
  static constexpr std::size_t kPatches = 64;

  CallRow(OutputGroups outputs, std::size_t samples, Isa isa) : samples_(samples) {
    std::vector<double> nets(48 * kPatches);
    for (std::size_t k = 0; k < nets.size(); ++k) {
      nets[k] = static_cast<double>(k * k % 251) / 251;
    }
    status_ =
        pack(simdbezier::ControlNets<double>::packed(nets.data(), kPatches, 3, 3), set_).status;
    for (std::size_t k = 0; k < kCalls + samples; ++k) {
      patch_.push_back(static_cast<std::uint32_t>(k * 37 % kPatches));
      u_.push_back(static_cast<double>(k * 13 % 97) / 97);
      v_.push_back(static_cast<double>(k * 29 % 89) / 89);
    }
    out_ = library_outputs(place_results<double>(outputs, samples, Layout::planes));
    options_.isa = isa;
    options_.threads = 1;
  }
  void operator()() {
    for (std::size_t k = 0; k < kCalls; ++k) {
      (void)call(k);
    }
  }
  std::string check() {
    status_ = status_ ? call(0) : status_;
    return std::string(status_ ? "" : simdbezier::to_string(status_));
  }
  [[nodiscard]] double items() const { return static_cast<double>(kCalls * samples_); }
  [[nodiscard]] double bytes() const { return 0; }

private:
  static constexpr std::size_t kCalls = 512;

  simdbezier::Status call(std::size_t k) {
    const auto part = [&](const auto& values) { return std::span(values).subspan(k, samples_); };
    return evaluate(set_, Samples<double>{part(patch_), part(u_), part(v_)}, out_, options_);
  }

  std::size_t samples_;
  simdbezier::PatchSet<double> set_;
  std::vector<std::uint32_t> patch_;
  std::vector<double> u_;
  std::vector<double> v_;
  simdbezier::Outputs<double> out_;
  simdbezier::Options options_;
  simdbezier::Status status_;
};

} // namespace

void register_call_rows() {
  for (const Isa isa : simdbezier::available_isas()) {
    for (const OutputGroups outputs : {OutputGroups::position, OutputGroups::position_derivatives,
                                       OutputGroups::position_normal}) {
      for (const std::size_t samples : {std::size_t{1}, std::size_t{8}}) {
        const RowName name{"call",
                           outputs,
                           false,
                           std::string(simdbezier::to_string(isa)),
                           samples,
                           1,
                           MemoryLevel::cache,
                           1};
        register_row(name.text(), benchmark::kNanosecond, 1,
                     [=] { return CallRow(outputs, samples, isa); });
      }
    }
  }
}

} // namespace simdbezier_bench
