// The bytes of an input: of a file, standard input or memory, unpacked where they are compressed by
// gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace simdbezier::tools {

class Gunzip;
class Progress;

/// What is wrong with the bytes of an input, for a message that has its name and the place.
struct DamagedInput {
  std::string expected;
  std::string found;
};

/// The bytes as they are stored.
class StoredBytes {
public:
  StoredBytes() = default;
  virtual ~StoredBytes() = default;
  StoredBytes(const StoredBytes&) = delete;
  StoredBytes& operator=(const StoredBytes&) = delete;

  /// Returns how many bytes there were; 0 at the end only. Throws DamagedInput.
  [[nodiscard]] virtual std::size_t read(char* data, std::size_t size) = 0;
  /// Returns so many bytes that follow those that were read, without a copy; null where they are
  /// not those of a file, or there are fewer.
  [[nodiscard]] virtual std::shared_ptr<std::byte[]> map(std::size_t /*size*/) { return nullptr; }
  /// Returns how many there are in all; 0 where that is unknown, as for pipes.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
};

/// Opens a file, or standard input ("-"). Throws Failure when it cannot be read: missing, a
/// directory, no permission.
[[nodiscard]] std::unique_ptr<StoredBytes> open_file(const std::string& path);

/// Reads an input. Whether it is compressed is decided by its first bytes, never by its name.
class ByteSource {
public:
  /// Throws Failure where open_file() does.
  explicit ByteSource(const std::string& path);
  /// Takes bytes that are in memory, and stay there as long as this.
  explicit ByteSource(std::span<const char> memory);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Returns how many bytes there were; 0 at the end only. Throws DamagedInput.
  [[nodiscard]] std::size_t read(char* data, std::size_t size);

  /// Returns the next bytes, which may be changed; null where there are fewer. Throws DamagedInput.
  [[nodiscard]] std::shared_ptr<std::byte[]> take(std::size_t size);

  /// Returns the size as it is stored, in bytes; 0 where that is unknown, as for pipes.
  [[nodiscard]] std::uint64_t stored_size() const { return stored_->size(); }
  /// Shows from now on how much of what is stored has been read.
  void show(Progress& progress) noexcept { progress_ = &progress; }

private:
  [[nodiscard]] std::size_t read_stored(char* data, std::size_t size);

  std::unique_ptr<StoredBytes> stored_;
  Progress* progress_ = nullptr;
  bool at_start_ = true;
  std::unique_ptr<Gunzip> gunzip_; // where the input is compressed
};

} // namespace simdbezier::tools
