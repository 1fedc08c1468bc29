// RenderMan .rib: Patch and PatchMesh, "bilinear" or "bicubic" in the bezier basis, with points
// "P" (x y z) or "Pw" (wx wy wz w), u fastest. Points are taken as they stand: transformations,
// like all requests that are no geometry, are passed over.
#include <tools/formats/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <optional>
#include <string_view>
#include <utility>

#include <tools/formats/rib_requests.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr double kBezierBasis[16] = {-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0};

constexpr const char* kPoints = "\"P\" or \"Pw\" of the patch";
constexpr std::string_view kSpace = " \t\n\r\f\v";

// Counts beyond this are no counts of points in a file.
constexpr std::size_t kMostPoints = std::size_t{1} << 31;

struct Basis {
  std::string name = "bezier";
  std::size_t step = 3;
};
struct Bases {
  Basis u;
  Basis v;
};

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
    } else {
      other_request();
      lexer_.next();
    }
  }

  /// Passes over anything but a patch or a basis. Its numbers come here one by one, as words do.
  void other_request() {
    const std::string_view name = lexer_.text();
    if (is_listed(name, kRibOtherGeometry)) {
      lexer_.fail("a Patch or PatchMesh");
    } else if (is_listed(name, kRibScopeBegins)) {
      bases_.push_back(bases_.back());
    } else if (is_listed(name, kRibScopeEnds)) {
      bases_.resize(bases_.size() > 1 ? bases_.size() - 1 : 1);
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
  /// strings means that the latter is missing, and what follows could be geometry.
  void pass_over_array() {
    const std::string expected = "']' for the array in line " + std::to_string(lexer_.line());
    while (!lexer_.next().at(TokenKind::close)) {
      if (!lexer_.at(TokenKind::string) && !at_number()) {
        lexer_.fail(expected);
      }
    }
  }

  void basis() {
    for (Basis* const basis : {&bases_.back().u, &bases_.back().v}) {
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
    const MeshDirection u = direction(degree, bases_.back().u, "u");
    const MeshDirection v = direction(degree, bases_.back().v, "v");
    add(degree, u, v);
  }

  /// Reads the degree. Bicubic patches in another basis are refused.
  int patch_type() {
    const std::size_t line = lexer_.line();
    lexer_.next();
    const bool bicubic = lexer_.text() == "bicubic";
    if (!lexer_.at(TokenKind::string) || !(bicubic || lexer_.text() == "bilinear")) {
      lexer_.fail("\"bicubic\" or \"bilinear\"");
    }
    for (const Basis* const basis : {&bases_.back().u, &bases_.back().v}) {
      if (bicubic && basis->name != "bezier") {
        bad_input_at(lexer_.name(), line, "a patch in the bezier basis",
                     "one in " + in_quotes(basis->name));
      }
    }
    return bicubic ? 3 : 1;
  }

  MeshDirection direction(int degree, const Basis& basis, const std::string& name) {
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
  std::vector<Bases> bases_ = {{}};
};

} // namespace

PatchFile read_rib(TextInput& input) { return RibReader(input).read(); }

} // namespace simdbezier::tools
