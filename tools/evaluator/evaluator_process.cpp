#include <tools/evaluator/evaluator_process.hpp>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <dlfcn.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <simdbezier/evaluator_plugin.h>

#include <tools/evaluator/evaluator_arrays.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kSharedBytes = std::size_t{256} << 20; // only what is used of them is there
constexpr int kPatience = 120'000;                           // milliseconds for one call

enum class Function : std::uint8_t { f32, f64, grid_f32 };

struct PluginRequest {
  Function function;
  int degree_u, degree_v;
  std::size_t n; // samples, or patches
  std::size_t nu, nv;
  struct { // places in the shared memory, in bytes from its start; 0 stands for null
    std::size_t net, weights, u, v, position, du, dv;
  } at;
  int answer;
};

// The functions that the child found.
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
  PluginRequest request;
  bool has[3];
  char name[64];
  char error[512];

  unsigned char* base() { return reinterpret_cast<unsigned char*>(this); }
  template <typename T>
  T* at(std::size_t place) {
    return place == 0 ? nullptr : reinterpret_cast<T*>(base() + place);
  }
};

namespace {

using Shared = EvaluatorProcess::Shared;

template <typename T, typename Evaluate>
int run_patch(Evaluate evaluate, Shared& shared) {
  const PluginRequest& task = shared.request;
  return evaluate(shared.at<T>(task.at.net), task.degree_u, task.degree_v,
                  shared.at<T>(task.at.weights), shared.at<T>(task.at.u), shared.at<T>(task.at.v),
                  task.n, shared.at<T>(task.at.position), shared.at<T>(task.at.du),
                  shared.at<T>(task.at.dv));
}

int run_request(const Loaded& loaded, Shared& shared) {
  const PluginRequest& task = shared.request;
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

// Names are parts of rows' names and of JSON: what is not a letter, a digit or one of . + - becomes
// an underscore.
std::string plain_name(std::string name) {
  for (char& letter : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                       std::strchr(".+-_", letter) != nullptr;
    letter = plain ? letter : '_';
  }
  return name;
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
  const char* const called = name != nullptr ? name() : nullptr;
  const bool has_name = called != nullptr && *called != '\0';
  const std::string known = has_name ? called : std::filesystem::path(file).stem().string();
  std::strncpy(shared.name, plain_name(known).c_str(), sizeof shared.name - 1);
  shared.has[0] = loaded.f32 != nullptr;
  shared.has[1] = loaded.f64 != nullptr;
  shared.has[2] = loaded.grid_f32 != nullptr;
  return loaded;
}

// The child's life: loads, then answers every byte with a byte, until there are no more.
[[noreturn]] void serve(const std::string& file, Shared& shared, int requests, int answers) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(STDERR_FILENO, STDOUT_FILENO); // what it prints is not part of a report
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
    wait_for_answer("loading it, or sbe_name(),");
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
  mourn(what);
}

void EvaluatorProcess::mourn(const std::string& what) {
  child_ = -1;
  cause_ = facts_.file + ": " + what;
  throw EvaluatorDied(cause_);
}

void EvaluatorProcess::send(const char* function) {
  if (child_ < 0) {
    throw EvaluatorDied(cause_ + " (before)");
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
  const std::string how = WIFSIGNALED(status) ? std::string(strsignal(WTERMSIG(status)))
                                              : "exit code " + std::to_string(WEXITSTATUS(status));
  mourn(std::string(function) + " ended its process: " + how);
}

int EvaluatorProcess::ask(const char* function, const EvaluatorArrays& arrays) {
  send(function);
  if (const std::string fault = arrays.fault(); !fault.empty()) {
    bury(function + (" " + fault));
  }
  arrays.copy_out();
  return shared_->request.answer;
}

template <typename T>
int EvaluatorProcess::evaluate(const PluginPatchTask<T>& task) {
  EvaluatorArrays arrays({shared_->base(), kSharedBytes}, sizeof(Shared));
  constexpr bool kSingle = sizeof(T) == sizeof(float);
  PluginRequest& request = shared_->request = {};
  request.function = kSingle ? Function::f32 : Function::f64;
  request.degree_u = task.degree_u;
  request.degree_v = task.degree_v;
  request.n = task.u.size();
  request.at.net = arrays.input("net", task.net);
  request.at.weights = arrays.input("weights", task.weights);
  request.at.u = arrays.input("u", task.u);
  request.at.v = arrays.input("v", task.v);
  request.at.position = arrays.output("position", task.position);
  request.at.du = arrays.output("du", task.du);
  request.at.dv = arrays.output("dv", task.dv);
  return ask(kSingle ? "sbe_evaluate_f32" : "sbe_evaluate_f64", arrays);
}

template int EvaluatorProcess::evaluate(const PluginPatchTask<float>&);
template int EvaluatorProcess::evaluate(const PluginPatchTask<double>&);

int EvaluatorProcess::evaluate(const PluginGridTask& task) {
  EvaluatorArrays arrays({shared_->base(), kSharedBytes}, sizeof(Shared));
  PluginRequest& request = shared_->request = {};
  request.function = Function::grid_f32;
  request.n = task.patches;
  request.nu = task.nu;
  request.nv = task.nv;
  request.at.net = arrays.input("nets", task.nets);
  request.at.position = arrays.output("position", task.position);
  request.at.du = arrays.output("du", task.du);
  request.at.dv = arrays.output("dv", task.dv);
  return ask("sbe_grid_f32", arrays);
}

} // namespace simdbezier::tools
