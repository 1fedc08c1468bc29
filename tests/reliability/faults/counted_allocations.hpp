// operator new and delete that count, and fail when they are told to.
#pragma once

namespace simdbezier::tests {

/// Allocations that still succeed; negative: all of them.
void allow_allocations(int number);
/// Blocks that are allocated now.
[[nodiscard]] long live_allocations();

} // namespace simdbezier::tests
