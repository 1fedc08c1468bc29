// grid/<outputs>/<type>/<isa>/<nu>x<nv>/<destination>/threads:<t>[/<key>:<value>…]
#include <string>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/rows/timed_grid.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

// Rows of 128 columns lie powers of two apart, which caches and memory like least.
constexpr Size kSizes[] = {{4, 4},   {5, 5},   {8, 8},   {9, 9},   {16, 16}, {17, 17}, {24, 24},
                           {32, 32}, {33, 33}, {64, 64}, {65, 65}, {16, 9},  {7, 33},  {128, 32}};
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives,
                                     OutputGroups::second_derivatives};

template <typename T>
void add_library(OutputGroups outputs, Isa isa, Size size, MemoryLevel level) {
  const int most = level == MemoryLevel::cache ? 1 : max_threads();
  for (int threads = 1; threads <= most; ++threads) {
    add_grid_row<T>({outputs, Algorithm::library, isa, size, level, threads});
  }
}

/// Adds rows of other layouts, which only the widest instruction set and AVX2 have.
template <typename T>
void add_layouts(OutputGroups outputs, Isa isa, Size size, MemoryLevel level) {
  for (const Layout layout : {Layout::triples, Layout::vertices}) {
    if (layout == Layout::vertices && group_count(outputs) == 1) {
      continue; // the same as triples
    }
    const int most = level == MemoryLevel::cache ? 1 : max_threads();
    for (int threads = 1; threads <= most; ++threads) {
      add_grid_row<T>({outputs, Algorithm::library, isa, size, level, threads, layout});
    }
  }
}

template <typename T>
void add_size(OutputGroups outputs, Size size) {
  const auto isas = simdbezier::available_isas();
  const Isa widest = isas.back();
  for (const MemoryLevel level : {MemoryLevel::cache, MemoryLevel::memory}) {
    for (const Algorithm baseline : {Algorithm::de_casteljau, Algorithm::autovectorised}) {
      if (baseline == Algorithm::de_casteljau || size.nu <= kLargestSwept) { // as far as they go
        add_grid_row<T>({outputs, baseline, Isa::automatic, size, level});
      }
    }
    for (const Isa isa : isas) {
      add_library<T>(outputs, isa, size, level);
      if (isa == widest || isa == Isa::avx2) {
        add_layouts<T>(outputs, isa, size, level);
      }
    }
  }
  add_grid_row<T>({outputs, Algorithm::library, Isa::automatic, size, MemoryLevel::cache});
  GridRow row{outputs, Algorithm::library, widest, size, MemoryLevel::cache};
  if (size.nu >= 8 && size.nv >= 8) { // smaller grids are nearly all boundary
    row.watertight = false;
    add_grid_row<T>(row);
    row.watertight = true;
  }
  row.level = MemoryLevel::memory;
  row.aligned = false;
  add_grid_row<T>(row);
  if (size.nu == size.nv && (size.nu == 16 || size.nu == 32)) {
    row.aligned = true;
    row.plain = true;
    add_grid_row<T>(row);
  }
}

template <typename T>
void add_type() {
  for (const OutputGroups outputs : kOutputs) {
    for (const Size size : kSizes) {
      add_size<T>(outputs, size);
    }
    for (const Size size : swept_beside(kSizes)) {
      for (const Algorithm baseline : {Algorithm::de_casteljau, Algorithm::autovectorised}) {
        add_grid_row<T>({outputs, baseline, Isa::automatic, size, MemoryLevel::cache});
      }
      for (const Isa isa : simdbezier::available_isas()) {
        add_library<T>(outputs, isa, size, MemoryLevel::cache);
      }
    }
  }
}

} // namespace

void register_grid_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
