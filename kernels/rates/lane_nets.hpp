// Nets of control vectors, of any degrees, with or without weights: lanes are patches.
#pragma once

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A vector of three components, or of w (P - c) and w.
template <typename V, std::size_t kComponents>
struct LaneVector {
  V x[kComponents];
};

/// A net of them, [j][i] as in ControlNets. Rows are as far apart as the patch's, so that a net of
/// less degree can be raised where it stands; what lies between them is undefined.
template <typename V, std::size_t kComponents>
struct LaneNet {
  using Vector = LaneVector<V, kComponents>;

  std::size_t columns; ///< degree in u, plus 1
  std::size_t rows;
  std::size_t stride;
  Vector* at;

  /// A net of the same sizes elsewhere.
  [[nodiscard]] LaneNet shaped_at(Vector* where) const { return {columns, rows, stride, where}; }
};

/// The lines of a net in one direction: vector i of line k stands at i * step + k * across.
struct NetLines {
  std::size_t points;
  std::size_t step;
  std::size_t count;
  std::size_t across;

  template <typename Net>
  SIMDBEZIER_INLINE NetLines(const Net& net, bool in_u)
      : points(in_u ? net.columns : net.rows), step(in_u ? 1 : net.stride),
        count(in_u ? net.rows : net.columns), across(in_u ? net.stride : 1) {}
};

/// Sets the vectors to[k] = a from[k] + b next[k] of all lines.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE void blend(const NetLines& lines, V a, const LaneVector<V, kComponents>* from,
                             V b, const LaneVector<V, kComponents>* next,
                             LaneVector<V, kComponents>* to) {
  for (std::size_t k = 0; k < lines.count;
       ++k, from += lines.across, next += lines.across, to += lines.across) {
    for (std::size_t c = 0; c < kComponents; ++c) {
      to->x[c] = a * from->x[c] + b * next->x[c];
    }
  }
}
template <typename Vector>
SIMDBEZIER_INLINE void copy_points(const NetLines& lines, const Vector* from, Vector* to) {
  for (std::size_t k = 0; k < lines.count; ++k) {
    to[k * lines.across] = from[k * lines.across];
  }
}

/// Differences of neighbours in one direction, times the degree: a net of one zero where the degree
/// is 0.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE LaneNet<V, kComponents>
differentiate(const LaneNet<V, kComponents>& net, bool in_u, LaneVector<V, kComponents>* where) {
  LaneNet<V, kComponents> to = net.shaped_at(where);
  const NetLines lines(net, in_u);
  if (lines.points < 2) {
    to.columns = 1;
    to.rows = 1;
    for (V& component : to.at->x) {
      component = broadcast<V>(0);
    }
    return to;
  }
  (in_u ? to.columns : to.rows) -= 1;
  const V degree = broadcast<V>(static_cast<ScalarOf<V>>(lines.points - 1));
  for (std::size_t j = 0; j < to.rows; ++j) {
    for (std::size_t i = 0; i < to.columns; ++i) {
      const std::size_t k = j * net.stride + i;
      for (std::size_t c = 0; c < kComponents; ++c) {
        to.at[k].x[c] = degree * (net.at[k + lines.step].x[c] - net.at[k].x[c]);
      }
    }
  }
  return to;
}

/// Leaves the part of a net over [t, 1] (keep_high) or [0, t] in one direction, by de Casteljau's
/// algorithm. rest: 1 - t.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE void cut_net(const LaneNet<V, kComponents>& net, bool in_u, V rest, V t,
                               bool keep_high) {
  const NetLines lines(net, in_u);
  for (std::size_t level = 1; level < lines.points; ++level) {
    for (std::size_t i = 0; i + level < lines.points; ++i) {
      // The kept end is where values come to rest: each pass leaves one of them.
      const std::size_t at = keep_high ? i : lines.points - 1 - i;
      auto* const to = net.at + at * lines.step;
      blend(lines, rest, keep_high ? to : to - lines.step, t, keep_high ? to + lines.step : to, to);
    }
  }
}

/// The parts over [0, 1/2] and [1/2, 1] in one direction, by the same algorithm. Line by line, so
/// that what is being halved stays in the first-level cache, however large the net is.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE void halve_net(const LaneNet<V, kComponents>& net, bool in_u,
                                 LaneVector<V, kComponents>* low,
                                 LaneVector<V, kComponents>* high) {
  const NetLines lines(net, in_u);
  const V half = broadcast<V>(0.5);
  for (std::size_t k = 0; k < lines.count; ++k) {
    const std::size_t first = k * lines.across;
    const std::size_t last = first + (lines.points - 1) * lines.step;
    low[first] = net.at[first];
    high[last] = net.at[last];
    for (std::size_t level = 1; level < lines.points; ++level) {
      const auto* const from = level == 1 ? net.at : high;
      for (std::size_t at = first; at < last - (level - 1) * lines.step; at += lines.step) {
        for (std::size_t c = 0; c < kComponents; ++c) {
          high[at].x[c] = half * (from[at].x[c] + from[at + lines.step].x[c]);
        }
      }
      low[first + level * lines.step] = high[first];
    }
  }
}

/// Raises the degree in one direction by one. A point depends on those before it, so that going
/// backwards reads none that is raised already.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE void raise_once(LaneNet<V, kComponents>& net, bool in_u) {
  const NetLines lines(net, in_u);
  auto* at = net.at + lines.points * lines.step;
  copy_points(lines, at - lines.step, at);
  for (std::size_t i = lines.points - 1; i > 0; --i) {
    at -= lines.step;
    const double share = static_cast<double>(i) / static_cast<double>(lines.points);
    blend(lines, broadcast<V>(share), at - lines.step, broadcast<V>(1 - share), at, at);
  }
  ++(in_u ? net.columns : net.rows);
}
/// Raises both degrees.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE void raise_net(LaneNet<V, kComponents>& net, std::size_t columns,
                                 std::size_t rows) {
  while (net.columns < columns) {
    raise_once(net, true);
  }
  while (net.rows < rows) {
    raise_once(net, false);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
