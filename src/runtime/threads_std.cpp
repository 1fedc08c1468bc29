// Threads of the standard library, for systems without OpenMP: started anew by every call, which
// takes tens of microseconds. Where the system refuses one, the caller does its share.
#include "src/runtime/threads.hpp"

#include <algorithm>
#include <new>
#include <thread>

namespace simdbezier::detail {

namespace {

thread_local bool is_worker = false;

int processors() noexcept {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace

int default_threads() noexcept { return is_worker ? 1 : processors(); }

int most_threads() noexcept {
  static const int most = std::max(16, 2 * processors());
  return most;
}

void run_on_threads(int threads, ThreadBody body) noexcept {
  const auto run = [body, threads](int worker) {
    const bool before = is_worker;
    is_worker = true;
    body(worker, threads);
    is_worker = before;
  };
  auto* const started = new (std::nothrow) std::thread[static_cast<std::size_t>(threads)];
  int next = 1;
  try {
    for (; started != nullptr && next < threads; ++next) {
      started[next] = std::thread(run, next);
    }
  } catch (...) { // no more threads
  }
  run(0);
  for (int worker = next; worker < threads; ++worker) {
    run(worker);
  }
  if (started != nullptr) {
    std::for_each(started + 1, started + next, [](std::thread& thread) { thread.join(); });
    delete[] started;
  }
}

} // namespace simdbezier::detail
