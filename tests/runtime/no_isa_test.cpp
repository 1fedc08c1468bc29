// A build that holds nothing that this machine can run: calls say so. CMakeLists.txt compiles the
// dispatcher once more, for an instruction set of another family, whose tables are these empty
// ones.
#include <gtest/gtest.h>

#include "src/pack/pack_request.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier {

template <typename T>
constexpr detail::KernelTable<T> foreign_table() {
  detail::KernelTable<T> table{};
  table.isa = Isa::SIMDBEZIER_FOREIGN_ISA;
  return table;
}

namespace SIMDBEZIER_FOREIGN_TABLES {
extern const detail::KernelTable<float> table_f32;
extern const detail::KernelTable<double> table_f64;
const detail::KernelTable<float> table_f32 = foreign_table<float>();
const detail::KernelTable<double> table_f64 = foreign_table<double>();
extern const detail::NetTable<float> net_table_f32;
extern const detail::NetTable<double> net_table_f64;
const detail::NetTable<float> net_table_f32{};
const detail::NetTable<double> net_table_f64{};
extern const detail::NetOperationTable<float> net_operations_f32;
extern const detail::NetOperationTable<double> net_operations_f64;
const detail::NetOperationTable<float> net_operations_f32{};
const detail::NetOperationTable<double> net_operations_f64{};
extern const detail::FormatTable<float> format_table_f32;
extern const detail::FormatTable<double> format_table_f64;
const detail::FormatTable<float> format_table_f32{};
const detail::FormatTable<double> format_table_f64{};
} // namespace SIMDBEZIER_FOREIGN_TABLES

namespace {

TEST(NoInstructionSet, nothing_is_available) { EXPECT_TRUE(available_isas().empty()); }

TEST(NoInstructionSet, none_resolves) {
  for (const Isa isa : {Isa::automatic, Isa::scalar, Isa::SIMDBEZIER_FOREIGN_ISA}) {
    Isa chosen = Isa::sse2;
    PackOptions options;
    options.isa = isa;
    EXPECT_EQ(resolve_isa(isa, chosen), Status::unsupported_isa) << to_string(isa);
    EXPECT_EQ(detail::packing_isa(options, chosen), Status::unsupported_isa) << to_string(isa);
    EXPECT_EQ(chosen, Isa::sse2);
  }
}

} // namespace
} // namespace simdbezier
