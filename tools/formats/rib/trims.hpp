// TrimCurve of RIB files: loops in the plane of parameters that restrict the surfaces behind them.
#pragma once

#include <cstddef>
#include <optional>

#include <simdbezier/splines.hpp>
#include <tools/formats/rib/tokens.hpp>

namespace simdbezier::tools {

/// A rectangle of parameters.
struct RibRectangle {
  Interval u;
  Interval v;
  friend bool operator==(const RibRectangle&, const RibRectangle&) = default;
};

struct RibTrim {
  std::size_t line = 0; ///< 0: nothing is restricted
  /// What its only loop runs around once, if it does. A surface on that rectangle is left whole.
  std::optional<RibRectangle> rectangle;
};

/// Reads the nine lists behind TrimCurve, whose name is the current token. No loops restrict
/// nothing.
[[nodiscard]] RibTrim read_rib_trim(RibTokens& tokens);

} // namespace simdbezier::tools
