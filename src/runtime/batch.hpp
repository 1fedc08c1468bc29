// Work cut into blocks, one contiguous block a thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <new>

#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

#include "src/runtime/fp_environment.hpp"
#include "src/runtime/threads.hpp"
#include "src/storage/aligned_memory.hpp"

namespace simdbezier::detail {

/// Bytes rounded up to whole cache lines.
constexpr std::size_t whole_lines(std::size_t bytes) noexcept { return (bytes + 63) / 64 * 64; }

/// The duration of work that may take any time: it is given to as many threads as there may be.
inline constexpr std::size_t kLongDuration = ~std::size_t(0);

/// About how long one thread works on `pieces`, in nanoseconds. This is an estimate for
/// thread_count() and nothing else: a factor of five does not matter.
constexpr std::size_t duration_of(std::size_t pieces, std::size_t nanoseconds) noexcept {
  std::size_t product = 0;
  return __builtin_mul_overflow(pieces, nanoseconds, &product) ? kLongDuration : product;
}

/// How many threads to use for `units` pieces of work, never more than these: `requested`, or where
/// that is 0 or negative, so many that each has kShortestShare of work, and at most OpenMP's
/// default, which is 1 inside a parallel region of the caller.
int thread_count(int requested, std::size_t units, std::size_t duration) noexcept;

/// The shortest work of a thread, in nanoseconds: to wake a thread and to wait for it take up to as
/// long.
inline constexpr std::size_t kShortestShare = 20'000;

/// `void(int worker, std::size_t begin, std::size_t end) noexcept`
using BlockBody = Borrowed<int, std::size_t, std::size_t>;

/// Calls body once per worker 0..threads-1 with its share of 0..units-1, in the library's
/// floating-point environment. One thread is the caller's own, without an OpenMP region.
void for_blocks(std::size_t units, int threads, BlockBody body) noexcept;
/// This is for_blocks() for a caller that is in that environment: to look at it takes as long as a
/// small patch.
void for_blocks_here(std::size_t units, int threads, BlockBody body) noexcept;

/// Calls body as for_blocks() does, on as many threads as thread_count() says of units that take so
/// many nanoseconds each.
template <typename F>
void divide_work(std::size_t units, std::size_t nanoseconds, int threads, F& body) noexcept {
  for_blocks(units, thread_count(threads, units, duration_of(units, nanoseconds)), BlockBody(body));
}

/// The first unit of which holds(unit) is false, tried as divide_work() says; `units` where there
/// is none. Those behind it may not be tried.
template <typename F>
std::size_t first_failure(std::size_t units, std::size_t nanoseconds, int threads,
                          const F& holds) noexcept {
  std::atomic<std::size_t> first = units;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t unit = begin; unit < end && unit < first; ++unit) {
      if (!holds(unit)) {
        std::size_t now = first;
        while (unit < now && !first.compare_exchange_weak(now, unit)) {
        }
        return;
      }
    }
  };
  divide_work(units, nanoseconds, threads, body);
  return first;
}

/// Where share k of n begins, and where share n - 1 ends for k == n: units / n each, the first
/// units % n one more.
constexpr std::size_t share_begin(std::size_t units, std::size_t n, std::size_t k) noexcept {
  return units / n * k + (k < units % n ? k : units % n); // no product that could overflow
}

/// Work cut into shares, one for each thread that divide_work() would take. They stay the same
/// however many threads are granted, so that what one step found in a share the next one can use.
class Shares {
public:
  Shares(std::size_t units, std::size_t nanoseconds, int threads) noexcept
      : units_(units), count_(static_cast<std::size_t>(
                           thread_count(threads, units, duration_of(units, nanoseconds)))) {}

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] std::size_t begin(std::size_t share) const noexcept {
    return share_begin(units_, count_, share);
  }
  [[nodiscard]] std::size_t end(std::size_t share) const noexcept { return begin(share + 1); }

  /// Calls body(share) noexcept for each, on threads of their own as far as they are granted.
  template <typename F>
  void run(const F& body) const noexcept {
    auto some = [&](int, std::size_t first, std::size_t last) {
      for (std::size_t share = first; share < last; ++share) {
        body(share);
      }
    };
    for_blocks(count_, static_cast<int>(count_), BlockBody(some));
  }

private:
  std::size_t units_;
  std::size_t count_;
};

/// Scratch of a call's threads, each from a cache line of its own.
class ThreadScratch {
public:
  /// False where there is no memory. bytes: of one thread; 0 needs none.
  [[nodiscard]] bool allocate(std::size_t bytes, int threads) noexcept {
    bytes_ = whole_lines(bytes);
    std::size_t all = 0;
    if (__builtin_mul_overflow(bytes_, static_cast<std::size_t>(threads), &all)) {
      return false;
    }
    if (bytes_ > 0) {
      memory_.reset(::operator new (all, std::align_val_t{64}, std::nothrow));
    }
    return bytes_ == 0 || memory_ != nullptr;
  }
  /// The scratch of one thread; null where none is needed.
  [[nodiscard]] unsigned char* of(int worker) const noexcept {
    auto* const first = static_cast<unsigned char*>(memory_.get());
    return first == nullptr ? nullptr : first + static_cast<std::size_t>(worker) * bytes_;
  }

private:
  std::unique_ptr<void, FreeAligned> memory_;
  std::size_t bytes_ = 0;
};

/// Keeps the instruction set that the calling thread's call ran on, for take_executed_isa().
void note_executed(Isa isa) noexcept;

/// Runs units [begin, end) of an evaluate call, which is in the library's floating-point
/// environment: `Isa work(worker, begin, end, unsigned char* scratch)` on every thread's share of
/// them. Returns the instruction set that ran.
template <typename Work>
Isa run_units(std::size_t begin, std::size_t end, int threads, const ThreadScratch& scratch,
              const Work& work) noexcept {
  // All that run a kernel run the same one, and a short share may have nothing for it.
  std::atomic<Isa> executed = Isa::automatic;
  auto body = [&](int worker, std::size_t first, std::size_t last) {
    const Isa ran = work(worker, begin + first, begin + last, scratch.of(worker));
    if (ran != Isa::automatic) {
      executed.store(ran, std::memory_order_relaxed);
    }
  };
  for_blocks_here(end - begin, threads, BlockBody(body));
  return executed;
}

/// Runs all units of an evaluate call likewise, each thread with `scratch_bytes` of its own, and
/// reports the instruction set that ran. Returns ok | out_of_memory, before anything is written.
template <typename Work>
Status run_blocks_here(std::size_t units, std::size_t duration, const RunOptions& options,
                       std::size_t scratch_bytes, const Work& work) noexcept {
  const int threads = thread_count(options.threads, units, duration);
  ThreadScratch scratch;
  if (!scratch.allocate(scratch_bytes, threads)) {
    return Status::out_of_memory;
  }
  note_executed(run_units(0, units, threads, scratch, work));
  return Status::ok;
}

/// Likewise, of a call that may be in any floating-point environment.
template <typename Work>
Status run_blocks(std::size_t units, std::size_t duration, const RunOptions& options,
                  std::size_t scratch_bytes, const Work& work) noexcept {
  const DefaultFpEnvironment environment;
  return run_blocks_here(units, duration, options, scratch_bytes, work);
}

} // namespace simdbezier::detail
