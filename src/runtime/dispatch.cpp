// The instruction sets of this build, and the choice of one. isa_list.inc is written by
// cmake/isa.cmake: SIMDBEZIER_EACH_ISA(X, …) is X(name, …) for each of them, narrowest first.
#include "src/runtime/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <optional>

#include <simdbezier/options.hpp>

#include "isa_list.inc"

namespace simdbezier {

namespace {

#define SIMDBEZIER_ISA_ENTRY(isa, ...) Isa::isa,
constexpr Isa kIsas[] = {SIMDBEZIER_EACH_ISA(SIMDBEZIER_ISA_ENTRY, )};

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

bool is_available(Isa wanted) noexcept { return std::ranges::count(available_isas(), wanted) > 0; }

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
} // namespace detail

// A list for each kind of table, so that a static program is linked without the kernels of types
// and operations that it does not call.
#define SIMDBEZIER_DECLARE_TABLE(isa, Table, name)                                                 \
  namespace isa_##isa {                                                                            \
    extern const detail::Table name;                                                               \
  }
#define SIMDBEZIER_TABLE_ADDRESS(isa, Table, name) &isa_##isa::name,
#define SIMDBEZIER_TABLE(function, Table, name)                                                    \
  SIMDBEZIER_EACH_ISA(SIMDBEZIER_DECLARE_TABLE, Table, name)                                       \
  template <>                                                                                      \
  const detail::Table& detail::function(Isa isa) noexcept {                                        \
    static constexpr const detail::Table* kTables[] = {                                            \
        SIMDBEZIER_EACH_ISA(SIMDBEZIER_TABLE_ADDRESS, Table, name)};                               \
    return table_of(isa, kTables);                                                                 \
  }
SIMDBEZIER_TABLE(kernel_table<float>, KernelTable<float>, table_f32)
SIMDBEZIER_TABLE(kernel_table<double>, KernelTable<double>, table_f64)
SIMDBEZIER_TABLE(separate_table<detail::NetTable<float>>, NetTable<float>, net_table_f32)
SIMDBEZIER_TABLE(separate_table<detail::NetTable<double>>, NetTable<double>, net_table_f64)
SIMDBEZIER_TABLE(separate_table<detail::NetOperationTable<float>>, NetOperationTable<float>,
                 net_operations_f32)
SIMDBEZIER_TABLE(separate_table<detail::NetOperationTable<double>>, NetOperationTable<double>,
                 net_operations_f64)
SIMDBEZIER_TABLE(separate_table<detail::FormatTable<float>>, FormatTable<float>, format_table_f32)
SIMDBEZIER_TABLE(separate_table<detail::FormatTable<double>>, FormatTable<double>, format_table_f64)

} // namespace simdbezier
