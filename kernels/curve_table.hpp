// The contract between the base code and the kernels for curves.
#pragma once

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

template <typename T>
struct CurveTable {};

} // namespace simdbezier::detail
