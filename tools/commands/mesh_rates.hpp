// How many cells every patch of a mesh gets, as the command line asks for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>

namespace simdbezier::tools {

/// The cells of every patch, one value a patch, and the certified deviation of all.
struct MeshRates {
  std::vector<std::uint32_t> cells_u;
  std::vector<std::uint32_t> cells_v;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviations;
  double deviation = 0;
};

/// What rates depend on.
template <typename T>
struct RatedPatches {
  std::span<const ControlNets<T>> nets;
  const Topology& topology;
  std::span<const double> errors;         ///< what rounding adds, for each patch
  SetRange own;                           ///< those whose deviation counts
  double diagonal;                        ///< the diagonal of the box of all control points
  double storage_error;                   ///< what the file's format adds
  bool far;                               ///< whether an origin of their own would be better
  const std::string& name;                ///< the name of their file, for messages
  std::span<const std::uint32_t> numbers; ///< those of patches in the file; empty: 0, 1, 2, …

  [[nodiscard]] std::string describe(std::size_t patch) const {
    return "patch " + std::to_string(numbers.empty() ? patch : numbers[patch]) + " of " + name;
  }
};

/// The options that say how fine a mesh is, for messages about all of it: "--relative and --angle",
/// or "--grid" where it is not adaptive.
[[nodiscard]] std::string resolution_options(const MeshArguments& mesh);

/// Throws Failure that names the option whose wish cannot be met.
template <typename T>
[[nodiscard]] MeshRates choose_mesh_rates(const RatedPatches<T>& patches,
                                          const Arguments& arguments);

} // namespace simdbezier::tools
