// simdbezier: the command-line program.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include <tools/commands.hpp>
#include <tools/failure.hpp>
#include <tools/interruption.hpp>

namespace {

using namespace simdbezier::tools;

void run(const Arguments& arguments) {
  switch (arguments.command) {
  case Command::tessellate:
    return run_tessellate(arguments);
  case Command::evaluate:
    return run_evaluate(arguments);
  case Command::info:
    return run_info(arguments);
  }
}

// One line, whatever a file name brings along.
int report(std::string message, int exit_code) {
  std::ranges::replace_if(
      message, [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; }, ' ');
  std::fprintf(stderr, "simdbezier: %s\n", message.c_str());
  return exit_code;
}

// Files would be opened in the place of a standard stream that the caller has closed, and data or
// messages go there. Reading and writing these fails.
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
  try {
    if (const auto arguments = parse_arguments(argc, argv)) {
      run(*arguments);
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
