// What a GLB file says about its vertices and indices.
#include <tools/mesh_files/glb/glb_file.hpp>

#include <tools/mesh_files/json_text.hpp>

namespace simdbezier::tools {

namespace {

// Numbers that glTF has for types and purposes.
constexpr std::uint64_t kVertices = 34962;
constexpr std::uint64_t kIndices = 34963;

std::uint64_t component_type(FieldType type) {
  switch (type) {
  case FieldType::i8:
    return 5120;
  case FieldType::i16:
    return 5122;
  case FieldType::u16:
    return 5123;
  case FieldType::u32:
    return 5125;
  case FieldType::f32:
  case FieldType::f64: // glTF has none
  case FieldType::none:
    break;
  }
  return 5126;
}

std::string asset(const MeshContents& contents) {
  std::string text = R"("asset":{"version":"2.0")";
  if (!contents.generator.empty()) {
    text += joined({",", member("generator", quoted(contents.generator))});
  }
  if (contents.has_bound()) {
    text += joined({R"(,"extras":{)", member("deviation", shortest(*contents.deviation)), "}"});
  }
  text += '}';
  return text;
}

std::string node(const MeshContents& contents) {
  std::array<double, 3> place = contents.origin.value_or(std::array<double, 3>{});
  std::string scale;
  if (contents.storage != VertexStorage::full) {
    const QuantisedSpace space = quantised_space(*contents.box);
    for (std::size_t c = 0; c < 3; ++c) {
      place[c] += space.low[c];
    }
    scale = joined({",", member("scale", list({space.extent, space.extent, space.extent}))});
  }
  const bool moved = contents.origin || !scale.empty();
  return joined({"{", member("mesh", 0),
                 moved ? joined({",", member("translation", list(place))}) : "", scale, "}"});
}

// Programs that simplify a mesh may keep what the asset says about another one. What the mesh says
// holds for a mesh of these counts.
std::string mesh_extras(const MeshContents& contents, const GlbParts& parts) {
  return contents.has_bound()
             ? joined({R"(,"extras":{)", member("deviation", shortest(*contents.deviation)), ",",
                       member("vertices", parts.vertices), ",",
                       member("triangles", parts.triangles), "}"})
             : "";
}

class Accessors {
public:
  explicit Accessors(std::uint64_t vertices) : vertices_(vertices) {}

  void attribute(std::string_view name, const RecordLayout::Field& field, std::string_view shape,
                 std::string_view more = "") {
    if (field.type == FieldType::none) {
      return;
    }
    attributes_ += attributes_.empty() ? "" : ",";
    attributes_ += member(name, count_++);
    list_ += joined({"{", member("bufferView", 0), ",", member("byteOffset", field.offset), ",",
                     member("componentType", component_type(field.type)), ",",
                     field.type == FieldType::f32 ? "" : R"("normalized":true,)",
                     member("count", vertices_), ",", member("type", quoted(shape)), more, "},"});
  }

  [[nodiscard]] std::string meshes(std::string_view extras) const {
    constexpr std::uint64_t kTriangles = 4; // the default, which not every program knows
    return joined({R"("meshes":[{"primitives":[{"attributes":{)", attributes_, "},",
                   member("indices", count_), ",", member("mode", kTriangles), "}]", extras, "}]"});
  }
  [[nodiscard]] std::string list(FieldType index, std::uint64_t indices) const {
    return joined({R"("accessors":[)", list_, "{", member("bufferView", 1), ",",
                   member("componentType", component_type(index)), ",", member("count", indices),
                   R"(,"type":"SCALAR"}])"});
  }

private:
  std::uint64_t vertices_;
  std::uint64_t count_ = 0;
  std::string attributes_;
  std::string list_;
};

std::string buffers(const GlbParts& parts) {
  return joined({R"("bufferViews":[{"buffer":0,)", member("byteLength", parts.vertex_bytes()), ",",
                 member("byteStride", parts.layout.size), ",", member("target", kVertices),
                 R"(},{"buffer":0,)", member("byteOffset", parts.vertex_bytes()), ",",
                 member("byteLength", parts.all_index_bytes()), ",", member("target", kIndices),
                 R"(}],"buffers":[{)", member("byteLength", parts.bytes()), "}]"});
}

} // namespace

std::string glb_description(const MeshContents& contents, const GlbParts& parts,
                            const StoredBounds& bounds) {
  if (parts.is_empty()) { // glTF has no accessors of nothing
    return joined({"{", asset(contents), "}"});
  }
  Accessors accessors(parts.vertices);
  accessors.attribute(
      "POSITION", parts.layout.position, "VEC3",
      joined({",", member("min", list(bounds.low())), ",", member("max", list(bounds.high()))}));
  accessors.attribute("NORMAL", parts.layout.normal, "VEC3");
  accessors.attribute("TEXCOORD_0", parts.layout.uv, "VEC2");
  accessors.attribute("_PATCH", parts.layout.patch, "SCALAR");
  constexpr const char* kExtensions =
      R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  const FieldType index = parts.index_bytes() == 2 ? FieldType::u16 : FieldType::u32;
  return joined({"{", asset(contents), contents.storage == VertexStorage::full ? "" : kExtensions,
                 R"(,"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)", node(contents), "],",
                 accessors.meshes(mesh_extras(contents, parts)), ",",
                 accessors.list(index, parts.triangles * 3), ",", buffers(parts), "}"});
}

} // namespace simdbezier::tools
