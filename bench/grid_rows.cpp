// grid/<outputs>/<type>/<isa>/<n>x<n>/<destination>/threads:<t>[/watertight:off]
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/baselines/baselines.hpp"
#include "bench/reference.hpp"
#include "bench/rows.hpp"
#include "bench/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

enum class Algorithm { library, de_casteljau, autovectorised };
enum class Destination { cache, memory };

constexpr std::size_t kSizes[] = {5, 8, 9, 16, 17, 32, 33};
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives};
constexpr std::size_t kCachePatches = 64;

struct GridRow {
  OutputGroups outputs;
  Algorithm algorithm;
  Isa isa; ///< of Algorithm::library only
  std::size_t n;
  Destination destination;
  int threads = 1;
  bool watertight = true;
};

template <typename T>
std::string name_of(const GridRow& row) {
  const char* const outputs[] = {"position", "position_normal", "position_derivatives"};
  const std::string n = std::to_string(row.n);
  std::string name = "grid/";
  name += outputs[static_cast<int>(row.outputs)];
  name += sizeof(T) == 4 ? "/f32/" : "/f64/";
  name += row.algorithm == Algorithm::de_casteljau     ? "de_casteljau"
          : row.algorithm == Algorithm::autovectorised ? "autovectorised"
                                                       : simdbezier::to_string(row.isa);
  name += "/" + n + "x" + n;
  name += row.destination == Destination::cache ? "/cache" : "/memory";
  name += "/threads:" + std::to_string(row.threads);
  return row.watertight ? name : name + "/watertight:off";
}

/// As many patches as fit the cache's share, or as it takes to leave every cache.
template <typename T>
std::size_t patch_count(const GridRow& row) {
  const std::size_t bytes = row.n * row.n * 3 * group_count(row.outputs) * sizeof(T);
  return row.destination == Destination::cache
             ? std::clamp<std::size_t>(kCacheBytes / bytes, 1, kCachePatches)
             : (kMemoryBytes + bytes - 1) / bytes;
}

/// Planes follow each other, each at a line's start and five lines further than it need be: planes
/// a power of two apart would compete for the same sets of a cache.
template <typename T>
void place_planes(GridJob<T>& job) {
  constexpr std::size_t kLine = kLineBytes / sizeof(T);
  const std::size_t samples = job.patches * job.n * job.n;
  const std::size_t stride = (samples + kLine - 1) / kLine * kLine + 5 * kLine;
  T* const first = reinterpret_cast<T*>(output_buffer());
  for (std::size_t k = 0; k < 3 * group_count(job.groups); ++k) {
    job.planes[k] = first + k * stride;
  }
}

/// A row made ready to run: the job, and what the library's call needs besides.
template <typename T>
class GridCall {
public:
  GridCall(const GridRow& row, const std::vector<T>& parameters) : row_(row) {
    job_.groups = row.outputs;
    job_.patches = patch_count<T>(row);
    job_.n = row.n;
    job_.parameters = parameters.data();
    place_planes(job_);
    if (row.algorithm == Algorithm::library) {
      prepare_library();
    } else {
      job_.input = row.algorithm == Algorithm::de_casteljau ? shared_nets<T>(job_.patches)
                                                            : shared_power_basis<T>(job_.patches);
      run_ = row.algorithm == Algorithm::de_casteljau ? widest_baselines<T>().de_casteljau
                                                      : widest_baselines<T>().autovectorised;
    }
  }

  void operator()() {
    if (row_.algorithm == Algorithm::library) {
      status_ = simdbezier::evaluate_grid(*set_, grid_, outputs_, options_);
    } else {
      run_(job_);
    }
  }

  /// Empty, or why the row must not be timed.
  std::string check() {
    if (row_.algorithm == Algorithm::library && set_->size() < job_.patches) {
      return "the patches could not be packed";
    }
    if (row_.algorithm != Algorithm::library && run_ == nullptr) {
      return "this machine has none of the baselines' instruction sets";
    }
    const bool interleaved = row_.algorithm == Algorithm::de_casteljau;
    poison_grid(job_, interleaved);
    Isa executed = Isa::automatic;
    options_.executed = &executed;
    (*this)();
    options_.executed = nullptr;
    if (status_ != simdbezier::Status::ok) {
      return std::string(simdbezier::to_string(status_));
    }
    if (row_.algorithm == Algorithm::library && executed != row_.isa) {
      return "another instruction set ran: " + std::string(simdbezier::to_string(executed));
    }
    return check_grid(job_, shared_nets<T>(job_.patches), interleaved);
  }

  [[nodiscard]] double samples() const {
    return static_cast<double>(job_.patches * job_.n * job_.n);
  }
  [[nodiscard]] double bytes() const {
    return samples() * static_cast<double>(3 * group_count(row_.outputs) * sizeof(T));
  }

private:
  void prepare_library() {
    set_ = &shared_patch_set<T>(job_.patches);
    grid_ = simdbezier::Grid<T>::uniform(row_.n, row_.n);
    T* const* const p = job_.planes;
    outputs_.position = simdbezier::Vectors<T>::planes(p[0], p[1], p[2]);
    if (row_.outputs == OutputGroups::position_normal) {
      outputs_.normal = simdbezier::Vectors<T>::planes(p[3], p[4], p[5]);
    } else if (row_.outputs == OutputGroups::position_derivatives) {
      outputs_.du = simdbezier::Vectors<T>::planes(p[3], p[4], p[5]);
      outputs_.dv = simdbezier::Vectors<T>::planes(p[6], p[7], p[8]);
    }
    options_.threads = row_.threads;
    options_.watertight = row_.watertight;
    options_.isa = row_.isa;
    options_.patch_count = job_.patches;
  }

  GridRow row_;
  GridJob<T> job_;
  void (*run_)(const GridJob<T>&) = nullptr;
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::Grid<T> grid_;
  simdbezier::Outputs<T> outputs_;
  simdbezier::Options options_;
  simdbezier::Status status_ = simdbezier::Status::ok;
};

template <typename T>
void register_row(const GridRow& row) {
  const auto checked = std::make_shared<bool>(false); // once a process, not once a repetition
  auto run = [row, checked](benchmark::State& state) {
    if (output_buffer() == nullptr) {
      return fail_row(state, "no memory for the output");
    }
    const std::vector<T> parameters = uniform_parameters<T>(row.n);
    GridCall<T> call(row, parameters);
    if (!*checked) {
      const std::string failure = call.check();
      if (!failure.empty()) {
        return fail_row(state, failure);
      }
      *checked = true;
    }
    time_calls(state, row.threads, call.samples(), call.bytes(), [&call] { call(); });
  };
  const bool cache = row.destination == Destination::cache;
  benchmark::RegisterBenchmark(name_of<T>(row).c_str(), run)
      ->Unit(cache ? benchmark::kMicrosecond : benchmark::kMillisecond);
}

template <typename T>
void register_size(OutputGroups outputs, std::size_t n) {
  const auto isas = simdbezier::available_isas();
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    for (const Algorithm baseline : {Algorithm::de_casteljau, Algorithm::autovectorised}) {
      register_row<T>({outputs, baseline, Isa::automatic, n, destination});
    }
    const int most = destination == Destination::cache ? 1 : max_threads();
    for (const Isa isa : isas) {
      for (int threads = 1; threads <= most; ++threads) {
        register_row<T>({outputs, Algorithm::library, isa, n, destination, threads});
      }
    }
  }
  if (n >= 8) { // smaller grids are nearly all boundary
    register_row<T>({outputs, Algorithm::library, isas.back(), n, Destination::cache, 1, false});
  }
}

template <typename T>
void register_type() {
  for (const OutputGroups outputs : kOutputs) {
    for (const std::size_t n : kSizes) {
      register_size<T>(outputs, n);
    }
  }
}

} // namespace

void register_grid_rows() {
  register_type<float>();
  register_type<double>();
}

} // namespace simdbezier_bench
