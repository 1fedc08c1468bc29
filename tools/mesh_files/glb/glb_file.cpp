#include <tools/mesh_files/glb/glb_file.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kFileHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
// A bound on what a description takes beside what wrote the file.
constexpr std::size_t kDescriptionBytes = 2560;

std::string word(std::uint64_t value) {
  std::string bytes(4, '\0');
  store_little(bytes.data(), static_cast<std::uint32_t>(value));
  return bytes;
}

// A description's room: every byte of the generator's name takes six at most.
std::size_t description_room(const MeshContents& contents) {
  return kDescriptionBytes + 6 * ((contents.generator.size() + 3) / 4 * 4);
}

} // namespace

std::uint64_t glb_frame_bytes(const MeshContents& contents) {
  return kFileHeaderBytes + 2 * kChunkHeaderBytes + description_room(contents);
}

GlbFile::GlbFile(const std::string& path, const MeshContents& contents, const GlbParts& parts)
    : contents_(contents), parts_(parts), bounds_(parts.layout), file_(path) {
  file_.expect_room(glb_frame_bytes(contents) + parts.bytes());
  if (file_.can_rewrite()) {
    file_.text(frame());
  } else {
    waiting_.emplace(path);
  }
}

std::string GlbFile::frame() const {
  std::string description = parts_.is_empty() || bounds_.low()[0] <= bounds_.high()[0]
                                ? glb_description(contents_, parts_, bounds_)
                                : ""; // no vertex has come yet
  assert(description.size() <= description_room(contents_));
  description.resize(description_room(contents_), ' ');
  // The binary chunk is left out where it is empty.
  const std::uint64_t chunk = parts_.bytes() > 0 ? kChunkHeaderBytes + parts_.bytes() : 0;
  std::string text = "glTF" + word(2);
  text += word(kFileHeaderBytes + kChunkHeaderBytes + description.size() + chunk);
  text += word(description.size()) + "JSON" + description;
  if (chunk > 0) {
    text += word(parts_.bytes()) + std::string("BIN\0", 4);
  }
  return text;
}

void GlbFile::body(const void* data, std::size_t size) {
  waiting_ ? waiting_->append(data, size) : file_.bytes(data, size);
}

void GlbFile::vertices(std::span<const std::byte> records) {
  if (!parts_.is_empty()) {
    bounds_.include(records);
    body(records.data(), records.size());
  }
}

void GlbFile::indices(std::span<const std::uint32_t> corners) {
  std::array<std::byte, 4096> bytes;
  const std::size_t size = parts_.index_bytes();
  for (std::size_t k = 0; k < corners.size();) {
    const std::size_t count = std::min(corners.size() - k, bytes.size() / size);
    for (std::size_t i = 0; i < count; ++i, ++k) {
      size == 2 ? store_little(&bytes[i * size], static_cast<std::uint16_t>(corners[k]))
                : store_little(&bytes[i * size], corners[k]);
    }
    body(bytes.data(), count * size);
  }
}

void GlbFile::complete() {
  if (!parts_.is_empty()) {
    constexpr std::array<char, 4> kZeros = {};
    body(kZeros.data(), parts_.bytes() - parts_.vertex_bytes() - parts_.all_index_bytes());
  }
  waiting_ ? write_waiting() : file_.rewrite(0, frame());
  file_.complete();
}

void GlbFile::write_waiting() {
  file_.text(frame());
  std::vector<char> block(std::size_t{1} << 16);
  for (std::uint64_t at = 0; at < waiting_->size(); at += block.size()) {
    const auto size =
        static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), waiting_->size() - at));
    waiting_->read(at, block.data(), size);
    file_.bytes(block.data(), size);
  }
}

} // namespace simdbezier::tools
