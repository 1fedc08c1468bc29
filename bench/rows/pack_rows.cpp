// pack/position/<type>/<isa>/4x4/<destination>/threads:1: from control points to a PatchSet.
#include <string>

#include <simdbezier/simdbezier.hpp>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

constexpr std::size_t kCached = 256;     ///< nets and set: 160 KB in float, 320 KB in double
constexpr std::size_t kMemory = 300'000; ///< 190 and 380 MB

/// Whether packing can be told an instruction set, which rows then name.
template <typename Options>
constexpr bool kTakesIsa = requires(Options options) {
  options.isa;
};

template <typename Options>
void ask_for(Options& options, Isa isa) {
  if constexpr (kTakesIsa<Options>) {
    options.isa = isa;
  }
}

/// Keeps freed memory in the process. Otherwise a set of 300 000 patches would come from the system
/// and go back there every time, and the row would measure page faults.
void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

void free_memory_as_usual() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 65536);
  mallopt(M_TRIM_THRESHOLD, 1 << 25);
  malloc_trim(0);
#endif
}

template <typename T>
class TimedPack {
public:
  TimedPack(Isa isa, std::size_t patches) : isa_(isa), patches_(patches) {
    nets_.points = shared_nets<T>(patches);
    nets_.count = patches;
    ask_for(options_, isa);
    keep_freed_memory();
    // Pages of the first sets come from the system. A few sets later, freed blocks are used again.
    for (int k = 0; k < 4; ++k) {
      (*this)();
    }
  }
  TimedPack(const TimedPack&) = delete;
  TimedPack& operator=(const TimedPack&) = delete;
  ~TimedPack() {
    set_ = {};
    free_memory_as_usual();
  }

  void operator()() {
    set_ = {}; // frees memory for the next set
    (void)simdbezier::pack(nets_, set_, options_);
  }

  /// A set is opaque, so the positions of a small grid are compared, which determine the patch.
  std::string check() {
    set_ = {};
    if (const simdbezier::Report report = simdbezier::pack(nets_, set_, options_); !report) {
      return std::string(simdbezier::to_string(report.status));
    }
    constexpr std::size_t kSize = 4;
    GridJob<T> job;
    job.patches = patches_;
    job.nu = job.nv = kSize;
    job.out = place_results<T>(OutputGroups::position, patches_ * kSize * kSize, Layout::planes);
    poison_grid(job);
    simdbezier::Options options;
    options.threads = 1;
    options.isa = isa_;
    const std::string failure = run_verified(options, [&](const auto& verified) {
      return simdbezier::evaluate(set_, simdbezier::Grid<T>::uniform(kSize, kSize),
                                  library_outputs(job.out), verified);
    });
    return failure.empty() ? check_grid(job, shared_nets<T>(patches_)) : failure;
  }

  [[nodiscard]] double items() const { return static_cast<double>(patches_); }
  [[nodiscard]] double bytes() const { return 0; }

private:
  Isa isa_;
  std::size_t patches_;
  simdbezier::ControlNets<T> nets_;
  simdbezier::PackOptions options_;
  simdbezier::PatchSet<T> set_;
};

template <typename T>
void add_type() {
  constexpr bool kEach = kTakesIsa<simdbezier::PackOptions>;
  Isa chosen = Isa::automatic;
  const bool known = simdbezier::resolve_isa(Isa::automatic, chosen) == simdbezier::Status::ok;
  for (const Isa isa : simdbezier::available_isas()) {
    if (!kEach && !(known && isa == chosen)) {
      continue;
    }
    for (const MemoryLevel level : {MemoryLevel::cache, MemoryLevel::memory}) {
      const RowName name{"pack",
                         OutputGroups::position,
                         sizeof(T) == 4,
                         std::string(simdbezier::to_string(isa)),
                         4,
                         4,
                         level,
                         1};
      const std::size_t patches = level == MemoryLevel::cache ? kCached : kMemory;
      register_row(name.text(),
                   level == MemoryLevel::cache ? benchmark::kMicrosecond : benchmark::kMillisecond,
                   1, [isa, patches] { return TimedPack<T>(isa, patches); });
    }
  }
}

} // namespace

void register_pack_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
