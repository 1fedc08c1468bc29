// The only file that knows OpenMP. Shares are static, so every thread writes the same pages in
// every call of equal shape.
#include "src/runtime/batch.hpp"

#include <algorithm>

#include <omp.h>

#include "src/runtime/fp_environment.hpp"

namespace simdbezier::detail {

int thread_count(int requested, std::size_t units) noexcept {
  if (requested == 1) {
    return 1;
  }
  // The runtime ends the process when the system refuses it a thread, and more than these gain
  // nothing. Asked once: the answer takes a system call.
  static const int most = std::max({16, 2 * omp_get_num_procs(), omp_get_max_threads()});
  int threads = std::min(requested, most);
  if (requested <= 0) {
    threads = omp_in_parallel() != 0 ? 1 : omp_get_max_threads();
  }
  if (threads > 1 && units < static_cast<std::size_t>(threads)) {
    threads = static_cast<int>(units);
  }
  return threads > 1 ? threads : 1;
}

namespace {

void run_share(std::size_t units, int worker, int workers, BlockBody body) {
  const auto share = [&](int k) {
    // units / workers each, the first units % workers one more; no product that could overflow.
    const auto n = static_cast<std::size_t>(workers);
    const auto i = static_cast<std::size_t>(k);
    return units / n * i + (i < units % n ? i : units % n);
  };
  const DefaultFpEnvironment environment;
  body(worker, share(worker), share(worker + 1));
}

} // namespace

void for_blocks(std::size_t units, int threads, BlockBody body) noexcept {
  if (threads <= 1) {
    run_share(units, 0, 1, body);
    return;
  }
#pragma omp parallel num_threads(threads)
  {
    // The runtime may grant fewer threads than asked for.
    run_share(units, omp_get_thread_num(), omp_get_num_threads(), body);
  }
}

} // namespace simdbezier::detail
