// What holds for every file of patches that a reader takes, and for every one that it refuses.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::fuzz {

/// A file in memory that has a path; its contents are replaced, never appended to.
class MemoryFile {
public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

private:
  int descriptor_;
  std::string path_;
};

/// Aborts unless a message is one line that names the file.
void require_message(const std::string& message, const std::string& path);

/// Reads the bytes as a file of that format. A refusal has to be a proper one. What is taken has to
/// be consistent and complete, comes back equal when it is written as .bv and read again, and is
/// packed and evaluated.
void check_patch_file(std::span<const std::uint8_t> bytes, tools::PatchFormat format);

} // namespace simdbezier::fuzz
