// simdbezier: the command-line program.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include <tools/commands/commands.hpp>
#include <tools/commands/report.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/interruption.hpp>

namespace {

using namespace simdbezier::tools;

// The parsers that we use allocate where they must not throw, for instance in destructors. Where
// memory runs out there, the program comes here. exit() removes the temporary file.
[[noreturn]] void end_without_memory() {
  try {
    if (const std::exception_ptr error = std::current_exception()) {
      std::rethrow_exception(error);
    }
  } catch (const std::bad_alloc&) {
    std::exit(report("not enough memory", 1));
  } catch (const std::exception& error) { // a defect of ours, of which abort() leaves a trace
    report(error.what(), 1);
  } catch (...) {
  }
  std::abort();
}

// Where the caller has closed a standard stream, the next file would be opened in its place, and
// data or messages would go there. What is opened instead here refuses to be read or written.
void keep_standard_streams_apart() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

} // namespace

int main(int argc, char** argv) {
  keep_standard_streams_apart();
  handle_interruptions();
  std::set_terminate(end_without_memory);
  try {
    if (const auto arguments = parse_arguments(argc, argv)) {
      run_command(*arguments);
    }
    return 0;
  } catch (const Failure& failure) {
    return report(failure.what(), failure.exit_code());
  } catch (const std::bad_alloc&) {
    return report("not enough memory", 1);
  } catch (const std::exception& error) {
    return report(error.what(), 1);
  }
}
