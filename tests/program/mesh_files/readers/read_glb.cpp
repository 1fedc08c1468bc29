#include "tests/program/mesh_files/readers/mesh_readers.hpp"

#include <nlohmann/json.hpp>

#include "tests/program/mesh_files/readers/byte_reader.hpp"

namespace simdbezier::tests {

namespace {

using Json = nlohmann::json;

// Component types of glTF.
constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

std::size_t component_size(int type) {
  return type == kByte ? 1 : type == kShort || type == kUnsignedShort ? 2 : 4;
}

double component(std::string_view bytes, std::size_t at, int type) {
  ByteReader data(bytes.substr(std::min(at, bytes.size())));
  switch (type) {
  case kByte:
    return data.take<std::int8_t>();
  case kShort:
    return data.take<std::int16_t>();
  case kUnsignedShort:
    return data.take<std::uint16_t>();
  case kUnsignedInt:
    return data.take<std::uint32_t>();
  default:
    EXPECT_EQ(type, kFloat);
    return double{data.take<float>()};
  }
}

class Glb {
public:
  explicit Glb(const std::string& bytes) {
    ByteReader data(bytes);
    EXPECT_EQ(data.take_bytes(4), "glTF");
    EXPECT_EQ(data.take<std::uint32_t>(), 2U);
    EXPECT_EQ(data.take<std::uint32_t>(), bytes.size());
    const std::string_view text = take_chunk(data, "JSON");
    json = Json::parse(text, nullptr, false);
    EXPECT_TRUE(json.is_object()) << text;
    if (data.rest() > 0) {
      body_ = take_chunk(data, std::string_view("BIN\0", 4));
      EXPECT_EQ(json["buffers"].size(), 1U);
      EXPECT_EQ(json["buffers"][0]["byteLength"], body_.size());
    }
    EXPECT_EQ(data.rest(), 0U);
  }

  // Components as they are stored.
  template <std::size_t N>
  [[nodiscard]] std::vector<std::array<double, N>> values(const Json& accessor, int target) const {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["target"], target);
    const int type = accessor["componentType"];
    const std::size_t size = component_size(type);
    const std::size_t stride = view.value("byteStride", size * N);
    const std::size_t offset = accessor.value("byteOffset", std::size_t{0});
    const std::size_t count = accessor["count"];
    EXPECT_EQ((view.value("byteOffset", std::size_t{0}) + offset) % size, 0U);
    EXPECT_LE(offset + (count - 1) * stride + N * size, view["byteLength"].get<std::size_t>());
    std::vector<std::array<double, N>> result(count);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < N; ++c) {
        result[k][c] = component(
            body_, view.value("byteOffset", std::size_t{0}) + offset + k * stride + c * size, type);
      }
    }
    return result;
  }
  template <std::size_t N>
  [[nodiscard]] std::vector<std::array<double, N>> attribute(const Json& primitive,
                                                             const char* name) const {
    const Json& attributes = primitive["attributes"];
    if (!attributes.contains(name)) {
      return {};
    }
    const Json& accessor = json["accessors"][attributes[name].get<std::size_t>()];
    EXPECT_EQ(accessor.value("normalized", false), accessor["componentType"] != kFloat) << name;
    return values<N>(accessor, 34962);
  }

  Json json;

private:
  static std::string_view take_chunk(ByteReader& data, std::string_view type) {
    const auto size = data.take<std::uint32_t>();
    EXPECT_EQ(size % 4, 0U);
    EXPECT_EQ(data.take_bytes(4), type);
    return data.take_bytes(size);
  }

  std::string_view body_;
};

void check_bounds(const Json& accessor, const std::vector<std::array<double, 3>>& positions) {
  for (std::size_t c = 0; c < 3; ++c) {
    double low = positions.front()[c];
    double high = low;
    for (const auto& position : positions) {
      low = std::min(low, position[c]);
      high = std::max(high, position[c]);
    }
    EXPECT_EQ(accessor["min"][c].get<double>(), low);
    EXPECT_EQ(accessor["max"][c].get<double>(), high);
  }
}

void read_triangles(const Glb& glb, const Json& accessor, ReadMesh& mesh) {
  const auto corners = glb.values<1>(accessor, 34963);
  EXPECT_EQ(corners.size() % 3, 0U);
  mesh.index_type = accessor["componentType"] == kUnsignedShort ? "ushort" : "uint";
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
    mesh.faces.push_back({static_cast<std::uint32_t>(corners[k][0]),
                          static_cast<std::uint32_t>(corners[k + 1][0]),
                          static_cast<std::uint32_t>(corners[k + 2][0])});
  }
}

void read_node(const Json& node, ReadMesh& mesh) {
  if (node.contains("scale")) {
    mesh.scale = node["scale"][0];
    EXPECT_EQ(node["scale"], (Json{mesh.scale, mesh.scale, mesh.scale}));
    EXPECT_TRUE(node.contains("translation"));
  }
  if (node.contains("translation")) {
    mesh.translation = node["translation"];
  }
}

} // namespace

ReadMesh read_glb_mesh(const std::string& bytes) {
  ReadMesh mesh;
  const Glb glb(bytes);
  const Json& asset = glb.json["asset"];
  EXPECT_EQ(asset["version"], "2.0");
  mesh.generator = asset.value("generator", "");
  if (asset.contains("extras")) {
    mesh.deviation = asset["extras"]["deviation"].get<double>();
  }
  if (!glb.json.contains("meshes")) {
    return mesh;
  }
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["mode"], 4);
  const Json& position =
      glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  mesh.positions = glb.attribute<3>(primitive, "POSITION");
  mesh.normals = glb.attribute<3>(primitive, "NORMAL");
  mesh.uv = glb.attribute<2>(primitive, "TEXCOORD_0");
  for (const auto& number : glb.attribute<1>(primitive, "_PATCH")) {
    mesh.patches.push_back(number[0]);
  }
  mesh.quantised = position["componentType"] != kFloat;
  EXPECT_EQ(glb.json.contains("extensionsRequired"), mesh.quantised);
  check_bounds(position, mesh.positions);
  const Json& extras = glb.json["meshes"][0].value("extras", Json::object());
  EXPECT_EQ(extras.contains("deviation"), mesh.deviation.has_value());
  read_triangles(glb, glb.json["accessors"][primitive["indices"].get<std::size_t>()], mesh);
  if (mesh.deviation) {
    EXPECT_EQ(extras["deviation"], *mesh.deviation);
    EXPECT_EQ(extras["vertices"], mesh.positions.size());
    EXPECT_EQ(extras["triangles"], mesh.faces.size());
  }
  read_node(glb.json["nodes"][0], mesh);
  return mesh;
}

} // namespace simdbezier::tests
