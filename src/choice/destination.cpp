// See src/choice/destination.hpp.
#include "src/choice/destination.hpp"

#include <cstdlib>
#include <string_view>

namespace simdbezier::detail {
namespace {

Destination read_environment() noexcept {
#if defined(__wasm__)
  return Destination::cache; // nothing stores past the caches
#else
  const char* const word = std::getenv("SIMDBEZIER_DESTINATION");
  const std::string_view wish = word == nullptr ? "" : word;
  return wish == "cache"    ? Destination::cache
         : wish == "memory" ? Destination::memory
                            : Destination::automatic;
#endif
}

} // namespace

Destination environment_destination() noexcept {
  static const Destination wish = read_environment();
  return wish;
}

DestinationNotes& destination_notes() noexcept {
  static DestinationNotes notes;
  return notes;
}

} // namespace simdbezier::detail
