#include <tools/formats/rib/scopes.hpp>

#include <utility>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// Less "Begin" or "End".
std::string scope_name(std::string_view request, std::string_view suffix) {
  return std::string(request.substr(0, request.size() - suffix.size()));
}

void copy_transformation(const RibState& from, RibState& to) {
  to.map = from.map;
  to.unknown = from.unknown;
}

} // namespace

// A world begins without the transformations before it, which make the camera's, and an object
// without those around it, because they are not those of its instances.
void RibScopes::begin(std::string_view request) {
  const std::string name = scope_name(request, "Begin");
  if (in_object_ && (name == "Object" || name == "World" || name == "Frame")) {
    tokens_.fail("ObjectEnd");
  }
  if (name == "World") {
    camera_mirrors_ = state().map.mirrors();
    marks_.clear();
  }
  Scope scope{state(), name, tokens_.line()};
  if (name == "World" || name == "Object") {
    copy_transformation({}, scope.state);
  }
  if (name == "Object") {
    in_object_ = true;
    scope.state.is_inside = false;
  }
  scopes_.push_back(std::move(scope));
}

void RibScopes::end(std::string_view request) {
  const std::string name = scope_name(request, "End");
  if (scopes_.size() == 1) {
    tokens_.fail(name + "Begin before it");
  }
  if (scopes_.back().opened != name) {
    tokens_.fail(scopes_.back().opened + "End for line " + std::to_string(scopes_.back().line));
  }
  RibState inner = std::move(state());
  scopes_.pop_back();
  if (name == "Transform") {
    copy_transformation(state(), inner);
    state() = std::move(inner);
  }
  in_object_ = in_object_ && name != "Object";
  camera_mirrors_ = camera_mirrors_ && name != "World";
}

void RibScopes::concatenate(const AffineMap& map, std::size_t line) {
  state().map = map * state().map;
  if (!state().map.is_finite()) {
    bad_input_at(tokens_.name(), line, "transformations whose product is finite", "another");
  }
}

void RibScopes::replace(const AffineMap& map) {
  state().map = map;
  state().unknown = {};
}

void RibScopes::concatenate_unknown(std::string_view name, std::size_t line) {
  if (state().unknown.line == 0) {
    state().unknown = {std::string(name), line};
  }
}

void RibScopes::require_known(const std::string& what) const {
  const RibState::Unknown& unknown = scopes_.back().state.unknown;
  if (unknown.line > 0) {
    bad_input_at(tokens_.name(), unknown.line,
                 "a known affine transformation of the " + what + " in line " +
                     std::to_string(tokens_.line()),
                 in_quotes(unknown.name));
  }
}

// The current orientation is changed by mirroring transformations as that of the coordinates is, so
// that a surface stays inside out or not. The coordinates of a camera are left-handed at first.
void RibScopes::orient(std::string_view side) {
  if (side == "outside" || side == "inside") {
    state().is_inside = side == "inside";
    return;
  }
  if (side != "lh" && side != "rh") {
    tokens_.fail("\"outside\", \"inside\", \"lh\" or \"rh\"");
  }
  if (in_object_) {
    tokens_.fail("\"outside\" or \"inside\" in an object");
  }
  const bool is_right_handed = camera_mirrors_ != state().map.mirrors();
  state().is_inside = is_right_handed != (side == "rh");
}

void RibScopes::mark(const std::string& name) {
  if (in_object_) { // as long as it has no place
    unmark(name);
  } else {
    copy_transformation(state(), marks_[name]);
  }
}

bool RibScopes::return_to(const std::string& name) {
  if (in_object_) {
    return false;
  }
  if (name == "world") {
    copy_transformation({}, state());
    return true;
  }
  const auto found = marks_.find(name);
  if (found != marks_.end()) {
    copy_transformation(found->second, state());
  }
  return found != marks_.end();
}

} // namespace simdbezier::tools
