#include <tools/patches/write_sbp.hpp>

#include <algorithm>
#include <vector>

#include <tools/formats/sbp_index.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

// Patches of a block: few, so that shards read little beside their own, and so many more in a
// large file that its index stays small.
std::size_t patches_per_block(std::size_t patches) {
  return std::clamp<std::size_t>(patches >> 16, 256, 4096);
}

// The blocks without their boxes and sums.
std::vector<SbpBlock> cut_blocks(const PatchFile& file, std::span<const std::uint32_t> order,
                                 std::uint32_t number_bytes) {
  const std::size_t most = patches_per_block(file.count);
  std::vector<SbpBlock> blocks;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const PatchRun& run = file.run_of(order[k]);
    SbpBlock block;
    block.first_patch = k;
    block.degree_u = static_cast<std::uint32_t>(run.degree_u);
    block.degree_v = static_cast<std::uint32_t>(run.degree_v);
    block.weights = run.weights;
    block.number_bytes = number_bytes;
    if (blocks.empty() || blocks.back().count == most || !blocks.back().has_shape_of(block)) {
      blocks.push_back(block);
    }
    ++blocks.back().count;
  }
  return blocks;
}

template <typename Stored>
void append_values(const PatchNets<double>& patches, std::vector<std::byte>& bytes) {
  for (const ControlNets<double>& nets : patches.nets) {
    const std::size_t values = nets.count * static_cast<std::size_t>(nets.patch_stride);
    std::size_t at = bytes.size();
    bytes.resize(at + values * sizeof(Stored));
    for (std::size_t k = 0; k < values; ++k, at += sizeof(Stored)) {
      store_little(&bytes[at], static_cast<Stored>(nets.points[k]));
    }
  }
}

// Calls visit(block, its patches' values) for all blocks.
template <typename Visit>
void for_blocks(const PatchFile& file, std::span<const std::uint32_t> order,
                std::vector<SbpBlock>& blocks, const Visit& visit) {
  std::vector<std::byte> bytes;
  for (SbpBlock& block : blocks) {
    const PatchNets<double> nets = file.nets<double>(order.subspan(block.first_patch, block.count));
    bytes.clear();
    block.number_bytes == 4 ? append_values<float>(nets, bytes)
                            : append_values<double>(nets, bytes);
    visit(block, std::span<const std::byte>(bytes));
  }
}

} // namespace

void write_sbp(const PatchFile& file, std::span<const std::uint32_t> order, OutputFile& out) {
  bool floats = true;
  file.visit_all_values([&](const auto values) {
    floats = floats && std::ranges::all_of(values, [](double value) {
               return std::abs(value) <= std::numeric_limits<float>::max() &&
                      static_cast<double>(static_cast<float>(value)) == value;
             });
  });
  SbpIndex index;
  index.patches = order.size();
  index.moved_error = file.moved_error + file.cut_error;
  index.blocks = cut_blocks(file, order, floats ? 4 : 8);
  const std::size_t both = kSbpHeaderBytes + kSbpEntryBytes * index.blocks.size();
  index.data_offset = (both + kSbpAlignment - 1) / kSbpAlignment * kSbpAlignment;
  index.size = index.data_offset;
  for_blocks(file, order, index.blocks, [&](SbpBlock& block, std::span<const std::byte> bytes) {
    block.offset = index.size;
    block.bytes = bytes.size();
    block.check = check_of(bytes);
    const MeshBox box = box_of(file.of(order.subspan(block.first_patch, block.count)));
    block.low = box.low;
    block.high = box.high;
    index.size += bytes.size();
  });
  out.expect_room(index.size);
  const std::vector<std::byte> header = sbp_bytes(index);
  out.bytes(header.data(), header.size());
  const std::vector<std::byte> between(index.data_offset - both);
  out.bytes(between.data(), between.size());
  for_blocks(file, order, index.blocks, [&](const SbpBlock&, std::span<const std::byte> bytes) {
    out.bytes(bytes.data(), bytes.size());
  });
}

} // namespace simdbezier::tools
