// grid/<outputs>/<type>/<isa>/<nu>x<nv>/cache/threads:1[/degree:MxN][/weights:rational]: patches of
// other degrees than 3 and rational ones, and curvatures, of bicubic patches as well.
#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/rows/timed_grid.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

constexpr BatchShape kShapes[] = {{1, 1},       {2, 2},       {4, 4},      {5, 5}, {6, 6},
                                  {7, 7},       {8, 8},       {3, 1},      {1, 3}, {2, 3},
                                  {2, 2, true}, {3, 3, true}, {4, 4, true}};
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives,
                                     OutputGroups::second_derivatives, OutputGroups::curvature};
constexpr Size kSizes[] = {{16, 16}, {17, 17}};

template <typename T>
void add(OutputGroups outputs, Isa isa, Size size, BatchShape shape) {
  GridRow row{outputs, Algorithm::library, isa, size, MemoryLevel::cache};
  row.shape = shape;
  add_grid_row<T>(row);
}

template <typename T>
void add_type() {
  const auto isas = simdbezier::available_isas();
  for (const OutputGroups outputs : kOutputs) {
    for (const BatchShape shape : kShapes) {
      for (const Isa isa : isas) {
        add<T>(outputs, isa, kSizes[0], shape);
      }
      add<T>(outputs, isas.back(), kSizes[1], shape);
    }
  }
  for (const Isa isa : isas) {
    for (const Size size : kSizes) {
      add<T>(OutputGroups::curvature, isa, size, {});
    }
  }
  for (int threads = 1; threads <= max_threads(); ++threads) {
    add_grid_row<T>({OutputGroups::curvature, Algorithm::library, isas.back(), kSizes[0],
                     MemoryLevel::memory, threads});
  }
}

} // namespace

void register_shape_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
