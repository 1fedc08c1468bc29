// grid/<outputs>/<type>/<peer>/16x16/cache/threads:1: the peer stands in place of an instruction
// set.
#include <string>
#include <string_view>
#include <vector>

#include <simdbezier/options.hpp>

#include "bench/peers/peers.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"
#include "simdbezier_bench/isa_list.hpp"

namespace simdbezier_bench {

#if defined(SIMDBEZIER_BENCH_WITH_EIGEN)
SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_DECLARE_EIGEN)
#endif

namespace {

constexpr std::size_t kSize = 16;

template <typename T>
class TimedPeer {
public:
  TimedPeer(PreparePeer<T> prepare, OutputGroups outputs, Layout layout)
      : parameters_(uniform_parameters<T>(kSize)) {
    job_.patches = cached_patches(kSize * kSize * 3 * group_count(outputs) * sizeof(T));
    job_.nu = job_.nv = kSize;
    job_.u = job_.v = parameters_.data();
    job_.input = shared_nets<T>(job_.patches);
    job_.out = place_results<T>(outputs, job_.patches * kSize * kSize, layout);
    call_ = prepare(job_, job_.input);
  }

  void operator()() { call_(); }

  std::string check() {
    poison_grid(job_);
    call_();
    return check_grid(job_, job_.input);
  }

  [[nodiscard]] double items() const { return static_cast<double>(job_.patches * kSize * kSize); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * group_count(job_.out.groups) * sizeof(T));
  }

private:
  std::vector<T> parameters_;
  GridJob<T> job_;
  std::function<void()> call_;
};

template <typename T>
[[maybe_unused]] void add(const char* peer, PreparePeer<T> prepare, Layout layout) {
  for (const OutputGroups outputs : {OutputGroups::position, OutputGroups::position_derivatives}) {
    const RowName name{"grid", outputs, sizeof(T) == 4, peer, kSize, kSize, MemoryLevel::cache, 1};
    register_row(name.text(), benchmark::kMicrosecond, 1,
                 [prepare, outputs, layout] { return TimedPeer<T>(prepare, outputs, layout); });
  }
}

#if defined(SIMDBEZIER_BENCH_WITH_EIGEN)
template <typename T>
std::function<void()> prepare_eigen(const GridJob<T>& job, const T*) {
  void (*run)(const GridJob<T>&) = nullptr;
  for (const simdbezier::Isa isa : simdbezier::available_isas()) { // narrowest first
    const std::string_view name = simdbezier::to_string(isa);
#define SIMDBEZIER_BENCH_TAKE(isa_name)                                                            \
  if (name == #isa_name) {                                                                         \
    run = isa_name::eigen;                                                                         \
  }
    SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_TAKE)
#undef SIMDBEZIER_BENCH_TAKE
  }
  return [run, job] { run(job); };
}
#endif

} // namespace

void register_peer_rows() {
#if defined(SIMDBEZIER_BENCH_WITH_EIGEN)
  add<float>("eigen", prepare_eigen<float>, Layout::planes);
  add<double>("eigen", prepare_eigen<double>, Layout::planes);
#endif
#if defined(SIMDBEZIER_BENCH_WITH_OPENSUBDIV)
  add<float>("opensubdiv", prepare_opensubdiv, Layout::triples);
#endif
#if defined(SIMDBEZIER_BENCH_WITH_OPENCASCADE)
  add<double>("opencascade", prepare_opencascade, Layout::triples);
#endif
#if defined(SIMDBEZIER_BENCH_WITH_SISL)
  add<double>("sisl", prepare_sisl, Layout::triples);
#endif
}

} // namespace simdbezier_bench
