// The contract between the base code and the kernels for operations on control nets.
#pragma once

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

template <typename T>
struct NetTable {};

} // namespace simdbezier::detail
