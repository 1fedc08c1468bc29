// Patches that are read piece by piece where their file allows it, and otherwise as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tools/formats/patch_file.hpp>
#include <tools/formats/sbp_index.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/temporary_file.hpp>

namespace simdbezier::tools {

/// A model of which any patches can be had. Binary patches (.sbp) stay in their file, of which only
/// the index is in memory; all other formats are read once. Every failure throws Failure.
class PatchSource {
public:
  /// Takes a file that has been read.
  explicit PatchSource(PatchFile file);
  /// Opens a file of binary patches; null where it is none, or cannot be read piece by piece.
  [[nodiscard]] static std::unique_ptr<PatchSource> open(const std::string& path);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::size_t patches() const noexcept { return patches_; }
  [[nodiscard]] const MeshBox& box() const noexcept { return box_; }
  /// Cover all patches in their order, and have a box. Where patches are in memory, nothing else of
  /// a block has a meaning.
  [[nodiscard]] std::span<const SbpBlock> blocks() const noexcept { return index_.blocks; }
  /// Differs where the patches differ.
  [[nodiscard]] std::uint64_t fingerprint() const noexcept { return fingerprint_; }
  [[nodiscard]] std::size_t ignored_trims() const noexcept { return whole_.ignored_trims; }
  [[nodiscard]] std::size_t merged_splines() const noexcept { return whole_.merged_splines; }

  [[nodiscard]] PatchFile read(std::size_t first, std::size_t count) const;
  /// Reads patches of these numbers, ascending.
  [[nodiscard]] PatchFile read(std::span<const std::uint32_t> numbers) const;
  /// Gives all patches away, which only a file that is read as a whole can.
  [[nodiscard]] PatchFile take() { return std::move(whole_); }

private:
  PatchSource() = default;
  void find_box();
  [[nodiscard]] std::shared_ptr<std::byte[]> bytes_of(const SbpBlock& block) const;

  std::string name_;
  std::size_t patches_ = 0;
  MeshBox box_;
  std::uint64_t fingerprint_ = 0;
  PatchFile whole_; // empty where patches stay in their file
  Descriptor file_; // of binary patches
  SbpIndex index_;
};

} // namespace simdbezier::tools
