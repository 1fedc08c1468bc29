#include <tools/evaluator_process.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

#include <dlfcn.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <simdbezier/evaluator_plugin.h>

#include <tools/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kSharedBytes = std::size_t{256} << 20; // of which only what is used is there
constexpr int kPatience = 120'000;                           // milliseconds for one call

enum class Function : std::uint8_t { f32, f64, grid_f32 };

struct Request {
  Function function;
  int degree_u, degree_v;
  std::size_t n; // samples, or patches
  std::size_t nu, nv;
  struct { // places in the shared memory, in bytes from its start; 0 stands for null
    std::size_t net, weights, u, v, position, du, dv;
  } at;
  int answer;
};

// What the child found.
struct Loaded {
  decltype(&sbe_evaluate_f32) f32 = nullptr;
  decltype(&sbe_evaluate_f64) f64 = nullptr;
  decltype(&sbe_grid_f32) grid_f32 = nullptr;
};

template <typename F>
void find(void* library, const char* name, F& function) {
  function = reinterpret_cast<F>(dlsym(library, name));
}

} // namespace

struct EvaluatorProcess::Shared {
  Request request;
  bool has[3];
  char name[64];
  char error[512];
  std::size_t used; // of the bytes that follow

  Request& start() {
    used = sizeof(Shared);
    return request = {};
  }
  unsigned char* base() { return reinterpret_cast<unsigned char*>(this); }
  template <typename T>
  T* at(std::size_t place) {
    return place == 0 ? nullptr : reinterpret_cast<T*>(base() + place);
  }
  // Room for values, apart from the last one's by a line.
  template <typename T>
  std::size_t place(std::size_t count) {
    if (count == 0) {
      return 0;
    }
    const std::size_t begin = (used + 127) / 64 * 64;
    if (count > (kSharedBytes - begin) / sizeof(T)) {
      bad_usage("an evaluator was given more samples than there is memory for");
    }
    used = begin + count * sizeof(T);
    return begin;
  }
  template <typename T>
  std::size_t copy_in(std::span<const T> values) {
    const std::size_t begin = place<T>(values.size());
    std::copy(values.begin(), values.end(), at<T>(begin));
    return begin;
  }
  template <typename T>
  std::size_t output(std::span<T> values) {
    const std::size_t begin = place<T>(values.size());
    std::fill_n(at<T>(begin), values.size(), std::numeric_limits<T>::quiet_NaN());
    return begin;
  }
  template <typename T>
  void copy_out(std::span<T> position, std::span<T> du, std::span<T> dv) {
    std::copy_n(at<T>(request.at.position), position.size(), position.begin());
    std::copy_n(at<T>(request.at.du), du.size(), du.begin());
    std::copy_n(at<T>(request.at.dv), dv.size(), dv.begin());
  }
};

namespace {

using Shared = EvaluatorProcess::Shared;

template <typename T, typename Evaluate>
int run_patch(Evaluate evaluate, Shared& shared) {
  const Request& task = shared.request;
  return evaluate(shared.at<T>(task.at.net), task.degree_u, task.degree_v,
                  shared.at<T>(task.at.weights), shared.at<T>(task.at.u), shared.at<T>(task.at.v),
                  task.n, shared.at<T>(task.at.position), shared.at<T>(task.at.du),
                  shared.at<T>(task.at.dv));
}

int run_request(const Loaded& loaded, Shared& shared) {
  const Request& task = shared.request;
  switch (task.function) {
  case Function::f32:
    return run_patch<float>(loaded.f32, shared);
  case Function::f64:
    return run_patch<double>(loaded.f64, shared);
  default:
    return loaded.grid_f32(shared.at<float>(task.at.net), task.n, task.nu, task.nv,
                           shared.at<float>(task.at.position), shared.at<float>(task.at.du),
                           shared.at<float>(task.at.dv));
  }
}

// Leaves what it found, or an error, in the shared memory.
Loaded load(const std::string& file, Shared& shared) {
  Loaded loaded;
  void* const library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::strncpy(shared.error, dlerror(), sizeof shared.error - 1);
    return loaded;
  }
  find(library, "sbe_evaluate_f32", loaded.f32);
  find(library, "sbe_evaluate_f64", loaded.f64);
  find(library, "sbe_grid_f32", loaded.grid_f32);
  decltype(&sbe_name) name = nullptr;
  find(library, "sbe_name", name);
  const std::string called =
      name != nullptr ? std::string(name()) : std::filesystem::path(file).stem().string();
  std::strncpy(shared.name, called.c_str(), sizeof shared.name - 1);
  shared.has[0] = loaded.f32 != nullptr;
  shared.has[1] = loaded.f64 != nullptr;
  shared.has[2] = loaded.grid_f32 != nullptr;
  return loaded;
}

// The child's life: loads, then answers every byte with a byte, until there are no more.
[[noreturn]] void serve(const std::string& file, Shared& shared, int requests, int answers) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Loaded loaded = load(file, shared);
  char byte = 0;
  while (write(answers, &byte, 1) == 1 && read(requests, &byte, 1) == 1) {
    shared.request.answer = run_request(loaded, shared);
  }
  _exit(0);
}

std::shared_ptr<Shared> map_shared() {
  void* const memory = mmap(nullptr, kSharedBytes, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    bad_input("no memory for an evaluator's process");
  }
  return {new (memory) Shared{}, [](Shared* shared) { munmap(shared, kSharedBytes); }};
}

} // namespace

EvaluatorProcess::EvaluatorProcess(const std::string& file) : shared_(map_shared()) {
  int requests[2];
  int answers[2];
  if (pipe(requests) != 0 || pipe(answers) != 0) {
    bad_input(file + ": no pipes for its process");
  }
  facts_.file = file;
  child_ = fork();
  if (child_ < 0) {
    bad_input(file + ": no process for it: " + std::strerror(errno));
  }
  if (child_ == 0) {
    close(requests[1]);
    close(answers[0]);
    serve(file, *shared_, requests[0], answers[1]);
  }
  close(requests[0]);
  close(answers[1]);
  to_child_ = requests[1];
  from_child_ = answers[0];
  std::signal(SIGPIPE, SIG_IGN); // a dead child is found by what it does not answer
  try {
    wait_for_answer("dlopen");
  } catch (const EvaluatorDied& died) {
    bad_input(died.what());
  }
  if (shared_->error[0] != '\0') {
    bad_input(file + ": expected a shared object, found '" + shared_->error + "'");
  }
  facts_.name = shared_->name;
  facts_.f32 = shared_->has[0];
  facts_.f64 = shared_->has[1];
  facts_.grid_f32 = shared_->has[2];
  if (!facts_.f32 && !facts_.f64) {
    bad_input(file + ": expected sbe_evaluate_f32 or sbe_evaluate_f64, found neither");
  }
}

EvaluatorProcess::~EvaluatorProcess() {
  close(to_child_);
  close(from_child_);
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
}

void EvaluatorProcess::bury(const std::string& what) {
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
  child_ = -1;
  throw EvaluatorDied(facts_.file + ": " + what);
}

void EvaluatorProcess::send(const char* function) {
  if (child_ < 0) {
    throw EvaluatorDied(facts_.file + ": is dead");
  }
  const char byte = 1;
  if (write(to_child_, &byte, 1) != 1) {
    bury(std::string("cannot be asked for ") + function);
  }
  wait_for_answer(function);
}

void EvaluatorProcess::wait_for_answer(const char* function) {
  pollfd answer{from_child_, POLLIN, 0};
  int ready = 0;
  do {
    ready = poll(&answer, 1, kPatience);
  } while (ready < 0 && errno == EINTR);
  if (ready == 0) {
    bury(std::string(function) + " did not return within " + std::to_string(kPatience / 1000) +
         " s");
  }
  char byte = 0;
  if (read(from_child_, &byte, 1) == 1) {
    return;
  }
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = -1;
  const std::string how = WIFSIGNALED(status) ? std::string(strsignal(WTERMSIG(status)))
                                              : "exit code " + std::to_string(WEXITSTATUS(status));
  throw EvaluatorDied(facts_.file + ": " + function + " ended its process: " + how);
}

template <typename T>
int EvaluatorProcess::evaluate(const PatchTask<T>& task) {
  Shared& shared = *shared_;
  Request& request = shared.start();
  constexpr bool kSingle = sizeof(T) == sizeof(float);
  request.function = kSingle ? Function::f32 : Function::f64;
  request.degree_u = task.degree_u;
  request.degree_v = task.degree_v;
  request.n = task.u.size();
  request.at = {shared.copy_in(task.net), shared.copy_in(task.weights), shared.copy_in(task.u),
                shared.copy_in(task.v),   shared.output(task.position), shared.output(task.du),
                shared.output(task.dv)};
  send(kSingle ? "sbe_evaluate_f32" : "sbe_evaluate_f64");
  shared.copy_out(task.position, task.du, task.dv);
  return request.answer;
}

template int EvaluatorProcess::evaluate(const PatchTask<float>&);
template int EvaluatorProcess::evaluate(const PatchTask<double>&);

int EvaluatorProcess::evaluate(const GridTask& task) {
  Shared& shared = *shared_;
  Request& request = shared.start();
  request.function = Function::grid_f32;
  request.n = task.patches;
  request.nu = task.nu;
  request.nv = task.nv;
  request.at.net = shared.copy_in(task.nets);
  request.at.position = shared.output(task.position);
  request.at.du = shared.output(task.du);
  request.at.dv = shared.output(task.dv);
  send("sbe_grid_f32");
  shared.copy_out(task.position, task.du, task.dv);
  return request.answer;
}

} // namespace simdbezier::tools
