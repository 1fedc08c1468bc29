// What the header and the index of a file of binary patches (.sbp) say. docs/formats.md has the
// layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Two sums of bytes as numbers of 64 bits, little endian, the last one filled with zeros: of the
/// numbers, and of all sums of the first ones. Each bit that is changed alone changes the first.
struct SbpCheck {
  std::uint64_t sum = 0;
  std::uint64_t sum_of_sums = 0;
  bool operator==(const SbpCheck&) const = default;
};
[[nodiscard]] SbpCheck check_of(std::span<const std::byte> bytes);

/// The sums of bytes that come piece by piece.
class RunningCheck {
public:
  void add(std::span<const std::byte> bytes);
  [[nodiscard]] SbpCheck value() const;

private:
  void add_number(const std::byte* bytes);

  SbpCheck check_;
  std::array<std::byte, sizeof(std::uint64_t)> rest_ = {};
  std::size_t rest_bytes_ = 0;
};

/// Consecutive patches of one shape, and the box of their control points.
struct SbpBlock {
  std::uint64_t first_patch = 0;
  std::uint64_t count = 0;
  std::uint64_t offset = 0; ///< of its first number, from the beginning of the file
  std::uint64_t bytes = 0;
  std::uint32_t degree_u = 3;
  std::uint32_t degree_v = 3;
  Weights weights = Weights::none;
  std::uint32_t number_bytes = 4; ///< 4 for floats, 8 for doubles
  std::array<double, 3> low = {};
  std::array<double, 3> high = {};
  SbpCheck check = {};

  [[nodiscard]] std::size_t values_per_patch() const noexcept {
    return std::size_t{degree_u + 1} * (degree_v + 1) * (weights == Weights::none ? 3 : 4);
  }
  [[nodiscard]] bool has_shape_of(const SbpBlock& other) const noexcept {
    return degree_u == other.degree_u && degree_v == other.degree_v && weights == other.weights;
  }
};

struct SbpIndex {
  std::uint64_t patches = 0;
  std::uint64_t data_offset = 0;
  std::uint64_t size = 0; ///< of the file
  double moved_error = 0; ///< the sum of PatchFile::moved_error and cut_error
  std::vector<SbpBlock> blocks;
};

inline constexpr std::size_t kSbpHeaderBytes = 128;
inline constexpr std::size_t kSbpEntryBytes = 128;
inline constexpr std::size_t kSbpAlignment = 4096; ///< of the first patch
/// A block is read as a whole, so that a damaged index must not promise too much.
inline constexpr std::size_t kMostSbpBlockBytes = std::size_t{1} << 26;

/// Returns the header and the index as bytes.
[[nodiscard]] std::vector<std::byte> sbp_bytes(const SbpIndex& index);
/// Whether a file that begins like this is one of binary patches.
[[nodiscard]] bool is_sbp(std::span<const std::byte> beginning);
/// Reads both, up to the first patch. read(bytes) fills bytes that follow those read before, and
/// returns how many there were. Throws Failure that begins with `name`.
template <typename Read>
[[nodiscard]] SbpIndex read_sbp_index(const std::string& name, const Read& read);

/// Adds some patches of a block to a file, as one mesh, whose memory `bytes` become.
/// Throws Failure that names the block where a number cannot be a coordinate or weight.
void add_sbp_patches(PatchFile& file, const SbpBlock& block,
                     const std::shared_ptr<std::byte[]>& bytes, std::size_t count);
/// Throws Failure that names the block where its bytes are not those that were written.
void expect_intact(const std::string& name, const SbpIndex& index, const SbpBlock& block,
                   std::span<const std::byte> bytes);

// What read_sbp_index() consists of.
[[nodiscard]] std::uint64_t sbp_blocks_of(const std::string& name,
                                          std::span<const std::byte> header);
[[nodiscard]] SbpIndex parse_sbp(const std::string& name, std::span<const std::byte> both);
void expect_zeros(const std::string& name, std::span<const std::byte> between);
[[noreturn]] void refuse_cut_sbp(const std::string& name, const std::string& what);

template <typename Read>
SbpIndex read_sbp_index(const std::string& name, const Read& read) {
  std::vector<std::byte> both(kSbpHeaderBytes);
  if (read(std::span(both)) != both.size()) {
    refuse_cut_sbp(name, "its header");
  }
  // Entries are read in pieces, because a damaged header may say anything of their number.
  constexpr std::uint64_t kAtOnce = 4096;
  for (std::uint64_t left = sbp_blocks_of(name, both); left > 0;) {
    const std::size_t bytes = kSbpEntryBytes * std::min(left, kAtOnce);
    both.resize(both.size() + bytes);
    if (read(std::span(both).last(bytes)) != bytes) {
      refuse_cut_sbp(name, "its index");
    }
    left -= std::min(left, kAtOnce);
  }
  SbpIndex index = parse_sbp(name, both);
  std::vector<std::byte> between(index.data_offset - both.size());
  if (read(std::span(between)) != between.size()) {
    refuse_cut_sbp(name, "its index");
  }
  expect_zeros(name, between);
  return index;
}

} // namespace simdbezier::tools
