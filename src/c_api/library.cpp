// Statuses, faults, version and instruction sets of simdbezier.h.
#include <cstdio>

#include <simdbezier/options.hpp>

#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

// Numbers of C are those of C++; a new Status gets a name in types.h.
static_assert(static_cast<int>(SIMDBEZIER_SNAP_TOO_LARGE) == Status::snap_too_large);
static_assert(static_cast<int>(SIMDBEZIER_BAD_KNOTS) == Status::bad_knots);
static_assert(static_cast<int>(SIMDBEZIER_BAD_RANGE) == Status::bad_range);
static_assert(static_cast<int>(SIMDBEZIER_BAD_TOPOLOGY) == Status::bad_topology);
static_assert(static_cast<int>(SIMDBEZIER_OUT_OF_MEMORY) == Status::out_of_memory);
#define SIMDBEZIER_INSTRUCTION_SET(name, upper, fuses, runs_here)                                  \
  static_assert(SIMDBEZIER_ISA_##upper == static_cast<int>(Isa::name));                            \
  static_assert(Isa::name <= kLastIsa);
#include "instruction_sets.inc"
#undef SIMDBEZIER_INSTRUCTION_SET
static_assert(SIMDBEZIER_HOMOGENEOUS == static_cast<int>(Weights::homogeneous));
static_assert(SIMDBEZIER_TO_MEMORY == static_cast<int>(Destination::memory));
static_assert(SIMDBEZIER_CENTRED == static_cast<int>(Parameters::centred));

bool is_isa(simdbezier_isa isa) noexcept { return isa >= 0 && isa <= static_cast<int>(kLastIsa); }

struct LastFault {
  const char* function = "";
  Fault fault;
  char argument[96] = "";
  char message[256] = "";
};
thread_local LastFault last;

void print(const Path& path, char (&text)[96]) noexcept {
  char index[32] = "";
  const bool indexed = path.index != Path::kNoIndex;
  if (indexed) {
    std::snprintf(index, sizeof index, "[%zu]", path.index);
  }
  const auto* const member = path.member == nullptr ? "" : path.member;
  const auto* const part = path.part == nullptr ? "" : path.part;
  std::snprintf(text, sizeof text, "%s%s%s%s%s%s", path.root, index,
                path.member == nullptr ? "" : (indexed ? "." : "->"), member,
                path.part == nullptr ? "" : ".", part);
}

} // namespace

simdbezier_status record(const char* function, const Fault& fault) noexcept {
  last.function = function;
  last.fault = fault;
  last.message[0] = last.argument[0] = '\0';
  if (fault.status != SIMDBEZIER_OK) {
    print(fault.path, last.argument);
  }
  return fault.status;
}

Path blamed_nets(Status status, const Path& nets) {
  return blamed(status,
                {{{Status::null_input, Status::null_output, Status::non_finite_input,
                   Status::coefficient_overflow, Status::overlapping_outputs},
                  nets / "points"},
                 {{Status::input_too_small, Status::output_too_small}, nets / "length"},
                 {{Status::bad_degree}, nets / "degree_u or degree_v"},
                 {{Status::bad_components}, nets / "components"},
                 {{Status::bad_weight}, nets / "weights"},
                 {{Status::bad_patch_range, Status::size_overflow}, nets / "count"},
                 {{Status::bad_stride}, nets}},
                blamed_in_call(status, {}));
}

Path blamed_curves(Status status, const Path& curves) {
  return status == Status::bad_degree ? curves / "degree" : blamed_nets(status, curves);
}

Path blamed_in_call(Status status, const Path& where) {
  const Path out{"out"};
  return blamed(status,
                {{{Status::unknown_isa, Status::unsupported_isa}, kOptions / "isa"},
                 {{Status::null_output, Status::missing_y, Status::missing_z, Status::extra_y,
                   Status::extra_z, Status::overlapping_outputs, Status::output_too_small,
                   Status::bad_stride},
                  out},
                 {{Status::bad_components}, out / "first_component"},
                 {{Status::out_of_memory}, {}}},
                where);
}

} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

const char* simdbezier_status_text(simdbezier_status status) {
  switch (status) {
  case SIMDBEZIER_BAD_STRUCT_SIZE:
    return "a struct_size is not the size of its struct, or of one with members that are not known";
  case SIMDBEZIER_BAD_SCALAR:
    return "a number type is neither float nor double, or not that of the others";
  case SIMDBEZIER_BAD_VALUE:
    return "a number stands for no name of its enumeration";
  case SIMDBEZIER_BAD_ALIGNMENT:
    return "memory is not aligned to the numbers in it";
  default: // the C++ texts are literals, which end in a zero
    return to_string(static_cast<Status::Code>(status < 0 || status > 255 ? 255 : status)).data();
  }
}

simdbezier_status simdbezier_last_fault(simdbezier_fault* fault) {
  if (fault == nullptr) {
    return SIMDBEZIER_NULL_OUTPUT;
  }
  if (!is_size<simdbezier_fault>(fault->struct_size)) {
    return SIMDBEZIER_BAD_STRUCT_SIZE;
  }
  simdbezier_fault known{};
  known.status = last.fault.status;
  known.patch = last.fault.patch;
  known.point = last.fault.status == SIMDBEZIER_OK ? 0 : last.fault.point;
  known.component = last.fault.component;
  known.function = last.function;
  known.argument = last.argument;
  write(fault, known);
  return SIMDBEZIER_OK;
}

const char* simdbezier_last_message(void) {
  const char* const text = simdbezier_status_text(last.fault.status);
  const char* const colon = last.argument[0] == '\0' ? "" : ": ";
  int length = std::snprintf(last.message, sizeof last.message, "%s%s%s: %s", last.function, colon,
                             last.argument, text);
  const bool of_point = last.fault.status == SIMDBEZIER_NON_FINITE_INPUT ||
                        last.fault.status == SIMDBEZIER_BAD_WEIGHT ||
                        last.fault.status == SIMDBEZIER_COEFFICIENT_OVERFLOW;
  const bool of_knot = last.fault.status == SIMDBEZIER_BAD_KNOTS;
  if ((of_point || of_knot || last.fault.status == SIMDBEZIER_BAD_RANGE) && last.fault.point >= 0 &&
      length > 0) {
    const auto used = std::min(static_cast<std::size_t>(length), sizeof last.message);
    char* const end = last.message + used;
    const std::size_t room = sizeof last.message - used;
    if (of_point) {
      std::snprintf(end, room, " (%s %zu, point %d, component %d)", last.fault.whole,
                    last.fault.patch, last.fault.point, last.fault.component);
    } else {
      std::snprintf(end, room, " (%s %d)", of_knot ? "knot" : "parameter", last.fault.point);
    }
  }
  return last.message;
}

#define SIMDBEZIER_TEXT(x) #x
#define SIMDBEZIER_NUMBERS(a, b, c) SIMDBEZIER_TEXT(a) "." SIMDBEZIER_TEXT(b) "." SIMDBEZIER_TEXT(c)
const char* simdbezier_version(void) {
  return SIMDBEZIER_NUMBERS(SIMDBEZIER_VERSION_MAJOR, SIMDBEZIER_VERSION_MINOR,
                            SIMDBEZIER_VERSION_PATCH);
}

const char* simdbezier_isa_name(simdbezier_isa isa) {
  return is_isa(isa) ? to_string(static_cast<Isa>(isa)).data() : "unknown";
}

simdbezier_status simdbezier_isa_from_name(const char* name, simdbezier_isa* isa) {
  return answer(__func__, [&] {
    require(name != nullptr, SIMDBEZIER_NULL_INPUT, {"name"});
    require(isa != nullptr, SIMDBEZIER_NULL_OUTPUT, {"isa"});
    const std::optional<Isa> found = isa_from_name(name);
    require(found.has_value(), SIMDBEZIER_UNKNOWN_ISA, {"name"});
    *isa = static_cast<simdbezier_isa>(*found);
  });
}

size_t simdbezier_available_isas(simdbezier_isa* isas, size_t length) {
  const std::span<const Isa> available = available_isas();
  for (std::size_t k = 0; isas != nullptr && k < std::min(length, available.size()); ++k) {
    isas[k] = static_cast<simdbezier_isa>(available[k]);
  }
  return available.size();
}

int simdbezier_fuses_multiply_add(simdbezier_isa isa) {
  return is_isa(isa) && fuses_multiply_add(static_cast<Isa>(isa)) ? 1 : 0;
}

simdbezier_isa simdbezier_take_executed_isa() {
  return static_cast<simdbezier_isa>(take_executed_isa());
}

simdbezier_status simdbezier_resolve_isa(simdbezier_isa requested, simdbezier_isa* chosen) {
  return answer(__func__, [&] {
    require(chosen != nullptr, SIMDBEZIER_NULL_OUTPUT, {"chosen"});
    Isa isa = Isa::automatic;
    require_ok(resolve_isa(isa_of(requested, {"requested"}), isa),
               [](Status) { return Path{"requested"}; });
    *chosen = static_cast<simdbezier_isa>(isa);
  });
}
