#include "tests/reliability/faults/traced_program.hpp"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>

#include <gtest/gtest.h>

namespace simdbezier::tests {

namespace {

constexpr unsigned kLongestRun = 60; // seconds, after which it counts as hung

[[noreturn]] void become_traced(std::vector<std::string> arguments, const std::string& out,
                                const std::string& err) {
  for (const auto& [path, descriptor] : {std::pair(&out, STDOUT_FILENO), {&err, STDERR_FILENO}}) {
    const int file = open(path->c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, descriptor);
    close(file);
  }
  arguments.insert(arguments.begin(), "simdbezier");
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  setenv("ASAN_OPTIONS", "detect_leaks=0", 1); // the leak checker traces as well
  alarm(kLongestRun);
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  execv(SIMDBEZIER_PROGRAM, argv.data());
  _exit(127);
}

void set_register(pid_t thread, std::size_t offset, long value) {
  ptrace(PTRACE_POKEUSER, thread, offset, value);
}

/// One traced process with all of its threads.
class Tracer {
public:
  Tracer(pid_t process, std::string folder, const SystemCallFault& fault)
      : process_(process), folder_(std::move(folder)), fault_(fault) {}

  /// Follows the process to its end; returns what waitpid() said of it.
  int follow() {
    int status = 0;
    int last = 0;
    waitpid(process_, &status, 0); // the stop after exec
    ptrace(PTRACE_SETOPTIONS, process_, nullptr,
           PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL);
    pid_t thread = process_;
    known_[thread] = true;
    for (int pass_on = 0; thread > 0; thread = waitpid(-1, &status, __WALL)) {
      if (WIFSTOPPED(status)) {
        pass_on = on_stop(thread, status);
        ptrace(PTRACE_SYSCALL, thread, nullptr, static_cast<long>(pass_on));
      } else if (thread == process_) {
        last = status;
      }
    }
    return last;
  }
  [[nodiscard]] long calls() const { return calls_; }

private:
  /// Returns the signal that the thread is to get.
  int on_stop(pid_t thread, int status) {
    const int signal = WSTOPSIG(status);
    if (signal == (SIGTRAP | 0x80)) {
      on_system_call(thread);
      return 0;
    }
    const bool first = !known_[thread];
    known_[thread] = true;
    const bool of_tracing = status >> 16 != 0 || signal == SIGTRAP || (first && signal == SIGSTOP);
    return of_tracing ? 0 : signal;
  }

  void on_system_call(pid_t thread) {
    __ptrace_syscall_info info{};
    ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info);
    if (info.op == PTRACE_SYSCALL_INFO_ENTRY) {
      on_entry(thread, info);
    } else if (chosen_ == thread) {
      chosen_ = 0;
      if (fault_.error != 0) {
        set_register(thread, offsetof(user, regs.rax), refusal_);
      }
      if (fault_.signal != 0) {
        kill(process_, fault_.signal);
      }
    }
  }

  void on_entry(pid_t thread, const __ptrace_syscall_info& info) {
    const auto number = static_cast<long>(info.entry.nr);
    watching_ = watching_ || (number == SYS_openat && names_our_file(info.entry.args[1]));
    if (!watching_ || (!fault_.calls.empty() && std::ranges::count(fault_.calls, number) == 0) ||
        ++calls_ != fault_.nth) {
      return;
    }
    chosen_ = thread;
    if (fault_.error != 0) {
      set_register(thread, offsetof(user, regs.orig_rax), -1);
      // This one knows no errors: it returns where the memory ends, too low where it could not.
      refusal_ = number == SYS_brk ? 0 : -fault_.error;
    }
    const auto count = static_cast<long>(info.entry.args[2]);
    if (fault_.short_transfer && count > 1) {
      set_register(thread, offsetof(user, regs.rdx), count / 2);
    }
  }

  [[nodiscard]] bool names_our_file(std::uint64_t address) const {
    std::string name(folder_.size(), '\0');
    const iovec to{name.data(), name.size()};
    const iovec from{reinterpret_cast<void*>(address), name.size()}; // NOLINT: of another process
    const auto read = process_vm_readv(process_, &to, 1, &from, 1, 0);
    return read == static_cast<ssize_t>(name.size()) && name == folder_;
  }

  pid_t process_;
  std::string folder_;
  const SystemCallFault& fault_;
  std::map<pid_t, bool> known_;
  bool watching_ = false;
  long calls_ = 0;
  long refusal_ = 0; ///< what it returns
  pid_t chosen_ = 0; ///< the thread that is inside of the call at fault
};

} // namespace

TracedOutcome run_traced(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                         const SystemCallFault& fault) {
  const TemporaryFolder streams;
  const pid_t process = fork();
  if (process == 0) {
    become_traced(arguments, streams.path("out"), streams.path("err"));
  }
  Tracer tracer(process, folder.path(""), fault);
  const int status = tracer.follow();
  TracedOutcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.out = read_file(streams.path("out"));
  outcome.err = read_file(streams.path("err"));
  outcome.calls = tracer.calls();
  return outcome;
}

} // namespace simdbezier::tests
