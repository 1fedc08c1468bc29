#include <tools/commands/meshes/mesh_plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tools/patches/library_status.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// The options that say how fine a mesh is, for messages about all of it: "--relative and --angle",
// or "--grid" if it is not adaptive.
std::string resolution_options(const MeshArguments& mesh) {
  std::string names;
  const auto add = [&](const std::optional<double>& wish, const char* option) {
    names += !wish ? "" : (names.empty() ? "" : " and ") + std::string(option);
  };
  add(mesh.tolerance, "--tolerance");
  add(mesh.relative, "--relative");
  add(mesh.pixels, "--pixels");
  add(mesh.angle, "--angle");
  return names.empty() ? "--grid" : names;
}

double relative_distance(const MeshArguments& mesh, const PlannedModel& model) {
  return mesh.relative && model.diagonal > 0 ? *mesh.relative * model.diagonal : kUnlimited;
}

// The option that a patch's tolerance comes from.
std::string distance_option(const MeshArguments& mesh, const PlannedModel& model,
                            double tolerance) {
  const double all = mesh.tolerance.value_or(kUnlimited);
  const double relative = relative_distance(mesh, model);
  return tolerance < std::min(all, relative) ? "--pixels"
         : relative < all                    ? "--relative"
                                             : "--tolerance";
}

void set_resolution(const Arguments& arguments, const PlannedModel& model, MeshOptions& options) {
  const MeshArguments& mesh = arguments.mesh;
  if (!mesh.adaptive()) {
    expect_grid_of_mesh(arguments);
    options.nu = static_cast<std::uint32_t>(arguments.grid.nu);
    options.nv = static_cast<std::uint32_t>(arguments.grid.nv);
    return;
  }
  options.rates.tolerance =
      std::min(mesh.tolerance.value_or(kUnlimited), relative_distance(mesh, model));
  if (model.diagonal == 0) { // no distance, and yet a wish
    options.relative_tolerance = mesh.relative.value_or(kUnlimited);
  }
  options.pixels = mesh.pixels.value_or(kUnlimited);
  options.camera = mesh.camera;
  options.rates.normal_degrees = mesh.angle.value_or(kUnlimited);
  options.rates.thorough = mesh.thorough;
}

} // namespace

void expect_grid_of_mesh(const Arguments& arguments) {
  const GridSize& grid = arguments.grid;
  if (arguments.mesh.weld && std::max(grid.nu, grid.nv) > kMostSegments + 1) {
    bad_usage("--grid: expected at most " + std::to_string(kMostSegments + 1) +
              " samples a direction without --no-weld, found " + std::to_string(grid.nu) + "x" +
              std::to_string(grid.nv));
  }
}

MeshOptions mesh_options(const Arguments& arguments, const PlannedModel& model) {
  const MeshArguments& mesh = arguments.mesh;
  MeshOptions options;
  set_resolution(arguments, model, options);
  options.topology = {mesh.point_size, mesh.orient, mesh.flip, mesh.snap};
  options.split_edges = mesh.split_edges;
  options.drop_repeated = mesh.drop_repeated;
  options.crease_degrees = mesh.crease.value_or(kUnlimited);
  options.parameters = mesh.parameters;
  options.threads = arguments.threads;
  return options;
}

template <typename T>
std::vector<double> tolerances_without(double storage_error, std::span<const ControlNets<T>> nets,
                                       const MeshOptions& options) {
  std::vector<double> tolerances(options.rates.errors.size(), kUnlimited);
  if (options.pixels != kUnlimited) {
    check(pixel_tolerances<T>(nets, options.camera, options.pixels, tolerances));
  }
  for (double& tolerance : tolerances) {
    // A little less than the difference: stated deviations are sums that are rounded upwards.
    const double asked = std::min(tolerance, options.rates.tolerance);
    tolerance =
        storage_error == 0 || asked == kUnlimited
            ? asked
            : std::max(asked - storage_error - 0x1p-50 * asked, std::numeric_limits<double>::min());
  }
  return tolerances;
}

void check_plan(const Report& report, const RateFault& fault, const Arguments& arguments,
                const PlannedModel& model, double storage_error) {
  const MeshArguments& mesh = arguments.mesh;
  if (report.status == Status::not_orientable) {
    bad_input("--orient: expected patches that can be turned to agree with their neighbours, found "
              "a surface of one side in " +
              model.name);
  }
  if (report.status == Status::size_overflow) {
    bad_input(resolution_options(mesh) + ": expected at most " + std::to_string(kMostMeshVertices) +
              " vertices, found more");
  }
  if (fault.limit == RateLimit::none) {
    return check(report.status);
  }
  const std::string name =
      "patch " + std::to_string(model.numbers.empty() ? report.item : model.numbers[report.item]) +
      " of " + model.name;
  if (fault.limit == RateLimit::angle) {
    bad_input("--angle: expected degrees that " + std::to_string(kMostSegments) +
              " cells a direction can keep, found " + shortest(*mesh.angle) + " for " + name);
  }
  const double error = fault.error + storage_error;
  if (fault.tolerance == kUnlimited || !std::isfinite(error)) {
    bad_input(resolution_options(mesh) +
              ": expected a patch whose error of rounding is bounded, found " + name);
  }
  const double asked = fault.tolerance;
  const std::string option = distance_option(mesh, model, asked);
  if (!(asked > error)) {
    bad_input(
        option + ": expected a distance above the error of rounding, " + shortest(error) +
        (model.far && mesh.origin == std::nullopt ? " (--origin auto makes it smaller)" : "") +
        ", found " + shortest(asked) + " for " + name);
  }
  if (fault.limit == RateLimit::snap) {
    const bool snapped = mesh.snap >= mesh.point_size;
    bad_input((snapped ? "--snap" : "--point-size") +
              (": expected a distance that leaves room within " + option) + ", " + shortest(asked) +
              ", found " + shortest(snapped ? mesh.snap : mesh.point_size) + " for " + name);
  }
  bad_input(option + ": expected a distance that " + std::to_string(kMostSegments) +
            " cells a direction can keep, found " + shortest(asked) + " for " + name);
}

template std::vector<double> tolerances_without(double, std::span<const ControlNets<float>>,
                                                const MeshOptions&);
template std::vector<double> tolerances_without(double, std::span<const ControlNets<double>>,
                                                const MeshOptions&);

} // namespace simdbezier::tools
