// The statements of OBJ files that the reader does not take, and numbers of vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include <tools/formats/input/text_input.hpp>

namespace simdbezier::tools {

// These statements do not change the shape of a surface.
inline constexpr std::string_view kObjPassedOver[] = {
    "vt",     "vn",       "g",     "s",        "mg",         "o",
    "bevel",  "c_interp", "lod",   "usemtl",   "mtllib",     "usemap",
    "maplib", "ctech",    "stech", "d_interp", "shadow_obj", "trace_obj"};

// These stand between surf and end. Special curves and points say where a mesh is to have vertices;
// they do not change the surface.
inline constexpr std::string_view kObjInSurfaces[] = {"trim", "hole", "scrv", "sp"};

struct ObjOther {
  std::string_view keyword;
  std::string_view what;
};
inline constexpr ObjOther kObjOthers[] = {{"p", "points"},
                                          {"l", "lines"},
                                          {"f", "polygons"},
                                          {"curv", "a curve"},
                                          {"con", "connectivity"},
                                          {"call", "another file"},
                                          {"csh", "a shell command"},
                                          {"bzp", "a superseded statement"},
                                          {"bsp", "a superseded statement"},
                                          {"cdc", "a superseded statement"},
                                          {"cdp", "a superseded statement"},
                                          {"res", "a superseded statement"}};

/// The number of a vertex, counted from 1, or backwards from the last one.
struct ObjReference {
  std::uint64_t number = 0;
  bool from_end = false;
};

/// Reads one number, which must not be 0.
[[nodiscard]] inline std::optional<ObjReference> parse_obj_number(std::string_view word) {
  const bool from_end = word.starts_with('-') && !word.starts_with("-+");
  const auto number = parse_integer(word.substr(from_end ? 1 : 0));
  return number.value_or(0) == 0 ? std::nullopt : std::optional(ObjReference{*number, from_end});
}

/// The v of v, v/vt, v//vn or v/vt/vn; nothing where the word is none of these.
[[nodiscard]] inline std::optional<ObjReference> parse_obj_reference(std::string_view word) {
  const std::string_view vertex = word.substr(0, word.find('/'));
  word.remove_prefix(vertex.size());
  if (!word.empty()) {
    word.remove_prefix(1);
    const std::string_view texture = word.substr(0, word.find('/'));
    word.remove_prefix(texture.size());
    const bool has_normal = !word.empty();
    if ((!texture.empty() || !has_normal) && !parse_obj_number(texture)) {
      return std::nullopt;
    }
    if (has_normal && !parse_obj_number(word.substr(1))) {
      return std::nullopt;
    }
  }
  return parse_obj_number(vertex);
}

} // namespace simdbezier::tools
