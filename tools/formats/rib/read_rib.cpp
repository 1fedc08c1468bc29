// RenderMan .rib: Patch and PatchMesh, "bilinear" or "bicubic" in any basis, and NuPatch, with
// points "P" (x y z) or "Pw" (wx wy wz w), u fastest, where transformations and instances of
// objects put them in the space of the world. Requests that concern no shape are passed over.
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <tools/formats/rib/requests.hpp>
#include <tools/formats/rib/scopes.hpp>
#include <tools/formats/rib/surfaces.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// Instances may show so many points, and as many times those of the file. They take memory, and
// few characters could ask for any number of them.
constexpr std::size_t kInstancePoints = std::size_t{1} << 22;
constexpr std::size_t kTimesInstanced = 4096;

class RibReader {
public:
  RibReader(TextInput& input, const ReadOptions& options)
      : tokens_(input), scopes_(tokens_), surfaces_(tokens_, file_, options.ignore_trims) {
    file_.name = input.name();
    file_.knot_tolerance = options.knot_tolerance;
  }

  PatchFile read() {
    tokens_.next();
    while (!tokens_.at(TokenKind::end)) {
      tokens_.at(TokenKind::word) ? request() : parameter();
    }
    if (scopes_.is_in_object()) {
      tokens_.fail("ObjectEnd");
    }
    if (file_.count == 0) {
      tokens_.fail("a patch (Patch, PatchMesh or NuPatch)");
    }
    return std::move(file_);
  }

private:
  /// Reads a request, from its name to the first token behind it.
  void request() {
    const std::string name(tokens_.text());
    if (RibSurfaces::reads(name)) {
      return surface();
    }
    const auto* const known =
        std::ranges::find(kRibTransformations, name, &RibTransformation::name);
    if (known != std::end(kRibTransformations)) {
      return transformation(*known);
    }
    if (name == "Basis") {
      basis();
    } else if (name == "TrimCurve") {
      const RibTrim trim = read_rib_trim(tokens_);
      scopes_.state().trim = trim.line > 0 ? std::make_shared<const RibTrim>(trim) : nullptr;
    } else if (name == "ObjectInstance") {
      instance();
    } else if (is_listed(name, kRibNamesBehind)) {
      named(name);
    } else {
      other_request(name);
    }
    tokens_.next();
  }

  void surface() {
    scopes_.require_known("patch");
    const RibShape shape = surfaces_.read(scopes_.state());
    points_read_ += shape.points();
    add(shape);
  }

  /// Puts a shape where it belongs.
  void add(const RibShape& shape) {
    if (scopes_.is_in_object()) {
      object_.take(file_, shape);
    } else {
      close_rib_shape(file_, shape);
    }
  }

  /// Reads a transformation, which replaces those before it (Identity, Transform) or is applied in
  /// front of them.
  void transformation(const RibTransformation& known) {
    const std::size_t line = tokens_.line();
    std::vector<double> numbers;
    if (tokens_.next().at(TokenKind::open)) {
      tokens_.pass_over_array(&numbers);
      tokens_.next();
    } else {
      for (; tokens_.at_number() && numbers.size() < known.numbers; tokens_.next()) {
        numbers.push_back(tokens_.number());
      }
    }
    if (numbers.size() != known.numbers) {
      bad_input_at(tokens_.name(), line,
                   quantity(known.numbers, "number", "numbers") + " behind " +
                       std::string(known.name),
                   std::to_string(numbers.size()));
    }
    std::array<double, 16> values = {};
    std::ranges::copy(numbers, values.begin());
    const std::optional<AffineMap> map = known.map(values);
    if (known.replaces) {
      scopes_.replace(map.value_or(AffineMap()));
    } else if (map) {
      scopes_.concatenate(*map, line);
    }
    if (!map) {
      scopes_.concatenate_unknown(known.name, line);
    }
  }

  /// Reads a request whose effect depends on the name behind it, which is a string or a number.
  void named(const std::string& request) {
    if (request == "ObjectBegin") {
      scopes_.begin(request);
    }
    tokens_.next();
    if (!tokens_.at(TokenKind::string) && !tokens_.at_number()) {
      tokens_.fail("a name behind " + request);
    }
    const std::string name(tokens_.text());
    if (request == "ObjectBegin") {
      object_name_ = name;
      object_ = {};
    } else if (request == "Orientation") {
      scopes_.orient(name);
    } else if (request == "Attribute") {
      scopes_.state().keeps_what_trims_enclose &= name != "trimcurve";
    } else if (request == "CoordinateSystem") {
      scopes_.mark(name);
    } else if (request == "ScopedCoordinateSystem") {
      scopes_.unmark(name); // it could be that of another scope
    } else if (!scopes_.return_to(name)) {
      scopes_.concatenate_unknown(request, tokens_.line());
    }
  }

  void instance() {
    tokens_.next();
    const auto found = objects_.find(std::string(tokens_.text()));
    if ((!tokens_.at(TokenKind::string) && !tokens_.at_number()) || found == objects_.end()) {
      tokens_.fail("an object (ObjectBegin) that ended before");
    }
    scopes_.require_known("object");
    const RibState& state = scopes_.state();
    const std::size_t most = kInstancePoints + kTimesInstanced * points_read_;
    points_shown_ += found->second.points();
    if (points_shown_ > most) {
      tokens_.fail("instances of at most " + std::to_string(most) + " points", "more");
    }
    found->second.show(file_, state.map, state.is_inside,
                       [&](const RibShape& shape) { add(shape); });
  }

  void other_request(const std::string& name) {
    if (is_listed(name, kRibOtherGeometry)) {
      tokens_.fail("a Patch, PatchMesh or NuPatch");
    }
    if (is_listed(name, kRibScopeBegins)) {
      begin_scope(name);
    } else if (is_listed(name, kRibScopeEnds)) {
      end_scope(name);
    } else if (is_listed(name, kRibUnknownTransformations)) {
      scopes_.concatenate_unknown(name, tokens_.line());
    } else if (name == "ReverseOrientation") {
      scopes_.state().is_inside = !scopes_.state().is_inside;
    } else if (!is_listed(name, kRibPassedOver) && !tokens_.at_number()) {
      tokens_.fail("a request of .rib files");
    }
  }

  /// Opens a scope. Another frame is another picture, which would show all of its patches once
  /// more.
  void begin_scope(const std::string& name) {
    if (file_.count > 0 && (name == "FrameBegin" || name == "WorldBegin")) {
      tokens_.fail("patches in one frame or world only");
    }
    scopes_.begin(name);
  }

  void end_scope(const std::string& name) {
    scopes_.end(name);
    if (name == "ObjectEnd") {
      objects_[object_name_] = std::exchange(object_, {});
    }
  }

  /// Passes over a string or an array behind a request that is passed over. Numbers come one by
  /// one, as words do.
  void parameter() {
    if (tokens_.at(TokenKind::close)) {
      tokens_.fail("a request of .rib files");
    }
    if (tokens_.at(TokenKind::open)) {
      tokens_.pass_over_array();
    }
    tokens_.next();
  }

  void basis() {
    for (RibBasis* const basis : {&scopes_.state().bases.u, &scopes_.state().bases.v}) {
      std::optional<RibMatrix> matrix;
      std::string name;
      tokens_.next();
      if (tokens_.at(TokenKind::open)) {
        matrix.emplace();
        for (double& number : *matrix) {
          number = tokens_.next().number();
        }
        tokens_.expect_close("16 numbers of a basis");
      } else if (tokens_.at(TokenKind::string)) {
        name = tokens_.text();
      } else {
        tokens_.fail("a basis");
      }
      const std::size_t step = tokens_.next_count("the step of a basis", 1);
      *basis = matrix ? rib_basis(*matrix, step) : rib_basis(name, step);
    }
  }

  RibTokens tokens_;
  PatchFile file_;
  RibScopes scopes_;
  RibSurfaces surfaces_;
  std::map<std::string, RibObject> objects_; // by their names or numbers
  RibObject object_;                         // the one that is being read
  std::string object_name_;
  std::size_t points_read_ = 0;
  std::size_t points_shown_ = 0; // by instances
};

} // namespace

PatchFile read_rib(TextInput& input, const ReadOptions& options) {
  return RibReader(input, options).read();
}

} // namespace simdbezier::tools
