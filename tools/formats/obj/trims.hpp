// Trimming curves of OBJ files: curves in the plane of parameters (curv2) and what names them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tools/formats/input/lexer.hpp>
#include <tools/formats/obj/state.hpp>
#include <tools/formats/obj/surface.hpp>
#include <tools/formats/surfaces/parameter_boundary.hpp>

namespace simdbezier::tools {

/// The trimming curves of one surface.
struct ObjTrims {
  std::size_t line = 0; ///< of the first trim or hole; 0: there is none
  std::string keyword;
  bool known = true; ///< the boundary is all there is
  ParameterBoundary boundary;
};

/// The points and curves of a file that trimming curves consist of.
class ObjCurves {
public:
  /// Reads what follows vp: u, v where there is one, and a weight.
  void read_point(Lexer& lexer);
  /// Reads what follows curv2, a list of such points, …
  void begin_curve(Lexer& lexer, const ObjState& state);
  [[nodiscard]] bool in_curve() const noexcept { return curve_.has_value(); }
  /// … then come its parameters, and its end.
  void set_parameters(std::vector<double> parameters) { parameters_ = std::move(parameters); }
  void end_curve();

  /// Reads what follows trim or hole: parts of curves.
  void read_trim(Lexer& lexer, ObjTrims& trims) const;

private:
  /// A curve that ends in its first and its last point; without points it is of another kind.
  struct Curve {
    std::optional<ObjType> type = std::nullopt;
    std::size_t degree = 1;
    std::vector<ParameterBoundary::Point> points;
    Interval range = {};
  };
  std::vector<std::array<double, 3>> points_; // u v w
  std::vector<Curve> curves_;
  std::optional<Curve> curve_; // the one that is being read
  std::vector<double> parameters_;
};

/// Checks a surface that has all of its statements, and leaves the part of it that its range and
/// its trimming curves leave.
void finish_obj_surface(const Lexer& lexer, PatchFile& file, ObjSurface& surface,
                        const ObjTrims& trims, bool ignore_trims);

/// Reads a reference to one of `count` things, and counts it from 0. `what` names one.
[[nodiscard]] std::uint32_t obj_index(const Lexer& lexer, std::size_t count, const char* what);

} // namespace simdbezier::tools
