#include <tools/process/interruption.hpp>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace simdbezier::tools {

namespace {

// This is all that a signal handler may look at.
struct Temporary {
  std::atomic<const char*> name{nullptr}; // null: nothing is registered here
  std::atomic<int> folder{-1};
};
std::array<Temporary, kMostTemporaries> temporaries;
std::atomic<bool> bar_is_shown{false};
// While a file is being created it may not exist yet: a signal that another thread takes meanwhile
// waits in here until the creation has ended.
std::atomic<bool> creating{false};
std::atomic<int> waiting_signal{0};
std::atomic<bool> ending{false}; // a signal is being handled
static_assert(std::atomic<const char*>::is_always_lock_free &&
              std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void clean_up() noexcept {
  for (Temporary& temporary : temporaries) {
    if (const char* const name = temporary.name.exchange(nullptr)) {
      unlinkat(temporary.folder, name, 0);
    }
  }
  if (bar_is_shown.exchange(false)) {
    clear_bar();
  }
}

extern "C" void clean_up_at_exit() { clean_up(); }

extern "C" void on_signal(int number, siginfo_t* info, void* /*context*/) {
  ending = true;
  if (creating) {
    waiting_signal = number;
    if (creating || waiting_signal.exchange(0) == 0) {
      return; // end_creation() sees the signal, or has seen it
    }
  }
  clean_up();
  if (number == SIGBUS && info != nullptr && info->si_code == BUS_ADRERR) {
    constexpr std::string_view kMessage =
        "simdbezier: expected an input that stays as it is, found "
        "one that became shorter or unreadable meanwhile\n";
    static_cast<void>(!write(STDERR_FILENO, kMessage.data(), kMessage.size()));
    _exit(1);
  }
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  sigaction(number, &action, nullptr);
  raise(number); // takes effect when this function returns
}

// All signals but these end a process that does not handle them.
bool ends_by_default(int number) {
  switch (number) {
  case SIGKILL: // neither can be caught
  case SIGSTOP:
  case SIGTSTP:
  case SIGTTIN:
  case SIGTTOU:
  case SIGCONT:
  case SIGCHLD:
  case SIGURG:
  case SIGWINCH:
  case SIGXFSZ: // is ignored below, so that the write fails instead
    return false;
  default:
    return true;
  }
}

} // namespace

void handle_interruptions() {
  std::atexit(clean_up_at_exit);
  struct sigaction action = {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO;
  sigfillset(&action.sa_mask);
  for (int number = 1; number <= SIGRTMAX; ++number) {
    struct sigaction before = {};
    // Somebody wants another action than the default: nohup ignores, sanitizers handle.
    if (ends_by_default(number) && sigaction(number, nullptr, &before) == 0 &&
        (before.sa_flags & SA_SIGINFO) == 0 && before.sa_handler == SIG_DFL) {
      sigaction(number, &action, nullptr);
    }
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool remember_temporary(int folder, const std::string& name) noexcept {
  for (Temporary& temporary : temporaries) {
    if (temporary.name == nullptr) {
      temporary.folder = folder;
      temporary.name = name.c_str();
      return true;
    }
  }
  return false;
}

void forget_temporary(const std::string& name) noexcept {
  for (Temporary& temporary : temporaries) {
    if (temporary.name == name.c_str()) {
      temporary.name = nullptr;
    }
  }
}

void begin_creation() noexcept {
  creating = true;
  if (ending) { // nothing is to be created any more
    end_creation();
    for (;;) {
      pause();
    }
  }
}

void end_creation() noexcept {
  creating = false;
  if (const int number = waiting_signal.exchange(0)) {
    on_signal(number, nullptr, nullptr);
  }
}

void remember_bar(bool shown) noexcept { bar_is_shown = shown; }

void clear_bar() noexcept {
  constexpr std::string_view kClear = "\r\x1b[K";
  const int before = errno;
  static_cast<void>(!write(STDERR_FILENO, kClear.data(), kClear.size()));
  errno = before;
}

} // namespace simdbezier::tools
