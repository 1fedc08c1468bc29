#include <tools/formats/sbp_index.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/little_endian.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::array<char, 8> kMagic = {'S', 'B', 'P', 'A', 'T', 'C', 'H', '\0'};
constexpr std::uint64_t kVersion = 1;
constexpr std::size_t kCheckAt = kSbpHeaderBytes - 2 * sizeof(std::uint64_t);

// Numbers one after the other.
class Cursor {
public:
  explicit Cursor(std::byte* at) : at_(at) {}
  template <typename V>
  void put(V value) {
    store_little(at_, value);
    at_ += sizeof value;
  }
  template <typename V>
  [[nodiscard]] V get() {
    const V value = load_little<V>(at_);
    at_ += sizeof value;
    return value;
  }

private:
  std::byte* at_;
};

void put_entry(const SbpBlock& block, std::byte* to) {
  Cursor out(to);
  for (const std::uint64_t value : {block.first_patch, block.count, block.offset, block.bytes}) {
    out.put(value);
  }
  for (const std::uint32_t value :
       {block.degree_u, block.degree_v, static_cast<std::uint32_t>(block.weights),
        block.number_bytes}) {
    out.put(value);
  }
  for (const auto& corner : {block.low, block.high}) {
    for (const double x : corner) {
      out.put(x);
    }
  }
  out.put(block.check.sum);
  out.put(block.check.sum_of_sums);
}

SbpBlock get_entry(const std::byte* from) {
  std::array<std::byte, kSbpEntryBytes> bytes;
  std::copy_n(from, bytes.size(), bytes.begin());
  Cursor in(bytes.data());
  SbpBlock block;
  for (std::uint64_t* const value :
       {&block.first_patch, &block.count, &block.offset, &block.bytes}) {
    *value = in.get<std::uint64_t>();
  }
  block.degree_u = in.get<std::uint32_t>();
  block.degree_v = in.get<std::uint32_t>();
  block.weights = static_cast<Weights>(in.get<std::uint32_t>());
  block.number_bytes = in.get<std::uint32_t>();
  for (auto* const corner : {&block.low, &block.high}) {
    for (double& x : *corner) {
      x = in.get<double>();
    }
  }
  block.check.sum = in.get<std::uint64_t>();
  block.check.sum_of_sums = in.get<std::uint64_t>();
  return block;
}

// The sums of the header, without their own place, and of the index.
SbpCheck check_of_both(std::span<const std::byte> both) {
  std::vector<std::byte> checked(both.begin(), both.end());
  std::fill_n(checked.begin() + kCheckAt, 2 * sizeof(std::uint64_t), std::byte{0});
  return check_of(checked);
}

// Whether a block that the sums let pass can be one, and follows the one before.
bool is_sound(const SbpBlock& block, std::uint64_t first_patch, std::uint64_t offset) {
  const auto is_degree = [](std::uint32_t degree) { return degree >= 1 && degree <= kMostDegree; };
  return block.first_patch == first_patch && block.offset == offset && block.count > 0 &&
         is_degree(block.degree_u) && is_degree(block.degree_v) &&
         (block.weights == Weights::none || block.weights == Weights::cartesian ||
          block.weights == Weights::homogeneous) &&
         (block.number_bytes == 4 || block.number_bytes == 8) && offset % block.number_bytes == 0 &&
         (Count(block.count) * block.values_per_patch() * block.number_bytes).value() ==
             std::optional(block.bytes) &&
         block.bytes <= kMostSbpBlockBytes && (Count(offset) + block.bytes).value().has_value();
}

// Returns whether all values can be what they are to be. They become the machine's own numbers.
template <typename S>
bool are_sound(S* values, std::size_t count, Weights weights) {
  if constexpr (std::endian::native != std::endian::little) {
    for (std::size_t k = 0; k < count; ++k) {
      values[k] = load_little<S>(reinterpret_cast<const std::byte*>(values + k));
    }
  }
  bool sound = true; // without a branch, so that a register of values takes one step
  for (std::size_t k = 0; k < count; ++k) {
    sound &= std::abs(values[k]) <= std::numeric_limits<S>::max();
  }
  for (std::size_t k = 3; weights != Weights::none && k < count; k += 4) {
    const double w = values[k];
    sound &= w > 0;
    for (std::size_t c = k - 3; c < k; ++c) {
      sound &= std::isfinite(weights == Weights::homogeneous ? values[c] / w : values[c] * w);
    }
  }
  return sound;
}

} // namespace

void RunningCheck::add_number(const std::byte* bytes) {
  check_.sum += load_little<std::uint64_t>(bytes);
  check_.sum_of_sums += check_.sum;
}

void RunningCheck::add(std::span<const std::byte> bytes) {
  while (!bytes.empty() && (rest_bytes_ > 0 || bytes.size() < rest_.size())) {
    rest_[rest_bytes_++] = bytes.front();
    bytes = bytes.subspan(1);
    if (rest_bytes_ == rest_.size()) {
      add_number(rest_.data());
      rest_bytes_ = 0;
    }
  }
  // Several numbers share a step, because every step waits for the one before.
  constexpr std::size_t kNumbers = 8;
  for (; bytes.size() >= kNumbers * rest_.size(); bytes = bytes.subspan(kNumbers * rest_.size())) {
    SbpCheck step;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      step.sum += load_little<std::uint64_t>(&bytes[k * rest_.size()]);
      step.sum_of_sums += step.sum;
    }
    check_.sum_of_sums += kNumbers * check_.sum + step.sum_of_sums;
    check_.sum += step.sum;
  }
  for (; bytes.size() >= rest_.size(); bytes = bytes.subspan(rest_.size())) {
    add_number(bytes.data());
  }
  std::ranges::copy(bytes, rest_.begin());
  rest_bytes_ += bytes.size();
}

SbpCheck RunningCheck::value() const {
  RunningCheck whole = *this;
  if (rest_bytes_ > 0) {
    std::fill(whole.rest_.begin() + static_cast<std::ptrdiff_t>(rest_bytes_), whole.rest_.end(),
              std::byte{0});
    whole.add_number(whole.rest_.data());
  }
  return whole.check_;
}

SbpCheck check_of(std::span<const std::byte> bytes) {
  RunningCheck check;
  check.add(bytes);
  return check.value();
}

std::vector<std::byte> sbp_bytes(const SbpIndex& index) {
  std::vector<std::byte> both(kSbpHeaderBytes + kSbpEntryBytes * index.blocks.size());
  std::memcpy(both.data(), kMagic.data(), kMagic.size());
  Cursor out(both.data() + kMagic.size());
  for (const std::uint64_t value : {kVersion, index.patches, index.data_offset,
                                    std::uint64_t{index.blocks.size()}, index.size}) {
    out.put(value);
  }
  out.put(index.moved_error);
  for (std::size_t k = 0; k < index.blocks.size(); ++k) {
    put_entry(index.blocks[k], both.data() + kSbpHeaderBytes + kSbpEntryBytes * k);
  }
  const SbpCheck check = check_of_both(both);
  Cursor sums(both.data() + kCheckAt);
  sums.put(check.sum);
  sums.put(check.sum_of_sums);
  return both;
}

bool is_sbp(std::span<const std::byte> beginning) {
  return beginning.size() >= kMagic.size() &&
         std::memcmp(beginning.data(), kMagic.data(), kMagic.size()) == 0;
}

void refuse_cut_sbp(const std::string& name, const std::string& what) {
  bad_input(name + ": expected binary patches, found the end of the file in " + what);
}

std::uint64_t sbp_blocks_of(const std::string& name, std::span<const std::byte> header) {
  if (!is_sbp(header)) {
    bad_input(name + ": expected binary patches, found a file that does not begin with SBPATCH");
  }
  if (const auto version = load_little<std::uint64_t>(&header[8]); version != kVersion) {
    bad_input(name + ": expected binary patches of version " + std::to_string(kVersion) +
              ", found version " + std::to_string(version));
  }
  return load_little<std::uint64_t>(&header[32]);
}

SbpIndex parse_sbp(const std::string& name, std::span<const std::byte> both) {
  std::vector<std::byte> bytes(both.begin(), both.end());
  Cursor in(bytes.data() + kMagic.size() + sizeof kVersion);
  SbpIndex index;
  index.patches = in.get<std::uint64_t>();
  index.data_offset = in.get<std::uint64_t>();
  const auto blocks = in.get<std::uint64_t>();
  index.size = in.get<std::uint64_t>();
  index.moved_error = in.get<double>();
  Cursor sums(bytes.data() + kCheckAt);
  const auto sum = sums.get<std::uint64_t>();
  if (check_of_both(both) != SbpCheck{sum, sums.get<std::uint64_t>()}) {
    bad_input(name + ": expected the header and the index that were written, found changed ones");
  }
  std::uint64_t patches = 0;
  std::uint64_t offset = index.data_offset;
  bool sound = index.moved_error >= 0 && std::isfinite(index.moved_error) &&
               offset >= both.size() && offset - both.size() < kSbpAlignment && blocks > 0;
  index.blocks.reserve(blocks);
  for (std::uint64_t k = 0; k < blocks && sound; ++k) {
    index.blocks.push_back(get_entry(bytes.data() + kSbpHeaderBytes + kSbpEntryBytes * k));
    sound = is_sound(index.blocks.back(), patches, offset);
    patches += index.blocks.back().count;
    offset += index.blocks.back().bytes;
  }
  if (!sound || patches != index.patches || offset != index.size ||
      patches > std::numeric_limits<std::uint32_t>::max()) {
    bad_input(name + ": expected an index of all patches, found one that contradicts itself");
  }
  return index;
}

void expect_zeros(const std::string& name, std::span<const std::byte> between) {
  if (std::ranges::any_of(between, [](std::byte byte) { return byte != std::byte{0}; })) {
    bad_input(name + ": expected zeros between the index and the patches, found other bytes");
  }
}

void expect_intact(const std::string& name, const SbpIndex& index, const SbpBlock& block,
                   std::span<const std::byte> bytes) {
  if (check_of(bytes) != block.check) {
    bad_input(name + ": expected block " + std::to_string(&block - index.blocks.data()) +
              " (patches " + std::to_string(block.first_patch) + " to " +
              std::to_string(block.first_patch + block.count - 1) +
              ") as it was written, found changed bytes");
  }
}

void add_sbp_patches(PatchFile& file, const SbpBlock& block,
                     const std::shared_ptr<std::byte[]>& bytes, std::size_t count) {
  const auto add = [&](auto* values) {
    if (!are_sound(values, count * block.values_per_patch(), block.weights)) {
      bad_input(file.name +
                ": expected finite coordinates and weights above 0, found others in patches " +
                std::to_string(block.first_patch) + " to " +
                std::to_string(block.first_patch + block.count - 1));
    }
    file.close_stored(
        {static_cast<int>(block.degree_u), static_cast<int>(block.degree_v), block.weights}, count,
        values);
  };
  block.number_bytes == 4 ? add(reinterpret_cast<float*>(bytes.get()))
                          : add(reinterpret_cast<double*>(bytes.get()));
  file.memory.push_back(bytes);
}

} // namespace simdbezier::tools
