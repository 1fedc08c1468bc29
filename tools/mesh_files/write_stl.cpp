// Binary STL: triangles one by one, each with its own normal and its corners' positions as floats.
// The vertices are kept aside until all of them have come.
#include <tools/mesh_files/mesh_formats.hpp>

#include <cmath>

#include <tools/mesh_files/mesh_bytes.hpp>
#include <tools/mesh_files/vertex_records.hpp>
#include <tools/process/little_endian.hpp>
#include <tools/process/output_file.hpp>
#include <tools/process/spill_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kHeaderBytes = 80;
using Position = StlPosition;

// It must not begin with "solid", as the text form does. An origin stands in it whole or not at
// all.
std::string header(const MeshContents& mesh) {
  std::string text = "binary STL";
  text += mesh.deviation ? ", " + worded_deviation(*mesh.deviation) : "";
  const std::string origin = mesh.origin ? ", origin " + spaced(*mesh.origin) : "";
  text += text.size() + origin.size() <= kHeaderBytes ? origin : "";
  text += mesh.generator.empty() ? "" : ", " + mesh.generator;
  text.resize(kHeaderBytes);
  return text;
}

// The normal by the right-hand rule, of unit length; zero where there is no area.
Position facet_normal(const std::array<Position, 3>& corners) {
  std::array<std::array<double, 3>, 2> side;
  for (std::size_t c = 0; c < 3; ++c) {
    side[0][c] = double{corners[1][c]} - double{corners[0][c]};
    side[1][c] = double{corners[2][c]} - double{corners[0][c]};
  }
  // Differences of floats lie far within the range of double, and so does all that follows.
  const std::array<double, 3> n = {side[0][1] * side[1][2] - side[0][2] * side[1][1],
                                   side[0][2] * side[1][0] - side[0][0] * side[1][2],
                                   side[0][0] * side[1][1] - side[0][1] * side[1][0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) {
    return {};
  }
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

template <typename T>
class StlWriter final : public MeshWriter<T> {
public:
  StlWriter(const std::string& path, const MeshContents& mesh)
      : MeshWriter<T>(path, mesh), packer_(path, mesh, float_positions()), positions_(path),
        file_(path) {
    file_.expect_room(kHeaderBytes + 4 + mesh.faces * kStlFacetBytes);
    file_.text(stl_head(mesh));
  }

  [[nodiscard]] bool is_terminal() const override { return file_.is_terminal(); }

private:
  void take_vertices(const VertexBlock<T>& block) override {
    const std::span<const std::byte> records = packer_.pack(block);
    positions_.append(records.data(), records.size());
  }

  void take_faces(std::span<const std::uint32_t> corners) override {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      facets_.clear();
      append_stl_facet({position(corners[k]), position(corners[k + 1]), position(corners[k + 2])},
                       facets_);
      file_.bytes(facets_.data(), facets_.size());
    }
  }

  Position position(std::uint64_t vertex) {
    std::array<std::byte, sizeof(Position)> record;
    positions_.read(vertex * record.size(), record.data(), record.size());
    return {load_little<float>(&record[0]), load_little<float>(&record[4]),
            load_little<float>(&record[8])};
  }

  void put_on_disk() override { file_.complete(); }
  void put_in_place() override { file_.commit(); }

  RecordPacker<T> packer_;
  SpillFile positions_;
  OutputFile file_;
  std::vector<std::byte> facets_;
};

} // namespace

std::string stl_head(const MeshContents& mesh) {
  std::array<char, 4> count;
  store_little(count.data(), static_cast<std::uint32_t>(mesh.faces));
  return header(mesh) + std::string(count.data(), count.size());
}

void append_stl_facet(const std::array<StlPosition, 3>& corners, std::vector<std::byte>& to) {
  std::size_t at = to.size();
  to.resize(at + kStlFacetBytes); // the last two are the attribute, 0
  for (const Position& vector : {facet_normal(corners), corners[0], corners[1], corners[2]}) {
    for (const float value : vector) {
      store_little(&to[at], value);
      at += sizeof value;
    }
  }
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_stl_writer(const std::string& path,
                                               const MeshContents& contents) {
  return std::make_unique<StlWriter<T>>(path, contents);
}

template std::unique_ptr<MeshWriter<float>> make_stl_writer(const std::string&,
                                                            const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_stl_writer(const std::string&,
                                                             const MeshContents&);

} // namespace simdbezier::tools
