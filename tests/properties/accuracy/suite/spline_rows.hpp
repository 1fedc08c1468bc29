// Rows of splines in the suite.
#pragma once

#include <cstddef>
#include <string>

namespace simdbezier::tests {

struct AccuracyReport;

/// Cuts some splines of every kind of knots on every instruction set, `nets` of them all together
/// and one a kind at least; those whose FAMILY/TYPE/EVALUATOR the filter is found in.
template <typename T>
void measure_splines(const char* type, std::size_t nets, const std::string& filter,
                     AccuracyReport& report);

} // namespace simdbezier::tests
