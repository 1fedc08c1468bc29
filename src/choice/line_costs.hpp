// What stores across cache lines cost on this machine, found out by measuring.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Whether stores across lines take so long that rows which share lines should be put together to
/// whole lines first: five times as long as others on some processors, no longer on others. The
/// first call for a kernel table measures it, in some 50 microseconds; SIMDBEZIER_SPLIT_STORES=slow
/// or =fast in the environment decides it without a measurement. Results do not depend on it.
template <typename T>
[[nodiscard]] bool splits_slowly(const KernelTable<T>& table) noexcept;

} // namespace simdbezier::detail
