// The instruction sets of this build, and the choice of one. isa_list.inc is written by
// cmake/isa.cmake: one SIMDBEZIER_ISA_ENTRY(name) for each instruction set of this build, narrowest
// first.
#include "src/runtime/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <optional>

#include <simdbezier/isa.hpp>

namespace simdbezier {

#define SIMDBEZIER_ISA_ENTRY(isa)                                                                  \
  namespace isa_##isa {                                                                            \
    extern const detail::KernelTable<float> table_f32;                                             \
    extern const detail::KernelTable<double> table_f64;                                            \
    extern const detail::NetTable<float> net_table_f32;                                            \
    extern const detail::NetTable<double> net_table_f64;                                           \
  }
#include "isa_list.inc"
#undef SIMDBEZIER_ISA_ENTRY

namespace {

// A list for each kind of table, so that a static program is linked without the kernels of types in
// which it does not evaluate, though it may change nets in them.
#define SIMDBEZIER_ISA_ENTRY(isa) Isa::isa,
constexpr Isa kIsas[] = {
#include "isa_list.inc"
};
#undef SIMDBEZIER_ISA_ENTRY
#define SIMDBEZIER_ISA_ENTRY(isa) &isa_##isa::table_f32,
constexpr const detail::KernelTable<float>* kFloatTables[] = {
#include "isa_list.inc"
};
#undef SIMDBEZIER_ISA_ENTRY
#define SIMDBEZIER_ISA_ENTRY(isa) &isa_##isa::table_f64,
constexpr const detail::KernelTable<double>* kDoubleTables[] = {
#include "isa_list.inc"
};
#undef SIMDBEZIER_ISA_ENTRY
#define SIMDBEZIER_ISA_ENTRY(isa) &isa_##isa::net_table_f32,
constexpr const detail::NetTable<float>* kFloatNetTables[] = {
#include "isa_list.inc"
};
#undef SIMDBEZIER_ISA_ENTRY
#define SIMDBEZIER_ISA_ENTRY(isa) &isa_##isa::net_table_f64,
constexpr const detail::NetTable<double>* kDoubleNetTables[] = {
#include "isa_list.inc"
};
#undef SIMDBEZIER_ISA_ENTRY

struct AvailableIsas {
  std::array<Isa, std::size(kIsas)> list{};
  std::size_t count = 0;

  AvailableIsas() noexcept {
    for (const Isa isa : kIsas) {
      if (detail::cpu_supports(isa)) {
        list[count++] = isa;
      }
    }
  }
};

bool is_available(Isa wanted) noexcept {
  for (const Isa isa : available_isas()) {
    if (isa == wanted) {
      return true;
    }
  }
  return false;
}

struct Resolution {
  Status status;
  Isa isa;
  Isa narrower = Isa::automatic; ///< see narrower_choice()
};

/// The next narrower instruction set than the best one, if it gives the same bits. Those that do
/// not fuse have compact kernels, which are never faster.
Isa narrower_than_best() noexcept {
  const std::span<const Isa> isas = available_isas();
  if (isas.size() < 2 || !fuses_multiply_add(isas[isas.size() - 2])) {
    return Isa::automatic;
  }
  return isas[isas.size() - 2];
}

/// What the environment asks for; the best one where it asks for nothing, or for an empty name.
Resolution resolve_automatic() noexcept {
  const char* const wish = std::getenv("SIMDBEZIER_ISA");
  const std::optional<Isa> isa =
      wish == nullptr || *wish == '\0' ? Isa::automatic : isa_from_name(wish);
  if (!isa) {
    return {Status::unknown_isa, Isa::automatic};
  }
  if (*isa == Isa::automatic && !available_isas().empty()) {
    return {Status::ok, available_isas().back(), narrower_than_best()};
  }
  return {is_available(*isa) ? Status::ok : Status::unsupported_isa, *isa};
}

const Resolution& automatic_resolution() noexcept {
  static const Resolution resolution = resolve_automatic();
  return resolution;
}

} // namespace

std::span<const Isa> available_isas() noexcept {
  static const AvailableIsas available;
  return {available.list.data(), available.count};
}

Status resolve_isa(Isa requested, Isa& chosen) noexcept {
  if (requested == Isa::automatic) {
    const Resolution& automatic = automatic_resolution();
    if (automatic.status == Status::ok) {
      chosen = automatic.isa;
    }
    return automatic.status;
  }
  if (!is_available(requested)) {
    return Status::unsupported_isa;
  }
  chosen = requested;
  return Status::ok;
}

namespace detail {

Isa narrower_choice(Isa requested) noexcept {
  return requested == Isa::automatic ? automatic_resolution().narrower : Isa::automatic;
}

namespace {

/// Returns the table of the instruction set, or the first one.
template <typename Table>
const Table& table_of(Isa isa, const Table* const (&tables)[std::size(kIsas)]) noexcept {
  const Isa* const found = std::find(std::begin(kIsas), std::end(kIsas), isa);
  return *tables[found == std::end(kIsas) ? 0 : found - kIsas];
}

} // namespace

template <>
const KernelTable<float>& kernel_table<float>(Isa isa) noexcept {
  return table_of(isa, kFloatTables);
}

template <>
const KernelTable<double>& kernel_table<double>(Isa isa) noexcept {
  return table_of(isa, kDoubleTables);
}

template <>
const NetTable<float>& net_table<float>(Isa isa) noexcept {
  return table_of(isa, kFloatNetTables);
}

template <>
const NetTable<double>& net_table<double>(Isa isa) noexcept {
  return table_of(isa, kDoubleNetTables);
}

} // namespace detail
} // namespace simdbezier
