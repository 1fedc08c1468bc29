#include <tools/parts/patch_source.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <tools/patches/patch_box.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kPatchesPerBlock = 256;

// Reads as much as there is.
std::size_t read_at(int file, std::uint64_t offset, std::span<std::byte> to,
                    const std::string& name) {
  std::size_t found = 0;
  while (found < to.size()) {
    const ssize_t more =
        pread(file, to.data() + found, to.size() - found, static_cast<off_t>(offset + found));
    if (more < 0 && errno != EINTR) {
      bad_input(name + ": expected readable binary patches, found " +
                in_quotes(std::strerror(errno)));
    }
    if (more == 0) {
      break;
    }
    found += static_cast<std::size_t>(std::max<ssize_t>(more, 0));
  }
  return found;
}

} // namespace

PatchSource::PatchSource(PatchFile file)
    : name_(file.name), patches_(file.count), whole_(std::move(file)) {
  for (std::size_t first = 0; first < patches_; first += kPatchesPerBlock) {
    const std::size_t count = std::min(kPatchesPerBlock, patches_ - first);
    const MeshBox box = box_of(whole_, first, count);
    SbpBlock& block = index_.blocks.emplace_back();
    block.first_patch = first;
    block.count = count;
    block.low = box.low;
    block.high = box.high;
  }
  find_box();
  RunningCheck values;
  whole_.visit_all_values([&](const auto some) { values.add(std::as_bytes(some)); });
  SbpCheck check = values.value();
  for (const PatchRun& run : whole_.runs) {
    const std::uint64_t shape[] = {run.count, static_cast<std::uint64_t>(run.degree_u),
                                   static_cast<std::uint64_t>(run.degree_v),
                                   static_cast<std::uint64_t>(run.weights)};
    check.sum_of_sums += check_of(std::as_bytes(std::span(shape))).sum_of_sums + check.sum;
    check.sum += check.sum_of_sums;
  }
  const SbpCheck named = check_of(std::as_bytes(std::span(whole_.vertices)));
  fingerprint_ = check.sum + 3 * check.sum_of_sums + 5 * named.sum_of_sums;
}

std::unique_ptr<PatchSource> PatchSource::open(const std::string& path) {
  std::unique_ptr<PatchSource> source(new PatchSource);
  source->file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  std::array<std::byte, 8> magic = {};
  const int file = source->file_.number();
  if (!source->file_.is_open() || fstat(file, &status) != 0 || !S_ISREG(status.st_mode) ||
      read_at(file, 0, magic, path) != magic.size() || !is_sbp(magic)) {
    return nullptr;
  }
  source->name_ = path;
  std::uint64_t offset = 0;
  source->index_ = read_sbp_index(path, [&](std::span<std::byte> to) {
    const std::size_t found = read_at(file, offset, to, path);
    offset += found;
    return found;
  });
  const SbpIndex& index = source->index_;
  if (static_cast<std::uint64_t>(status.st_size) != index.size) {
    bad_input(path + ": expected " + std::to_string(index.size) +
              " bytes of binary patches, found " + std::to_string(status.st_size));
  }
  source->patches_ = index.patches;
  const SbpCheck check = check_of(sbp_bytes(index)); // which has the sums of all blocks
  source->fingerprint_ = check.sum + 3 * check.sum_of_sums;
  source->find_box();
  return source;
}

void PatchSource::find_box() {
  box_.low.fill(std::numeric_limits<double>::infinity());
  box_.high.fill(-std::numeric_limits<double>::infinity());
  for (const SbpBlock& block : blocks()) {
    for (std::size_t c = 0; c < 3; ++c) {
      box_.low[c] = std::min(box_.low[c], block.low[c]);
      box_.high[c] = std::max(box_.high[c], block.high[c]);
    }
  }
}

std::shared_ptr<std::byte[]> PatchSource::bytes_of(const SbpBlock& block) const {
  std::shared_ptr<std::byte[]> bytes(new std::byte[block.bytes]);
  const std::span<std::byte> all(bytes.get(), block.bytes);
  if (read_at(file_.number(), block.offset, all, name_) != all.size()) {
    refuse_cut_sbp(name_, "its patches");
  }
  expect_intact(name_, index_, block, all);
  return bytes;
}

PatchFile PatchSource::read(std::size_t first, std::size_t count) const {
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t k = 0; k < count; ++k) {
    numbers[k] = static_cast<std::uint32_t>(first + k);
  }
  return read(numbers);
}

PatchFile PatchSource::read(std::span<const std::uint32_t> numbers) const {
  if (!file_.is_open()) {
    return whole_.of(numbers);
  }
  PatchFile file;
  file.name = name_;
  file.cut_error = index_.moved_error;
  for (std::size_t k = 0; k < numbers.size();) {
    const auto after = std::ranges::upper_bound(index_.blocks, std::uint64_t{numbers[k]}, {},
                                                &SbpBlock::first_patch);
    const SbpBlock& block = *std::prev(after);
    std::shared_ptr<std::byte[]> bytes = bytes_of(block);
    const std::size_t begin = k;
    while (k < numbers.size() && numbers[k] < block.first_patch + block.count) {
      ++k;
    }
    if (k - begin < block.count) { // the others need not stay in memory
      const std::size_t each = block.bytes / block.count;
      const std::shared_ptr<std::byte[]> all = std::move(bytes);
      bytes.reset(new std::byte[(k - begin) * each]);
      for (std::size_t n = begin; n < k; ++n) {
        std::memcpy(&bytes[(n - begin) * each], &all[(numbers[n] - block.first_patch) * each],
                    each);
      }
    }
    add_sbp_patches(file, block, bytes, k - begin);
  }
  return file;
}

} // namespace simdbezier::tools
