// Wavefront .obj: free-form surfaces of cstype bezier. Points are vertices v x y z [w], w being a
// Cartesian weight, which counts where the type is rational. A surface may consist of several
// patches that share rows and columns: k + 1 values of parm make k patches in that direction.
#include <tools/lexer.hpp>
#include <tools/patch_file.hpp>
#include <tools/segment_mesh.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include <tools/failure.hpp>
#include <tools/output_file.hpp>

namespace simdbezier::tools {

namespace {

// What does not change the shape of a surface.
constexpr std::string_view kPassedOver[] = {
    "vt",    "vn",       "vp",       "g",          "s",         "mg",     "o",
    "bevel", "c_interp", "lod",      "usemtl",     "mtllib",    "usemap", "maplib",
    "ctech", "stech",    "d_interp", "shadow_obj", "trace_obj", "step",   "bmat"};

struct Other {
  std::string_view keyword;
  std::string_view what;
};
constexpr Other kOthers[] = {{"p", "points"},
                             {"l", "lines"},
                             {"f", "polygons"},
                             {"curv", "a curve"},
                             {"curv2", "a curve"},
                             {"trim", "a trimming curve"},
                             {"hole", "a trimming curve"},
                             {"scrv", "a special curve"},
                             {"sp", "special points"},
                             {"con", "connectivity"},
                             {"call", "another file"},
                             {"csh", "a shell command"},
                             {"bzp", "a superseded statement"},
                             {"bsp", "a superseded statement"},
                             {"cdc", "a superseded statement"},
                             {"cdp", "a superseded statement"},
                             {"res", "a superseded statement"}};

/// One direction of a surface as its statements give it.
struct Range {
  double first = 0;
  double last = 0;
  std::vector<double> parameters; // of parm; empty before it
};

struct Surface {
  std::size_t line = 0;
  int degree_u = 0;
  int degree_v = 0;
  bool rational = false;
  Range u;
  Range v;
  std::vector<std::size_t> vertices;
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
    const auto* const other = std::ranges::find(kOthers, lexer_.text(), &Other::keyword);
    if (other != std::end(kOthers)) {
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
    } else if (std::ranges::find(kPassedOver, lexer_.text()) != std::end(kPassedOver)) {
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

  // Colours may follow x y z, which makes six numbers.
  void vertex() {
    MeshPoint point;
    point.line = lexer_.line();
    std::size_t count = 0;
    for (lexer_.next(); !at_line_end(); lexer_.next(), ++count) {
      const double number = lexer_.number();
      if (count < point.value.size()) {
        point.value[count] = number;
      }
    }
    if (count != 3 && count != 4 && count != 6) {
      bad_input_at(lexer_.name(), point.line, "x y z or x y z w",
                   std::to_string(count) + " numbers");
    }
    if (count == 6) {
      point.value[3] = 1;
    }
    vertices_.push_back(point);
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
    surface_ = Surface{lexer_.line(), degree_u_, degree_v_, rational_, {}, {}, {}};
    for (double* const bound :
         {&surface_->u.first, &surface_->u.last, &surface_->v.first, &surface_->v.last}) {
      *bound = lexer_.next().number();
    }
    for (lexer_.next(); !at_line_end(); lexer_.next()) {
      surface_->vertices.push_back(vertex_index());
    }
  }

  /// Of v, v/vt, v//vn or v/vt/vn, counted from 0.
  [[nodiscard]] std::size_t vertex_index() const {
    if (vertices_.empty()) {
      lexer_.fail("vertices (v) before the surface");
    }
    const std::string_view word = lexer_.text().substr(0, lexer_.text().find('/'));
    const bool from_end = word.starts_with('-');
    const auto number = parse_integer(word.substr(from_end ? 1 : 0));
    if (!number || *number == 0 || *number > vertices_.size()) {
      lexer_.fail("the number of a vertex, 1 to " + std::to_string(vertices_.size()) +
                  " or -1 to -" + std::to_string(vertices_.size()));
    }
    return from_end ? vertices_.size() - *number : *number - 1;
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

  /// The patches of one direction. The part of a surface that a range of its own cuts out is
  /// another surface, so ranges must be whole.
  [[nodiscard]] MeshDirection direction(const Range& range, int degree,
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
    return {degree, patches * step + 1, step, patches};
  }

  void end() {
    if (!surface_) {
      lexer_.fail("surf before end");
    }
    const MeshDirection u = direction(surface_->u, surface_->degree_u, "u");
    const MeshDirection v = direction(surface_->v, surface_->degree_v, "v");
    const std::vector<std::size_t>& vertices = surface_->vertices;
    if (vertices.size() != u.points * v.points) {
      bad_input_at(lexer_.name(), surface_->line,
                   std::to_string(u.points * v.points) + " points (" + std::to_string(u.points) +
                       " x " + std::to_string(v.points) + ")",
                   std::to_string(vertices.size()));
    }
    const auto at = [&](std::size_t k) -> const MeshPoint& {
      const MeshPoint& point = vertices_[vertices[k]];
      if (surface_->rational && point.value[3] <= 0) {
        bad_input_at(lexer_.name(), point.line, "a weight above 0", shortest(point.value[3]));
      }
      return point;
    };
    add_mesh(file_, u, v, surface_->rational ? Weights::cartesian : Weights::none, at);
    surface_.reset();
    expect_line_end();
  }

  Lexer lexer_;
  PatchFile file_;
  std::vector<MeshPoint> vertices_;
  bool has_type_ = false;
  bool rational_ = false;
  int degree_u_ = 0; // 0: not given yet
  int degree_v_ = 0;
  std::optional<Surface> surface_;
};

} // namespace

PatchFile read_obj(TextInput& input) { return ObjReader(input).read(); }

} // namespace simdbezier::tools
