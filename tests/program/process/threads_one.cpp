// Every kind of call on as many threads as the argument says; prints the call that it is at.
// Started where no thread can be had, this shows that calls on one thread start none.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

using namespace simdbezier;

namespace {

constexpr std::size_t kPatches = 256;
constexpr std::size_t kGrid = 16;
constexpr std::size_t kSamples = kPatches * kGrid * kGrid;

void at(const char* call) { std::fprintf(stderr, "%s\n", call); }

void expect(Status status) {
  if (status != Status::ok) {
    std::exit(3);
  }
}
template <typename Report>
void expect(const Report& report) {
  expect(report.status);
}

struct Models {
  std::vector<double> points = std::vector<double>(kPatches * 48);
  ControlNets<double> nets{points.data(), kPatches};
  PatchSet<float> patches;
  CurveSet<float> curves;
  std::vector<float> values = std::vector<float>(3 * kSamples);

  Models() {
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = static_cast<double>((k * 2654435761U) % 1000U);
    }
  }
};

void pack_all(Models& m, const PackOptions& options) {
  at("pack");
  expect(pack(m.nets, m.patches, options));
  at("pack (curves)");
  expect(pack(ControlCurves<double>::packed(m.points.data(), 4 * kPatches, 3), m.curves, options));
  at("iso_u");
  CurveSet<float> iso;
  expect(iso_u(m.nets, 0.25, iso, options));
  expect(iso_v(m.patches, 0.25, iso, options));
  std::vector<double> line(kPatches * 12);
  expect(iso_u(m.nets, 0.25, line, {.threads = options.threads}));
}

void evaluate_patches(Models& m, const Options& options) {
  Outputs<float> out;
  out.position = Vectors<float>::xyz(m.values.data());
  const auto grid = Grid<float>::uniform(kGrid, kGrid);
  at("evaluate, grid");
  expect(evaluate(m.patches, grid, out, options));
  at("evaluate_tiles");
  const auto ignore = [](const Tile<float>&) {};
  expect(evaluate_tiles(m.patches, grid, TileFormat{}, ignore, options));
  at("evaluate, patch grids");
  const std::vector<std::uint32_t> sides(kPatches, kGrid);
  expect(evaluate(m.patches, PatchGrids{sides, sides}, out, options));
  at("evaluate, samples");
  std::vector<std::uint32_t> patch(kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) {
    patch[k] = static_cast<std::uint32_t>(k % kPatches);
  }
  const std::vector<float> u(kSamples, 0.25F);
  const Samples<float> samples{patch, u, u};
  expect(evaluate(m.patches, samples, out, options));
  at("evaluate_derivatives");
  const PartialDerivative<float> third{2, 1, out.position};
  expect(evaluate_derivatives(m.patches, samples, std::span(&third, 1), options));
  expect(evaluate_derivatives(m.patches, grid, std::span(&third, 1), options));
}

void evaluate_all_curves(Models& m, const Options& options) {
  CurveOutputs<float> out;
  out.position = Vectors<float>::xyz(m.values.data());
  const std::size_t curves = 4 * kPatches;
  at("evaluate, curves");
  expect(evaluate(m.curves, CurveGrid<float>::uniform(kGrid), out, options));
  const std::vector<std::uint32_t> sides(curves, kGrid);
  expect(evaluate(m.curves, CurveGrids{sides}, out, options));
  std::vector<std::uint32_t> curve(curves * kGrid);
  std::iota(curve.begin(), curve.end(), 0U);
  for (std::uint32_t& k : curve) {
    k %= static_cast<std::uint32_t>(curves);
  }
  const std::vector<float> t(curve.size(), 0.25F);
  expect(evaluate(m.curves, CurveSamples<float>{curve, t}, out, options));
}

void operate_on_nets(const Models& m, const Options& options) {
  std::vector<double> out(kPatches * 48);
  const auto nets = MutableNets<double>::packed(out.data(), kPatches, 3, 3);
  at("reverse_u");
  expect(reverse_u(m.nets, nets, options));
  at("transpose");
  expect(transpose(m.nets, nets, options));
  at("to_bezier");
  expect(to_bezier(Basis::power, m.nets, nets, options));
  at("flatness");
  expect(flatness(m.nets, out.data(), options));
  at("tight_boxes");
  std::vector<double> high(kPatches * 3);
  expect(tight_boxes(m.nets, 2, Boxes<double>{out.data(), high.data()}, options));
  at("find_adjacency");
  std::vector<EdgeLink> edges(kPatches * 4);
  expect(find_adjacency(m.nets, edges.data(), options));
}

} // namespace

int main(int argc, char** argv) {
  const int threads = argc == 2 ? std::atoi(argv[1]) : 1;
  PackOptions pack_options;
  pack_options.threads = threads;
  Options options;
  options.threads = threads;
  Models models;
  pack_all(models, pack_options);
  evaluate_patches(models, options);
  evaluate_all_curves(models, options);
  operate_on_nets(models, options);
  return 0;
}
