#include <tools/process/output_file.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

thread_local OutputInMemory* innermost = nullptr;

class MemoryTarget final : public OutputTarget {
public:
  explicit MemoryTarget(std::vector<char>& bytes) : bytes_(bytes) { bytes_.clear(); }

  [[nodiscard]] bool is_terminal() const override { return false; }
  void expect_room(std::uintmax_t bytes) const override {
    if (bytes <= bytes_.max_size()) { // and otherwise append() fails
      bytes_.reserve(static_cast<std::size_t>(bytes));
    }
  }
  [[nodiscard]] bool can_rewrite() const noexcept override { return true; }
  void rewrite(std::uint64_t at, std::string_view text) override {
    std::ranges::copy(text, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  void complete() override {}
  void commit() override {}
  void append(const char* data, std::size_t size) override {
    bytes_.insert(bytes_.end(), data, data + size);
  }

private:
  std::vector<char>& bytes_;
};

std::unique_ptr<OutputTarget> target_of(const std::string& path) {
  return innermost != nullptr && innermost->path() == path
             ? std::make_unique<MemoryTarget>(innermost->bytes)
             : open_target(path);
}

} // namespace

OutputInMemory::OutputInMemory(std::string path)
    : path_(std::move(path)), outer_(std::exchange(innermost, this)) {}

OutputInMemory::~OutputInMemory() { innermost = outer_; }

OutputFile::OutputFile(const std::string& path) : target_(target_of(path)), buffer_(kBufferSize) {}

void OutputFile::bytes(const void* data, std::size_t size) {
  if (size > kBufferSize - used_) {
    flush();
  }
  if (size > kBufferSize) {
    return target_->append(static_cast<const char*>(data), size);
  }
  // Of no bytes, data may be null, which memcpy() may not be given.
  std::copy_n(static_cast<const char*>(data), size, buffer_.data() + used_);
  used_ += size;
}

void OutputFile::flush() { target_->append(buffer_.data(), std::exchange(used_, 0)); }

void OutputFile::rewrite(std::uint64_t at, std::string_view text) {
  flush();
  target_->rewrite(at, text);
}

void OutputFile::complete() {
  flush();
  target_->complete();
  is_complete_ = true;
}

void OutputFile::commit() {
  if (!is_complete_) {
    complete();
  }
  target_->commit();
}

std::string extension_of(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0 || name == "..") { // a hidden file, or a folder
    return "";
  }
  std::string extension = name.substr(dot + 1);
  for (char& c : extension) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return extension;
}

#if defined(__wasm__)
// As std::to_chars() has it, whose tables would be a tenth of a module: the fewest digits that read
// back, as 0.001 or 1e-05, whichever is shorter.
std::string shortest(double value) {
  std::array<char, 40> text;
  int digits = 0;
  do {
    std::snprintf(text.data(), text.size(), "%.*e", digits, value);
  } while (++digits < 17 && std::strtod(text.data(), nullptr) != value);
  const std::string scientific = text.data();
  const std::size_t e = scientific.find('e');
  if (e == std::string::npos) { // inf, nan
    return scientific;
  }
  const std::string sign = value < 0 || scientific[0] == '-' ? "-" : "";
  std::string figures;
  std::ranges::copy_if(scientific.substr(sign.size(), e - sign.size()), std::back_inserter(figures),
                       [](char c) { return c != '.'; });
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  const int last = static_cast<int>(figures.size()) - 1;
  std::string fixed;
  if (exponent < 0) {
    fixed = "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + figures;
  } else if (exponent > 22) { // longer than any scientific form
    return scientific;
  } else if (exponent >= last) { // digits that are not needed stay those of the value
    std::snprintf(text.data(), text.size(), "%.0f", value < 0 ? -value : value);
    fixed = text.data();
  } else {
    fixed = figures.insert(static_cast<std::size_t>(exponent) + 1, ".");
  }
  return sign.size() + fixed.size() <= scientific.size() ? sign + fixed : scientific;
}
#else
std::string shortest(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}
#endif

} // namespace simdbezier::tools
