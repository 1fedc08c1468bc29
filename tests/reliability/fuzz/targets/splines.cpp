// Meshes of B-splines: equal bits on all instruction sets and for any strides, the control points
// of the textbook.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/made_nets.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class SplineCase {
public:
  explicit SplineCase(ByteSource& bytes) : bytes_(bytes) {
    const std::uint8_t choice = bytes.byte();
    mesh_.periodic_u = (choice & 1) != 0;
    mesh_.periodic_v = (choice & 2) != 0;
    mesh_.components = components(bytes);
    mesh_.rows = (mesh_.periodic_v ? 3 : 4) + bytes.below(5);
    mesh_.columns = (mesh_.periodic_u ? 3 : 4) + bytes.below(20);
    values_ = nets_of<T>(bytes, static_cast<int>(mesh_.columns) - 1,
                         static_cast<int>(mesh_.rows) - 1, mesh_.components, Weights::none, 1);
    const auto c = static_cast<std::ptrdiff_t>(mesh_.components);
    mesh_.points = values_.values.data();
    mesh_.point_stride = c;
    mesh_.row_stride = c * static_cast<std::ptrdiff_t>(mesh_.columns);
  }

  void run() {
    Nets<T> expected{
        3, 3, mesh_.components, Weights::none, mesh_.patches_u() * mesh_.patches_v(), true, {}};
    expected.values.assign(expected.count * expected.values_per_patch(), T(0));
    std::optional<Status> first;
    for (const Isa isa : available_isas()) {
      const Arrangement arrangement(bytes_);
      StridedNets<T> memory(expected, arrangement, placement(bytes_));
      const Status status =
          spline_to_bezier(mesh_, memory.view(), with({}, isa, isa == Isa::avx2 ? 2 : 1)).status;
      memory.check_surroundings();
      require_status(status, {Status::ok, Status::non_finite_input}, "spline_to_bezier");
      require(!first || *first == status, "spline_to_bezier has another status");
      if (status == Status::ok) {
        const std::vector<T> values = memory.values();
        if (first) {
          require_equal(values, expected.values, named("spline_to_bezier gives other bits", isa));
        }
        expected.values = values;
      }
      first = status;
    }
    if (*first == Status::ok && values_.moderate) {
      judge(expected);
    }
  }

private:
  /// Control point k of the piece between knots: weights of the mesh's points 0 to 3 in sixths.
  static constexpr int kSixths[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};

  void judge(const Nets<T>& made) const {
    for (std::size_t p = 0; p < made.count; ++p) {
      for (int k = 0; k < 16; ++k) {
        for (int c = 0; c < mesh_.components; ++c) {
          judge_value(made.point(p, k / 4, k % 4)[c], p, k, c);
        }
      }
    }
  }

  void judge_value(T value, std::size_t patch, int point, int c) const {
    Real exact = 0;
    Real size = 0;
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t row = (patch / mesh_.patches_u() + k / 4) % mesh_.rows;
      const std::size_t column = (patch % mesh_.patches_u() + k % 4) % mesh_.columns;
      const auto at =
          static_cast<Real>(values_.point(0, static_cast<int>(row), static_cast<int>(column))[c]);
      exact += kSixths[point / 4][k / 4] * kSixths[point % 4][k % 4] * at / 36;
      size = std::max(size, std::fabs(at));
    }
    require(std::fabs(static_cast<Real>(value) - exact) <=
                8 * std::numeric_limits<T>::epsilon() * size + std::numeric_limits<T>::min(),
            "a piece of a B-spline has another control point");
  }

  ByteSource& bytes_;
  SplineMesh<T> mesh_;
  Nets<T> values_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::SplineCase>(data, size);
}
