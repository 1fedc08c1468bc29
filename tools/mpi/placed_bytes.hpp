// Bytes of one rank on their way to consecutive places of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tools/mpi/rank_file.hpp>

namespace simdbezier::tools {

/// Collects bytes, so that few large pieces are written.
class PlacedBytes {
public:
  PlacedBytes(RankFile& file, std::uint64_t at) : file_(file), at_(at) {}
  [[nodiscard]] std::vector<std::byte>& bytes() noexcept { return bytes_; }
  void flush_when_full() {
    constexpr std::size_t kFull = std::size_t{1} << 22;
    if (bytes_.size() >= kFull) {
      flush();
    }
  }
  void flush() {
    file_.write(at_, bytes_);
    at_ += bytes_.size();
    bytes_.clear();
  }

private:
  RankFile& file_;
  std::uint64_t at_;
  std::vector<std::byte> bytes_;
};

} // namespace simdbezier::tools
