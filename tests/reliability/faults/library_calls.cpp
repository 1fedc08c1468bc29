#include "tests/reliability/faults/library_calls.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>

#include <gtest/gtest.h>

#include "tests/support/random.hpp"

namespace simdbezier::tests {

namespace {

constexpr std::size_t kPatches = 5;

std::vector<float> random_values(std::size_t count) {
  Random random(count);
  std::vector<float> values(count);
  std::ranges::generate(values, [&] { return static_cast<float>(random.unit() + 0.5); });
  return values;
}

template <typename T>
PatchSet<T> packed(std::span<const ControlNets<float>> nets) {
  PatchSet<T> set;
  EXPECT_TRUE(pack(nets, set));
  return set;
}

/// What calls read; never changed.
struct Inputs {
  std::vector<float> values = random_values(1 << 14);
  ControlNets<float> cubic = ControlNets<float>::packed(values.data(), kPatches, 3, 3);
  ControlNets<float> rational =
      ControlNets<float>::packed(values.data(), kPatches, 7, 2, 3, Weights::cartesian);
  std::vector<ControlNets<float>> mixed = {cubic, rational, cubic};
  ControlCurves<float> polygons = ControlCurves<float>::packed(values.data(), kPatches, 7);
  PatchSet<float> set = packed<float>({&cubic, 1});
  PatchSet<float> mixed_set = packed<float>(mixed);
  CurveSet<float> curves;
  std::vector<std::uint32_t> sizes = {3, 200, 5, 40, 7};
  std::vector<std::uint32_t> numbers = std::vector<std::uint32_t>(3000, 2);
  Grid<float> given{300, 200, values.data(), values.data(), Parameters::unit};
  Samples<float> samples{std::span(numbers).first(3000), std::span(values).first(3000),
                         std::span(values).first(3000), Parameters::unit};

  Inputs() { EXPECT_TRUE(pack(polygons, curves)); }
};

const Inputs& inputs() {
  static const Inputs all;
  return all;
}

/// A periodic B-spline surface.
SplineSurface<float> torus(const Inputs& in) {
  SplineSurface<float> surface;
  surface.points = in.values.data();
  surface.rows = 5;
  surface.columns = 6;
  surface.row_stride = 18;
  surface.periodic_u = surface.periodic_v = true;
  return surface;
}

PackOptions pack_options(const Options& options) { return {.threads = options.threads}; }

std::vector<Call> packing() {
  const Inputs& in = inputs();
  return {
      {"pack", true,
       [&](Results& r, const Options& o) { return pack(in.cubic, r.set, pack_options(o)).status; }},
      {"pack, to double", true,
       [&](Results& r, const Options& o) {
         return pack(in.cubic, r.wide, pack_options(o)).status;
       }},
      {"pack, several shapes", true,
       [&](Results& r, const Options& o) {
         return pack(std::span(in.mixed), r.set, pack_options(o)).status;
       }},
      {"pack (curves)", true,
       [&](Results& r, const Options& o) {
         return pack(in.polygons, r.curves, pack_options(o)).status;
       }},
      {"iso_u, of nets", true,
       [&](Results& r, const Options& o) {
         return iso_u(in.rational, 0.25, r.curves, pack_options(o)).status;
       }},
      {"iso_v, of a set", true,
       [&](Results& r, const Options& o) {
         return iso_v(in.set, 0.25, r.curves, pack_options(o)).status;
       }},
      {"iso_u, points", false,
       [&](Results& r, const Options& o) { return iso_u(in.cubic, 0.25, r.doubles, o).status; }},
  };
}

std::vector<Call> grids() {
  const Inputs& in = inputs();
  return {
      {"evaluate, grid, given parameters", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.set, Grid<float>{130, 140, in.values.data(), in.values.data()},
                         r.vertices(), o);
       }},
      {"evaluate, grid, planes past the cache", true,
       [&](Results& r, Options o) {
         o.destination = Destination::memory;
         return evaluate(in.set, Grid<float>::uniform(130, 200), r.planes(), o);
       }},
      {"evaluate, grid, several shapes", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.mixed_set, Grid<float>::uniform(19, 19), r.vertices(), o);
       }},
      {"evaluate, patch grids", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.set, PatchGrids{in.sizes, in.sizes}, r.vertices(), o);
       }},
      {"evaluate, samples", true,
       [&](Results& r, const Options& o) { return evaluate(in.set, in.samples, r.vertices(), o); }},
      {"evaluate, samples, several shapes", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.mixed_set, in.samples, r.vertices(), o);
       }},
      {"evaluate_tiles", true,
       [&](Results& r, const Options& o) {
         const auto count = [&](const Tile<float>& tile) {
           std::atomic_ref<std::size_t>(r.tiles) += tile.samples;
         };
         return evaluate_tiles(in.set, Grid<float>::uniform(200, 200), {}, count, o);
       }},
  };
}

std::vector<Call> derivatives_and_curves() {
  const Inputs& in = inputs();
  return {
      {"evaluate_derivatives, grid", true,
       [&](Results& r, const Options& o) {
         const PartialDerivative<float> wanted[] = {{1, 2, Vectors<float>::xyz(r.at(0), 4)}};
         return evaluate_derivatives<float>(in.set, Grid<float>::uniform(40, 200), wanted, o);
       }},
      {"evaluate_derivatives, scattered", true,
       [&](Results& r, const Options& o) {
         const PartialDerivative<float> wanted[] = {{2, 1, Vectors<float>::xyz(r.at(0), 4)}};
         return evaluate_derivatives<float>(in.mixed_set, in.samples, wanted, o);
       }},
      {"evaluate, curves, common parameters", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.curves, CurveGrid<float>::uniform(700), r.curve_vertices(), o);
       }},
      {"evaluate, curves, counts", true,
       [&](Results& r, const Options& o) {
         return evaluate(in.curves, CurveGrids{in.sizes}, r.curve_vertices(), o);
       }},
      {"evaluate, curves, scattered", true,
       [&](Results& r, const Options& o) {
         const CurveSamples<float> samples{std::span(in.numbers).first(3000),
                                           std::span(in.values).first(3000)};
         return evaluate(in.curves, samples, r.curve_vertices(), o);
       }},
  };
}

/// Operations on nets, which have scratch on the stack or of their own.
std::vector<Call> nets() {
  const Inputs& in = inputs();
  return {
      {"split", true,
       [&](Results& r, const Options& o) {
         const auto out = [&](std::size_t k) { return r.nets(in.rational, k); };
         return split(in.rational, 0.25F, 0.5F, {out(0), out(1), out(2), out(3)}, o).status;
       }},
      {"segment", true,
       [&](Results& r, const Options& o) {
         return segment(in.rational, {0.25F, 0.5F, 0.75F, 1.0F}, r.nets(in.rational), o).status;
       }},
      {"elevate", true,
       [&](Results& r, const Options& o) {
         const auto out = MutableNets<float>::packed(r.at(0), kPatches, 15, 15);
         return elevate(in.cubic, out, o).status;
       }},
      {"reverse_u", false,
       [&](Results& r, const Options& o) {
         return reverse_u(in.rational, r.nets(in.rational), o).status;
       }},
      {"from_bezier", true,
       [&](Results& r, const Options& o) {
         return from_bezier(Basis::centred_power, in.cubic, r.nets(in.cubic), o).status;
       }},
      {"to_bezier, of a spline", true,
       [&](Results& r, const Options& o) {
         return to_bezier(torus(in), MutableNets<float>::packed(r.at(0), 30, 3, 3), {}, o).status;
       }},
      {"pack, of a spline", true,
       [&](Results& r, const Options& o) {
         return pack(torus(in), r.set, {}, pack_options(o)).status;
       }},
      {"tessellate, of a spline", true,
       [&](Results&, const Options& o) {
         const SplineSurface<float> surface = torus(in);
         MeshOptions options;
         options.rates.tolerance = 0.1;
         options.threads = o.threads;
         return tessellate<float>(std::span<const SplineSurface<float>>(&surface, 1), options)
             .report.status;
       }},
      {"tessellate, of an edge and its halves", true,
       [&](Results&, const Options& o) {
         static constexpr float kSquares[] = {0,  0, 0, 2, 0, 0, 0,  2, 0, 2, 2, 0,
                                              -1, 0, 0, 0, 0, 0, -1, 1, 0, 0, 1, 0,
                                              -1, 1, 0, 0, 1, 0, -1, 2, 0, 0, 2, 0};
         MeshOptions options;
         options.nu = options.nv = 2;
         options.split_edges = true;
         options.threads = o.threads;
         return tessellate<float>(ControlNets<float>::packed(&kSquares[0], 3, 1, 1), options)
             .report.status;
       }},
      {"tessellate, of weights that are far apart", true,
       [&](Results&, const Options& o) {
         static constexpr float kQuarter[] = {1, 0, 0, 1, 1, 1, 0, 1000, 0, 1, 0, 1,
                                              1, 0, 1, 1, 1, 1, 1, 1000, 0, 1, 1, 1};
         MeshOptions options;
         options.rates.tolerance = 1e-3;
         options.threads = o.threads;
         return tessellate<float>(
                    ControlNets<float>::packed(&kQuarter[0], 1, 2, 1, 3, Weights::cartesian),
                    options)
             .report.status;
       }},
      {"choose_polylines, of weights that are far apart", true,
       [&](Results&, const Options& o) {
         static constexpr float kQuarters[] = {1, 0, 0, 1, 1, 1, 0, 1000, 0, 1, 0, 1,
                                               1, 0, 1, 1, 1, 1, 1, 1000, 0, 1, 1, 1};
         std::uint32_t points[2];
         FlattenOptions options;
         options.tolerance = 1e-3;
         return choose_polylines(
                    ControlCurves<float>::packed(&kQuarters[0], 2, 2, 3, Weights::cartesian),
                    options, points, {}, o)
             .status;
       }},
      {"evaluate_grid, of a spline", true,
       [&](Results& r, const Options& o) {
         const double at[] = {0, 0.5, 1.5, 3.25, 4};
         Outputs<float> out;
         out.position = {r.at(0), r.at(0) + 25, r.at(0) + 50};
         return evaluate_grid(torus(in), at, at, out, o).status;
       }},
      {"control_boxes", true,
       [&](Results& r, const Options& o) {
         return control_boxes(in.rational, {r.at(0), r.at(1)}, o).status;
       }},
      {"tight_boxes", true,
       [&](Results& r, const Options& o) {
         return tight_boxes(in.rational, 2, {r.at(0), r.at(1)}, o).status;
       }},
      {"flatness", true,
       [&](Results& r, const Options& o) { return flatness(in.rational, r.at(0), o).status; }},
      {"find_adjacency", true,
       [&](Results& r, const Options& o) {
         return find_adjacency(std::span(in.mixed), r.links.data(), o);
       }},
  };
}

} // namespace

Results::Results() : set(inputs().set), curves(inputs().curves) {}

std::vector<Call> all_calls() {
  std::vector<Call> all;
  for (const auto& calls : {packing(), grids(), derivatives_and_curves(), nets()}) {
    all.insert(all.end(), calls.begin(), calls.end());
  }
  return all;
}

} // namespace simdbezier::tests
