// See pixels.hpp, and pixel_tolerances() in rates.hpp.
#include "src/mesh/rates/pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/mesh/net_points.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

template <typename S>
PointBox box_of(const ControlNets<S>& nets, std::size_t patch) {
  PointBox box;
  for_points(nets, patch, [&](const Point3& point) { box.include(point); });
  return box;
}

/// Values between two.
struct Interval {
  double low;
  double high;

  friend Interval operator-(const Interval& a, const Interval& b) {
    return {a.low - b.high, a.high - b.low};
  }
  friend Interval operator+(const Interval& a, const Interval& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const double products[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    return {*std::min_element(products, products + 4), *std::max_element(products, products + 4)};
  }
  [[nodiscard]] double size() const { return std::max(std::fabs(low), std::fabs(high)); }
};
using IntervalVector = std::array<Interval, 3>;

IntervalVector intervals_of(const PointBox& box) {
  return {Interval{box.low(0), box.high(0)}, {box.low(1), box.high(1)}, {box.low(2), box.high(2)}};
}

/// The camera's axis, and the size in pixels at which distances are seen.
class View {
public:
  View(const Camera& camera, const Topology& topology) : camera_(camera), topology_(topology) {
    int exponent = 0; // whatever the direction's length, its square is neither 0 nor infinite
    axis_ =
        scaled_to_one({{camera.direction[0], camera.direction[1], camera.direction[2]}}, exponent);
    length_ = length(axis_);
    radius_ = length(Point3{{camera.width, camera.height, 0}}) / 2 / camera.focal_length;
    secant_ = std::sqrt(1 + radius_ * radius_);
    pixels_per_unit_ = camera.focal_length * (camera.orthographic ? 1 : secant_);
  }
  [[nodiscard]] bool is_sound() const {
    const auto& eye = camera_.eye;
    return is_positive(length_) && is_positive(pixels_per_unit_) && is_positive(secant_) &&
           is_positive(camera_.focal_length) && is_positive(camera_.width) &&
           is_positive(camera_.height) && is_positive(camera_.nearest) &&
           is_finite({{eye[0], eye[1], eye[2]}});
  }
  /// Writes the tolerances of a view's patches, whose numbers in the topology are from `first` on.
  template <typename S>
  void write_tolerances(const ControlNets<S>& nets, std::size_t first, double pixels,
                        const RunOptions& run, double* out) const {
    auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
      write_some(nets, first, begin, end, pixels, run.isa, out);
    };
    divide_work(nets.count, 10, run.threads, body);
  }

private:
  template <typename S>
  void write_some(const ControlNets<S>& nets, std::size_t first, std::size_t begin, std::size_t end,
                  double pixels, Isa isa, double* out) const {
    const NetView<const S> view = view_of(nets);
    const bool measured =
        view.packed && nets.weights == Weights::none && nets.degree_u == 3 && nets.degree_v == 3;
    std::size_t patch = begin;
    for (; measured && end - patch >= kMeasured; patch += kMeasured) {
      double nearest[kMeasured];
      double farthest[kMeasured];
      for (std::size_t k = 0; k < kMeasured; ++k) {
        ask_for_net(nets, std::min(patch + kMeasured + k, nets.count - 1));
      }
      separate_table<NetTable<S>>(isa).measures.depths(values_at(nets, patch, 0, 0),
                                                       nets.patch_stride, camera_.eye.data(),
                                                       axis_.x, nearest, farthest);
      for (std::size_t k = 0; k < kMeasured; ++k) {
        out[patch + k] =
            sees(nets, patch + k, first, farthest[k]) ? tolerance(nearest[k], pixels) : kUnlimited;
      }
    }
    for (; patch < end; ++patch) {
      double nearest = HUGE_VAL;
      double farthest = -HUGE_VAL;
      for_points(nets, patch, [&](const Point3& point) {
        const double depth = along_axis(point);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
      });
      out[patch] = sees(nets, patch, first, farthest) ? tolerance(nearest, pixels) : kUnlimited;
    }
  }

  // nearest, farthest: depths of a patch's points, times the length of the camera's direction.
  [[nodiscard]] double tolerance(double nearest, double pixels) const {
    const double depth = std::max(nearest / length_, camera_.nearest);
    return pixels * (camera_.orthographic ? 1 : depth) / pixels_per_unit_;
  }
  template <typename S>
  [[nodiscard]] bool sees(const ControlNets<S>& nets, std::size_t patch, std::size_t first,
                          double farthest) const {
    if (farthest / length_ < camera_.nearest) {
      return false;
    }
    if (!camera_.skip_outside && !camera_.skip_back) { // then nothing asks for a box
      return true;
    }
    const PointBox box = box_of(nets, patch);
    return !(camera_.skip_outside && is_outside(box)) &&
           !(camera_.skip_back && is_back(nets, patch, box, topology_.is_turned(first + patch)));
  }

  [[nodiscard]] double along_axis(const Point3& point) const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      sum += (point.x[c] - camera_.eye[c]) * axis_.x[c];
    }
    return sum;
  }

  /// Whether the sphere around a patch's box is outside of the cone (or cylinder) whose section is
  /// the circle around the picture.
  [[nodiscard]] bool is_outside(const PointBox& box) const {
    const Point3 from_eye = {{box.middle(0) - camera_.eye[0], box.middle(1) - camera_.eye[1],
                              box.middle(2) - camera_.eye[2]}};
    const double depth = dot(from_eye, axis_) / length_;
    const double off_axis = length(cross(from_eye, axis_)) / length_;
    const double beside =
        camera_.orthographic ? off_axis - radius_ : (off_axis - depth * radius_) / secant_;
    const double rounding = kMargin * (length(from_eye) + box.diagonal());
    return beside > box.diagonal() / 2 + rounding; // false where something is not finite
  }
  /// Whether du x dv, or its negative where the patch is turned, points away from the eye wherever
  /// the derivatives are between the differences of control points, and the surface is between
  /// these.
  template <typename S>
  [[nodiscard]] bool is_back(const ControlNets<S>& nets, std::size_t patch, const PointBox& box,
                             bool turned) const {
    if (nets.weights != Weights::none) {
      return false;
    }
    PointBox box_u;
    PointBox box_v;
    for (std::ptrdiff_t j = 0; j <= nets.degree_v; ++j) {
      for (std::ptrdiff_t i = 0; i <= nets.degree_u; ++i) {
        const Point3 point = point_at(nets, patch, i, j);
        if (i < nets.degree_u) {
          box_u.include(point_at(nets, patch, i + 1, j) - point);
        }
        if (j < nets.degree_v) {
          box_v.include(point_at(nets, patch, i, j + 1) - point);
        }
      }
    }
    const IntervalVector du = intervals_of(box_u);
    const IntervalVector dv = intervals_of(box_v);
    IntervalVector sight = intervals_of(box);
    Interval facing = {0, 0};
    double size = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = (c + 1) % 3;
      const std::size_t b = (c + 2) % 3;
      sight[c] = camera_.orthographic ? Interval{axis_.x[c], axis_.x[c]}
                                      : sight[c] - Interval{camera_.eye[c], camera_.eye[c]};
      const Interval normal = du[a] * dv[b] - du[b] * dv[a];
      facing = facing + normal * sight[c];
      size += (du[a].size() * dv[b].size() + du[b].size() * dv[a].size()) *
              (sight[c].size() + std::fabs(camera_.eye[c]));
    }
    return (turned ? -facing.high : facing.low) > kMargin * size;
  }

  static constexpr double kMargin = 1e-12; ///< more than all roundings of a test
  const Camera& camera_;
  const Topology& topology_;
  Point3 axis_;
  double length_;
  double radius_; ///< of the circle around the picture, in units, at a depth of one
  double secant_; ///< of the angle between the axis and that circle
  double pixels_per_unit_;
};

} // namespace

template <typename S>
Status view_tolerances(std::span<const ControlNets<S>> nets, const Topology& topology,
                       const Camera& camera, double pixels, std::span<double> out,
                       const RunOptions& options) noexcept {
  const View camera_view(camera, topology);
  if (!camera_view.is_sound() || !is_positive(pixels)) {
    return Status::bad_tolerance;
  }
  std::size_t patches = 0;
  if (const Status status = count_patches(nets, patches); !status) {
    return status;
  }
  for (const ControlNets<S>& view : nets) {
    if (const Status status = check_in_space(view); !status) {
      return status;
    }
  }
  if (out.size() < patches) {
    return Status::output_too_small;
  }
  Isa isa = Isa::automatic;
  if (const Status status = resolve_isa(options.isa, isa); !status) {
    return status;
  }
  std::size_t first = 0;
  for (const ControlNets<S>& view : nets) {
    camera_view.write_tolerances(view, first, pixels, {options.threads, isa}, out.data() + first);
    first += view.count;
  }
  return Status::ok;
}

SIMDBEZIER_OF_BOTH_TYPES(view_tolerances);

} // namespace detail

template <typename S>
Status pixel_tolerances(std::span<const ControlNets<S>> nets, const Camera& camera, double pixels,
                        std::span<double> out, const RunOptions& options) noexcept {
  const detail::DefaultFpEnvironment environment;
  return detail::view_tolerances(nets, Topology(), camera, pixels, out, options);
}

template SIMDBEZIER_API Status pixel_tolerances(std::span<const ControlNets<float>>, const Camera&,
                                                double, std::span<double>,
                                                const RunOptions&) noexcept;
template SIMDBEZIER_API Status pixel_tolerances(std::span<const ControlNets<double>>, const Camera&,
                                                double, std::span<double>,
                                                const RunOptions&) noexcept;

} // namespace simdbezier
