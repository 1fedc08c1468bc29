#include "src/nets/iso_points.hpp"

#include <algorithm>
#include <cmath>

#include "src/runtime/both_types.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {
namespace {

/// A power of two by which all weights of a patch are below 1, so that products do not overflow; 1
/// where it has none, or points are products already.
template <typename S>
double weight_scale(const IsoTask<S>& task, const S* net) {
  if (task.nets.weights != Weights::cartesian) {
    return 1;
  }
  const S* const weight =
      net + static_cast<std::ptrdiff_t>(task.nets.components) * task.nets.component_stride;
  double heaviest = 0;
  for (int i = 0; i <= task.nets.degree_u; ++i) {
    for (int j = 0; j <= task.nets.degree_v; ++j) {
      const S at = weight[i * task.nets.point_stride + j * task.nets.row_stride];
      heaviest = std::max(heaviest, static_cast<double>(at));
    }
  }
  // Of the smallest weights, less is enough: powers of two above 2^1023 are none.
  return std::ldexp(1.0, std::min(-1 - std::ilogb(heaviest), 1000));
}

/// One patch's control points as rows of `row` values, one row for each point across; weights, and
/// what is multiplied by them, times `scale`.
template <typename S>
void read_rows(const IsoTask<S>& task, const S* net, double scale, double* rows) {
  const bool homogenise = task.nets.weights == Weights::cartesian;
  const auto weight_at = static_cast<std::ptrdiff_t>(task.nets.components);
  for (int i = 0; i <= task.nets.degree_u; ++i) {
    for (int j = 0; j <= task.nets.degree_v; ++j) {
      const S* const point = net + i * task.nets.point_stride + j * task.nets.row_stride;
      for (std::size_t c = 0; c < task.channels; ++c) {
        const auto at = static_cast<std::ptrdiff_t>(c);
        *rows = static_cast<double>(point[at * task.nets.component_stride]);
        if (homogenise) {
          const S weight = point[weight_at * task.nets.component_stride];
          *rows = static_cast<double>(weight) * scale * (at < weight_at ? *rows : 1);
        }
        ++rows;
      }
    }
  }
}

template <typename S>
void interpolate(const IsoTask<S>& task, std::size_t patch, double* points) {
  const std::size_t row = task.curve_values();
  double rows[kMostOrder * kMostOrder * kMostChannels];
  const double scale = weight_scale(task, task.net(patch));
  read_rows(task, task.net(patch), scale, rows);
  const double s = 1 - task.t;
  for (int last = task.nets.degree_u; last > 0; --last) {
    // All rows of a level lie side by side: one long loop.
    const std::size_t count = static_cast<std::size_t>(last) * row;
    for (std::size_t k = 0; k < count; ++k) {
      rows[k] = s * rows[k] + task.t * rows[k + row];
    }
  }
  const bool divides = task.nets.weights == Weights::cartesian;
  for (std::size_t k = 0; k < row; ++k) {
    const std::size_t c = k % task.channels;
    const bool weight = c + 1 == task.channels;
    points[k] = !divides ? rows[k]
                : weight ? rows[k] / scale
                         : rows[k] / rows[k - c + task.channels - 1];
    points[k] += 0.0;
  }
}

/// The curve at 0 or 1 is a boundary, whose points are copied, since products with weights round.
template <typename S>
void copy_boundary(const IsoTask<S>& task, std::size_t patch, double* points) {
  const S* const first =
      task.net(patch) + (task.t == 1 ? task.nets.degree_u * task.nets.point_stride : 0);
  for (int j = 0; j <= task.nets.degree_v; ++j) {
    for (std::size_t c = 0; c < task.channels; ++c) {
      const auto at =
          j * task.nets.row_stride + static_cast<std::ptrdiff_t>(c) * task.nets.component_stride;
      *points++ = static_cast<double>(first[at]) + 0.0;
    }
  }
}

/// Makes points of rational curves that are means of one point (one_point.hpp) that point again:
/// all of them where the whole curve is, also where values of S are one and those of double are
/// not.
template <typename S>
void restore_points(const IsoTask<S>& task, std::size_t patch, double* points) {
  const bool boundary = task.t == 0 || task.t == 1;
  const std::size_t across = boundary ? 1 : static_cast<std::size_t>(task.nets.degree_u) + 1;
  const std::size_t along = static_cast<std::size_t>(task.nets.degree_v) + 1;
  const S* const first =
      task.net(patch) + (task.t == 1 ? task.nets.degree_u * task.nets.point_stride : 0);
  const auto restore = [&](std::size_t begin, std::size_t count) {
    const auto point = [&](std::size_t k) {
      return first + static_cast<std::ptrdiff_t>(begin + k / across) * task.nets.row_stride +
             static_cast<std::ptrdiff_t>(k % across) * task.nets.point_stride;
    };
    double one[kMostChannels];
    if (!are_one_point<S>(point, count * across, task.channels - 1, task.nets.component_stride,
                          task.nets.weights, one)) {
      return false;
    }
    for (std::size_t k = begin; k < begin + count; ++k) {
      double* const to = points + k * task.channels;
      const double weight = task.nets.weights == Weights::homogeneous ? to[task.channels - 1] : 1;
      for (std::size_t c = 0; c + 1 < task.channels; ++c) {
        to[c] = one[c] * weight + 0.0;
      }
    }
    return true;
  };
  if (!restore(0, along) && !boundary) {
    for (std::size_t k = 0; k < along; ++k) {
      restore(k, 1);
    }
  }
}

/// Homogeneous points become Cartesian ones.
template <typename S>
void divide_by_weights(const IsoTask<S>& task, double* points) {
  for (std::size_t k = 0; k < task.curve_values(); k += task.channels) {
    for (std::size_t c = 0; c + 1 < task.channels; ++c) {
      points[k + c] = points[k + c] / points[k + task.channels - 1] + 0.0;
    }
  }
}

} // namespace

template <typename S>
void form_curve(const IsoTask<S>& task, std::size_t patch, double* points) noexcept {
  if (task.t == 0 || task.t == 1) {
    copy_boundary(task, patch, points);
  } else {
    interpolate(task, patch, points);
  }
  if (task.nets.weights != Weights::none) {
    restore_points(task, patch, points);
  }
  if (task.form != task.nets.weights) {
    divide_by_weights(task, points);
  }
}

SIMDBEZIER_OF_BOTH_TYPES(form_curve);

} // namespace simdbezier::detail
