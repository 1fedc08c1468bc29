// Wavefront .obj: free-form surfaces of cstype bezier. Points are vertices v x y z [w], w being a
// Cartesian weight, which counts where the type is rational. A surface may consist of several
// patches that share rows and columns: k + 1 values of parm make k patches in that direction.
#include <tools/formats/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <tools/formats/obj_statements.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// One direction of a surface as its statements give it.
struct ParameterRange {
  double first = 0;
  double last = 0;
  std::vector<double> parameters; // those of the parm statement; empty before it
};

struct Surface {
  std::size_t line = 0;
  int degree_u = 0;
  int degree_v = 0;
  bool rational = false;
  ParameterRange u;
  ParameterRange v;
  std::size_t first_vertex = 0; // where the ones that it names begin in PatchFile::vertices
};

/// One direction of a surface, which has to have as many points as the statements say.
struct Direction {
  MeshDirection mesh;
  Count points;
};

class ObjReader {
public:
  explicit ObjReader(TextInput& input) : lexer_(input, {.comments = true, .lines = true}) {
    file_.name = input.name();
  }

  PatchFile read() {
    for (lexer_.next(); !lexer_.at(TokenKind::end); lexer_.next()) {
      if (!lexer_.at(TokenKind::line_end)) {
        statement();
      }
    }
    if (surface_) {
      lexer_.fail(end_of_surface());
    }
    if (file_.count == 0) {
      lexer_.fail("a surface (surf)");
    }
    return std::move(file_);
  }

private:
  void statement() {
    const auto* const other = std::ranges::find(kObjOthers, lexer_.text(), &ObjOther::keyword);
    if (other != std::end(kObjOthers)) {
      lexer_.fail("a Bézier surface and what belongs to it",
                  lexer_.described() + " (" + std::string(other->what) + ")");
    }
    if (lexer_.at_word("parm")) {
      parm();
    } else if (lexer_.at_word("end")) {
      end();
    } else if (surface_) {
      lexer_.fail("parm or " + end_of_surface());
    } else if (lexer_.at_word("v")) {
      vertex();
    } else if (lexer_.at_word("cstype")) {
      cstype();
    } else if (lexer_.at_word("deg")) {
      deg();
    } else if (lexer_.at_word("surf")) {
      surf();
    } else if (std::ranges::find(kObjPassedOver, lexer_.text()) != std::end(kObjPassedOver)) {
      pass_over();
    } else {
      lexer_.fail("a statement of .obj files");
    }
  }

  [[nodiscard]] std::string end_of_surface() const {
    return "the end of the surface in line " + std::to_string(surface_->line);
  }

  [[nodiscard]] bool at_line_end() const {
    return lexer_.at(TokenKind::line_end) || lexer_.at(TokenKind::end);
  }

  void pass_over() {
    while (!at_line_end()) {
      lexer_.next();
    }
  }

  void expect_line_end() {
    lexer_.next();
    if (!at_line_end()) {
      lexer_.fail("the end of the line");
    }
  }

  // Reads a vertex. Colours may follow x y z, which makes six numbers.
  void vertex() {
    const std::size_t line = lexer_.line();
    std::array<double, 4> value = {0, 0, 0, 1};
    std::size_t count = 0;
    for (lexer_.next(); !at_line_end(); lexer_.next(), ++count) {
      const double number = lexer_.number();
      if (count < value.size()) {
        value[count] = number;
      }
    }
    if (count != 3 && count != 4 && count != 6) {
      bad_input_at(lexer_.name(), line, "x y z or x y z w", quantity(count, "number", "numbers"));
    }
    if (count == 6) {
      value[3] = 1;
    }
    if (file_.lines.size() == std::numeric_limits<std::uint32_t>::max()) {
      lexer_.fail("at most " + std::to_string(file_.lines.size()) + " vertices", "more");
    }
    file_.points.insert(file_.points.end(), value.begin(), value.end());
    file_.add_line(line);
  }

  void cstype() {
    rational_ = lexer_.next().at_word("rat");
    if (rational_) {
      lexer_.next();
    }
    if (!lexer_.at_word("bezier")) {
      lexer_.fail("cstype bezier or rat bezier");
    }
    has_type_ = true;
    expect_line_end();
  }

  void deg() {
    degree_u_ = lexer_.next().degree("in u");
    degree_v_ = lexer_.next().degree("in v");
    expect_line_end();
  }

  void surf() {
    if (!has_type_ || degree_u_ == 0) {
      lexer_.fail(has_type_ ? "deg before surf" : "cstype before surf");
    }
    surface_ =
        Surface{lexer_.line(), degree_u_, degree_v_, rational_, {}, {}, file_.vertices.size()};
    for (double* const bound :
         {&surface_->u.first, &surface_->u.last, &surface_->v.first, &surface_->v.last}) {
      *bound = lexer_.next().number();
    }
    for (lexer_.next(); !at_line_end(); lexer_.next()) {
      file_.vertices.push_back(vertex_number());
    }
  }

  /// Reads the number of a vertex, and counts it from 0.
  [[nodiscard]] std::uint32_t vertex_number() const {
    const std::size_t vertices = file_.lines.size();
    if (vertices == 0) {
      lexer_.fail("vertices (v) before the surface");
    }
    const auto reference = parse_obj_reference(lexer_.text());
    if (!reference || reference->number > vertices) {
      lexer_.fail("the number of a vertex, 1 to " + std::to_string(vertices) + " or -1 to -" +
                  std::to_string(vertices));
    }
    return static_cast<std::uint32_t>(reference->from_end ? vertices - reference->number
                                                          : reference->number - 1);
  }

  void parm() {
    if (!surface_) {
      lexer_.fail("surf before parm");
    }
    const bool is_u = lexer_.next().at_word("u");
    if (!is_u && !lexer_.at_word("v")) {
      lexer_.fail("parm u or parm v");
    }
    std::vector<double>& parameters = (is_u ? surface_->u : surface_->v).parameters;
    if (!parameters.empty()) {
      lexer_.fail("one parm of each direction");
    }
    for (lexer_.next(); !at_line_end(); lexer_.next()) {
      const double parameter = lexer_.number();
      if (!parameters.empty() && parameter <= parameters.back()) {
        lexer_.fail("a parameter above " + shortest(parameters.back()));
      }
      parameters.push_back(parameter);
    }
    if (parameters.size() < 2) {
      lexer_.fail("2 parameters or more");
    }
  }

  /// Finds the patches of one direction. A range that cuts out a part of the surface would make
  /// another surface of it, so ranges have to be whole.
  [[nodiscard]] Direction direction(const ParameterRange& range, int degree,
                                    const std::string& name) const {
    const std::vector<double>& parameters = range.parameters;
    if (parameters.empty()) {
      lexer_.fail("parm " + name + " before the end of the surface in line " +
                  std::to_string(surface_->line));
    }
    if (range.first != parameters.front() || range.last != parameters.back()) {
      bad_input_at(lexer_.name(), surface_->line,
                   "the whole range " + shortest(parameters.front()) + " " +
                       shortest(parameters.back()) + " of parm " + name,
                   shortest(range.first) + " " + shortest(range.last));
    }
    const auto step = static_cast<std::size_t>(degree);
    const std::size_t patches = parameters.size() - 1;
    const Count points = Count(patches) * step + 1;
    return {{points.value().value_or(0), step, patches}, points};
  }

  void end() {
    if (!surface_) {
      lexer_.fail("surf before end");
    }
    const Direction u = direction(surface_->u, surface_->degree_u, "u");
    const Direction v = direction(surface_->v, surface_->degree_v, "v");
    const Count expected = u.points * v.points;
    const std::size_t found = file_.vertices.size() - surface_->first_vertex;
    if (expected.value() != found) {
      bad_input_at(lexer_.name(), surface_->line,
                   to_string(expected) + " points (" + to_string(u.points) + " x " +
                       to_string(v.points) + ")",
                   std::to_string(found));
    }
    if (surface_->rational) {
      check_weights();
    }
    file_.close_indexed_mesh(surface_->degree_u, surface_->degree_v,
                             surface_->rational ? Weights::cartesian : Weights::none, u.mesh,
                             v.mesh);
    surface_.reset();
    expect_line_end();
  }

  void check_weights() const {
    for (std::size_t k = surface_->first_vertex; k < file_.vertices.size(); ++k) {
      const std::size_t vertex = file_.vertices[k];
      const std::span<const double> point = std::span(file_.points).subspan(4 * vertex, 4);
      if (point[3] <= 0) {
        bad_input_at(lexer_.name(), file_.lines[vertex], "a weight above 0", shortest(point[3]));
      }
      for (const double coordinate : point.first(3)) {
        if (!std::isfinite(coordinate * point[3])) {
          bad_input_at(lexer_.name(), file_.lines[vertex],
                       "coordinates that are finite when multiplied by their weight",
                       shortest(coordinate) + " * " + shortest(point[3]));
        }
      }
    }
  }

  Lexer lexer_;
  PatchFile file_;
  bool has_type_ = false;
  bool rational_ = false;
  int degree_u_ = 0; // 0 until it is given
  int degree_v_ = 0;
  std::optional<Surface> surface_;
};

} // namespace

PatchFile read_obj(TextInput& input, const ReadOptions& /*options*/) {
  return ObjReader(input).read();
}

} // namespace simdbezier::tools
