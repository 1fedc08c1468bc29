#include "tests/reliability/fuzz/checks/promised_patches.hpp"

#include <algorithm>
#include <limits>

namespace simdbezier::fuzz {

namespace {

constexpr std::string_view kSpace = " \n\t\r\f\v";
constexpr std::size_t kMoreThanAny = std::numeric_limits<std::size_t>::max() / 2;

/// What a request outside of strings, lists and comments promises.
std::size_t promise_of_request(std::string_view word) {
  constexpr std::string_view kOtherGeometry[] = {
      "Sphere",      "Polygon",         "Torus",  "Cone",   "Cylinder", "Disk",
      "ReadArchive", "SubdivisionMesh", "Blobby", "Curves", "Points"};
  if (std::ranges::find(kOtherGeometry, word) != std::end(kOtherGeometry)) {
    return kMoreThanAny;
  }
  return word == "Patch" || word == "PatchMesh" || word == "NuPatch" ? 1 : 0;
}

std::size_t behind_string(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"') {
    at += text[at] == '\\' ? 2 : 1;
  }
  return at + 1;
}

std::size_t promised_by_rib(std::string_view text) {
  std::size_t promised = 0;
  std::size_t depth = 0;
  bool in_object = false; // whose patches show where there are instances
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (kSpace.find(c) != std::string_view::npos) {
      ++at;
    } else if (c == '#') {
      at = std::min(text.find_first_of("\r\n", at), text.size());
    } else if (c == '[' || c == ']') {
      depth = c == '[' ? depth + 1 : depth - std::min<std::size_t>(depth, 1);
      ++at;
    } else if (c == '"') {
      at = behind_string(text, at + 1);
    } else {
      const std::size_t end = std::min(text.find_first_of(" \n\t\r\f\v[]\"", at), text.size());
      const std::string_view word = text.substr(at, end - at);
      const std::size_t promise = depth == 0 ? promise_of_request(word) : 0;
      in_object = (in_object || word == "ObjectBegin") && word != "ObjectEnd";
      promised += in_object && promise == 1 ? 0 : promise;
      at = end;
    }
  }
  return promised;
}

/// Statements begin their lines. Lines may be joined by a backslash: such files promise nothing.
std::size_t promised_by_obj(std::string_view text) {
  std::size_t promised = 0;
  while (!text.empty() && text.find('\\') == std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::size_t first = text.find_first_not_of(" \t\f\v");
    const std::string_view line = text.substr(std::min(first, end), end - std::min(first, end));
    promised += line.starts_with("surf ") || line.starts_with("surf\t") ? 1 : 0;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return promised;
}

} // namespace

std::size_t promised_patches(std::string_view text, tools::PatchFormat format) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  text.remove_prefix(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  switch (format) {
  case tools::PatchFormat::rib:
    return promised_by_rib(text);
  case tools::PatchFormat::obj:
    return promised_by_obj(text);
  default:
    return 0;
  }
}

} // namespace simdbezier::fuzz
