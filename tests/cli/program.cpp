#include "tests/cli/program.hpp"

#include <fcntl.h>
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

// What the child does between fork() and exec(); nothing it changes reaches the test itself.
[[noreturn]] void become_program(std::vector<std::string> arguments,
                                 const Circumstances& circumstances, const std::string& out,
                                 const std::string& err) {
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  unsetenv("SIMDBEZIER_ISA");
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
  id_ = fork();
  if (id_ == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    dup2(ends[0], STDIN_FILENO);
    become_program(arguments, circumstances, folder_.path("out"), folder_.path("err"));
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

Outcome Program::finish() {
  close(input_);
  int status = 0;
  waitpid(std::exchange(id_, -1), &status, 0);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.out = read_file(folder_.path("out"));
  outcome.err = read_file(folder_.path("err"));
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
