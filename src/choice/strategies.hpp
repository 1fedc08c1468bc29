// Which strategies calls may take, and which of them have been taken: for tests, and for the
// benchmark's --without. Results do not depend on it.
#pragma once

#include <simdbezier/version.hpp>

#include "src/tables/grid_strategy.hpp"

namespace simdbezier::detail {

/// All strategies but those that allow_strategies() has left out. `tiles` is taken wherever no
/// other one is.
[[nodiscard]] StrategySet allowed_strategies() noexcept;
SIMDBEZIER_API void allow_strategies(StrategySet allowed) noexcept;

/// Keeps in mind what a kernel has taken.
void note_strategies(StrategySet taken) noexcept;
/// Returns what kernels have taken since the last call of this function.
[[nodiscard]] SIMDBEZIER_API StrategySet take_strategies() noexcept;

} // namespace simdbezier::detail
