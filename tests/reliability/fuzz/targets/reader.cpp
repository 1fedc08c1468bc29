// One reader of patches: the build says which one.
#include <span>

#include "tests/reliability/fuzz/checks/patch_file_checks.hpp"

#ifndef SIMDBEZIER_FUZZ_FORMAT
#error "the build defines SIMDBEZIER_FUZZ_FORMAT, an enumerator of PatchFormat"
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  simdbezier::fuzz::check_patch_file(std::span(data, size),
                                     simdbezier::tools::PatchFormat::SIMDBEZIER_FUZZ_FORMAT);
  return 0;
}
