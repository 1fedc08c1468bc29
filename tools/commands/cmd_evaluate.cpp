// simdbezier evaluate: values at samples, as CSV.
#include <tools/commands/commands.hpp>

#include <cstdint>
#include <span>
#include <utility>

#include <tools/commands/result_lines.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

namespace {

// Data in a pipe mostly end up on the terminal that would show the bar.
bool may_show_bar(const Arguments& arguments, const OutputFile& file) {
  return arguments.out != "-" && !file.is_terminal();
}

template <typename T>
void evaluate_on_grid(const Arguments& arguments, const PatchFile& patches) {
  const GridSize grid = arguments.grid;
  const std::size_t columns = column_count(arguments.outputs);
  const std::uint64_t samples = checked_sample_count(patches.count, grid, columns * sizeof(T));
  GridEvaluator<T> evaluator(patches, grid, arguments.threads);
  OutputFile file(arguments.out);
  file.expect_room(least_bytes(samples, columns));
  file.text(result_header(false, arguments.outputs));
  ResultWriter writer(file);
  ResultTable<T> table(arguments.outputs);
  Progress progress("evaluating", "samples", samples, may_show_bar(arguments, file));
  for_each_block(patches.count, grid, [&](const GridBlock& block) {
    write_grid_block(evaluator, block, grid, 0, table, writer);
    progress.advance(block.samples(grid));
  });
  file.commit();
}

template <typename T>
void evaluate_samples(const Arguments& arguments, const PatchFile& patches) {
  // A patch that T cannot hold is a failure, whether it has samples or not.
  PatchSet<T> set;
  for (std::size_t p = 0; p < patches.count; p += kBlockPatches) {
    set = PatchSet<T>(); // frees memory that the next set may take
    set = pack_patches<T>(patches, p, kBlockPatches);
  }
  BlockEvaluator<T> evaluator(
      [&](std::span<const std::uint32_t> wanted) { return pack_patches<T>(patches, wanted); },
      arguments.threads, set.size() == patches.count ? std::move(set) : PatchSet<T>());
  SampleReader reader(*arguments.samples, patches.count);
  OutputFile file(arguments.out);
  file.text(result_header(reader.centred(), arguments.outputs));
  ResultWriter writer(file);
  ResultTable<T> table(arguments.outputs);
  Progress progress("evaluating", "samples", 0, may_show_bar(arguments, file));
  for (SampleBlock<T> block; block.read(reader);) {
    write_sample_block(evaluator, block, table, writer);
    progress.advance(block.given.size());
  }
  file.commit();
}

template <typename T>
void evaluate(const Arguments& arguments) {
  const PatchFile patches = read_input(arguments);
  arguments.samples ? evaluate_samples<T>(arguments, patches)
                    : evaluate_on_grid<T>(arguments, patches);
}

} // namespace

void run_evaluate(const Arguments& arguments) {
  chosen_isa();
  refuse_input_as_output(arguments.out, inputs_of(arguments));
  arguments.precision == Precision::f32 ? evaluate<float>(arguments) : evaluate<double>(arguments);
}

} // namespace simdbezier::tools
