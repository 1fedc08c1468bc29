// The bytes of an input: of a file or standard input, unpacked where they are compressed by gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace simdbezier::tools {

class Gunzip;
class Progress;

/// What is wrong with the bytes of an input, for a message that has its name and the place.
struct DamagedInput {
  std::string expected;
  std::string found;
};

/// Reads an input. Whether it is compressed is decided by its first bytes, never by its name.
class ByteSource {
public:
  /// Throws Failure when the input cannot be read: missing, a directory, no permission.
  explicit ByteSource(const std::string& path);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Returns how many bytes there were; 0 at the end only. Throws DamagedInput.
  [[nodiscard]] std::size_t read(char* data, std::size_t size);

  /// Returns the size as it is stored, in bytes; 0 where that is unknown, as for pipes.
  [[nodiscard]] std::uint64_t stored_size() const;
  /// Shows from now on how much of what is stored has been read.
  void show(Progress& progress) noexcept { progress_ = &progress; }

private:
  struct Close {
    void operator()(std::FILE* file) const noexcept;
  };
  [[nodiscard]] std::size_t read_stored(char* data, std::size_t size);

  std::unique_ptr<std::FILE, Close> file_;
  Progress* progress_ = nullptr;
  bool at_start_ = true;
  std::unique_ptr<Gunzip> gunzip_; // where the input is compressed
};

} // namespace simdbezier::tools
