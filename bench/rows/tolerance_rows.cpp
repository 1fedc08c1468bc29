// tolerance/<operation>/<type>/<isa>/<degree>/cache/threads:1[/weights:rational]: what chooses and
// certifies cells by a tolerance. Items are patches, or curves.
//
//   choose_rates      rates, diagonals and deviations of patches that share no edges
//   position_errors   of packed patches
//   choose_polylines  points and deviations of curves; it has no kernels and is called scalar
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <simdbezier/flatten.hpp>
#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/subjects/patches.hpp"
#include "bench/subjects/reference_sample.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using simdbezier::Status;

constexpr std::size_t kCount = 256;
/// Bicubic patches, which are about as large as 1, have 203 cells in the mean then: some 14 x 14.
constexpr double kTolerance = 2e-3;
constexpr BatchShape kShapes[] = {{3, 3}, {2, 2}, {5, 4}, {8, 8}, {2, 2, true}, {3, 3, true}};
/// Curves are the two rows of patches of degree 1 in v.
constexpr BatchShape kCurves[] = {{3, 1}, {8, 1}, {3, 1, true}};

using Point = std::array<double, 3>;

Point position_of(const Sample& sample) {
  return {sample.position[0], sample.position[1], sample.position[2]};
}
Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point edge = difference(b, a);
  const Point from = difference(p, a);
  const double t = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
  return length({from[0] - t * edge[0], from[1] - t * edge[1], from[2] - t * edge[2]});
}

/// The foot of the perpendicular has the barycentric coordinates s, t in terms of ab, ac.
double distance_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = difference(b, a);
  const Point ac = difference(c, a);
  const Point from = difference(p, a);
  const double determinant = dot(ab, ab) * dot(ac, ac) - dot(ab, ac) * dot(ab, ac);
  const double s = (dot(ac, ac) * dot(ab, from) - dot(ab, ac) * dot(ac, from)) / determinant;
  const double t = (dot(ab, ab) * dot(ac, from) - dot(ab, ac) * dot(ab, from)) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) {
    return length({from[0] - s * ab[0] - t * ac[0], from[1] - s * ab[1] - t * ac[1],
                   from[2] - s * ab[2] - t * ac[2]});
  }
  return std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

/// The zone (simdbezier::Zone) of cell k of n.
unsigned zone_of(std::size_t k, std::size_t n) { return 2 * k + 1 == n ? 2 : 2 * k >= n ? 1 : 0; }

/// The cells of one patch, cut as choose_rates() says.
template <typename T>
struct CutPatch {
  const T* net;
  BatchShape shape;
  std::size_t nu, nv;
  unsigned diagonals;

  /// Returns the distance of the surface at the place (s, t) of a cell from the cell's triangles.
  [[nodiscard]] double deviation(std::size_t i, std::size_t j, double s, double t) const {
    const bool turned = (diagonals >> (3 * zone_of(j, nv) + zone_of(i, nu)) & 1U) != 0;
    const double low = turned ? 1 : 0; // u of the diagonal's end at the lower v
    const Point here = at(i, j, s, t);
    const Point ends[2] = {at(i, j, low, 0), at(i, j, 1 - low, 1)};
    return std::min(distance_to_triangle(here, ends[0], ends[1], at(i, j, 1 - low, 0)),
                    distance_to_triangle(here, ends[0], ends[1], at(i, j, low, 1)));
  }

private:
  [[nodiscard]] Point at(std::size_t i, std::size_t j, double s, double t) const {
    return position_of(reference_sample(net, shape,
                                        (static_cast<double>(i) + s) / static_cast<double>(nu),
                                        (static_cast<double>(j) + t) / static_cast<double>(nv)));
  }
};

template <typename T>
class TimedRates {
public:
  TimedRates(BatchShape shape, Isa isa)
      : shape_(shape), nets_(shaped_patches<T>(kCount, shape).nets),
        views_(simdbezier::ControlNets<T>::packed(nets_.data(), kCount, shape.degree_u,
                                                  shape.degree_v, 3, weights_of(shape))) {
    options_.tolerance = kTolerance;
    run_.isa = isa;
    joined_ = simdbezier::find_topology(views_, topology_);
  }
  void operator()() { (void)run(); }
  std::string check() {
    for (const Status status : {joined_, run()}) {
      if (!status) {
        return std::string(simdbezier::to_string(status));
      }
    }
    const std::size_t values = values_per_patch(shape_);
    for (std::size_t p = 0; p < kCount; ++p) {
      const CutPatch<T> patch{nets_.data() + p * values, shape_, cells_u_[p], cells_v_[p],
                              diagonals_[p]};
      if (!(deviation_[p] <= kTolerance)) {
        return "patch " + std::to_string(p) + " has a larger deviation than was asked for";
      }
      for (std::size_t k = 0; k < 16; ++k) {
        const double place = static_cast<double>(k) / 16;
        if (!(patch.deviation(k % cells_u_[p], 3 * k % cells_v_[p], place, 1 - place / 2) <=
              deviation_[p] * (1 + 1e-9))) {
          return "patch " + std::to_string(p) + " is farther from its triangles than was promised";
        }
      }
    }
    return {};
  }
  [[nodiscard]] double items() const { return kCount; }
  [[nodiscard]] double bytes() const { return 0; }

private:
  Status run() {
    return simdbezier::choose_rates(std::span<const simdbezier::ControlNets<T>>(&views_, 1),
                                    topology_, options_,
                                    {cells_u_, cells_v_, diagonals_, deviation_}, run_)
        .status;
  }

  BatchShape shape_;
  std::span<const T> nets_;
  simdbezier::ControlNets<T> views_;
  simdbezier::Topology topology_;
  simdbezier::RateOptions options_;
  simdbezier::RunOptions run_ = {.threads = 1};
  Status joined_;
  std::vector<std::uint32_t> cells_u_ = std::vector<std::uint32_t>(kCount);
  std::vector<std::uint32_t> cells_v_ = std::vector<std::uint32_t>(kCount);
  std::vector<std::uint16_t> diagonals_ = std::vector<std::uint16_t>(kCount);
  std::vector<double> deviation_ = std::vector<double>(kCount);
};

template <typename T>
class TimedErrors {
public:
  TimedErrors(BatchShape shape, Isa isa)
      : shape_(shape), patches_(shaped_patches<T>(kCount, shape)) {
    options_.threads = 1;
    options_.isa = isa;
  }
  void operator()() { (void)run(); }
  std::string check() {
    if (const Status status = run(); !status) {
      return std::string(simdbezier::to_string(status));
    }
    std::vector<T> points(3 * errors_.size());
    simdbezier::Outputs<T> out;
    out.position = simdbezier::Vectors<T>::xyz(std::span(points));
    const T at[2] = {T(0.3125), T(0.6875)};
    const auto grid = simdbezier::Grid<T>::at(std::span(at, 1), std::span(at + 1, 1));
    if (const Status status = simdbezier::evaluate(patches_.set, grid, out, options_); !status) {
      return std::string(simdbezier::to_string(status));
    }
    constexpr double kOfReference = 1e-14; // its own rounding
    for (std::size_t p = 0; p < errors_.size(); ++p) {
      const T* const found = points.data() + 3 * p;
      const T* const net = patches_.nets.data() + p * values_per_patch(shape_);
      const Point exact = position_of(reference_sample(net, shape_, at[0], at[1]));
      if (!(length(difference(exact, {found[0], found[1], found[2]})) <=
            errors_[p] + kOfReference)) {
        return "patch " + std::to_string(p) + " has a larger error than was promised";
      }
    }
    return {};
  }
  [[nodiscard]] double items() const { return static_cast<double>(errors_.size()); }
  [[nodiscard]] double bytes() const { return 0; }

private:
  Status run() { return simdbezier::position_errors(patches_.set, std::span(errors_), options_); }

  BatchShape shape_;
  const ShapedPatches<T>& patches_;
  simdbezier::Options options_;
  std::vector<double> errors_ = std::vector<double>(patches_.set.size());
};

template <typename T>
class TimedPolylines {
public:
  explicit TimedPolylines(BatchShape shape)
      : row_{shape.degree_u, 0, shape.rational}, nets_(random_nets<T>(kCount / 2, shape)),
        curves_(simdbezier::ControlCurves<T>::packed(nets_.data(), kCount, shape.degree_u, 3,
                                                     weights_of(shape))) {
    options_.tolerance = kTolerance;
  }
  void operator()() { (void)run(); }
  std::string check() {
    if (const Status status = run(); !status) {
      return std::string(simdbezier::to_string(status));
    }
    for (std::size_t k = 0; k < kCount; ++k) {
      const T* const net = nets_.data() + k * values_per_patch(row_);
      const double segments = points_[k] - 1;
      const auto at = [&](double t) { return position_of(reference_sample(net, row_, t, 0)); };
      for (double segment = 0; segment < segments; ++segment) {
        const Point low = at(segment / segments);
        const Point high = at((segment + 1) / segments);
        if (!(distance_to_segment(at((segment + 0.5) / segments), low, high) <=
              std::min(kTolerance, deviation_[k] * (1 + 1e-9)))) {
          return "curve " + std::to_string(k) + " is farther from its polyline than was promised";
        }
      }
    }
    return {};
  }
  [[nodiscard]] double items() const { return kCount; }
  [[nodiscard]] double bytes() const { return 0; }

private:
  Status run() {
    return simdbezier::choose_polylines(curves_, options_, std::span(points_),
                                        std::span(deviation_), {.threads = 1})
        .status;
  }

  BatchShape row_; ///< one curve as a patch
  std::vector<T> nets_;
  simdbezier::ControlCurves<T> curves_;
  simdbezier::FlattenOptions options_;
  std::vector<std::uint32_t> points_ = std::vector<std::uint32_t>(kCount);
  std::vector<double> deviation_ = std::vector<double>(kCount);
};

template <typename T>
std::string name_of(const char* operation, Isa isa, bool rational, const std::string& degree) {
  return std::string("tolerance/") + operation + (sizeof(T) == 4 ? "/f32/" : "/f64/") +
         std::string(simdbezier::to_string(isa)) + "/" + degree + "/cache/threads:1" +
         (rational ? "/weights:rational" : "");
}

template <typename T>
void add_type() {
  const auto unit = benchmark::kMicrosecond;
  for (const Isa isa : simdbezier::available_isas()) {
    for (const BatchShape shape : kShapes) {
      const std::string degree =
          std::to_string(shape.degree_u) + "x" + std::to_string(shape.degree_v);
      register_row(name_of<T>("choose_rates", isa, shape.rational, degree), unit, 1,
                   [=] { return TimedRates<T>(shape, isa); });
      register_row(name_of<T>("position_errors", isa, shape.rational, degree), unit, 1,
                   [=] { return TimedErrors<T>(shape, isa); });
    }
  }
  for (const BatchShape shape : kCurves) {
    register_row(
        name_of<T>("choose_polylines", Isa::scalar, shape.rational, std::to_string(shape.degree_u)),
        unit, 1, [=] { return TimedPolylines<T>(shape); });
  }
}

} // namespace

void register_tolerance_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
