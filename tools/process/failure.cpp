#include <tools/process/failure.hpp>

namespace simdbezier::tools {

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kShown = 40;
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result = "'";
  for (const char c : word.substr(0, kShown)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7f) {
      result.push_back(c);
    } else {
      result.append({'\\', 'x', kDigits[code >> 4], kDigits[code & 15]});
    }
  }
  return result + (word.size() > kShown ? "…'" : "'");
}

std::string alternatives(std::span<const std::string> words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
  }
  return text;
}

} // namespace simdbezier::tools
