// Wavefront .obj: free-form surfaces of every cstype. Points are vertices v x y z [w], w being a
// Cartesian weight, which counts where the type is rational. A surface may consist of several
// patches: k + 1 values of parm make k patches in that direction, and those of bspline are knots.
#include <tools/formats/input/lexer.hpp>
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <tools/formats/obj/state.hpp>
#include <tools/formats/obj/statements.hpp>
#include <tools/formats/obj/surface.hpp>
#include <tools/formats/obj/trims.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

class ObjReader {
public:
  ObjReader(TextInput& input, const ReadOptions& options)
      : options_(options), lexer_(input, {.comments = true, .lines = true}) {
    file_.name = input.name();
    file_.knot_tolerance = options.knot_tolerance;
  }

  PatchFile read() {
    for (lexer_.next(); !lexer_.at(TokenKind::end); lexer_.next()) {
      if (!lexer_.at(TokenKind::line_end)) {
        statement();
      }
    }
    if (surface_ || curves_.in_curve()) {
      lexer_.fail(end_of_element());
    }
    for (const ObjSurface& surface : waiting_) {
      close_obj_surface(file_, surface);
    }
    if (file_.count == 0) {
      lexer_.fail("a surface (surf)");
    }
    return std::move(file_);
  }

private:
  void statement() {
    const std::string_view word = lexer_.text();
    const auto* const other = std::ranges::find(kObjOthers, word, &ObjOther::keyword);
    if (other != std::end(kObjOthers)) {
      lexer_.fail("a free-form surface and what belongs to it",
                  lexer_.described() + " (" + std::string(other->what) + ")");
    }
    const bool inside = surface_ || curves_.in_curve();
    if (word == "parm") {
      parm();
    } else if (word == "end") {
      end();
    } else if (surface_ && (word == "trim" || word == "hole")) {
      curves_.read_trim(lexer_, trims_);
    } else if (std::ranges::find(kObjInSurfaces, word) != std::end(kObjInSurfaces)) {
      inside ? pass_over() : lexer_.fail("surf before " + std::string(word));
    } else if (inside) {
      lexer_.fail("parm or " + end_of_element());
    } else if (!vertex_or_state(word)) {
      if (std::ranges::find(kObjPassedOver, word) == std::end(kObjPassedOver)) {
        lexer_.fail("a statement of .obj files");
      }
      pass_over();
    }
  }

  /// Reads a statement that stands before surfaces, or begins one; false where it is none.
  bool vertex_or_state(std::string_view word) {
    if (word == "v") {
      vertex();
    } else if (word == "vp") {
      curves_.read_point(lexer_);
    } else if (word == "surf") {
      surf();
    } else if (word == "curv2") {
      element_line_ = lexer_.line();
      curves_.begin_curve(lexer_, state_);
    } else {
      return state_.read(lexer_);
    }
    return true;
  }

  [[nodiscard]] std::string end_of_element() const {
    return std::string("the end of the ") + (surface_ ? "surface" : "curve") + " in line " +
           std::to_string(element_line_);
  }

  void pass_over() {
    while (!ends_statement(lexer_)) {
      lexer_.next();
    }
  }

  // Reads a vertex. Colours may follow x y z, which makes six numbers.
  void vertex() {
    const std::size_t line = lexer_.line();
    std::array<double, 4> value = {0, 0, 0, 1};
    std::size_t count = 0;
    for (lexer_.next(); !ends_statement(lexer_); lexer_.next(), ++count) {
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

  void surf() {
    surface_ = state_.surface(lexer_);
    element_line_ = surface_->line;
    trims_ = {};
    for (Interval* const range : {&surface_->u.range, &surface_->v.range}) {
      range->begin = lexer_.next().number();
      range->end = lexer_.next().number();
    }
    for (lexer_.next(); !ends_statement(lexer_); lexer_.next()) {
      if (file_.lines.empty()) {
        lexer_.fail("vertices (v) before the surface");
      }
      surface_->vertices.push_back(obj_index(lexer_, file_.lines.size(), "vertex"));
    }
  }

  void parm() {
    if (!surface_ && !curves_.in_curve()) {
      lexer_.fail("surf before parm");
    }
    const bool is_u = lexer_.next().at_word("u");
    if (!is_u && !(surface_ && lexer_.at_word("v"))) {
      lexer_.fail(surface_ ? "parm u or parm v" : "parm u");
    }
    std::vector<double> parameters;
    const bool are_knots = state_.type() == ObjType::bspline;
    for (lexer_.next(); !ends_statement(lexer_); lexer_.next()) {
      const double parameter = lexer_.number();
      if (!parameters.empty() &&
          (are_knots ? parameter < parameters.back() : parameter <= parameters.back())) {
        lexer_.fail((are_knots ? "a knot of at least " : "a parameter above ") +
                    shortest(parameters.back()));
      }
      parameters.push_back(parameter);
    }
    const int degree = surface_ ? (is_u ? surface_->u : surface_->v).degree : 0;
    const std::size_t least = surface_ && are_knots ? 2 * static_cast<std::size_t>(degree) + 2 : 2;
    if (parameters.size() < least) {
      lexer_.fail(std::to_string(least) + (are_knots ? " knots or more" : " parameters or more"));
    }
    if (!surface_) {
      return curves_.set_parameters(std::move(parameters));
    }
    std::vector<double>& place = (is_u ? surface_->u : surface_->v).parameters;
    if (!place.empty()) {
      lexer_.fail("one parm of each direction", is_u ? "'u'" : "'v'");
    }
    place = std::move(parameters);
  }

  void end() {
    if (curves_.in_curve()) {
      curves_.end_curve();
    } else if (surface_) {
      finish_obj_surface(lexer_, file_, *surface_, trims_, options_.ignore_trims);
      // Vertices come first among points, so what makes new points waits for the last vertex.
      if (waiting_.empty() && surface_->has_bezier_points()) {
        close_obj_surface(file_, *surface_);
      } else {
        waiting_.push_back(std::move(*surface_));
      }
      surface_.reset();
    } else {
      lexer_.fail("surf before end");
    }
    expect_statement_end(lexer_);
  }

  const ReadOptions& options_;
  Lexer lexer_;
  PatchFile file_;
  ObjState state_;
  ObjCurves curves_;
  std::optional<ObjSurface> surface_; // the one that is being read
  ObjTrims trims_;                    // its own
  std::size_t element_line_ = 0;      // where it, or the curve that is being read, begins
  std::vector<ObjSurface> waiting_;   // with all that followed them
};

} // namespace

PatchFile read_obj(TextInput& input, const ReadOptions& options) {
  return ObjReader(input, options).read();
}

} // namespace simdbezier::tools
