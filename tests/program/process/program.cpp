#include "tests/program/process/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace simdbezier::tests {

namespace fs = std::filesystem;

namespace {

void redirect(const std::string& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

void redirect_to(const Circumstances& circumstances, const std::string& out, const std::string& err,
                 int terminal) {
  redirect(out, STDOUT_FILENO);
  if (circumstances.append_path == "closed") {
    close(STDOUT_FILENO);
  } else if (!circumstances.append_path.empty()) {
    dup2(open(circumstances.append_path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC), STDOUT_FILENO);
  }
  if (!circumstances.input_path.empty()) {
    dup2(open(circumstances.input_path.c_str(), O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  }
  if (terminal >= 0) {
    dup2(terminal, STDERR_FILENO);
  } else {
    redirect(err, STDERR_FILENO);
  }
}

// What the child does between fork() and exec(); nothing it changes reaches the test itself.
[[noreturn]] void become_program(std::vector<std::string> arguments,
                                 const Circumstances& circumstances) {
  for (const int number : circumstances.ignored_signals) {
    std::signal(number, SIG_IGN);
  }
  unsetenv("SIMDBEZIER_ISA");
  if (!circumstances.fault.empty()) {
    setenv("LD_PRELOAD", SIMDBEZIER_FAULT_LIBRARY, 1);
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
    setenv("SIMDBEZIER_TEST_FAULT", circumstances.fault.c_str(), 1);
  }
  for (const auto& [name, value] : circumstances.environment) {
    setenv(name.c_str(), value.c_str(), 1);
  }
  if (circumstances.file_size_limit >= 0) {
    const auto bytes = static_cast<rlim_t>(circumstances.file_size_limit);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  arguments.insert(arguments.begin(), "simdbezier");
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  execv(SIMDBEZIER_PROGRAM, argv.data());
  _exit(127);
}

} // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "simdbezier-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    ADD_FAILURE() << "no temporary folder " << name;
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Program::Program(const std::vector<std::string>& arguments, const Circumstances& circumstances) {
  std::signal(SIGPIPE, SIG_IGN); // a program may stop reading before it has been fed
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) {
    ADD_FAILURE() << "no pipe";
    return;
  }
  int inner = -1;
  if (circumstances.columns > 0) {
    winsize size = {};
    size.ws_col = circumstances.columns;
    size.ws_row = 24;
    if (openpty(&terminal_, &inner, nullptr, nullptr, &size) != 0) {
      ADD_FAILURE() << "no terminal";
    }
  }
  id_ = fork();
  if (id_ == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    dup2(ends[0], STDIN_FILENO);
    redirect_to(circumstances, folder_.path("out"), folder_.path("err"), inner);
    become_program(arguments, circumstances);
  }
  if (inner >= 0) {
    close(inner);
  }
  close(ends[0]);
  input_ = ends[1];
}

Program::~Program() {
  if (id_ > 0) {
    finish();
  }
}

void Program::feed(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(input_, text.data() + done, text.size() - done);
    if (written <= 0) {
      return;
    }
    done += static_cast<std::size_t>(written);
  }
}

void Program::await_on_terminal(const std::string& part) {
  for (char block[256]; shown_.find(part) == std::string::npos;) {
    constexpr int kPatience = 20000; // milliseconds
    pollfd wait = {terminal_, POLLIN, 0};
    const ssize_t got = poll(&wait, 1, kPatience) > 0 ? read(terminal_, block, sizeof block) : 0;
    if (got <= 0) { // the program has ended, or says no more
      ADD_FAILURE() << "not shown: " << part << "\nshown: " << shown_;
      return;
    }
    shown_.append(block, static_cast<std::size_t>(got));
  }
}

void Program::close_input() {
  if (input_ >= 0) {
    close(std::exchange(input_, -1));
  }
}

Outcome Program::finish() {
  close_input();
  int status = 0;
  rusage usage = {};
  if (terminal_ >= 0) {
    for (char block[256]; true;) {
      const ssize_t got = read(terminal_, block, sizeof block);
      if (got <= 0) {
        break;
      }
      shown_.append(block, static_cast<std::size_t>(got));
    }
    close(std::exchange(terminal_, -1));
  }
  wait4(std::exchange(id_, -1), &status, 0, &usage);
  Outcome outcome;
  outcome.memory = usage.ru_maxrss;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.out = read_file(folder_.path("out"));
  outcome.err = shown_.empty() ? read_file(folder_.path("err")) : shown_;
  return outcome;
}

Outcome run(const std::vector<std::string>& arguments, const Circumstances& circumstances) {
  Program program(arguments, circumstances);
  program.feed(circumstances.input);
  return program.finish();
}

void expect_silent_success(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

void expect_failure(const Outcome& outcome, int exit_code, const std::string& part) {
  EXPECT_EQ(outcome.exit_code, exit_code);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("simdbezier: ")) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\n")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos)
      << "expected: " << part << "\nfound: " << outcome.err;
}

} // namespace simdbezier::tests
