#include <tools/commands/report.hpp>

#include <cstdio>

namespace simdbezier::tools {

int report(std::string_view message, int exit_code) {
  static char line[BUFSIZ];
  std::setvbuf(stderr, line, _IOFBF, sizeof line);
  std::fputs("simdbezier: ", stderr);
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c); // char has a sign on some machines alone
    const bool control = byte < 0x20 || byte == 0x7f;
    std::putc(control ? ' ' : c, stderr);
  }
  std::putc('\n', stderr);
  std::fflush(stderr);
  return exit_code;
}

} // namespace simdbezier::tools
