#include "tests/program/mesh_files/sample_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

namespace {

void append_vertex(const SampleShape& shape, std::mt19937_64& random, SampleMesh& mesh) {
  std::uniform_real_distribution<double> place(-3, 5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int c = 0; c < 3; ++c) {
    mesh.values.push_back(place(random));
  }
  if (shape.normals) {
    const double x = place(random);
    const double y = place(random);
    const double z = place(random);
    const double length = std::sqrt(x * x + y * y + z * z);
    mesh.values.insert(mesh.values.end(), {x / length, y / length, z / length});
  }
  if (shape.uv) {
    mesh.values.insert(mesh.values.end(), {share(random), share(random)});
  }
  if (shape.patches) {
    mesh.patch.push_back(static_cast<std::uint32_t>(random() % mesh.contents.patches));
  }
}

} // namespace

SampleMesh make_sample(const SampleShape& shape, bool floats) {
  SampleMesh mesh;
  mesh.contents.vertices = shape.vertices;
  mesh.contents.faces = shape.faces;
  mesh.contents.corners = shape.corners;
  mesh.contents.normals = shape.normals;
  mesh.contents.uv = shape.uv;
  mesh.contents.patches = shape.patches ? std::uint64_t{1} << 24 : 0;
  mesh.contents.storage = shape.storage;
  mesh.contents.floats = shape.floats;
  mesh.contents.box = tools::MeshBox{{-3, -3.5, -4}, {5, 5, 6}};
  std::mt19937_64 random(shape.vertices * 31 + shape.faces);
  for (std::uint32_t k = 0; k < shape.vertices; ++k) {
    append_vertex(shape, random, mesh);
  }
  if (shape.vertices > 2) {
    const double tiny[] = {-0.0, 1e-45, 1e-300};
    std::ranges::copy(tiny, mesh.values.begin());
  }
  for (double& value : mesh.values) {
    value = floats ? double{static_cast<float>(value)} : value;
  }
  for (std::size_t k = 0; k < std::size_t{shape.faces} * shape.corners; ++k) {
    mesh.corners.push_back(k == 0 ? shape.vertices - 1
                                  : static_cast<std::uint32_t>(random() % shape.vertices));
  }
  return mesh;
}

template <typename T>
void write_sample(const SampleMesh& mesh, tools::MeshWriter<T>& writer, std::size_t block) {
  const std::size_t stride = mesh.contents.stride();
  const std::vector<T> values(mesh.values.begin(), mesh.values.end());
  for (std::size_t k = 0; k < mesh.contents.vertices; k += block) {
    const std::size_t count = std::min<std::size_t>(block, mesh.contents.vertices - k);
    const std::span<const std::uint32_t> patch(mesh.patch);
    writer.vertices({std::span(values).subspan(k * stride, count * stride),
                     patch.empty() ? patch : patch.subspan(k, count)});
  }
  const std::size_t corners = mesh.contents.corners;
  for (std::size_t k = 0; k < mesh.contents.faces; k += block) {
    const std::size_t count = std::min<std::size_t>(block, mesh.contents.faces - k);
    writer.faces(std::span(mesh.corners).subspan(k * corners, count * corners));
  }
  writer.finish();
}

template <typename T>
std::string written(const SampleMesh& mesh, tools::MeshFormat format, std::size_t block) {
  const TemporaryFolder folder;
  const std::string path = folder.path("mesh");
  write_sample<T>(mesh, *tools::make_mesh_writer<T>(path, format, mesh.contents), block);
  return read_file(path);
}

template void write_sample(const SampleMesh&, tools::MeshWriter<float>&, std::size_t);
template void write_sample(const SampleMesh&, tools::MeshWriter<double>&, std::size_t);
template std::string written<float>(const SampleMesh&, tools::MeshFormat, std::size_t);
template std::string written<double>(const SampleMesh&, tools::MeshFormat, std::size_t);

} // namespace simdbezier::tests
