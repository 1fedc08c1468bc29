#include <tools/commands/mesh_rates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tools/patches/library_status.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// The distances that are asked for.
struct Tolerances {
  double all = kUnlimited;
  std::string option;         ///< the one that `all` comes from; empty where that is unlimited
  std::vector<double> single; ///< each patch's own, at most `all`; empty without --pixels

  [[nodiscard]] double of(std::size_t patch) const { return single.empty() ? all : single[patch]; }
  [[nodiscard]] std::string option_of(std::size_t patch) const {
    return of(patch) < all ? "--pixels" : option;
  }
  void lower(double tolerance, const char* from) {
    if (tolerance < all) {
      all = tolerance;
      option = from;
    }
  }
};

template <typename T>
Tolerances find_tolerances(const RatedPatches<T>& patches, const MeshArguments& mesh) {
  Tolerances found;
  found.lower(mesh.tolerance.value_or(kUnlimited), "--tolerance");
  if (mesh.relative && patches.diagonal > 0) {
    found.lower(*mesh.relative * patches.diagonal, "--relative");
  }
  if (mesh.pixels) {
    found.single.resize(patches.errors.size());
    check(pixel_tolerances<T>(patches.nets, mesh.camera, *mesh.pixels, found.single));
    for (double& tolerance : found.single) {
      tolerance = std::min(tolerance, found.all);
    }
  }
  return found;
}

// Whether a patch cannot keep its distance, whatever is to blame.
bool is_too_fine(Status status) {
  return status == Status::bad_tolerance || status == Status::snap_too_large;
}

// Whether the patch would have its rates without the angle.
template <typename T>
bool asks_too_small_an_angle(const RatedPatches<T>& patches, RateOptions how,
                             const CertifiedRates& rates, const RunOptions& run,
                             std::size_t patch) {
  how.normal_degrees = kUnlimited;
  const Report report = choose_rates<T>(patches.nets, patches.topology, how, rates, run);
  return !is_too_fine(report.status) || report.item != patch;
}

// Throws a Failure that says why the patch cannot keep its distance: rounding, edges that are moved
// together, or too many cells.
template <typename T>
[[noreturn]] void refuse_distance(const RatedPatches<T>& patches, const MeshArguments& mesh,
                                  const Tolerances& tolerances, const Report& report) {
  const std::size_t patch = report.item;
  const std::string name = patches.describe(patch);
  const double found = tolerances.of(patch);
  const double error = patches.errors[patch] + patches.storage_error;
  if (found == kUnlimited || !std::isfinite(error)) {
    bad_input(resolution_options(mesh) + ": expected a patch whose error of rounding is bounded, " +
              "found " + name);
  }
  const std::string option = tolerances.option_of(patch);
  if (!(found > error)) {
    bad_input(
        option + ": expected a distance above the error of rounding, " + shortest(error) +
        (patches.far && mesh.origin == std::nullopt ? " (--origin auto makes it smaller)" : "") +
        ", found " + shortest(found) + " for " + name);
  }
  if (report.status == Status::snap_too_large) {
    const bool snapped = mesh.snap >= mesh.point_size;
    bad_input((snapped ? "--snap" : "--point-size") +
              (": expected a distance that leaves room within " + option) + ", " + shortest(found) +
              ", found " + shortest(snapped ? mesh.snap : mesh.point_size) + " for " + name);
  }
  bad_input(option + ": expected a distance that " + std::to_string(kMostSegments) +
            " cells a direction can keep, found " + shortest(found) + " for " + name);
}

// The tolerance that leaves room for what storing adds: a little less than the difference, because
// stated deviations are sums that are rounded upwards.
double without(double tolerance, double storage_error) {
  return storage_error == 0 || tolerance == kUnlimited
             ? tolerance
             : std::max(tolerance - storage_error - 0x1p-50 * tolerance,
                        std::numeric_limits<double>::min());
}

// Whether deviations are within tolerances also when storing has added to them, as is usual.
bool keep(const Tolerances& tolerances, std::span<const double> deviations, double storage_error) {
  for (std::size_t patch = 0; patch < deviations.size(); ++patch) {
    if (deviations[patch] > without(tolerances.of(patch), storage_error)) {
      return false;
    }
  }
  return true;
}

template <typename T>
void choose_adaptive(const RatedPatches<T>& patches, const Arguments& arguments,
                     const CertifiedRates& rates) {
  const MeshArguments& mesh = arguments.mesh;
  const Tolerances tolerances = find_tolerances(patches, mesh);
  RateOptions how;
  how.errors = patches.errors;
  how.normal_degrees = mesh.angle.value_or(kUnlimited);
  const RunOptions run{.threads = arguments.threads};
  std::vector<double> single;
  const auto choose = [&](double storage_error) {
    single.resize(tolerances.single.size());
    std::ranges::transform(tolerances.single, single.begin(),
                           [&](double t) { return without(t, storage_error); });
    how.tolerance = without(tolerances.all, storage_error);
    how.tolerances = single;
    return choose_rates<T>(patches.nets, patches.topology, how, rates, run);
  };
  Report report = choose(0);
  if (report.status && !keep(tolerances, rates.deviation, patches.storage_error)) {
    report = choose(patches.storage_error);
  }
  if (is_too_fine(report.status)) {
    if (mesh.angle && asks_too_small_an_angle(patches, how, rates, run, report.item)) {
      bad_input("--angle: expected degrees that " + std::to_string(kMostSegments) +
                " cells a direction can keep, found " + shortest(*mesh.angle) + " for " +
                patches.describe(report.item));
    }
    refuse_distance(patches, mesh, tolerances, report);
  }
  check(report.status);
}

template <typename T>
void choose_uniform(const RatedPatches<T>& patches, const Arguments& arguments,
                    const CertifiedRates& rates) {
  const GridSize& grid = arguments.grid;
  if (std::max(grid.nu, grid.nv) > kMostSegments + 1) {
    bad_usage("--grid: expected at most " + std::to_string(kMostSegments + 1) +
              " samples a direction without --no-weld, found " + std::to_string(grid.nu) + "x" +
              std::to_string(grid.nv));
  }
  std::ranges::fill(rates.cells_u, static_cast<std::uint32_t>(grid.nu - 1));
  std::ranges::fill(rates.cells_v, static_cast<std::uint32_t>(grid.nv - 1));
  std::size_t raised = 0;
  check(separate_vertices(patches.topology, rates.cells_u, rates.cells_v, raised));
  check(certify_rates<T>(patches.nets, patches.topology, patches.errors, rates,
                         {.threads = arguments.threads})
            .status);
}

} // namespace

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

template <typename T>
MeshRates choose_mesh_rates(const RatedPatches<T>& patches, const Arguments& arguments) {
  const std::size_t count = patches.errors.size();
  MeshRates chosen;
  chosen.cells_u.resize(count);
  chosen.cells_v.resize(count);
  chosen.diagonals.resize(count);
  chosen.deviations.resize(count);
  const CertifiedRates rates{chosen.cells_u, chosen.cells_v, chosen.diagonals, chosen.deviations};
  arguments.mesh.adaptive() ? choose_adaptive(patches, arguments, rates)
                            : choose_uniform(patches, arguments, rates);
  // Nothing is claimed to be exact, even if no rounding can be found.
  const auto own = std::span(chosen.deviations).subspan(patches.own.first, patches.own.count);
  chosen.deviation = std::max(std::ranges::max(own), std::numeric_limits<double>::min());
  return chosen;
}

template MeshRates choose_mesh_rates(const RatedPatches<float>&, const Arguments&);
template MeshRates choose_mesh_rates(const RatedPatches<double>&, const Arguments&);

} // namespace simdbezier::tools
