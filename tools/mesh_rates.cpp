#include <tools/mesh_rates.hpp>

#include <algorithm>
#include <limits>

#include <tools/failure.hpp>
#include <tools/library_status.hpp>
#include <tools/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// What is asked of single patches; of all of them, where there is nothing for single ones.
struct Tolerances {
  double all = 0;
  std::vector<double> single;

  [[nodiscard]] double of(std::size_t patch) const { return single.empty() ? all : single[patch]; }
};

template <typename T>
Tolerances find_tolerances(const RatedPatches<T>& patches, const MeshArguments& mesh) {
  Tolerances found;
  found.all = mesh.tolerance.value_or(kUnlimited);
  if (mesh.relative && patches.diagonal > 0) {
    found.all = std::min(found.all, *mesh.relative * patches.diagonal);
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

[[noreturn]] void refuse(const MeshArguments& mesh, double found, double error,
                         const std::string& patch) {
  const char* const option = mesh.tolerance  ? "--tolerance"
                             : mesh.relative ? "--relative"
                             : mesh.pixels   ? "--pixels"
                                             : "--angle";
  const std::string needed =
      found > error
          ? "a distance that " + std::to_string(kMostSegments) + " cells a direction can keep"
          : "a distance above the error of rounding, " + shortest(error);
  bad_input(std::string(option) + ": expected " + needed + ", found " + shortest(found) + " for " +
            patch);
}

template <typename T>
void choose_adaptive(const RatedPatches<T>& patches, const Arguments& arguments,
                     const CertifiedRates& rates) {
  const Tolerances tolerances = find_tolerances(patches, arguments.mesh);
  RateOptions how;
  how.tolerance = tolerances.all;
  how.tolerances = tolerances.single;
  how.errors = patches.errors;
  how.normal_angle = arguments.mesh.angle.value_or(how.normal_angle);
  how.threads = arguments.threads;
  const RateReport report = choose_rates<T>(patches.nets, patches.topology, how, rates);
  if (report.status == Status::bad_tolerance) {
    refuse(arguments.mesh, tolerances.of(report.patch), patches.errors[report.patch],
           "patch " + std::to_string(report.patch) + " of " + patches.name);
  }
  check(report.status);
}

template <typename T>
void choose_uniform(const RatedPatches<T>& patches, const Arguments& arguments,
                    const CertifiedRates& rates) {
  const GridSize& grid = arguments.grid;
  if (std::max(grid.nu, grid.nv) > kMostSegments + 1) {
    bad_input("--grid: expected at most " + std::to_string(kMostSegments + 1) +
              " samples a direction without --no-weld, found " + std::to_string(grid.nu) + "x" +
              std::to_string(grid.nv));
  }
  std::ranges::fill(rates.nu, static_cast<std::uint32_t>(grid.nu - 1));
  std::ranges::fill(rates.nv, static_cast<std::uint32_t>(grid.nv - 1));
  std::size_t raised = 0;
  check(separate_vertices(patches.topology, rates.nu, rates.nv, raised));
  check(certify_rates<T>(patches.nets, patches.topology, patches.errors, rates, arguments.threads)
            .status);
}

} // namespace

template <typename T>
MeshRates choose_mesh_rates(const RatedPatches<T>& patches, const Arguments& arguments) {
  const std::size_t count = patches.errors.size();
  MeshRates chosen;
  chosen.nu.resize(count);
  chosen.nv.resize(count);
  chosen.diagonals.resize(count);
  std::vector<double> deviations(count);
  const CertifiedRates rates{chosen.nu, chosen.nv, chosen.diagonals, deviations};
  arguments.mesh.adaptive() ? choose_adaptive(patches, arguments, rates)
                            : choose_uniform(patches, arguments, rates);
  // Nothing is claimed to be exact, even if no rounding can be found.
  chosen.deviation = std::max(std::ranges::max(deviations), std::numeric_limits<double>::min());
  return chosen;
}

template MeshRates choose_mesh_rates(const RatedPatches<float>&, const Arguments&);
template MeshRates choose_mesh_rates(const RatedPatches<double>&, const Arguments&);

} // namespace simdbezier::tools
