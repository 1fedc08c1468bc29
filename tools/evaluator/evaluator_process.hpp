// Somebody else's evaluator (include/simdbezier/evaluator_plugin.h) in a process of its own: what
// it does there cannot end the program that judges it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace simdbezier::tools {

/// What an evaluator did instead of answering; the text names its file. After that it is dead.
class EvaluatorDied : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Which functions a file has.
struct EvaluatorFacts {
  std::string file;
  std::string name;
  bool f32 = false;
  bool f64 = false;
  bool grid_f32 = false;
};

/// One patch at many parameters. Spans of derivatives are empty where they are not wanted.
template <typename T>
struct PluginPatchTask {
  std::span<const T> net;
  int degree_u = 3;
  int degree_v = 3;
  std::span<const T> weights;
  std::span<const T> u;
  std::span<const T> v;
  std::span<T> position;
  std::span<T> du;
  std::span<T> dv;
};

/// Bicubic patches on one grid.
struct PluginGridTask {
  std::span<const float> nets;
  std::size_t patches = 0;
  std::size_t nu = 0;
  std::size_t nv = 0;
  std::span<float> position;
  std::span<float> du;
  std::span<float> dv;
};

class EvaluatorArrays;

/// A running evaluator. It has to be made before a program starts threads, because its process has
/// none of them.
class EvaluatorProcess {
public:
  /// Throws Failure naming the file where it cannot be loaded or has none of the functions.
  explicit EvaluatorProcess(const std::string& file);
  ~EvaluatorProcess();
  EvaluatorProcess(const EvaluatorProcess&) = delete;
  EvaluatorProcess& operator=(const EvaluatorProcess&) = delete;

  [[nodiscard]] const EvaluatorFacts& facts() const noexcept { return facts_; }

  /// Returns what the function returned. Outputs that it does not write become nan. Throws
  /// EvaluatorDied, also where it has written anywhere near its arrays but not into an output.
  template <typename T>
  int evaluate(const PluginPatchTask<T>& task);
  int evaluate(const PluginGridTask& task);

  struct Shared; ///< memory that both processes see

private:
  int ask(const char* function, const EvaluatorArrays& arrays);
  void send(const char* function);
  void wait_for_answer(const char* function);
  [[noreturn]] void bury(const std::string& what);
  [[noreturn]] void mourn(const std::string& what);

  EvaluatorFacts facts_;
  std::string cause_; ///< why it died
  std::shared_ptr<Shared> shared_;
  int child_ = -1;
  int to_child_ = -1;
  int from_child_ = -1;
};

} // namespace simdbezier::tools
