// Results by many processes. Lines have different lengths, so that nobody knows where a block's
// begin before all earlier ones are there: in each round, every rank makes the lines of one block,
// all tell how long these are, and write them.
#include <tools/mpi/mpi_evaluate.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/commands/meshes/part_work.hpp>
#include <tools/commands/result_lines.hpp>
#include <tools/mpi/rank_file.hpp>
#include <tools/process/output_file.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
class MpiEvaluation {
public:
  MpiEvaluation(const Ranks& ranks, const Arguments& arguments, const PatchSource& source)
      : ranks_(ranks), arguments_(arguments), source_(source), table_(arguments.outputs) {}

  void on_grid() {
    const GridSize grid = arguments_.grid;
    const std::size_t columns = column_count(arguments_.outputs);
    std::uint64_t samples = 0;
    ranks_.together(
        [&] { samples = checked_sample_count(source_.patches(), grid, columns * sizeof(T)); });
    begin(least_bytes(samples, columns), false);
    Progress progress("evaluating", "samples", samples, ranks_.is_first());
    std::optional<GridBlock> own;
    int rank = 0; // whose block the next one is
    const auto end_round = [&] {
      ranks_.together([&] {
        if (own) {
          write_block(*own);
        }
      });
      write_lines();
      own.reset();
      rank = 0;
    };
    for_each_block(source_.patches(), grid, [&](const GridBlock& block) {
      if (rank == ranks_.rank()) {
        own = block;
      }
      if (++rank == ranks_.count()) {
        end_round();
      }
      progress.advance(block.samples(grid));
    });
    end_round();
    file_->finish();
  }

  // All ranks read all samples.
  void at_samples() {
    std::optional<SampleReader> reader;
    ranks_.together([&] {
      expect_own_patches_fit();
      reader.emplace(*arguments_.samples, source_.patches());
    });
    begin(0, reader->centred());
    Progress progress("evaluating", "samples", 0, ranks_.is_first());
    BlockEvaluator<T> evaluator(
        [&](std::span<const std::uint32_t> wanted) {
          return pack_patches<T>(source_.read(wanted));
        },
        arguments_.threads);
    SampleBlock<T> block;
    for (bool more = true; more;) {
      ranks_.together([&] {
        for (int rank = 0; rank < ranks_.count() && more; ++rank) {
          more = block.read(*reader);
          if (more && rank == ranks_.rank()) {
            add_lines([&](ResultWriter& writer) {
              write_sample_block(evaluator, block, table_, writer);
            });
          }
          progress.advance(block.given.size());
        }
      });
      write_lines();
    }
    file_->finish();
  }

private:
  void begin(std::uint64_t least, bool centred) {
    file_.emplace(ranks_, MPI_COMM_WORLD, arguments_.out, least);
    if (ranks_.is_first()) {
      const std::string header = result_header(centred, arguments_.outputs);
      lines_.assign(header.begin(), header.end());
    }
  }
  void write_block(const GridBlock& block) {
    const PatchFile patches = source_.read(block.first_patch, block.patch_count);
    GridEvaluator<T> evaluator(patches, arguments_.grid, arguments_.threads);
    add_lines([&](ResultWriter& writer) {
      write_grid_block(evaluator, {0, block.patch_count, block.first_row, block.row_count},
                       arguments_.grid, block.first_patch, table_, writer);
    });
  }
  // Puts what write(writer) writes behind the lines that wait.
  template <typename Write>
  void add_lines(const Write& write) {
    OutputInMemory memory(arguments_.out);
    OutputFile file(memory.path());
    ResultWriter writer(file);
    write(writer);
    file.complete();
    lines_.insert(lines_.end(), memory.bytes.begin(), memory.bytes.end());
  }
  void write_lines() {
    const std::uint64_t before = ranks_.sum_before(lines_.size());
    const std::uint64_t all = ranks_.sum(lines_.size());
    ranks_.together([&] { file_->write(written_ + before, std::as_bytes(std::span(lines_))); });
    written_ += all;
    lines_.clear();
  }
  // Patches that T cannot hold are a failure, whether they have samples or not.
  void expect_own_patches_fit() const {
    const auto rank = static_cast<std::size_t>(ranks_.rank());
    const SetRange own =
        shard_range(source_.patches(), rank, static_cast<std::size_t>(ranks_.count()));
    for (std::size_t done = 0; done < own.count; done += kBlockPatches) {
      static_cast<void>(pack_patches<T>(
          source_.read(own.first + done, std::min(kBlockPatches, own.count - done))));
    }
  }

  const Ranks& ranks_;
  const Arguments& arguments_;
  const PatchSource& source_;
  ResultTable<T> table_;
  std::vector<char> lines_; // of this round
  std::optional<RankFile> file_;
  std::uint64_t written_ = 0; // by all ranks
};

template <typename T>
void evaluate(const Ranks& ranks, const Arguments& arguments, const PatchSource& source) {
  MpiEvaluation<T> evaluation(ranks, arguments, source);
  arguments.samples ? evaluation.at_samples() : evaluation.on_grid();
}

} // namespace

void run_mpi_evaluate(Ranks& ranks, const Arguments& arguments) {
  std::unique_ptr<PatchSource> source;
  ranks.together([&] {
    chosen_isa();
    for (const std::string& name : inputs_of(arguments)) {
      if (name == "-") {
        bad_usage("IN: expected files that all ranks can read, found standard input");
      }
    }
    if (is_written_directly(arguments.out)) {
      bad_usage("-o: expected a file that all ranks can write, found " + arguments.out);
    }
    refuse_input_as_output(arguments.out, inputs_of(arguments));
    source = open_source(arguments);
  });
  arguments.precision == Precision::f32 ? evaluate<float>(ranks, arguments, *source)
                                        : evaluate<double>(ranks, arguments, *source);
}

} // namespace simdbezier::tools
