// A viewer's loop: in every frame, each patch gets the fewest cells that are off by half a pixel at
// most, and all patches make one mesh without gaps. Edges are joined once; memory only grows.
#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "seed/wavy_sheet.hpp"

using namespace simdbezier;

namespace {

/// What stays from frame to frame.
struct Model {
  std::vector<std::array<float, 3>> points = seed::wavy_sheet(16);
  PatchSet<float> set;
  Topology topology;
  std::vector<double> errors, tolerances, deviations;
  std::vector<std::uint32_t> cells_u, cells_v;
  std::vector<std::uint16_t> diagonals;
  std::vector<float> vertices; ///< x y z nx ny nz
  std::vector<std::uint32_t> triangles;

  [[nodiscard]] ControlNets<float> nets() const { return ControlNets<float>::packed(points); }
};

Status prepare(Model& model) {
  if (const Report report = pack(model.nets(), model.set); !report) {
    return report.status;
  }
  const std::size_t patches = model.set.size();
  for (std::vector<double>* const values : {&model.errors, &model.tolerances, &model.deviations}) {
    values->resize(patches);
  }
  model.cells_u.resize(patches);
  model.cells_v.resize(patches);
  model.diagonals.resize(patches);
  const Status status = position_errors(model.set, model.errors);
  return status ? find_topology(model.nets(), model.topology) : status;
}

/// Rates, then the mesh.
Status draw(Model& model, const Camera& camera, MeshSize& size) {
  const ControlNets<float> nets = model.nets();
  const std::span one(&nets, 1);
  if (const Status status = pixel_tolerances(one, camera, 0.5, model.tolerances); !status) {
    return status;
  }
  RateOptions options;
  options.tolerances = model.tolerances;
  options.errors = model.errors;
  const Report chosen =
      choose_rates(one, model.topology, options,
                   {model.cells_u, model.cells_v, model.diagonals, model.deviations});
  MeshLayout layout;
  Status status = chosen.status;
  status =
      status ? lay_out_mesh(model.topology, {model.cells_u, model.cells_v, model.diagonals}, layout)
             : status;
  if (!status) {
    return status;
  }
  size = layout.size();
  model.vertices.resize(std::max(model.vertices.size(), 6 * size.vertices));
  model.triangles.resize(std::max(model.triangles.size(), 3 * size.triangles));
  MeshOutputs<float> out;
  out.position = Vectors<float>::xyz(std::span(model.vertices), 6);
  out.normal = Vectors<float>::xyz(std::span(model.vertices).subspan(3), 6);
  status = evaluate_mesh(model.set, layout, out);
  return status ? write_triangles(layout, std::span(model.triangles)) : status;
}

} // namespace

int main() {
  Model model;
  if (Status status = prepare(model); !status) {
    return std::puts(to_string(status).data());
  }
  std::size_t before = 0;
  for (const double distance : {1000.0, 100.0, 10.0}) {
    Camera camera;
    camera.eye = {8, 8, distance};
    MeshSize size;
    if (Status status = draw(model, camera, size); !status) {
      return std::puts(to_string(status).data());
    }
    const double seen = *std::max_element(model.deviations.begin(), model.deviations.end());
    const double pixel = *std::max_element(model.tolerances.begin(), model.tolerances.end());
    std::printf("from %4g away: %s triangles, %s\n", distance,
                size.triangles > before ? "more" : "not more",
                seen <= pixel ? "within half a pixel" : "too coarse");
    before = size.triangles;
  }
}
