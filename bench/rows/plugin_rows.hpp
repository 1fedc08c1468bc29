// Rows of evaluators that were given by --evaluator FILE.so.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tools/evaluator/evaluator_process.hpp>

namespace simdbezier_bench {

using PluginProcess = std::shared_ptr<simdbezier::tools::EvaluatorProcess>;

/// Starts a process for each file, before the program has threads. What is wrong with a file is
/// printed, and makes `faulty` true; the others run.
std::vector<PluginProcess> start_plugins(const std::vector<std::string>& files, bool& faulty);

/// grid/<outputs>/<type>/<the evaluator's name>/…: bicubic patches, positions and derivatives.
void register_plugin_rows(const std::vector<PluginProcess>& plugins);

} // namespace simdbezier_bench
