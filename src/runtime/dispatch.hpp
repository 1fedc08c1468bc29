// Which kernel table a call uses.
#pragma once

#include <cstddef>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// True where the machine, and its operating system, can run the instruction set.
bool cpu_supports(Isa isa) noexcept;

/// Bytes of the last-level cache that this core reaches; 8 MiB where that cannot be found out.
std::size_t last_level_cache() noexcept;
/// Bytes of the second-level cache, likewise; 512 KiB.
std::size_t second_level_cache() noexcept;
/// Bytes of the first-level cache for data; 32 KiB.
std::size_t first_level_cache() noexcept;

/// The table of an instruction set that available_isas() lists.
template <typename T>
const KernelTable<T>& kernel_table(Isa isa) noexcept;

} // namespace simdbezier::detail
