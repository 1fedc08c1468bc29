// Somebody else's evaluator (include/simdbezier/evaluator_plugin.h) in a process of its own: what
// it does there cannot end the program that judges it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include <tools/evaluator/evaluator_functions.hpp>

namespace simdbezier::tools {

/// What an evaluator did instead of answering; the text names its file. After that it is dead.
class EvaluatorDied : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a file has.
struct EvaluatorFacts {
  std::string file;
  std::string name;
  EvaluatorForms f32;
  EvaluatorForms f64;

  template <typename T>
  [[nodiscard]] const EvaluatorForms& forms() const noexcept {
    return std::is_same_v<T, float> ? f32 : f64;
  }
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
  template <typename T>
  int evaluate(const PluginGridTask<T>& task);

  struct Shared; ///< memory that both processes see

private:
  template <typename T>
  void place(EvaluatorArrays& arrays, const PluginOutputs<T>& out, std::size_t samples);
  int ask(const std::string& function, const EvaluatorArrays& arrays);
  void send(const std::string& function);
  void wait_for_answer(const std::string& function);
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
