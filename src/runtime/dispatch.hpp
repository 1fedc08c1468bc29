// Which kernel table a call uses.
#pragma once

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// True where the machine, and its operating system, can run the instruction set.
bool cpu_supports(Isa isa) noexcept;

/// The table of an instruction set that available_isas() lists.
template <typename T>
const KernelTable<T>& kernel_table(Isa isa) noexcept;

} // namespace simdbezier::detail
