// Patch, PatchMesh and NuPatch of RIB files.
#pragma once

#include <string>

#include <tools/formats/rib/scopes.hpp>
#include <tools/formats/rib/shape.hpp>
#include <tools/formats/rib/tokens.hpp>

namespace simdbezier::tools {

/// Reads surfaces, each from its request, which is the current token, to the first token behind it.
/// Its points are added to the file, and what is to be done with them is returned.
class RibSurfaces {
public:
  RibSurfaces(RibTokens& tokens, PatchFile& file, bool ignore_trims)
      : tokens_(tokens), file_(file), ignore_trims_(ignore_trims) {}

  [[nodiscard]] static bool reads(std::string_view request) {
    return request == "Patch" || request == "PatchMesh" || request == "NuPatch";
  }
  [[nodiscard]] RibShape read(const RibState& state);

private:
  void patch(const RibState& state, bool is_mesh, RibShape& shape);
  [[nodiscard]] MeshDirection direction(int degree, const RibBasis& basis, const std::string& name);
  [[nodiscard]] SplineDirection spline_direction(const std::string& name);
  void check_trim(const RibState& state, RibShape& shape) const;
  void parameters(RibShape& shape);
  void read_points(const RibShape& shape, bool has_means);

  RibTokens& tokens_;
  PatchFile& file_;
  bool ignore_trims_;
};

} // namespace simdbezier::tools
