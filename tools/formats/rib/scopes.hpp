// What ends with its scope in RIB files: bases, transformations, orientation and trimming.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tools/formats/rib/bases.hpp>
#include <tools/formats/rib/tokens.hpp>
#include <tools/formats/rib/trims.hpp>
#include <tools/formats/surfaces/affine_map.hpp>

namespace simdbezier::tools {

/// What holds for the surfaces at some place of the file.
struct RibState {
  /// A transformation that is none of AffineMap, or is not known.
  struct Unknown {
    std::string name;
    std::size_t line = 0; ///< 0: there is none
  };

  RibBases bases;
  AffineMap map; ///< to the world, before it to the camera, and in objects to the object
  Unknown unknown;
  bool is_inside = false;               ///< whether surfaces are turned inside out
  std::shared_ptr<const RibTrim> trim;  ///< null: there is none
  bool keeps_what_trims_enclose = true; ///< as long as no attribute may say otherwise
};

class RibScopes {
public:
  /// Messages name the current token.
  explicit RibScopes(const RibTokens& tokens) : tokens_(tokens) {}

  [[nodiscard]] RibState& state() noexcept { return scopes_.back().state; }
  [[nodiscard]] bool is_in_object() const noexcept { return in_object_; }

  /// Opens and closes scopes by requests that are listed in requests.hpp. Objects are in no
  /// other ones.
  void begin(std::string_view request);
  void end(std::string_view request);

  /// A transformation is applied before those that hold already, or replaces them.
  void concatenate(const AffineMap& map, std::size_t line);
  void replace(const AffineMap& map);
  /// One that is not known makes those behind it unknown, too.
  void concatenate_unknown(std::string_view name, std::size_t line);
  /// Throws Failure where the transformation of the current request is not known.
  void require_known(const std::string& what) const;
  /// "outside" is the side of the normals, "lh" and "rh" are its name by the hand of a world.
  void orient(std::string_view side);

  /// Gives the current transformation a name, until a world begins …
  void mark(const std::string& name);
  /// … and returns whether there is one of that name, which then replaces the current one.
  [[nodiscard]] bool return_to(const std::string& name);
  /// Forgets what has the name.
  void unmark(const std::string& name) { marks_.erase(name); }

private:
  struct Scope {
    RibState state;
    std::string opened; // by which request, without its Begin
    std::size_t line = 0;
  };

  const RibTokens& tokens_;
  std::vector<Scope> scopes_ = std::vector<Scope>(1);
  std::map<std::string, RibState> marks_; // of which the transformations count
  bool in_object_ = false;
  bool camera_mirrors_ = false;
};

} // namespace simdbezier::tools
