// No threads but the caller's.
#include "src/runtime/threads.hpp"

namespace simdbezier::detail {

int default_threads() noexcept { return 1; }

int most_threads() noexcept { return 1; }

void run_on_threads(int /*threads*/, ThreadBody body) noexcept { body(0, 1); }

} // namespace simdbezier::detail
