// Files that appear complete or not at all.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace simdbezier::tools {

/// Where written bytes go. Every failure throws Failure.
class OutputTarget {
public:
  OutputTarget() = default;
  virtual ~OutputTarget() = default;
  OutputTarget(const OutputTarget&) = delete;
  OutputTarget& operator=(const OutputTarget&) = delete;

  /// These do what OutputFile's members of their names do.
  [[nodiscard]] virtual bool is_terminal() const = 0;
  virtual void expect_room(std::uintmax_t bytes) const = 0;
  [[nodiscard]] virtual bool can_rewrite() const noexcept = 0;
  virtual void rewrite(std::uint64_t at, std::string_view text) = 0;
  virtual void complete() = 0;
  virtual void commit() = 0;

  virtual void append(const char* data, std::size_t size) = 0;
};

/// Begins a file on a disk, or opens what "-", a device or a pipe stands for.
[[nodiscard]] std::unique_ptr<OutputTarget> open_target(const std::string& path);

/// While it lives, what its thread writes to a file of this name is here instead.
class OutputInMemory {
public:
  explicit OutputInMemory(std::string path);
  ~OutputInMemory();
  OutputInMemory(const OutputInMemory&) = delete;
  OutputInMemory& operator=(const OutputInMemory&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  std::vector<char> bytes; ///< all of the file when it has been completed

private:
  std::string path_;
  OutputInMemory* outer_;
};

/// Writes to a temporary file beside `path`. commit() puts it there, on the disk, with the owner,
/// group and mode of the file that it replaces. Without commit() the temporary file is removed, and
/// an existing file stays as it was. Links are followed. "-", devices and pipes have no name that
/// could be replaced and are written as they are. A name that an OutputInMemory has goes there.
/// Every failure throws Failure.
class OutputFile {
public:
  explicit OutputFile(const std::string& path);

  /// Whether people can see the output while it is written.
  [[nodiscard]] bool is_terminal() const { return target_->is_terminal(); }
  /// Fails at once where the file system has no room for that much.
  void expect_room(std::uintmax_t bytes) const { target_->expect_room(bytes); }

  void text(std::string_view text) { bytes(text.data(), text.size()); }
  void character(char c) { *room(1) = c, ++used_; }
  void bytes(const void* data, std::size_t size);
  /// Whether what has been written can be replaced: not in devices and pipes.
  [[nodiscard]] bool can_rewrite() const noexcept { return target_->can_rewrite(); }
  /// Replaces bytes that have been written.
  void rewrite(std::uint64_t at, std::string_view text);

  /// Shortest decimals that read back to the same bits (integers: all digits).
  template <typename T>
  void number(T value) {
    char* const first = room(kLongestNumber);
    used_ +=
        static_cast<std::size_t>(std::to_chars(first, first + kLongestNumber, value).ptr - first);
  }

  /// Brings everything to its disk or device. Nothing more can be written; only the name is
  /// missing.
  void complete();
  /// Gives the file its name, after complete() if that has not been called.
  void commit();

private:
  static constexpr std::size_t kLongestNumber = 32;
  static constexpr std::size_t kBufferSize = std::size_t{1} << 18;

  void flush();
  char* room(std::size_t size) {
    if (kBufferSize - used_ < size) {
      flush();
    }
    return buffer_.data() + used_;
  }

  std::unique_ptr<OutputTarget> target_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  bool is_complete_ = false;
};

/// Throws Failure where the output would go to the file that an input is read from, by whatever
/// names. "-" means standard input or standard output.
void refuse_input_as_output(const std::string& out, std::span<const std::string> inputs);

/// True for "-", and for every other name of the file or device that standard output is, but not
/// for /dev/null, where nothing can mix.
[[nodiscard]] bool mixes_with_standard_output(const std::string& path);

/// True for "-", devices and pipes, which have no temporary file.
[[nodiscard]] bool is_written_directly(const std::string& path);

/// The folder that an output is written to: links are followed.
[[nodiscard]] std::string folder_of(const std::string& output);

/// What follows the last dot of a file's name, in lower case, without the dot.
[[nodiscard]] std::string extension_of(const std::string& path);

/// The shortest decimals that read back to the same value.
[[nodiscard]] std::string shortest(double value);

} // namespace simdbezier::tools
