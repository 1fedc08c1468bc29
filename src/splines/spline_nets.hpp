// Spline surfaces on their way to Bézier nets: one row of spans at a time.
//
// Lines are the values of a row of Bézier control points in u, [mean][channel], in homogeneous
// coordinates and in double; spans that join share one. The spline's rows become lines one by one,
// and means of up to degree_v + 1 of these are the rows of nets. A thread keeps as many lines as it
// needs for one row of spans, and goes on with the next one.
#pragma once

#include <cstddef>

#include "src/splines/spline_list.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::detail {

/// Makes nets of rows of spans, one after the other, in the scratch of one thread.
template <typename S>
class SplineCutter {
public:
  SplineCutter(const SplineList<S>& list, const MeanKernels& means, unsigned char* scratch) noexcept
      : list_(list), means_(means), scratch_(reinterpret_cast<double*>(scratch)) {}

  /// Writes the nets of a row of spans to out[0 …]. Their weights are homogeneous or Cartesian.
  void cut(std::size_t row, const NetView<S>& out) noexcept;

private:
  /// Lets the lines be those of another spline.
  void begin(const PreparedSpline<S>& spline) noexcept;
  /// Returns the line of one of the spline's rows; rows of periodic ones count on.
  const double* line(std::size_t row) noexcept;
  void fill(std::size_t row, double* line) noexcept;
  void store(const double* line, std::size_t j, const NetView<S>& out) const noexcept;
  void restore(std::size_t span_v, const NetView<S>& out) const noexcept;

  const SplineList<S>& list_;
  MeanKernels means_;
  double* scratch_;
  const PreparedSpline<S>* spline_ = nullptr;
  double* row_ = nullptr; ///< a row of the spline's points in double
  double* mean_of_lines_ = nullptr;
  const SplineMean* mean_ = nullptr;  ///< what that is
  double* lines_ = nullptr;           ///< order_v of them
  std::size_t held_[kMostOrder] = {}; ///< the row of each line
};

} // namespace simdbezier::detail
