// The reader of --samples files.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tools/formats/csv.hpp>
#include <tools/process/failure.hpp>

#include "tests/reliability/fuzz/checks/patch_file_checks.hpp"
#include "tests/reliability/fuzz/checks/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace simdbezier;
  static fuzz::MemoryFile file;
  file.write(std::span(data, size));
  constexpr std::size_t kPatches = 12;
  try {
    tools::SampleReader reader(file.path(), kPatches);
    std::size_t count = 0;
    while (const std::optional<tools::CsvSample> sample = reader.next()) {
      fuzz::require(sample->patch < kPatches, "a patch outside of the set");
      fuzz::require(std::isfinite(sample->u) && std::isfinite(sample->v),
                    "a parameter is not finite");
      ++count;
    }
    // Two commas, a number each.
    fuzz::require(count * 5 <= size, "more samples than the file has room for");
  } catch (const tools::Failure& failure) {
    fuzz::require(failure.exit_code() == 1, "bad input has another exit code than 1");
    fuzz::require_message(failure.what(), file.path());
  }
  return 0;
}
