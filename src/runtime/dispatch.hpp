// Chooses the kernel table that a call uses.
#pragma once

#include "src/tables/format_table.hpp"
#include "src/tables/kernel_table.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::detail {

/// True where the machine, and its operating system, can run the instruction set.
bool cpu_supports(Isa isa) noexcept;

/// The table of an instruction set that available_isas() lists.
template <typename T>
const KernelTable<T>& kernel_table(Isa isa) noexcept;
/// Its NetTable, NetOperationTable or FormatTable.
template <typename Table>
const Table& separate_table(Isa isa) noexcept;

/// The instruction set on which a call with `requested` may run instead of the resolved one,
/// because it is the next narrower one and gives the same bits. automatic: there is none, or
/// somebody has named the instruction set, here or in SIMDBEZIER_ISA.
Isa narrower_choice(Isa requested) noexcept;

} // namespace simdbezier::detail
