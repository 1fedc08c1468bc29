// One row of grids: its name, its data, its call and its check.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/baselines/baselines.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/library_or_baseline.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {

enum class Algorithm { library, de_casteljau, autovectorised };

struct Size {
  std::size_t nu;
  std::size_t nv;
};

constexpr std::size_t kLargestSwept = 65;

/// Squares of every size, for the plot of speed against size, without those that have rows anyway.
/// None unless SIMDBEZIER_BENCH_SWEEP is set.
inline std::vector<Size> swept_beside(std::span<const Size> known) {
  std::vector<Size> sizes;
  const char* const sweep = std::getenv("SIMDBEZIER_BENCH_SWEEP");
  const bool wanted = sweep != nullptr && *sweep != '\0' && *sweep != '0';
  for (std::size_t n = 2; wanted && n <= kLargestSwept; ++n) {
    if (std::none_of(known.begin(), known.end(),
                     [n](Size size) { return size.nu == n && size.nv == n; })) {
      sizes.push_back({n, n});
    }
  }
  return sizes;
}

struct GridRow {
  OutputGroups outputs;
  Algorithm algorithm;
  simdbezier::Isa isa; ///< for Algorithm::library only
  Size size;
  MemoryLevel level;
  int threads = 1;
  Layout layout = Layout::planes;
  bool watertight = true;
  bool aligned = true;   ///< false where planes begin 1, 2, 3… elements behind a line's start
  bool plain = false;    ///< plain stores, wherever the output ends
  BatchShape shape = {}; ///< bicubic for the baselines
};

template <typename T>
std::string grid_row_name(const GridRow& row) {
  RowName name{"grid", row.outputs, sizeof(T) == 4};
  name.who = row.algorithm == Algorithm::de_casteljau     ? "de_casteljau"
             : row.algorithm == Algorithm::autovectorised ? "autovectorised"
                                                          : simdbezier::to_string(row.isa);
  name.nu = row.size.nu;
  name.nv = row.size.nv;
  name.level = row.level;
  name.threads = row.threads;
  std::string text = name.text();
  text += row.layout == Layout::triples    ? "/layout:aos"
          : row.layout == Layout::vertices ? "/layout:interleaved"
                                           : "";
  text += row.watertight ? "" : "/watertight:off";
  text += row.aligned ? "" : "/align:" + std::to_string(sizeof(T));
  text += row.plain ? "/stores:plain" : "";
  return text + shape_parts(row.shape);
}

/// Returns how many patches fit the cache's share, or leave every cache.
template <typename T>
std::size_t grid_patch_count(const GridRow& row) {
  const std::size_t bytes = row.size.nu * row.size.nv * value_count(row.outputs) * sizeof(T);
  return row.level == MemoryLevel::cache ? cached_patches(bytes)
                                         : (kMemoryBytes + bytes - 1) / bytes;
}

/// A grid row that is ready to run: the job, and what the library's call needs besides.
template <typename T>
class TimedGrid final : public LibraryOrBaseline<GridJob<T>> {
public:
  explicit TimedGrid(const GridRow& row)
      : LibraryOrBaseline<GridJob<T>>(row.algorithm == Algorithm::library), row_(row),
        u_(uniform_parameters<T>(row.size.nu)), v_(uniform_parameters<T>(row.size.nv)) {
    job_.patches = grid_patch_count<T>(row);
    job_.nu = row.size.nu;
    job_.nv = row.size.nv;
    job_.u = u_.data();
    job_.v = v_.data();
    job_.shape = row.shape;
    const Layout layout = row.algorithm == Algorithm::de_casteljau ? Layout::triples : row.layout;
    job_.out = place_results<T>(row.outputs, job_.patches * job_.nu * job_.nv, layout, row.aligned);
    const Baselines<T> baselines = widest_baselines<T>();
    switch (row.algorithm) {
    case Algorithm::library:
      set_ = is_bicubic(row.shape) ? &shared_patch_set<T>(job_.patches)
                                   : &shaped_patches<T>(job_.patches, row.shape).set;
      outputs_ = library_outputs(job_.out);
      options_.threads = row.threads;
      options_.watertight = row.watertight;
      options_.isa = row.isa;
      if (row.plain) {
        options_.destination = simdbezier::Destination::cache;
      }
      break;
    case Algorithm::de_casteljau:
      job_.input = shared_nets<T>(job_.patches);
      baseline_ = baselines.de_casteljau;
      break;
    case Algorithm::autovectorised:
      job_.input = shared_power_basis<T>(job_.patches);
      baseline_ = baselines.autovectorised;
      break;
    }
  }

  [[nodiscard]] double items() const {
    return static_cast<double>(job_.patches * job_.nu * job_.nv);
  }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(value_count(row_.outputs) * sizeof(T));
  }

private:
  using LibraryOrBaseline<GridJob<T>>::job_;
  using LibraryOrBaseline<GridJob<T>>::options_;
  using LibraryOrBaseline<GridJob<T>>::baseline_;

  simdbezier::Status evaluate(const simdbezier::Options& options) const override {
    return simdbezier::evaluate(*set_,
                                simdbezier::Grid<T>::uniform(job_.nu, job_.nv, {0, job_.patches}),
                                outputs_, options);
  }

  [[nodiscard]] bool is_packed() const override { return set_->size() >= job_.patches; }
  void poison_results() override { poison_grid(job_); }
  [[nodiscard]] std::string check_results() const override { return check_grid(job_, nets()); }

  [[nodiscard]] const T* nets() const {
    return is_bicubic(row_.shape) ? shared_nets<T>(job_.patches)
                                  : shaped_patches<T>(job_.patches, row_.shape).nets.data();
  }

  GridRow row_;
  std::vector<T> u_;
  std::vector<T> v_;
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::Outputs<T> outputs_;
};

template <typename T>
void add_grid_row(const GridRow& row) {
  const bool cache = row.level == MemoryLevel::cache;
  register_row(grid_row_name<T>(row), cache ? benchmark::kMicrosecond : benchmark::kMillisecond,
               row.threads, [row] { return TimedGrid<T>(row); });
}

} // namespace simdbezier_bench
