// simdbezier: many Bézier patches at many parameters in one call.
#pragma once

#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "simdbezier's C++ headers need C++20 (-std=c++20); <simdbezier.h> is for C and older C++"
#endif

#include <simdbezier/bounds.hpp>        // IWYU pragma: export
#include <simdbezier/control_nets.hpp>  // IWYU pragma: export
#include <simdbezier/curves.hpp>        // IWYU pragma: export
#include <simdbezier/evaluate.hpp>      // IWYU pragma: export
#include <simdbezier/evaluate_mesh.hpp> // IWYU pragma: export
#include <simdbezier/flatten.hpp>       // IWYU pragma: export
#include <simdbezier/mesh.hpp>          // IWYU pragma: export
#include <simdbezier/mesh_layout.hpp>   // IWYU pragma: export
#include <simdbezier/nets.hpp>          // IWYU pragma: export
#include <simdbezier/options.hpp>       // IWYU pragma: export
#include <simdbezier/outputs.hpp>       // IWYU pragma: export
#include <simdbezier/patch_set.hpp>     // IWYU pragma: export
#include <simdbezier/rates.hpp>         // IWYU pragma: export
#include <simdbezier/results.hpp>       // IWYU pragma: export
#include <simdbezier/splines.hpp>       // IWYU pragma: export
#include <simdbezier/status.hpp>        // IWYU pragma: export
#include <simdbezier/topology.hpp>      // IWYU pragma: export
#include <simdbezier/version.hpp>       // IWYU pragma: export
