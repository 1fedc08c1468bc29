// Threads of OpenMP's runtime: the only file that knows it.
#include "src/runtime/threads.hpp"

#include <algorithm>

#include <omp.h>

namespace simdbezier::detail {

int default_threads() noexcept { return omp_in_parallel() != 0 ? 1 : omp_get_max_threads(); }

int most_threads() noexcept {
  // The runtime ends the process when the system refuses it a thread. Its numbers take a system
  // call, so that it is asked once.
  static const int most = std::max({16, 2 * omp_get_num_procs(), omp_get_max_threads()});
  return most;
}

void run_on_threads(int threads, ThreadBody body) noexcept {
#pragma omp parallel num_threads(threads)
  {
    // The runtime may grant fewer threads than asked for.
    body(omp_get_thread_num(), omp_get_num_threads());
  }
}

} // namespace simdbezier::detail
