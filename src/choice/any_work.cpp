// See src/choice/any_work.hpp.
#include "src/choice/any_work.hpp"

#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

Status run_work(const AnyWork& work, const RunOptions& options) noexcept {
  return run_blocks_here(work.units, work.duration, options, work.scratch_bytes, work);
}

} // namespace simdbezier::detail
