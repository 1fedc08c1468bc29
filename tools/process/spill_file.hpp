// Bytes that are read again later, and may be more than memory should hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tools/process/temporary_file.hpp>

namespace simdbezier::tools {

/// Appended to, then read at any place. The last 64 MiB used are in memory, the others in a file
/// without a name, which is not made before it is needed and goes away by itself. Every failure
/// throws Failure.
class SpillFile {
public:
  /// `output` is the file that it is needed for: both are in one folder, or the spill is where
  /// temporary files belong, if the output is a device or pipe.
  explicit SpillFile(const std::string& output);

  void append(const void* data, std::size_t size);
  /// Reads bytes that have been appended.
  void read(std::uint64_t at, void* data, std::size_t size);
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

private:
  static constexpr std::size_t kPageSize = std::size_t{1} << 16;
  static constexpr std::size_t kPagesInMemory = std::size_t{1} << 10;

  struct Page {
    std::uint64_t number = 0;
    bool changed = false;
    std::unique_ptr<char[]> bytes;
  };

  [[noreturn]] void fail(const std::string& what, int error) const;
  Page& page(std::uint64_t number);
  void store(Page& page);
  void load(Page& page);
  void open();
  template <typename Copy>
  void for_pages(std::uint64_t at, std::size_t size, Copy&& copy);

  std::string folder_;
  Descriptor file_;
  std::vector<Page> pages_; // the page of number n is at n mod kPagesInMemory
  std::uint64_t size_ = 0;
  std::uint64_t pages_made_ = 0;
};

} // namespace simdbezier::tools
