// See rates.hpp: tolerances from what a camera sees.
#include <algorithm>
#include <cmath>

#include <simdbezier/rates.hpp>

#include "src/mesh/net_points.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

/// The camera's axis, and the size in pixels at which distances are seen.
class View {
public:
  explicit View(const Camera& camera) : camera_(camera) {
    int exponent = 0; // whatever the direction's length, its square is neither 0 nor infinite
    axis_ =
        scaled_to_one({{camera.direction[0], camera.direction[1], camera.direction[2]}}, exponent);
    length_ = length(axis_);
    const double corner = std::hypot(camera.width, camera.height) / 2 / camera.focal_length;
    pixels_per_unit_ = camera.focal_length * std::sqrt(1 + corner * corner);
  }
  [[nodiscard]] bool is_sound() const {
    const auto& eye = camera_.eye;
    return is_positive(length_) && is_positive(pixels_per_unit_) &&
           is_positive(camera_.focal_length) && is_positive(camera_.width) &&
           is_positive(camera_.height) && is_positive(camera_.nearest) &&
           is_finite({{eye[0], eye[1], eye[2]}});
  }
  [[nodiscard]] double depth(const Point3& point) const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      sum += (point.x[c] - camera_.eye[c]) * axis_.x[c];
    }
    return sum / length_;
  }
  template <typename S>
  [[nodiscard]] double tolerance(const ControlNets<S>& nets, std::size_t patch,
                                 double pixels) const {
    double nearest = HUGE_VAL;
    double farthest = -HUGE_VAL;
    PointBox box;
    for_points(nets, patch, [&](const Point3& point) {
      nearest = std::min(nearest, depth(point));
      farthest = std::max(farthest, depth(point));
      box.include(point);
    });
    if (farthest < camera_.nearest) {
      return std::max(box.diagonal(), camera_.nearest);
    }
    return pixels * std::max(nearest, camera_.nearest) / pixels_per_unit_;
  }

private:
  const Camera& camera_;
  Point3 axis_;
  double length_;
  double pixels_per_unit_;
};

} // namespace
} // namespace detail

template <typename S>
Status pixel_tolerances(std::span<const ControlNets<S>> nets, const Camera& camera, double pixels,
                        std::span<double> out) noexcept {
  const detail::DefaultFpEnvironment environment;
  const detail::View camera_view(camera);
  if (!camera_view.is_sound() || !detail::is_positive(pixels)) {
    return Status::bad_tolerance;
  }
  if (detail::is_missing(nets)) {
    return Status::null_input;
  }
  for (const ControlNets<S>& view : nets) {
    if (const Status status = detail::check_in_space(view); !status) {
      return status;
    }
  }
  if (out.size() < detail::patches_of(nets)) {
    return Status::output_too_small;
  }
  std::size_t first = 0;
  for (const ControlNets<S>& view : nets) {
    for (std::size_t patch = 0; patch < view.count; ++patch) {
      out[first + patch] = camera_view.tolerance(view, patch, pixels);
    }
    first += view.count;
  }
  return Status::ok;
}

template SIMDBEZIER_API Status pixel_tolerances(std::span<const ControlNets<float>>, const Camera&,
                                                double, std::span<double>) noexcept;
template SIMDBEZIER_API Status pixel_tolerances(std::span<const ControlNets<double>>, const Camera&,
                                                double, std::span<double>) noexcept;

} // namespace simdbezier
