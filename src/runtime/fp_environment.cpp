#include "src/runtime/fp_environment.hpp"

namespace simdbezier::detail {
namespace {

thread_local ChangedFpState innermost{};

} // namespace

ChangedFpState DefaultFpEnvironment::enter(FpState callers) noexcept {
  const ChangedFpState outer = innermost;
  innermost = {true, callers};
  set_default_fp_state();
  return outer;
}

void DefaultFpEnvironment::leave(ChangedFpState outer) noexcept { innermost = outer; }

CallersFpEnvironment::CallersFpEnvironment() noexcept : changed_(innermost.any) {
  if (changed_) {
    set_fp_state(innermost.before);
  }
}

CallersFpEnvironment::~CallersFpEnvironment() {
  if (changed_) {
    set_default_fp_state();
  }
}

} // namespace simdbezier::detail
