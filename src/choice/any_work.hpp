// A call's work, whatever its type: what the choices that are made by measuring have in common.
#pragma once

#include <cstddef>

#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

/// See src/calls/call.hpp for what a work has.
struct AnyWork {
  const void* work;
  Isa (*run)(const void* work, int worker, std::size_t begin, std::size_t end,
             unsigned char* scratch);
  std::size_t units;
  std::size_t duration;
  std::size_t grain;
  std::size_t scratch_bytes;

  template <typename Work>
  explicit AnyWork(const Work& of, std::size_t units_of_patch = 1) noexcept
      : work(&of), run([](const void* self, int worker, std::size_t begin, std::size_t end,
                          unsigned char* scratch) {
          return static_cast<const Work*>(self)->run(worker, begin, end, scratch);
        }),
        units(of.units()), duration(of.duration()), grain(units_of_patch),
        scratch_bytes(of.scratch_bytes()) {}

  Isa operator()(int worker, std::size_t begin, std::size_t end,
                 unsigned char* scratch) const noexcept {
    return run(work, worker, begin, end, scratch);
  }
};

/// Runs it in the floating-point environment of make_call(). Returns ok | out_of_memory, before
/// anything is written.
[[nodiscard]] inline Status run_work(const AnyWork& work, const RunOptions& options) noexcept {
  return run_blocks_here(work.units, work.duration, options, work.scratch_bytes, work);
}

} // namespace simdbezier::detail
