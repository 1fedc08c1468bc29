// What rows of grids, scattered samples and curves have in common: each times the library, or a
// baseline that does the same job.
#pragma once

#include <string>

#include <simdbezier/simdbezier.hpp>

#include "bench/subjects/library_call.hpp"

namespace simdbezier_bench {

/// A row that is ready to run. The constructors of derived classes fill in the job, and the options
/// of the library's call or the baseline that runs in its place.
template <typename Job>
class LibraryOrBaseline {
public:
  virtual ~LibraryOrBaseline() = default;

  void operator()() {
    if (is_library_) {
      (void)evaluate(options_);
    } else {
      baseline_(job_);
    }
  }

  /// Runs once. Returns an empty string, or the reason why this row must not be timed.
  std::string check() {
    poison_results();
    std::string failure;
    if (is_library_) {
      failure = is_packed()
                    ? run_verified(options_, [this](const auto& how) { return evaluate(how); })
                    : "the set could not be packed";
    } else if (baseline_ == nullptr) {
      failure = "this machine has none of the baselines' instruction sets";
    } else {
      baseline_(job_);
    }
    return failure.empty() ? check_results() : failure;
  }

protected:
  explicit LibraryOrBaseline(bool is_library) : is_library_(is_library) {}

  /// The library's call.
  virtual simdbezier::Status evaluate(const simdbezier::Options& options) const = 0;
  /// Whether the set that the library's call reads is there.
  [[nodiscard]] virtual bool is_packed() const = 0;
  /// Overwrites what check_results() looks at, so that an earlier row's results cannot pass.
  virtual void poison_results() = 0;
  /// Compares with the reference: an empty string, or what is wrong.
  [[nodiscard]] virtual std::string check_results() const = 0;

  Job job_;
  simdbezier::Options options_;            ///< the library's call takes these
  void (*baseline_)(const Job&) = nullptr; ///< null where the machine cannot run it

private:
  bool is_library_;
};

} // namespace simdbezier_bench
