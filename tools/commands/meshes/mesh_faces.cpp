#include <tools/commands/meshes/mesh_faces.hpp>

#include <algorithm>
#include <utility>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/patches/library_status.hpp>

namespace simdbezier::tools {

void MeshFaces::count(const MeshLayout& layout, SetRange patches) {
  count_ =
      layout.first_triangle(patches.first + patches.count) - layout.first_triangle(patches.first);
  if (quads_) {
    PolygonSize size;
    check(polygon_size(layout, size, {.threads = threads_}, patches));
    count_ = size.polygons;
    among_quads_ = 4 * size.polygons - size.indices;
  }
}

void MeshFaces::name_before(std::vector<std::uint32_t> before) {
  before_ = std::move(before);
  shift_ = 0U - static_cast<std::uint32_t>(before_.size());
}

void MeshFaces::place(std::uint32_t first_vertex, std::span<const std::uint32_t> foreign) {
  std::size_t next = 0;
  for (std::uint32_t& vertex : before_) {
    vertex = vertex == kNoVertex ? kNoVertex : foreign[next++];
  }
  shift_ += first_vertex;
}

std::span<const std::uint32_t> MeshFaces::corners(const MeshLayout& layout, SetRange patches) {
  quads_ ? find_quads(layout, patches) : find_triangles(layout, patches);
  for (std::size_t k = 0; k < corners_.size() && (shift_ != 0 || !before_.empty()); ++k) {
    std::uint32_t& vertex = corners_[k];
    vertex = vertex < before_.size() ? before_[vertex]
             : vertex != kNoVertex   ? vertex + shift_
                                     : kNoVertex;
  }
  return corners_;
}

void MeshFaces::find_triangles(const MeshLayout& layout, SetRange patches) {
  corners_.resize(3 * (layout.first_triangle(patches.first + patches.count) -
                       layout.first_triangle(patches.first)));
  check(write_triangles<std::uint32_t>(layout, corners_, {.threads = threads_}, patches));
}

void MeshFaces::find_quads(const MeshLayout& layout, SetRange patches) {
  PolygonSize size;
  check(polygon_size(layout, size, {.threads = threads_}, patches));
  polygons_.resize(size.indices);
  sizes_.resize(size.polygons);
  check(write_polygons<std::uint32_t>(layout, polygons_, sizes_, {.threads = threads_}, patches));
  corners_.assign(4 * size.polygons, kNoVertex);
  auto next = polygons_.begin();
  for (std::size_t k = 0; k < sizes_.size(); next += sizes_[k++]) {
    std::copy_n(next, sizes_[k], &corners_[4 * k]);
  }
}

} // namespace simdbezier::tools
