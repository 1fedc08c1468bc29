// Binary patches, once as they are, and once with sums that fit, since hardly any made-up bytes
// have such.
#include <algorithm>
#include <span>
#include <vector>

#include <tools/formats/sbp_index.hpp>
#include <tools/process/little_endian.hpp>

#include "tests/reliability/fuzz/checks/patch_file_checks.hpp"

namespace {

using namespace simdbezier::tools;

void put_sums(std::byte* to, const SbpCheck& check) {
  store_little(to, check.sum);
  store_little(to + sizeof(std::uint64_t), check.sum_of_sums);
}

void repair(std::span<std::byte> file) {
  constexpr std::size_t kSumsOfEntry = 96;
  constexpr std::size_t kSumsOfHeader = 112;
  const auto blocks =
      std::min<std::uint64_t>(load_little<std::uint64_t>(&file[32]), file.size() / kSbpEntryBytes);
  const std::size_t both = kSbpHeaderBytes + kSbpEntryBytes * blocks;
  if (both > file.size()) {
    return;
  }
  for (std::size_t k = 0; k < blocks; ++k) {
    std::byte* const entry = &file[kSbpHeaderBytes + kSbpEntryBytes * k];
    const auto offset = load_little<std::uint64_t>(entry + 16);
    const auto bytes = load_little<std::uint64_t>(entry + 24);
    if (offset <= file.size() && bytes <= file.size() - offset) {
      put_sums(entry + kSumsOfEntry, check_of(file.subspan(offset, bytes)));
    }
  }
  std::fill_n(&file[kSumsOfHeader], 16, std::byte{0});
  put_sums(&file[kSumsOfHeader], check_of(file.first(both)));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> given(data, size);
  simdbezier::fuzz::check_patch_file(given, PatchFormat::sbp);
  if (size >= kSbpHeaderBytes) {
    std::vector<std::uint8_t> repaired(given.begin(), given.end());
    repair(std::as_writable_bytes(std::span(repaired)));
    simdbezier::fuzz::check_patch_file(repaired, PatchFormat::sbp);
  }
  return 0;
}
