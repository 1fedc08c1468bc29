#include <tools/mesh_files/glb/split_glb.hpp>

#include <algorithm>
#include <cassert>
#include <filesystem>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

} // namespace

SplitGlb::SplitGlb(const std::string& path, const MeshContents& contents, std::uint64_t most_bytes)
    : path_(path), contents_(contents), layout_(glb_records(contents)),
      most_body_bytes_(most_bytes - glb_frame_bytes(contents)), records_(path) {
  assert(most_bytes >= glb_frame_bytes(contents) + 3 * layout_.size + 12);
  if (is_written_directly(path)) {
    bad_input((path == "-" ? "standard output" : path) +
              ": expected a mesh that fits into one GLB file, found " +
              std::to_string(contents.vertices) + " vertices and " +
              std::to_string(contents.faces) + " triangles");
  }
}

// NAME.glb becomes NAME-0.glb.
std::string SplitGlb::name(std::size_t number) const {
  std::filesystem::path path(path_);
  const std::string extension = path.extension().string();
  return path.replace_extension().string() + "-" + std::to_string(number) + extension;
}

bool SplitGlb::has_room(std::span<const std::uint32_t, 3> triangle) const {
  std::uint32_t end = part_.end;
  std::size_t copied = part_.copied.size();
  for (const std::uint32_t corner : triangle) {
    end = std::max(end, corner + 1);
    copied += corner < part_.first && !part_.place.contains(corner) ? 1 : 0;
  }
  const GlbParts parts{std::uint64_t{end} - part_.first + copied, part_.triangles + 1, layout_};
  return parts.bytes() <= most_body_bytes_;
}

void SplitGlb::take(std::span<const std::uint32_t, 3> triangle) {
  for (const std::uint32_t corner : triangle) {
    part_.end = std::max(part_.end, corner + 1);
    const auto next = static_cast<std::uint32_t>(part_.copied.size());
    if (corner < part_.first && part_.place.try_emplace(corner, next).second) {
      part_.copied.push_back(corner);
    }
  }
  ++part_.triangles;
  if (!corners_) {
    corners_.emplace(path_);
  }
  corners_->append(triangle.data(), triangle.size_bytes());
}

void SplitGlb::triangles(std::span<const std::uint32_t> corners) {
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const auto triangle = corners.subspan(k).first<3>();
    if (!has_room(triangle)) {
      complete_part();
    }
    take(triangle);
  }
}

void SplitGlb::complete_part() {
  if (part_.triangles == 0) {
    // A jump over vertices that nobody names: they would fill a file by themselves.
    bad_input(path_ + ": expected vertices in the order of their faces, found faces that name "
                      "vertices too far apart for one GLB file");
  }
  const GlbParts parts{part_.vertices(), part_.triangles, layout_};
  GlbFile& file = files_.emplace_back(name(files_.size()), contents_, parts);
  write_vertices(file);
  write_triangles(file);
  file.complete();
  corners_.reset();
  Part next;
  next.first = part_.end;
  next.end = part_.end;
  part_ = std::move(next);
}

// Writes the part's new vertices first, then its copies, as write_triangles() numbers them.
void SplitGlb::write_vertices(GlbFile& file) {
  const std::size_t size = layout_.size;
  std::vector<std::byte> block(kBlockBytes / size * size);
  const std::uint64_t last = part_.end * size;
  for (std::uint64_t at = part_.first * size; at < last; at += block.size()) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), last - at));
    records_.read(at, block.data(), count);
    file.vertices(std::span(block).first(count));
  }
  for (const std::uint32_t vertex : part_.copied) {
    records_.read(vertex * std::uint64_t{size}, block.data(), size);
    file.vertices(std::span(block).first(size));
  }
}

void SplitGlb::write_triangles(GlbFile& file) {
  std::vector<std::uint32_t> block(kBlockBytes / sizeof(std::uint32_t));
  const std::uint32_t own = part_.end - part_.first;
  for (std::uint64_t at = 0; at < corners_->size(); at += kBlockBytes) {
    const auto size =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBlockBytes, corners_->size() - at));
    corners_->read(at, block.data(), size);
    const auto corners = std::span(block).first(size / sizeof(std::uint32_t));
    for (std::uint32_t& corner : corners) {
      corner = corner < part_.first ? own + part_.place.at(corner) : corner - part_.first;
    }
    file.indices(corners);
  }
}

void SplitGlb::complete() {
  if (part_.triangles > 0) {
    complete_part();
  }
}

void SplitGlb::commit() {
  for (GlbFile& file : files_) {
    file.commit();
  }
}

} // namespace simdbezier::tools
