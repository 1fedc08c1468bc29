// The library's plan of a mesh, as the command line asks for it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>

namespace simdbezier::tools {

/// The model of a plan, or of a part of it, for messages and for what depends on all of it.
struct PlannedModel {
  const std::string& name;                ///< the file's
  double diagonal;                        ///< of the box of all control points
  bool far;                               ///< whether an origin of its own would be better
  std::span<const std::uint32_t> numbers; ///< of the patches in the file; empty: 0, 1, 2, …
};

/// Throws Failure where a mesh without gaps cannot have such a grid.
void expect_grid_of_mesh(const Arguments& arguments);

/// Returns the options that the command line asks for. Throws Failure that names an option whose
/// wish no mesh can meet.
[[nodiscard]] MeshOptions mesh_options(const Arguments& arguments, const PlannedModel& model);

/// Returns the tolerance of every patch of `nets`, less what storing adds to distances. options:
/// with RateOptions::errors.
template <typename T>
[[nodiscard]] std::vector<double> tolerances_without(double storage_error,
                                                     std::span<const ControlNets<T>> nets,
                                                     const MeshOptions& options);

/// Does nothing for a plan that was made. Otherwise throws Failure that names the option whose wish
/// cannot be met, and the patch. storage_error: what the file's format adds to distances.
void check_plan(const Report& report, const RateFault& fault, const Arguments& arguments,
                const PlannedModel& model, double storage_error);

} // namespace simdbezier::tools
