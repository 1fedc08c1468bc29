// See src/runtime/fp_environment.hpp.
#include "src/runtime/fp_environment.hpp"

namespace simdbezier::detail {
namespace {

/// The innermost environment of this thread that changed something.
thread_local const DefaultFpEnvironment* innermost = nullptr;

} // namespace

void DefaultFpEnvironment::enter() noexcept {
  FpState::set_default();
  outer_ = innermost;
  innermost = this;
}

void DefaultFpEnvironment::leave() const noexcept { innermost = outer_; }

CallersFpEnvironment::CallersFpEnvironment() noexcept : changed_(innermost) {
  if (changed_ != nullptr) {
    changed_->callers_.restore();
  }
}

CallersFpEnvironment::~CallersFpEnvironment() {
  if (changed_ != nullptr) {
    FpState::set_default();
  }
}

} // namespace simdbezier::detail
