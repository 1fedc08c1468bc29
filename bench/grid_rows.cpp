// grid/<outputs>/<type>/<isa>/<nu>x<nv>/<destination>/threads:<t>[/<key>:<value>…]
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/baselines/baselines.hpp"
#include "bench/library_call.hpp"
#include "bench/place.hpp"
#include "bench/reference.hpp"
#include "bench/rows.hpp"
#include "bench/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

enum class Algorithm { library, de_casteljau, autovectorised };

struct Size {
  std::size_t nu;
  std::size_t nv;
};
constexpr Size kSizes[] = {{4, 4},   {5, 5},   {8, 8},   {9, 9},   {16, 16}, {17, 17}, {24, 24},
                           {32, 32}, {33, 33}, {64, 64}, {65, 65}, {16, 9},  {7, 33}};
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives,
                                     OutputGroups::second_derivatives};
constexpr std::size_t kLargestSwept = 65;

struct GridRow {
  OutputGroups outputs;
  Algorithm algorithm;
  Isa isa; ///< of Algorithm::library only
  Size size;
  Place place;
  int threads = 1;
  Layout layout = Layout::planes;
  bool watertight = true;
  bool aligned = true; ///< false: planes begin 1, 2, 3… elements behind a line's start
  bool plain = false;  ///< plain stores, wherever the output ends
};

template <typename T>
std::string name_of(const GridRow& row) {
  RowName name{"grid", row.outputs, sizeof(T) == 4};
  name.who = row.algorithm == Algorithm::de_casteljau     ? "de_casteljau"
             : row.algorithm == Algorithm::autovectorised ? "autovectorised"
                                                          : simdbezier::to_string(row.isa);
  name.nu = row.size.nu;
  name.nv = row.size.nv;
  name.place = row.place;
  name.threads = row.threads;
  std::string text = name.text();
  text += row.layout == Layout::triples    ? "/layout:aos"
          : row.layout == Layout::vertices ? "/layout:interleaved"
                                           : "";
  text += row.watertight ? "" : "/watertight:off";
  text += row.aligned ? "" : "/align:" + std::to_string(sizeof(T));
  return row.plain ? text + "/stores:plain" : text;
}

/// As many patches as fit the cache's share, or as it takes to leave every cache.
template <typename T>
std::size_t patch_count(const GridRow& row) {
  const std::size_t bytes = row.size.nu * row.size.nv * 3 * group_count(row.outputs) * sizeof(T);
  return row.place == Place::cache ? cached_patches(bytes) : (kMemoryBytes + bytes - 1) / bytes;
}

/// A row made ready to run: the job, and what the library's call needs besides.
template <typename T>
class GridCall {
public:
  explicit GridCall(const GridRow& row)
      : row_(row), u_(uniform_parameters<T>(row.size.nu)), v_(uniform_parameters<T>(row.size.nv)) {
    job_.patches = patch_count<T>(row);
    job_.nu = row.size.nu;
    job_.nv = row.size.nv;
    job_.u = u_.data();
    job_.v = v_.data();
    const Layout layout = row.algorithm == Algorithm::de_casteljau ? Layout::triples : row.layout;
    job_.out = place_results<T>(row.outputs, job_.patches * job_.nu * job_.nv, layout, row.aligned);
    const Baselines<T> baselines = widest_baselines<T>();
    switch (row.algorithm) {
    case Algorithm::library:
      set_ = &shared_patch_set<T>(job_.patches);
      outputs_ = library_outputs(job_.out);
      options_.threads = row.threads;
      options_.watertight = row.watertight;
      options_.isa = row.isa;
      options_.patch_count = job_.patches;
      if (row.plain) {
        options_.destination = simdbezier::Destination::cache;
      }
      break;
    case Algorithm::de_casteljau:
      job_.input = shared_nets<T>(job_.patches);
      run_ = baselines.de_casteljau;
      break;
    case Algorithm::autovectorised:
      job_.input = shared_power_basis<T>(job_.patches);
      run_ = baselines.autovectorised;
      break;
    }
  }

  void operator()() {
    if (row_.algorithm == Algorithm::library) {
      (void)evaluate(options_);
    } else {
      run_(job_);
    }
  }

  std::string check() {
    poison_grid(job_);
    std::string failure;
    if (row_.algorithm == Algorithm::library) {
      failure = run_verified(*set_, job_.patches, options_,
                             [this](const auto& options) { return evaluate(options); });
    } else if (run_ == nullptr) {
      failure = "this machine has none of the baselines' instruction sets";
    } else {
      run_(job_);
    }
    return failure.empty() ? check_grid(job_, shared_nets<T>(job_.patches)) : failure;
  }

  [[nodiscard]] double items() const {
    return static_cast<double>(job_.patches * job_.nu * job_.nv);
  }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * group_count(row_.outputs) * sizeof(T));
  }

private:
  simdbezier::Status evaluate(const simdbezier::Options& options) const {
    return simdbezier::evaluate_grid(*set_, simdbezier::Grid<T>::uniform(job_.nu, job_.nv),
                                     outputs_, options);
  }

  GridRow row_;
  std::vector<T> u_;
  std::vector<T> v_;
  GridJob<T> job_;
  void (*run_)(const GridJob<T>&) = nullptr;
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::Outputs<T> outputs_;
  simdbezier::Options options_;
};

template <typename T>
void add(const GridRow& row) {
  const bool cache = row.place == Place::cache;
  register_row(name_of<T>(row), cache ? benchmark::kMicrosecond : benchmark::kMillisecond,
               row.threads, [row] { return GridCall<T>(row); });
}

template <typename T>
void add_library(OutputGroups outputs, Isa isa, Size size, Place place) {
  const int most = place == Place::cache ? 1 : max_threads();
  for (int threads = 1; threads <= most; ++threads) {
    add<T>({outputs, Algorithm::library, isa, size, place, threads});
  }
}

/// What only the widest instructions set and AVX2 show: other layouts.
template <typename T>
void add_layouts(OutputGroups outputs, Isa isa, Size size, Place place) {
  for (const Layout layout : {Layout::triples, Layout::vertices}) {
    if (layout == Layout::vertices && group_count(outputs) == 1) {
      continue; // the same as triples
    }
    const int most = place == Place::cache ? 1 : max_threads();
    for (int threads = 1; threads <= most; ++threads) {
      add<T>({outputs, Algorithm::library, isa, size, place, threads, layout});
    }
  }
}

template <typename T>
void add_size(OutputGroups outputs, Size size) {
  const auto isas = simdbezier::available_isas();
  const Isa widest = isas.back();
  for (const Place place : {Place::cache, Place::memory}) {
    for (const Algorithm baseline : {Algorithm::de_casteljau, Algorithm::autovectorised}) {
      add<T>({outputs, baseline, Isa::automatic, size, place});
    }
    for (const Isa isa : isas) {
      add_library<T>(outputs, isa, size, place);
      if (isa == widest || isa == Isa::avx2) {
        add_layouts<T>(outputs, isa, size, place);
      }
    }
  }
  GridRow row{outputs, Algorithm::library, widest, size, Place::cache};
  if (size.nu >= 8 && size.nv >= 8) { // smaller grids are nearly all boundary
    row.watertight = false;
    add<T>(row);
    row.watertight = true;
  }
  row.place = Place::memory;
  row.aligned = false;
  add<T>(row);
  if (size.nu == size.nv && (size.nu == 16 || size.nu == 32)) {
    row.aligned = true;
    row.plain = true;
    add<T>(row);
  }
}

/// Every size in cache, for the plot of speed against size.
template <typename T>
void add_sweep(OutputGroups outputs) {
  for (std::size_t n = 2; n <= kLargestSwept; ++n) {
    const Size size{n, n};
    const bool registered = std::any_of(std::begin(kSizes), std::end(kSizes),
                                        [n](Size known) { return known.nu == n && known.nv == n; });
    if (registered) {
      continue;
    }
    for (const Algorithm baseline : {Algorithm::de_casteljau, Algorithm::autovectorised}) {
      add<T>({outputs, baseline, Isa::automatic, size, Place::cache});
    }
    for (const Isa isa : simdbezier::available_isas()) {
      add_library<T>(outputs, isa, size, Place::cache);
    }
  }
}

template <typename T>
void add_type() {
  const char* const sweep = std::getenv("SIMDBEZIER_BENCH_SWEEP");
  for (const OutputGroups outputs : kOutputs) {
    for (const Size size : kSizes) {
      add_size<T>(outputs, size);
    }
    if (sweep != nullptr && *sweep != '\0' && *sweep != '0') {
      add_sweep<T>(outputs);
    }
  }
}

} // namespace

void register_grid_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
