// Unpacks what gzip has compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

struct z_stream_s; // zlib's

namespace simdbezier::tools {

/// Takes compressed bytes, gives back what they stand for. Files that follow each other are one,
/// and zeros behind the last one are passed over, as gzip has it. Throws DamagedInput where the
/// bytes are none of gzip's, and where they unpack to more than the limit that SECURITY.md states,
/// which small files could exceed a thousandfold.
class Gunzip {
public:
  /// What compressed bytes begin with, and text never does.
  static constexpr std::string_view kMagic = "\x1f\x8b";
  static constexpr std::size_t kRoom = std::size_t{1} << 16;
  /// More than this may be unpacked, at any place of the input, only up to so many times its bytes.
  static constexpr std::uint64_t kAlwaysUnpacked = std::uint64_t{1} << 24;
  static constexpr std::uint64_t kMostTimes = 100;

  explicit Gunzip(std::string_view first);
  ~Gunzip();
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  /// Returns how many bytes there are; 0 where compressed ones are missing.
  [[nodiscard]] std::size_t unpack(char* data, std::size_t size);
  /// Returns where the next compressed bytes go, at most kRoom.
  [[nodiscard]] char* room() noexcept { return packed_.data(); }
  /// Says how many bytes have been put there.
  void fed(std::size_t size) noexcept;
  /// Throws where the compressed data end too early.
  void expect_end() const;

private:
  void pass_over_zeros();
  void step();
  void check_limit() const;

  std::vector<char> packed_;
  std::unique_ptr<z_stream_s> stream_;
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
  bool is_complete_ = false; // the bytes so far are one or more whole files
  bool is_padded_ = false;   // and zeros behind them
  bool has_more_ = false;    // whether there is more than there was room for
};

} // namespace simdbezier::tools
