// RenderMan .rib: Patch and PatchMesh, "bilinear" or "bicubic" in the bezier basis, with points
// "P" (x y z) or "Pw" (wx wy wz w), u fastest. Points are taken as they stand: a patch that a
// transformation moves is refused, and requests that concern no shape are passed over.
#include <tools/formats/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <tools/formats/rib_requests.hpp>
#include <tools/formats/rib_scopes.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr double kBezierBasis[16] = {-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0};

constexpr const char* kPoints = "\"P\" or \"Pw\" of the patch";
constexpr std::string_view kSpace = " \t\n\r\f\v";

// Counts beyond this are no counts of points in a file.
constexpr std::size_t kMostPoints = std::size_t{1} << 31;

class RibReader {
public:
  explicit RibReader(TextInput& input)
      : lexer_(input, {.comments = true, .brackets = true, .strings = true}) {
    file_.name = input.name();
  }

  PatchFile read() {
    lexer_.next();
    while (!lexer_.at(TokenKind::end)) {
      lexer_.at(TokenKind::word) ? request() : parameter();
    }
    if (file_.count == 0) {
      lexer_.fail("a Patch or PatchMesh");
    }
    return std::move(file_);
  }

private:
  /// Reads a request, from its name to the first token behind it.
  void request() {
    if (lexer_.at_word("Patch")) {
      patch();
    } else if (lexer_.at_word("PatchMesh")) {
      patch_mesh();
    } else if (lexer_.at_word("Basis")) {
      basis();
    } else if (const auto* const known =
                   std::ranges::find(kRibTransformations, lexer_.text(), &RibTransformation::name);
               known != std::end(kRibTransformations)) {
      transformation(*known);
    } else {
      other_request();
      lexer_.next();
    }
  }

  /// Reads a transformation, which replaces those before it (Identity, Transform) or joins them.
  void transformation(const RibTransformation& known) {
    const std::size_t line = lexer_.line();
    std::vector<double> numbers;
    if (lexer_.next().at(TokenKind::open)) {
      pass_over_array(&numbers);
      lexer_.next();
    } else {
      for (; at_number() && numbers.size() < known.numbers; lexer_.next()) {
        numbers.push_back(lexer_.number());
      }
    }
    if (numbers.size() != known.numbers) {
      bad_input_at(lexer_.name(), line,
                   std::to_string(known.numbers) + " numbers behind " + std::string(known.name),
                   std::to_string(numbers.size()));
    }
    scopes_.transform(known, numbers, line);
  }

  /// Opens a scope. Another frame is another picture, which would show all of its patches once
  /// more.
  void begin_scope(std::string_view name) {
    if (file_.count > 0 && (name == "FrameBegin" || name == "WorldBegin")) {
      lexer_.fail("patches in one frame or world only");
    }
    scopes_.begin(name);
  }

  /// Passes over anything but a patch or a basis. Its numbers come here one by one, as words do.
  void other_request() {
    const std::string_view name = lexer_.text();
    if (is_listed(name, kRibOtherGeometry)) {
      lexer_.fail("a Patch or PatchMesh");
    } else if (is_listed(name, kRibScopeBegins)) {
      begin_scope(name);
    } else if (is_listed(name, kRibScopeEnds)) {
      scopes_.end(name);
    } else if (is_listed(name, kRibUnknownTransformations)) {
      scopes_.move(name, lexer_.line());
    } else if (!is_listed(name, kRibPassedOver) && !parse_finite(name)) {
      lexer_.fail("a request of .rib files");
    }
  }

  /// Passes over a string or an array behind such a request.
  void parameter() {
    if (lexer_.at(TokenKind::close)) {
      lexer_.fail("a request of .rib files");
    }
    if (lexer_.at(TokenKind::open)) {
      pass_over_array();
    }
    lexer_.next();
  }

  [[nodiscard]] bool at_number() const {
    return lexer_.at(TokenKind::word) && parse_finite(lexer_.text());
  }

  /// Passes over an array, from its opening to its closing bracket. Anything but numbers and
  /// strings means that the latter is missing, and what follows could be geometry. Hands over the
  /// numbers where they are wanted.
  void pass_over_array(std::vector<double>* numbers = nullptr) {
    const std::string expected = "']' for the array in line " + std::to_string(lexer_.line());
    while (!lexer_.next().at(TokenKind::close)) {
      if (!lexer_.at(TokenKind::string) && !at_number()) {
        lexer_.fail(expected);
      }
      if (numbers != nullptr && lexer_.at(TokenKind::word)) {
        numbers->push_back(lexer_.number());
      }
    }
  }

  void basis() {
    for (RibScopes::Basis* const basis : {&scopes_.bases().u, &scopes_.bases().v}) {
      lexer_.next();
      if (lexer_.at(TokenKind::open)) {
        basis->name = basis_of_matrix();
      } else if (lexer_.at(TokenKind::string)) {
        basis->name = lexer_.text();
      } else {
        lexer_.fail("a basis");
      }
      basis->step = next_count("the step of a basis", 1);
    }
    lexer_.next();
  }

  std::size_t next_count(const std::string& what, std::size_t least) {
    const std::string range = std::to_string(least) + " to " + std::to_string(kMostPoints);
    return lexer_.next().integer(what + " (" + range + ")", least, kMostPoints);
  }

  std::string basis_of_matrix() {
    bool bezier = true;
    for (const double value : kBezierBasis) {
      bezier = lexer_.next().number() == value && bezier;
    }
    expect_close("16 numbers of a basis");
    return bezier ? "bezier" : "a matrix";
  }

  void patch() {
    const int degree = patch_type();
    const auto order = static_cast<std::size_t>(degree) + 1;
    add(degree, {order, order, 1}, {order, order, 1});
  }

  void patch_mesh() {
    const int degree = patch_type();
    const MeshDirection u = direction(degree, scopes_.bases().u, "u");
    const MeshDirection v = direction(degree, scopes_.bases().v, "v");
    add(degree, u, v);
  }

  /// Reads the degree. Bicubic patches in another basis are refused.
  int patch_type() {
    const std::size_t line = lexer_.line();
    if (const RibScopes::Mover& mover = scopes_.mover(); mover.line > 0) {
      bad_input_at(lexer_.name(), mover.line,
                   "no transformation of the patch in line " + std::to_string(line),
                   in_quotes(mover.name));
    }
    lexer_.next();
    const bool bicubic = lexer_.text() == "bicubic";
    if (!lexer_.at(TokenKind::string) || !(bicubic || lexer_.text() == "bilinear")) {
      lexer_.fail("\"bicubic\" or \"bilinear\"");
    }
    for (const RibScopes::Basis* const basis : {&scopes_.bases().u, &scopes_.bases().v}) {
      if (bicubic && basis->name != "bezier") {
        bad_input_at(lexer_.name(), line, "a patch in the bezier basis",
                     "one in " + in_quotes(basis->name));
      }
    }
    return bicubic ? 3 : 1;
  }

  MeshDirection direction(int degree, const RibScopes::Basis& basis, const std::string& name) {
    const std::size_t step = degree == 3 ? basis.step : 1;
    const auto order = static_cast<std::size_t>(degree) + 1;
    const std::size_t points = next_count("the number of points in " + name, 2);
    const std::string found = std::to_string(points);
    const std::size_t line = lexer_.line();
    lexer_.next();
    const bool periodic = lexer_.text() == "periodic";
    if (!lexer_.at(TokenKind::string) || !(periodic || lexer_.text() == "nonperiodic")) {
      lexer_.fail("\"periodic\" or \"nonperiodic\"");
    }
    const std::string each = std::to_string(step);
    if (periodic ? points % step != 0 : points < order || (points - order) % step != 0) {
      bad_input_at(lexer_.name(), line,
                   periodic ? "a multiple of " + each + " points in periodic " + name
                            : std::to_string(order) + " points in " + name + " and " + each +
                                  " more a patch",
                   found);
    }
    return {points, step, periodic ? points / step : (points - order) / step + 1};
  }

  /// Reads the parameter list and adds the patches. What follows a list has to be a request:
  /// anything else belongs to a list that is not as it should be.
  void add(int degree, const MeshDirection& u, const MeshDirection& v) {
    std::optional<Weights> weights;
    for (lexer_.next(); lexer_.at(TokenKind::string); lexer_.next()) {
      const std::string name = parameter_name();
      if (name == "P" || name == "Pw" || name == "Pz") {
        if (weights || name == "Pz") {
          lexer_.fail(weights ? "one of \"P\" and \"Pw\"" : kPoints);
        }
        weights = name == "Pw" ? Weights::homogeneous : Weights::none;
        read_points(Count(u.points) * v.points, *weights);
      } else {
        pass_over_value(name);
      }
    }
    if (!weights) {
      lexer_.fail(kPoints);
    }
    if (!lexer_.at(TokenKind::end) && (!lexer_.at(TokenKind::word) || at_number())) {
      lexer_.fail("a parameter's name or a request behind the patch");
    }
    file_.close_mesh(degree, degree, *weights, u, v);
  }

  /// Declarations may stand in front of the name: "vertex point P".
  [[nodiscard]] std::string parameter_name() const {
    const std::string_view text = lexer_.text();
    const std::size_t end = text.find_last_not_of(kSpace) + 1;
    return std::string(text.substr(0, end).substr(text.substr(0, end).find_last_of(kSpace) + 1));
  }

  /// Reads a number, a string, or an array of them, behind a parameter's name.
  void pass_over_value(const std::string& name) {
    if (lexer_.next().at(TokenKind::open)) {
      pass_over_array();
    } else if (!lexer_.at(TokenKind::string) && !at_number()) {
      lexer_.fail("a value of the parameter " + in_quotes(name));
    }
  }

  void read_points(Count count, Weights weights) {
    const std::size_t values = weights == Weights::none ? 3 : 4;
    const std::size_t all = lexer_.counted(count * values, "coordinates");
    const std::string what =
        std::to_string(all / values) + " points of " + std::to_string(values) + " numbers";
    if (!lexer_.next().at(TokenKind::open)) {
      lexer_.fail("'[' and " + std::to_string(all / values) + " points");
    }
    for (std::size_t k = 0; k < all; ++k) {
      lexer_.next();
      if (lexer_.at(TokenKind::close) || lexer_.at(TokenKind::end)) {
        lexer_.fail(what, lexer_.described() + " after " + quantity(k, "number", "numbers"));
      }
      if (k % values == 0) {
        file_.add_line(lexer_.line());
      }
      const bool is_weight = k % values == 3;
      file_.points.push_back(is_weight ? lexer_.weight() : lexer_.number());
      if (is_weight) {
        file_.check_quotients();
      }
    }
    expect_close(what);
  }

  void expect_close(const std::string& what) {
    if (!lexer_.next().at(TokenKind::close)) {
      lexer_.fail("']' after " + what);
    }
  }

  Lexer lexer_;
  PatchFile file_;
  RibScopes scopes_;
};

} // namespace

PatchFile read_rib(TextInput& input) { return RibReader(input).read(); }

} // namespace simdbezier::tools
