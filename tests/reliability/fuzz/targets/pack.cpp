// pack(): any strides, instruction sets and numbers of threads give the same set; descriptions that
// make no sense are refused and leave the set as it was.
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/hostile.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/scene.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {
namespace {

/// Samples at and off the edges of every patch.
template <typename T>
struct SampleList {
  explicit SampleList(std::size_t patches) {
    constexpr T kParameters[] = {T(-1), T(-0.75), T(0), T(0.3), T(1)};
    for (std::size_t k = 0; k < patches * 25; k += 3) {
      patch.push_back(static_cast<std::uint32_t>(k / 25));
      x.push_back(kParameters[k % 5]);
      y.push_back(kParameters[k / 5 % 5]);
    }
  }
  [[nodiscard]] Samples<T> view() const { return {patch, x, y, Parameters::centred}; }
  std::vector<std::uint32_t> patch;
  std::vector<T> x;
  std::vector<T> y;
};

/// What evaluation shows of a set: all components of positions and first derivatives.
template <typename T>
std::vector<T> appearance(const PatchSet<T>& set) {
  const SampleList<T> samples(set.size());
  const std::size_t count = samples.patch.size();
  std::vector<T> seen;
  tests::CallOptions options;
  options.threads = 1;
  for (int c = 0; c < set.components(); c += 3) {
    options.first_component = c;
    const int dimension = std::min(set.components() - c, 3);
    std::vector<T> values(9 * count);
    T* next = values.data();
    Outputs<T> out;
    for (Vectors<T>* const group : {&out.position, &out.du, &out.dv}) {
      *group = {next, dimension > 1 ? next + count : nullptr,
                dimension > 2 ? next + 2 * count : nullptr, 1};
      next += 3 * count;
    }
    require_status(evaluate(set, samples.view(), out, options), {Status::ok}, "evaluate, samples");
    seen.insert(seen.end(), values.begin(), values.end());
  }
  return seen;
}

template <typename T, typename S>
class PackCase {
public:
  explicit PackCase(ByteSource& bytes)
      : bytes_(bytes), options_(pack_options(bytes)),
        nets_(any_nets<S>(bytes, 20, components(bytes))) {}

  void run() {
    PatchSet<T> expected;
    const Report report = pack(nets_.view(), expected, options_);
    require_packed(report, nets_.moderate);
    same_however_given(expected, report);
    hostile(expected);
  }

private:
  [[nodiscard]] PackOptions on(Isa isa, int threads) const {
    PackOptions options = options_;
    options.isa = isa;
    options.threads = threads;
    return options;
  }

  void require_same(const Report& report, const PatchSet<T>& set, const Report& expected,
                    const PatchSet<T>& expected_set) {
    require(report.status == expected.status && report.item == expected.item &&
                report.point == expected.point && report.component == expected.component,
            "pack reports something else");
    if (report) {
      require_equal(appearance(set), appearance(expected_set), "a set has other bits");
    }
  }

  /// Strides, instruction sets and threads.
  void same_however_given(const PatchSet<T>& expected, const Report& report) {
    const Arrangement arrangement(bytes_);
    StridedNets<S> strided(nets_, arrangement, placement(bytes_));
    strided.fill(nets_.values);
    for (const Isa isa : available_isas()) {
      PatchSet<T> set;
      const ControlNets<S> view = strided.view();
      const Report again = pack(view, set, on(isa, isa == Isa::avx2 ? 2 : 1));
      require_same(again, set, report, expected);
    }
  }

  void hostile(const PatchSet<T>& before) {
    const std::size_t size = nets_.values.size();
    const Block<S> block(size, placement(bytes_));
    std::ranges::copy(nets_.values, block.data());
    ControlNets<S> nets = nets_.view();
    nets.points = block.data() + (bytes_.rarely(64) ? bytes_.below(size) : 0);
    nets.memory = block.span();
    spoil(bytes_, nets);
    PackOptions options = options_;
    options.threads = static_cast<int>(bytes_.below(3));
    const Verdict verdict = verdict_on(nets);
    PatchSet<T> set = before;
    const Report report = pack(nets, set, options);
    require(verdict != Verdict::refused || !report, "pack takes nets that make no sense");
    require(verdict != Verdict::overflow || report.status == Status::size_overflow,
            "pack takes strides that overflow");
    require(report || set.storage() == before.storage(), "a failed pack has changed the set");
    if (report && nets.count > 0) {
      check_copy(nets, set, options);
    }
  }

  /// The set is that of the same values packed.
  void check_copy(const ControlNets<S>& nets, const PatchSet<T>& set, const PackOptions& options) {
    Nets<S> copy{nets.degree_u, nets.degree_v, nets.components, nets.weights, nets.count, true, {}};
    for (std::size_t k = 0; k < nets.count * copy.values_per_patch(); ++k) {
      const auto c = static_cast<std::ptrdiff_t>(k % copy.channels());
      const auto point = static_cast<std::ptrdiff_t>(k / copy.channels() % copy.points());
      const auto patch = static_cast<std::ptrdiff_t>(k / copy.values_per_patch());
      copy.values.push_back(
          nets.points[patch * nets.patch_stride + point / (nets.degree_u + 1) * nets.row_stride +
                      point % (nets.degree_u + 1) * nets.point_stride + c * nets.component_stride]);
    }
    PatchSet<T> again;
    const Report report = pack(copy.view(), again, options);
    require_same(Report{}, set, report, again);
  }

  ByteSource& bytes_;
  PackOptions options_;
  Nets<S> nets_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_mixed_case<simdbezier::fuzz::PackCase>(data, size);
}
