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

#include <tools/evaluator/evaluator_arrays.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kSharedBytes = std::size_t{256} << 20; // only what is used of them is there
constexpr int kPatience = 120'000;                           // milliseconds for one call

// The functions that the child found.
struct Loaded {
  EvaluatorFunctions<float> f32;
  EvaluatorFunctions<double> f64;
  explicit Loaded(void* library) : f32(library), f64(library) {}
};

} // namespace

struct EvaluatorProcess::Shared {
  /// A task whose arrays are places in the shared memory.
  struct Request {
    bool is_single, is_grid;
    PluginLayout layout;
    int degree_u, degree_v;
    std::size_t n; // samples, or patches
    std::size_t nu, nv;
    struct { // in bytes from its start; 0 stands for null
      std::size_t net, weights, u, v;
      std::array<std::array<std::size_t, 3>, kPluginVectors> out;
    } at;
    int answer;
  };

  Request request;
  EvaluatorForms f32;
  EvaluatorForms f64;
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

template <typename T>
int run_request(const EvaluatorFunctions<T>& functions, Shared& shared) {
  const Shared::Request& task = shared.request;
  const auto array = [&](std::size_t place, std::size_t count) {
    T* const values = shared.at<T>(place);
    return std::span<const T>(values, values == nullptr ? 0 : count);
  };
  PluginOutputs<T> out{task.layout, {}};
  for (std::size_t k = 0; k < kPluginVectors; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.at[k][c] = shared.at<T>(task.at.out[k][c]);
    }
  }
  if (task.is_grid) {
    return functions(
        PluginGridTask<T>{array(task.at.net, 48 * task.n), task.n, task.nu, task.nv, out});
  }
  const auto points = static_cast<std::size_t>((task.degree_u + 1) * (task.degree_v + 1));
  return functions(PluginPatchTask<T>{array(task.at.net, 3 * points), task.degree_u, task.degree_v,
                                      array(task.at.weights, points), array(task.at.u, task.n),
                                      array(task.at.v, task.n), out});
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
  void* const library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::strncpy(shared.error, dlerror(), sizeof shared.error - 1);
    return Loaded(nullptr);
  }
  Loaded loaded(library);
  shared.f32 = loaded.f32.forms();
  shared.f64 = loaded.f64.forms();
  const auto name = reinterpret_cast<decltype(&sbe_name)>(dlsym(library, "sbe_name"));
  const char* const called = name != nullptr ? name() : nullptr;
  const bool has_name = called != nullptr && *called != '\0';
  const std::string known = has_name ? called : std::filesystem::path(file).stem().string();
  std::strncpy(shared.name, plain_name(known).c_str(), sizeof shared.name - 1);
  return loaded;
}

// The child's life: loads, then answers every byte with a byte, until there are no more.
[[noreturn]] void serve(const std::string& file, Shared& shared, int requests, int answers) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(STDERR_FILENO, STDOUT_FILENO); // what it prints is not part of a report
  const Loaded loaded = load(file, shared);
  char byte = 0;
  while (write(answers, &byte, 1) == 1 && read(requests, &byte, 1) == 1) {
    shared.request.answer = shared.request.is_single ? run_request(loaded.f32, shared)
                                                     : run_request(loaded.f64, shared);
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
  facts_.f32 = shared_->f32;
  facts_.f64 = shared_->f64;
  const auto evaluates = [](const EvaluatorForms& forms) {
    return forms.has_patch(PluginLayout::triples) || forms.has_patch(PluginLayout::planes);
  };
  if (!evaluates(facts_.f32) && !evaluates(facts_.f64)) {
    bad_input(file + ": expected sbe_evaluate_f32 or sbe_evaluate_f64, found neither, nor "
                     "sbe_evaluate_planes_f32 or sbe_evaluate_planes_f64");
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

void EvaluatorProcess::send(const std::string& function) {
  if (child_ < 0) {
    throw EvaluatorDied(cause_ + " (before)");
  }
  const char byte = 1;
  if (write(to_child_, &byte, 1) != 1) {
    bury("cannot be asked for " + function);
  }
  wait_for_answer(function);
}

void EvaluatorProcess::wait_for_answer(const std::string& function) {
  pollfd answer{from_child_, POLLIN, 0};
  int ready = 0;
  do {
    ready = poll(&answer, 1, kPatience);
  } while (ready < 0 && errno == EINTR);
  if (ready == 0) {
    bury(function + " did not return within " + std::to_string(kPatience / 1000) + " s");
  }
  char byte = 0;
  if (read(from_child_, &byte, 1) == 1) {
    return;
  }
  int status = 0;
  waitpid(child_, &status, 0);
  const std::string how = WIFSIGNALED(status) ? std::string(strsignal(WTERMSIG(status)))
                                              : "exit code " + std::to_string(WEXITSTATUS(status));
  mourn(function + " ended its process: " + how);
}

int EvaluatorProcess::ask(const std::string& function, const EvaluatorArrays& arrays) {
  send(function);
  if (const std::string fault = arrays.fault(); !fault.empty()) {
    bury(function + " " + fault);
  }
  arrays.copy_out();
  return shared_->request.answer;
}

template <typename T>
void EvaluatorProcess::place(EvaluatorArrays& arrays, const PluginOutputs<T>& out,
                             std::size_t samples) {
  shared_->request.layout = out.layout;
  const std::size_t count = out.layout == PluginLayout::planes ? samples : 3 * samples;
  for (std::size_t k = 0; k < kPluginVectors; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      shared_->request.at.out[k][c] = arrays.output(
          kPluginVectorNames[k], std::span<T>(out.at[k][c], out.at[k][c] == nullptr ? 0 : count));
    }
  }
}

template <typename T>
int EvaluatorProcess::evaluate(const PluginPatchTask<T>& task) {
  EvaluatorArrays arrays({shared_->base(), kSharedBytes}, sizeof(Shared));
  Shared::Request& request = shared_->request = {};
  request.is_single = std::is_same_v<T, float>;
  request.degree_u = task.degree_u;
  request.degree_v = task.degree_v;
  request.n = task.u.size();
  request.at.net = arrays.input("net", task.net);
  request.at.weights = arrays.input("weights", task.weights);
  request.at.u = arrays.input("u", task.u);
  request.at.v = arrays.input("v", task.v);
  place(arrays, task.out, request.n);
  return ask(function_name<T>("evaluate", task.out.layout), arrays);
}

template <typename T>
int EvaluatorProcess::evaluate(const PluginGridTask<T>& task) {
  EvaluatorArrays arrays({shared_->base(), kSharedBytes}, sizeof(Shared));
  Shared::Request& request = shared_->request = {};
  request.is_single = std::is_same_v<T, float>;
  request.is_grid = true;
  request.n = task.patches;
  request.nu = task.nu;
  request.nv = task.nv;
  request.at.net = arrays.input("nets", task.nets);
  place(arrays, task.out, task.patches * task.nu * task.nv);
  return ask(function_name<T>("grid", task.out.layout), arrays);
}

template int EvaluatorProcess::evaluate(const PluginPatchTask<float>&);
template int EvaluatorProcess::evaluate(const PluginPatchTask<double>&);
template int EvaluatorProcess::evaluate(const PluginGridTask<float>&);
template int EvaluatorProcess::evaluate(const PluginGridTask<double>&);

} // namespace simdbezier::tools
