// Work cut into blocks, one contiguous block a thread.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

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
/// floating-point environment. One thread: on the caller's, without an OpenMP region.
void for_blocks(std::size_t units, int threads, BlockBody body) noexcept;

} // namespace simdbezier::detail
