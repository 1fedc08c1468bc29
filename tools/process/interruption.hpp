// What has to be done when the program ends early: by a signal, or because a library calls exit(),
// as OpenMP does where the system refuses it a thread.
#pragma once

#include <cstddef>
#include <string>

namespace simdbezier::tools {

/// From now on, exit() and each signal that would end the program remove what is registered below.
/// Signals that were ignored stay ignored, and the program still ends by the signal that it got. A
/// file that outgrows its limit is a failed write, and one that is cut while it is mapped is bad
/// input. main() calls this once.
void handle_interruptions();

/// The number of files that can be registered at a time.
inline constexpr std::size_t kMostTemporaries = 256;

/// Registers a file by its name in an open folder. Both have to stay as they are until they are
/// forgotten. Call it before the file is created, so that there is no moment at which it would be
/// left behind. Returns false where there are too many.
[[nodiscard]] bool remember_temporary(int folder, const std::string& name) noexcept;
void forget_temporary(const std::string& name) noexcept;
/// These stand around the system call that creates a registered file, and around the calls that
/// create a file and take its name away: a signal waits for their end, whichever thread takes it.
void begin_creation() noexcept;
void end_creation() noexcept;

/// Says whether the terminal shows a progress bar, whose line has to be cleared.
void remember_bar(bool shown) noexcept;
/// Clears the line of the bar.
void clear_bar() noexcept;

} // namespace simdbezier::tools
