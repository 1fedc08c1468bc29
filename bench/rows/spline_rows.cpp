// A clamped bicubic NURBS surface of 64 x 64 spans, in double:
//
//   spline/<outputs>/f64/<who>/1024x1024/memory/threads:1   a grid in its own parameters, by one
//   call
//                                                           from control points and knots on
//   spline_nets/position/f64/<who>/64x64/cache/threads:1    Bézier nets of all spans
//   spline_pack/…                                           a set of them, without nets in between
//   spline_pack_alone/…                                     packing nets that are there already
//
// Items are samples or patches. The peer is Open CASCADE, whose spans are evaluated by an adaptor
// and made Bézier surfaces by GeomConvert.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/peers/peers.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/place.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using Surface = simdbezier::SplineSurface<double>;

constexpr std::size_t kSpans = 64;
constexpr std::size_t kPoints = kSpans + 3;
constexpr std::size_t kSamples = 1024;
constexpr std::size_t kPatches = kSpans * kSpans;

/// The surface's memory: a wavy sheet with unequal knots and weights.
struct Model {
  std::vector<double> net;
  std::vector<double> knots;
  std::vector<double> at;
  Surface surface;

  Model() {
    for (std::size_t k = 0; k < kPoints + 4; ++k) {
      const double inner = static_cast<double>(k) - 3;
      const double knot = inner + 0.3 * std::sin(2.0 * inner);
      knots.push_back(k < 4 ? 0 : k >= kPoints ? static_cast<double>(kSpans) : knot);
    }
    for (std::size_t k = 0; k < kPoints * kPoints; ++k) {
      const auto x = static_cast<double>(k % kPoints);
      const auto y = static_cast<double>(k / kPoints);
      const double w = 1 + 0.25 * std::sin(0.7 * x + 0.4 * y);
      net.insert(net.end(), {w * x, w * y, w * std::sin(0.5 * x) * std::cos(0.3 * y), w});
    }
    for (std::size_t k = 0; k < kSamples; ++k) {
      at.push_back(static_cast<double>(kSpans * k) / (kSamples - 1));
    }
    surface.points = net.data();
    surface.rows = surface.columns = kPoints;
    surface.row_stride = 4 * kPoints;
    surface.point_stride = 4;
    surface.weights = simdbezier::Weights::homogeneous;
    surface.knots_u = surface.knots_v = knots;
  }
};

const Model& model() {
  static const Model only;
  return only;
}

/// The cubic B-splines that are not zero at t, by the recursion of Cox and de Boor, and the first.
std::size_t basis_at(long double t, long double (&values)[4]) {
  const std::vector<double>& knots = model().knots;
  std::size_t span = 3;
  while (span + 1 < kPoints && knots[span + 1] <= t) {
    ++span;
  }
  values[0] = 1;
  for (std::size_t r = 1; r <= 3; ++r) {
    long double rest = 0;
    for (std::size_t k = 0; k < r; ++k) {
      const long double right = knots[span + k + 1] - t;
      const long double left = t - knots[span + 1 + k - r];
      const long double share = values[k] / (right + left);
      values[k] = rest + right * share;
      rest = left * share;
    }
    values[r] = rest;
  }
  return span - 3;
}

/// Compares some positions with the definition.
std::string check_positions(const Results<double>& out) {
  for (std::size_t k = 0; k < kSamples * kSamples; k += 997) {
    long double u[4];
    long double v[4];
    const std::size_t column = basis_at(model().at[k % kSamples], u);
    const std::size_t row = basis_at(model().at[k / kSamples], v);
    long double sum[4] = {};
    for (std::size_t n = 0; n < 64; ++n) {
      const std::size_t point = (row + n / 16) * kPoints + column + n / 4 % 4;
      sum[n % 4] += v[n / 16] * u[n / 4 % 4] * model().net[4 * point + n % 4];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const long double apart = out.component[c][k] - sum[c] / sum[3];
      if (!(std::fabs(apart) <= 1e-12L)) {
        return "sample " + std::to_string(k) + " is wrong";
      }
    }
  }
  return {};
}

/// What is timed: a call, and the check of what it has done.
struct SplineRow {
  std::function<void()> call;
  std::function<std::string()> verify;
  double count;
  double written;

  void operator()() const { call(); }
  [[nodiscard]] std::string check() const { return verify(); }
  [[nodiscard]] double items() const { return count; }
  [[nodiscard]] double bytes() const { return written; }
};

SplineJob job_of(OutputGroups outputs) {
  SplineJob job;
  job.net = model().net.data();
  job.points = kPoints;
  job.knots = model().knots.data();
  job.at = model().at.data();
  job.samples = kSamples;
  job.out = place_results<double>(outputs, kSamples * kSamples, Layout::planes);
  return job;
}

SplineRow grid_row(OutputGroups outputs, const std::function<void()>& call, const SplineJob& job) {
  const double samples = kSamples * kSamples;
  return {call,
          [call, job] {
            call();
            return check_positions(job.out);
          },
          samples, samples * static_cast<double>(3 * group_count(outputs) * sizeof(double))};
}

SplineRow library_grid(OutputGroups outputs, Isa isa) {
  const SplineJob job = job_of(outputs);
  const auto call = [job, isa] {
    simdbezier::Options options;
    options.threads = 1;
    options.isa = isa;
    (void)simdbezier::evaluate_grid(model().surface, model().at, model().at,
                                    library_outputs(job.out), options);
  };
  return grid_row(outputs, call, job);
}

/// Nets of all spans, and a set; shared by the copies of a row.
struct Made {
  std::vector<double> values = std::vector<double>(kPatches * 64);
  simdbezier::PatchSet<double> set;
  simdbezier::PackOptions packing;
  simdbezier::Options options;

  explicit Made(Isa isa) {
    packing.threads = options.threads = 1;
    packing.isa = options.isa = isa;
    packing.reuse_memory = true;
  }
  simdbezier::MutableNets<double> nets() {
    return simdbezier::MutableNets<double>::packed(values.data(), kPatches, 3, 3, 3,
                                                   simdbezier::Weights::homogeneous);
  }
};

enum class Product { nets, set, set_of_nets };

SplineRow library_patches(Product product, Isa isa) {
  const auto made = std::make_shared<Made>(isa);
  (void)simdbezier::to_bezier(model().surface, made->nets());
  const auto call = [made, product]() -> simdbezier::Status {
    switch (product) {
    case Product::nets:
      return simdbezier::to_bezier(model().surface, made->nets(), {}, made->options).status;
    case Product::set:
      return simdbezier::pack(model().surface, made->set, {}, made->packing).status;
    case Product::set_of_nets:
      break;
    }
    return simdbezier::pack(simdbezier::ControlNets<double>(made->nets()), made->set, made->packing)
        .status;
  };
  return {[call] { (void)call(); },
          [call] {
            const simdbezier::Status status = call();
            return status ? std::string() : std::string(simdbezier::to_string(status));
          },
          kPatches, 0};
}

void add(const char* call, OutputGroups outputs, const std::string& who, std::size_t size,
         MemoryLevel level, const std::function<SplineRow()>& make) {
  const RowName name{call, outputs, false, who, size, size, level, 1};
  register_row(name.text(), benchmark::kMillisecond, 1, make);
}

constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives};

#if defined(SIMDBEZIER_BENCH_WITH_OPENCASCADE_SPLINE)
void add_opencascade() {
  for (const OutputGroups outputs : kOutputs) {
    add("spline", outputs, "opencascade", kSamples, MemoryLevel::memory, [outputs] {
      const SplineJob job = job_of(outputs);
      return grid_row(outputs, prepare_opencascade_spline(job), job);
    });
  }
  add("spline_nets", OutputGroups::position, "opencascade", kSpans, MemoryLevel::cache, [] {
    const std::function<void()> call = prepare_opencascade_patches(job_of(OutputGroups::position));
    return SplineRow{call, [] { return std::string(); }, kPatches, 0};
  });
}
#endif

} // namespace

void register_spline_rows() {
  for (const Isa isa : simdbezier::available_isas()) {
    const std::string who(simdbezier::to_string(isa));
    for (const OutputGroups outputs : kOutputs) {
      add("spline", outputs, who, kSamples, MemoryLevel::memory,
          [outputs, isa] { return library_grid(outputs, isa); });
    }
    const struct {
      const char* call;
      Product product;
    } products[] = {{"spline_nets", Product::nets},
                    {"spline_pack", Product::set},
                    {"spline_pack_alone", Product::set_of_nets}};
    for (const auto& [call, product] : products) {
      add(call, OutputGroups::position, who, kSpans, MemoryLevel::cache,
          [product, isa] { return library_patches(product, isa); });
    }
  }
#if defined(SIMDBEZIER_BENCH_WITH_OPENCASCADE_SPLINE)
  add_opencascade();
#endif
}

} // namespace simdbezier_bench
