// Work cut into blocks, one contiguous block a thread.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include <simdbezier/options.hpp>
#include <simdbezier/status.hpp>

#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

/// Bytes rounded up to whole cache lines.
constexpr std::size_t whole_lines(std::size_t bytes) noexcept { return (bytes + 63) / 64 * 64; }

/// How many threads to use for `units` pieces of work: `requested`, or OpenMP's default where it
/// is 0 or negative; 1 inside a parallel region of the caller; never more than there are units.
int thread_count(int requested, std::size_t units) noexcept;

/// A borrowed callable `void(int worker, std::size_t begin, std::size_t end) noexcept`.
class BlockBody {
public:
  template <typename F>
  explicit BlockBody(F& body) noexcept
      : context_(&body), call_([](void* context, int worker, std::size_t begin, std::size_t end) {
          (*static_cast<F*>(context))(worker, begin, end);
        }) {}
  void operator()(int worker, std::size_t begin, std::size_t end) const {
    call_(context_, worker, begin, end);
  }

private:
  void* context_;
  void (*call_)(void*, int, std::size_t, std::size_t);
};

/// Calls body once per worker 0..threads-1 with its share of 0..units-1, in the library's
/// floating-point environment. One thread is the caller's own, without an OpenMP region.
void for_blocks(std::size_t units, int threads, BlockBody body) noexcept;

/// Runs an evaluate call: `Isa work(worker, begin, end, unsigned char* scratch)` on every thread's
/// share of the units, each with `scratch_bytes` of its own from a cache line of its own, and
/// reports the instruction set that ran. Returns ok | out_of_memory, before anything is written.
template <typename Work>
Status run_blocks(std::size_t units, const Options& options, std::size_t scratch_bytes,
                  const Work& work) noexcept {
  const int threads = thread_count(options.threads, units);
  const std::size_t bytes = whole_lines(scratch_bytes);
  std::unique_ptr<void, FreeAligned> scratch;
  if (bytes > 0) {
    scratch.reset(::operator new (bytes* static_cast<std::size_t>(threads), std::align_val_t{64},
                                  std::nothrow));
    if (scratch == nullptr) {
      return Status::out_of_memory;
    }
  }
  Isa executed = Isa::automatic;
  auto body = [&](int worker, std::size_t begin, std::size_t end) {
    auto* const own = static_cast<unsigned char*>(scratch.get());
    const std::size_t offset = static_cast<std::size_t>(worker) * bytes;
    const Isa ran = work(worker, begin, end, own == nullptr ? nullptr : own + offset);
    if (worker == 0) {
      executed = ran;
    }
  };
  for_blocks(units, threads, BlockBody(body));
  if (options.executed != nullptr) {
    *options.executed = executed;
  }
  return Status::ok;
}

} // namespace simdbezier::detail
