// simdbezier: many Bézier patches at many parameters in one call.
#pragma once

#include <simdbezier/certificate.hpp>  // IWYU pragma: export
#include <simdbezier/control_nets.hpp> // IWYU pragma: export
#include <simdbezier/evaluate.hpp>     // IWYU pragma: export
#include <simdbezier/isa.hpp>          // IWYU pragma: export
#include <simdbezier/patch_grids.hpp>  // IWYU pragma: export
#include <simdbezier/patch_set.hpp>    // IWYU pragma: export
#include <simdbezier/status.hpp>       // IWYU pragma: export
#include <simdbezier/tiles.hpp>        // IWYU pragma: export
#include <simdbezier/version.hpp>      // IWYU pragma: export
