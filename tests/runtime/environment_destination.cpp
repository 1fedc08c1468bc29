// What large calls with Destination::automatic do: `./environment_destination WORD` sets
// SIMDBEZIER_DESTINATION to WORD, makes three calls and prints how each of them stored its units:
// "cache", "memory", or "both" for the one that measures. Once per process, because the library
// reads the variable at its first use. The calls write nothing, so that they cost nothing.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "src/calls/destined_call.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/cache_sizes.hpp"

namespace {

using namespace simdbezier;
using namespace simdbezier::detail;

constexpr std::size_t kPatches = 100000;
constexpr std::size_t kStrips[] = {1, 3}; ///< of plain and of streamed patches

/// How often each patch went through the caches (0) and past them (1), and which way last.
struct Log {
  std::vector<int> times[2] = {std::vector<int>(kPatches), std::vector<int>(kPatches)};
  std::vector<int> last = std::vector<int>(kPatches, -1);

  [[nodiscard]] const char* ways() const {
    bool used[2] = {};
    for (std::size_t k = 0; k < kPatches; ++k) {
      const int way = last[k];
      const auto strips = static_cast<int>(kStrips[way == 1 ? 1 : 0]);
      if (way < 0 || times[way][k] % strips != 0) {
        return "missing";
      }
      used[way] = true;
    }
    return used[0] && used[1] ? "both" : used[0] ? "cache" : "memory";
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
      log->last[unit / grain()] = static_cast<int>(way);
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

  [[nodiscard]] FakeWork plan(Destination destination) const {
    return {destination == Destination::memory ? 1U : 0U, log};
  }
  [[nodiscard]] std::size_t written() const { return bytes; }
  [[nodiscard]] CallKind kind() const { return CallKind().add(1); }
};

std::string run(std::size_t bytes, Destination destination) {
  Log log;
  Isa executed = Isa::automatic;
  Options options;
  options.threads = 1;
  options.destination = destination;
  options.executed = &executed;
  const Status status = run_to_destination(FakeCall{&log, bytes}, options);
  return status && executed == Isa::scalar ? log.ways() : "failed";
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2 || setenv("SIMDBEZIER_DESTINATION", argv[1], 1) != 0) {
    return 2;
  }
  const std::size_t large = 4 * last_level_cache() + 1024 * second_level_cache();
  const std::string first = run(large, Destination::automatic);
  const std::string second = run(large, Destination::automatic);
  std::printf("%s %s small %s asked %s %s\n", first.c_str(),
              second == "cache" || second == "memory" ? second.c_str() : "undecided",
              run(1000, Destination::automatic).c_str(), run(large, Destination::cache).c_str(),
              run(large, Destination::memory).c_str());
  return 0;
}
