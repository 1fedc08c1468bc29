// See options.hpp.
#include "src/runtime/executed_isa.hpp"

#include <utility>

namespace simdbezier {
namespace {

thread_local Isa executed = Isa::automatic;

} // namespace

namespace detail {

void note_executed(Isa isa) noexcept { executed = isa; }

} // namespace detail

Isa take_executed_isa() noexcept { return std::exchange(executed, Isa::automatic); }

} // namespace simdbezier
