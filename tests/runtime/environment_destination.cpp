// What large calls do: `./environment_destination WORD` sets SIMDBEZIER_DESTINATION to WORD, makes
// some calls and prints how each of them stored its units: "cache", "memory" or "memory-other",
// joined by + in the ones that measure. Once per process, because the library reads the variable at
// its first use. The calls write nothing, so that they cost nothing.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "src/choice/measured_call.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"

namespace {

using namespace simdbezier;
using namespace simdbezier::detail;

constexpr std::size_t kPatches = 100000;
constexpr std::size_t kWays = 3;
constexpr const char* kNames[kWays] = {"cache", "memory", "memory-other"};
constexpr std::size_t kStrips[kWays] = {1, 3, 2}; ///< a patch's units

/// How often each patch went each way, and which one last.
struct Log {
  std::vector<std::size_t> times[kWays] = {std::vector<std::size_t>(kPatches),
                                           std::vector<std::size_t>(kPatches),
                                           std::vector<std::size_t>(kPatches)};
  std::vector<std::size_t> last = std::vector<std::size_t>(kPatches, kWays);

  [[nodiscard]] std::string ways() const {
    bool used[kWays] = {};
    for (std::size_t k = 0; k < kPatches; ++k) {
      const std::size_t way = last[k];
      if (way == kWays || times[way][k] % kStrips[way] != 0) {
        return "missing";
      }
      used[way] = true;
    }
    std::string names;
    for (std::size_t way = 0; way < kWays; ++way) {
      names += used[way] ? (names.empty() ? "" : "+") + std::string(kNames[way]) : "";
    }
    return names;
  }
};

struct FakeWork {
  std::size_t way;
  Log* log;

  [[nodiscard]] std::size_t grain() const { return kStrips[way]; }
  [[nodiscard]] std::size_t units() const { return kPatches * grain(); }
  [[nodiscard]] std::size_t duration() const { return kLongDuration; }
  [[nodiscard]] std::size_t scratch_bytes() const { return way * 64; }
  Isa run(int, std::size_t begin, std::size_t end, unsigned char* scratch) const {
    for (std::size_t unit = begin; unit < end; ++unit) {
      ++log->times[way][unit / grain()];
      log->last[unit / grain()] = way;
    }
    if (scratch != nullptr) {
      scratch[63] = 1;
    }
    return Isa::scalar;
  }
};

struct FakeCall {
  Log* log;
  std::size_t bytes;

  [[nodiscard]] FakeWork plan(Way way) const {
    return {way == Way::cache ? 0U : way == Way::memory ? 1U : 2U, log};
  }
  [[nodiscard]] std::size_t written() const { return bytes; }
  [[nodiscard]] CallKind kind() const { return CallKind().add(1); }
};

std::string run(std::size_t bytes, Destination destination) {
  Log log;
  Options options;
  options.threads = 1;
  options.destination = destination;
  const Status status = run_to_destination(FakeCall{&log, bytes}, options);
  return status && take_executed_isa() == Isa::scalar ? log.ways() : "failed";
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2 || setenv("SIMDBEZIER_DESTINATION", argv[1], 1) != 0) {
    return 2;
  }
  const std::size_t large = 4 * last_level_cache() + 1024 * second_level_cache();
  // The first call, and the first that measures nothing in any case: three at most do.
  const auto first_and_fourth = [large](Destination destination) {
    const std::string first = run(large, destination);
    (void)run(large, destination);
    (void)run(large, destination);
    return first + " " + run(large, destination);
  };
  const std::string automatic = first_and_fourth(Destination::automatic);
  const std::string memory = first_and_fourth(Destination::memory);
  std::printf("%s small %s %s asked %s, %s\n", automatic.c_str(),
              run(1000, Destination::automatic).c_str(), run(1000, Destination::memory).c_str(),
              run(large, Destination::cache).c_str(), memory.c_str());
  return 0;
}
