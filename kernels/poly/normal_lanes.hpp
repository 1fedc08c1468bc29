// The second look at the normals of a register of samples that did not all pass the quick test.
#pragma once

#include <limits>

#include "kernels/simd/transpose.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The normals of a register that are to be looked at: which lanes are samples, and which ones.
/// They are a row, or several.
struct UncertainNormals {
  std::size_t lane;    ///< first lane
  std::size_t columns; ///< lanes a row
  std::size_t active;  ///< of them in the grid
  std::size_t rows;
  std::size_t at;       ///< first sample
  std::size_t row_step; ///< samples from one row to the next
  std::size_t status_step;
  std::size_t value_step = 1; ///< values from one sample's normal to the next
};

/// Returns a floor with which every normal takes a second look.
template <typename V>
SIMDBEZIER_INLINE V no_floor() {
  return broadcast<V>(static_cast<ScalarOf<V>>(__builtin_inf()));
}
/// Returns the patch's floor where t lies in the patch's range, and infinity elsewhere: outside of
/// the patch no bound holds.
template <typename V>
SIMDBEZIER_INLINE V floor_inside(V t, V floor) {
  using T = ScalarOf<V>;
  // These are named, since clang warns of & between calls that give bool.
  const MaskOf<V> below = t <= broadcast<V>(T(0.5));
  const MaskOf<V> above = t >= broadcast<V>(T(-0.5));
  return select_where<V>(below & above, floor, no_floor<V>());
}

/// Finds unit normals of a polynomial patch's samples by their leading coefficient
/// (poly/normal_start.hpp), component by component, and the numbers of the coefficients, or -1
/// where nothing is certain; in whole registers. shape_f64_kernels.cpp has it for all objects.
void start_normals(const detail::NetShape& shape, const detail::GivenNet& net, double tolerance,
                   const double* x, const double* y, std::size_t count, double* normals,
                   std::size_t step, double* orders);

/// Samples of one patch whose normals did not pass. They are rare, so all of this is kept out of
/// line.
template <typename T>
class DoubtfulSamples {
public:
  DoubtfulSamples(const detail::SampleTask<T>& task, std::size_t patch)
      : task_(task), patch_(patch) {}
  [[nodiscard]] bool any() const { return count_ > 0; }

  /// Adds those of a register. Vectors come by value, or the fast path would have to keep them in
  /// memory.
  template <typename V>
  SIMDBEZIER_KERNEL void add(UncertainNormals s, V x, V y, V squared, V floor) {
    if (count_ + s.rows * s.active > kMost) {
      resolve();
    }
    status_step_ = s.status_step;
    value_step_ = s.value_step;
    const V vectors[4] = {squared, floor, x, y};
    alignas(64) T lanes[4][kLanes<V>];
    for (int i = 0; i < 4; ++i) {
      store_vector(lanes[i], vectors[i]);
    }
    for (std::size_t row = 0; row < s.rows; ++row) {
      for (std::size_t k = 0; k < s.active; ++k) {
        const std::size_t i = s.lane + row * s.columns + k;
        x_[count_] = static_cast<double>(lanes[2][i]);
        y_[count_] = static_cast<double>(lanes[3][i]);
        at_[count_] = s.at + row * s.row_step + k;
        count_ += lanes[0][i] > lanes[1][i] ? 0 : 1;
      }
    }
  }

  /// Resolves all samples that have been added.
  SIMDBEZIER_KERNEL void resolve() {
    const detail::NetShape& shape = *task_.shape;
    const detail::GivenNet net = task_.given.net(patch_ * shape.control_values());
    for (std::size_t k = count_; k < count_ + kWideLanes; ++k) { // lanes of the last register
      x_[k] = y_[k] = 1;
    }
    double normals[3][kMost + kWideLanes];
    double orders[kMost + kWideLanes];
    if (shape.rational) {
      for (std::size_t k = 0; k < count_; ++k) {
        orders[k] = -1;
      }
    } else {
      start_normals(shape, net, detail::kLimitTolerance<T>, x_, y_, count_, normals[0],
                    kMost + kWideLanes, orders);
    }
    for (std::size_t k = 0; k < count_; ++k) {
      T normal[3];
      if (orders[k] < 0) {
        const detail::NormalQuery<T> query{&shape, net, static_cast<T>(x_[k]),
                                           static_cast<T>(y_[k])};
        put(at_[k], task_.resolve_normal(query, normal), normal);
      } else {
        for (std::size_t c = 0; c < 3; ++c) {
          normal[c] = static_cast<T>(normals[c][k]) + T(0);
        }
        put(at_[k], orders[k] == 0 ? SampleStatus::regular : SampleStatus::limit, normal);
      }
    }
    count_ = 0;
  }

private:
  static constexpr std::size_t kMost = 4 * detail::kMaxLanes;

  void put(std::size_t at, SampleStatus status, const T normal[3]) const {
    const detail::Planes<T>& to = task_.out[output_index(Output::normal)];
    for (std::size_t c = 0; to.wanted() && c < 3; ++c) {
      to.component[c][at * value_step_] = normal[c];
    }
    for (T* const curvature : task_.curvature) {
      if (curvature != nullptr && status != SampleStatus::regular) {
        curvature[at] = std::numeric_limits<T>::quiet_NaN();
      }
    }
    if (task_.status != nullptr) {
      task_.status[at * status_step_] = status;
    }
  }

  const detail::SampleTask<T>& task_;
  std::size_t patch_;
  std::size_t status_step_ = 1;
  std::size_t value_step_ = 1;
  std::size_t count_ = 0;
  double x_[kMost + kWideLanes];
  double y_[kMost + kWideLanes];
  std::size_t at_[kMost + 1];
};

/// Resolves the normals of a register that did not pass.
template <typename V>
SIMDBEZIER_RARE void resolve_normals(const detail::SampleTask<ScalarOf<V>>& task, std::size_t patch,
                                     UncertainNormals s, V x, V y, V squared, V floor) {
  DoubtfulSamples<ScalarOf<V>> samples(task, patch);
  samples.add(s, x, y, squared, floor);
  samples.resolve();
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
