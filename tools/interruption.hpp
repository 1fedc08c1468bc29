// What is left to do when the program ends before its time: by a signal, or because a library under
// it calls exit(), as OpenMP does where the system refuses it a thread.
#pragma once

#include <string>

namespace simdbezier::tools {

/// A signal that would end the program and exit() remove what is registered below. Signals that
/// were ignored stay ignored, and the program still ends by the signal that it got; a file that
/// outgrows its limit is a failed write. To be called once, by main().
void handle_interruptions();

/// Registers a file: its name in an open folder. Both have to stay as they are until forgotten. To
/// be called before the file is created, so that there is no moment at which it would be left.
void remember_temporary(int folder, const std::string& name) noexcept;
void forget_temporary() noexcept;

/// Whether there is a progress bar on the terminal, whose line is to be cleared.
void remember_bar(bool shown) noexcept;
/// Clears the line of the bar.
void clear_bar() noexcept;

} // namespace simdbezier::tools
