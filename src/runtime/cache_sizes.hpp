// What the processor says of its caches.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

/// Bytes of the last-level cache that this core reaches; 8 MiB where that cannot be found out.
std::size_t last_level_cache() noexcept;
/// Whether so many bytes are more than half of it: the consumer has other data, too.
bool exceeds_caches(std::size_t bytes) noexcept;
/// Bytes of the second-level cache, likewise; 512 KiB.
std::size_t second_level_cache() noexcept;
/// Bytes of the first-level cache for data; 32 KiB.
std::size_t first_level_cache() noexcept;

} // namespace simdbezier::detail
