// operator new and delete that count, and fail when they are told to.
#pragma once

namespace simdbezier::tests {

/// Allocations that still succeed; negative: all of them. Those behind fail, or only the first.
void allow_allocations(int number, bool one_fails = false);
/// Blocks that are allocated now.
[[nodiscard]] long live_allocations();

} // namespace simdbezier::tests
