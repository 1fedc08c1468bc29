// simdbezier-mpi: the program, by many processes.
#include <cstdlib>
#include <exception>

#include <mpi.h>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <tools/commands/commands.hpp>
#include <tools/commands/report.hpp>
#include <tools/mpi/mpi_evaluate.hpp>
#include <tools/mpi/mpi_tessellate.hpp>
#include <tools/process/interruption.hpp>

namespace {

using namespace simdbezier::tools;

// All ranks get the same words, so one of them answers. Commands that ranks cannot share are run by
// the first one.
int run(int argc, char** argv) {
  Ranks ranks(MPI_COMM_WORLD);
  if (!ranks.is_first()) {
    static_cast<void>(dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO));
    static_cast<void>(dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO));
  }
  try {
    std::optional<Arguments> arguments;
    ranks.together([&] {
      arguments = parse_arguments(argc, argv, true);
      if (arguments && arguments->shard) {
        bad_usage("--shard: expected with simdbezier, found with simdbezier-mpi");
      }
      if (arguments && arguments->command == Command::tessellate) {
        expect_local_options(*arguments);
      }
    });
    if (arguments && arguments->command == Command::tessellate) {
      run_mpi_tessellate(ranks, *arguments);
    } else if (arguments && arguments->command == Command::evaluate) {
      run_mpi_evaluate(ranks, *arguments);
    } else if (arguments) {
      ranks.together([&] { ranks.is_first() ? run_command(*arguments) : void(); });
    }
    return 0;
  } catch (const Failure& failure) {
    return ranks.is_first() ? report(failure.what(), failure.exit_code()) : failure.exit_code();
  }
}

} // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  handle_interruptions();
  // What a shard needed goes back to the system when it is done. Otherwise the allocator comes to
  // keep ever larger pieces, between which memory is lost from shard to shard.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  // Small blocks stay: the next patches would only touch their pages again, which are cleared.
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
  int code = 1;
  try {
    code = run(argc, argv);
  } catch (const std::exception& error) { // between collective calls: others would wait
    report(error.what(), 1);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return code;
}
