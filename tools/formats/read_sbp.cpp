// Binary patches, from the first byte to the last, so that pipes and compressed files will do.
#include <tools/formats/sbp_index.hpp>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

PatchFile read_sbp(TextInput& input, const ReadOptions& /*options*/) try {
  const auto read = [&](std::span<std::byte> to) {
    std::size_t found = 0;
    while (found < to.size()) {
      const std::size_t more =
          input.bytes().read(reinterpret_cast<char*>(to.data()) + found, to.size() - found);
      if (more == 0) {
        break;
      }
      found += more;
    }
    return found;
  };
  PatchFile file;
  file.name = input.name();
  const SbpIndex index = read_sbp_index(file.name, read);
  file.cut_error = index.moved_error;
  for (const SbpBlock& block : index.blocks) {
    const auto size = static_cast<std::size_t>(block.bytes); // at most kMostSbpBlockBytes
    const std::shared_ptr<std::byte[]> bytes = input.bytes().take(size);
    if (bytes == nullptr) {
      refuse_cut_sbp(file.name, "its patches");
    }
    expect_intact(file.name, index, block, {bytes.get(), size});
    add_sbp_patches(file, block, bytes, static_cast<std::size_t>(block.count));
  }
  std::byte behind = {};
  if (read(std::span(&behind, 1)) != 0) {
    bad_input(file.name + ": expected " + std::to_string(index.size) +
              " bytes of binary patches, found more");
  }
  return file;
} catch (const DamagedInput& damage) {
  bad_input(input.name() + ": expected " + damage.expected + ", found " + damage.found);
}

} // namespace simdbezier::tools
