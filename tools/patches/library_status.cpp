#include <tools/patches/library_status.hpp>

#include <cstdlib>
#include <string>
#include <string_view>

#include <tools/formats/input/text_input.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// The library takes every other word for no wish.
void check_wish(const char* variable, std::string_view one, std::string_view other) {
  const char* const value = std::getenv(variable);
  const std::string_view wish = value == nullptr ? "" : value;
  if (!wish.empty() && wish != "automatic" && wish != one && wish != other) {
    bad_usage(std::string(variable) + ": expected " + std::string(one) + " or " +
              std::string(other) + ", found " + in_quotes(wish));
  }
}

} // namespace

std::string available_isa_names(std::string_view separator) {
  std::string names;
  for (const Isa isa : available_isas()) {
    names += names.empty() ? "" : separator;
    names += to_string(isa);
  }
  return names;
}

std::string program_version() {
  return "simdbezier " + std::to_string(SIMDBEZIER_VERSION_MAJOR) + "." +
         std::to_string(SIMDBEZIER_VERSION_MINOR) + "." + std::to_string(SIMDBEZIER_VERSION_PATCH);
}

void check(Status status) {
  switch (status.code()) {
  case Status::ok:
    return;
  case Status::unknown_isa:
  case Status::unsupported_isa: {
    if (available_isas().empty()) {
      bad_input("this machine has none of the instruction sets that the library was built for");
    }
    const char* const value = std::getenv("SIMDBEZIER_ISA");
    bad_usage("SIMDBEZIER_ISA: expected one of " + available_isa_names(", ") + ", found " +
              in_quotes(value == nullptr ? "" : value) +
              (status == Status::unknown_isa ? "" : ", which is not available here"));
  }
  case Status::out_of_memory:
    bad_input("not enough memory");
  default:
    bad_input(std::string(to_string(status)));
  }
}

Isa chosen_isa() {
  check_wish("SIMDBEZIER_DESTINATION", "memory", "cache");
  check_wish("SIMDBEZIER_SPLIT_STORES", "slow", "fast");
  Isa isa = Isa::automatic;
  check(resolve_isa(Isa::automatic, isa));
  return isa;
}

} // namespace simdbezier::tools
