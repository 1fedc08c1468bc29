// IGES: spline surfaces (128), parametric surfaces (114), their transformations (124), subfigures
// (308, 408), and surfaces whose boundary leaves all of the surface or a rectangle of it (143,
// 144), also as faces of solids (186, 514, 510).
#include <tools/formats/patch_file.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tools/formats/iges/boundary.hpp>
#include <tools/formats/iges/kinds.hpp>
#include <tools/formats/iges/parameters.hpp>
#include <tools/formats/iges/surfaces.hpp>
#include <tools/formats/surfaces/parameter_boundary.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::size_t kMostIndex = std::size_t{1} << 31;
constexpr std::size_t kMostNested = 64;

class IgesReader {
public:
  IgesReader(TextInput& input, const ReadOptions& options)
      : options_(options), records_(read_iges_records(input)), part_(records_.entities.size()),
        on_surface_(records_.entities.size()) {
    file_.name = records_.name;
    file_.knot_tolerance = options.knot_tolerance;
  }

  PatchFile read() {
    for (std::size_t k = 0; k < part_.size(); ++k) {
      mark_parts(k);
    }
    for (std::size_t k = 0; k < part_.size(); ++k) {
      if (!part_[k] && !(on_surface_[k] && records_.entities[k].dependent())) {
        show(k, {}, 0);
      }
    }
    if (file_.count == 0) {
      bad_input_at(records_.name, records_.directory_line,
                   "a directory with a surface to be shown (entity 128 or 114)", "none");
    }
    return std::move(file_);
  }

private:
  /// Marks what an entity shows, and what therefore is not shown by itself. Files do not always
  /// say so where it stands. The surface of a curve is a case of its own: nothing shows it.
  void mark_parts(std::size_t index) {
    switch (records_.entities[index].type) {
    case iges_trimmed_surface:
    case iges_bounded_surface:
    case iges_face:
      part_[read_iges_trimmed(records_, index).surface] = true;
      break;
    case iges_solid:
    case iges_shell:
      for (const SolidPart& part : solid_parts(index)) {
        part_[part.index] = true;
      }
      break;
    case iges_subfigure:
      for (const std::size_t member : members(index)) {
        mark_member(member);
      }
      break;
    case iges_curve_on_surface: {
      IgesParameters parameters(records_, index);
      parameters.skip(1, "how the curve was made");
      if (const auto surface = parameters.pointer("the number of a surface")) {
        on_surface_[*surface] = true;
      }
      break;
    }
    default:
      break;
    }
  }

  void mark_member(std::size_t member) {
    std::vector<std::size_t> marked = {member};
    while (!marked.empty()) {
      const std::size_t next = marked.back();
      marked.pop_back();
      if (!part_[next]) {
        part_[next] = true;
        if (records_.entities[next].type == iges_group) {
          const std::vector<std::size_t> more = members(next);
          marked.insert(marked.end(), more.begin(), more.end());
        }
      }
    }
  }

  /// Returns the members of a subfigure, which has a depth and a name first, or of a group.
  std::vector<std::size_t> members(std::size_t index) {
    const IgesEntity& entity = records_.entities[index];
    std::vector<std::size_t> found;
    const bool is_group = entity.type == iges_group;
    if (is_group && entity.form != 1 && entity.form != 7 && entity.form != 14 &&
        entity.form != 15) {
      return found; // another association
    }
    IgesParameters parameters(records_, index);
    parameters.skip(is_group ? 0 : 2, "the depth or the name of a subfigure");
    const std::size_t count = parameters.integer("the number of members", 0, kMostIndex);
    for (std::size_t k = 0; k < count; ++k) {
      if (const auto member = parameters.pointer("the number of a member")) {
        found.push_back(*member);
      }
    }
    return found;
  }

  /// A shell of a solid or a face of a shell.
  struct SolidPart {
    std::size_t index;
    bool turned; ///< its normals are to point to the other side
  };

  std::vector<SolidPart> solid_parts(std::size_t index) {
    const bool is_solid = records_.entities[index].type == iges_solid;
    const char* const what =
        is_solid ? "the number of a shell (entity 514)" : "the number of a face (entity 510)";
    IgesParameters parameters(records_, index);
    std::vector<SolidPart> found;
    const auto add = [&] {
      const auto part = parameters.pointer(what);
      if (!part || records_.entities[*part].type != (is_solid ? iges_shell : iges_face)) {
        parameters.fail(what);
      }
      found.push_back({*part, parameters.integer("a flag of the side, 0 or 1", 0, 1) == 0});
    };
    if (is_solid) {
      add();
    }
    const std::size_t count =
        parameters.integer(is_solid ? "the number of shells inside" : "the number of faces",
                           is_solid ? 0 : 1, kMostIndex);
    for (std::size_t k = 0; k < count; ++k) {
      add();
    }
    return found;
  }

  /// Shows an entity where the map puts it, turned around or not.
  void show(std::size_t index, const AffineMap& outer, std::size_t depth, bool turned = false) {
    const IgesEntity& entity = records_.entities[index];
    if (entity.blanked()) {
      return;
    }
    if (depth > kMostNested) {
      records_.fail(index, "subfigures in at most 64 others", "more");
    }
    switch (entity.type) {
    case iges_spline_surface:
    case iges_parametric_surface:
      return add(read_iges_surface(records_, index), index, outer, turned);
    case iges_trimmed_surface:
    case iges_bounded_surface:
    case iges_face:
      return add_trimmed(index, read_iges_trimmed(records_, index), outer, turned);
    case iges_solid:
    case iges_shell:
      for (const SolidPart& part : solid_parts(index)) {
        show(part.index, iges_map(records_, index) * outer, depth + 1, part.turned != turned);
      }
      return;
    case iges_instance:
      return show_instance(index, outer, depth);
    case iges_group:
      if (depth > 0) { // its members are shown anyway where it is not in a subfigure
        show_members(index, outer, depth);
      }
      return;
    default:
      break;
    }
    const bool without_end = entity.type == iges_plane && entity.form == 0;
    if (!without_end &&
        std::ranges::find(kIgesPassedOver, entity.type) == std::end(kIgesPassedOver)) {
      records_.fail(index, "surfaces of entities 128 and 114, untrimmed",
                    describe_iges_type(entity.type));
    }
  }

  void show_members(std::size_t index, const AffineMap& map, std::size_t depth) {
    for (const std::size_t member : members(index)) {
      show(member, map, depth + 1);
    }
  }

  /// An instance of a subfigure: x' = scale x + translation, then its own transformation.
  void show_instance(std::size_t index, const AffineMap& outer, std::size_t depth) {
    IgesParameters parameters(records_, index);
    const auto subfigure = parameters.pointer("the number of a subfigure (entity 308)");
    if (!subfigure || records_.entities[*subfigure].type != iges_subfigure) {
      parameters.fail("the number of a subfigure (entity 308)");
    }
    AffineMap::Vector translation = {};
    for (double& number : translation) {
      number = parameters.more() ? parameters.real("a translation") : 0;
    }
    double scale = parameters.more() ? parameters.real("a scale") : 0;
    scale = parameters.left_out() || scale == 0 ? 1 : scale;
    show_members(*subfigure,
                 AffineMap::scaling({scale, scale, scale}) * AffineMap::translation(translation) *
                     iges_map(records_, index) * outer,
                 depth);
  }

  void add_trimmed(std::size_t index, const IgesTrimmed& trimmed, const AffineMap& outer,
                   bool turned) {
    const std::uint32_t type = records_.entities[trimmed.surface].type;
    if (type != iges_spline_surface && type != iges_parametric_surface) {
      records_.fail(trimmed.surface, "surfaces of entities 128 and 114, untrimmed",
                    describe_iges_type(type));
    }
    IgesSurface surface = read_iges_surface(records_, trimmed.surface);
    if (!trimmed.known || !trimmed.curves.empty()) {
      for (SplineDirection* const direction : {&surface.spline.u, &surface.spline.v}) {
        direction->range = range_of(*direction);
      }
      const auto rectangle =
          trimmed.known ? iges_rectangle(records_, trimmed.curves) : std::nullopt;
      const bool is_part =
          rectangle && narrow(surface.spline.u.range, surface.spline.v.range, *rectangle);
      if (!is_part && !options_.ignore_trims) {
        records_.fail(index, "a surface without trimming curves (--ignore-trims reads all of it)",
                      describe_iges_type(records_.entities[index].type));
      }
      file_.ignored_trims += is_part ? 0 : 1;
    }
    add(std::move(surface), trimmed.surface, iges_map(records_, index) * outer, turned);
  }

  void add(IgesSurface surface, std::size_t index, const AffineMap& outer, bool turned) {
    move_surface(surface, iges_map(records_, index) * outer, turned, records_.name);
    file_.close_spline(surface.spline);
    file_.moved_error = std::max(file_.moved_error, surface.error);
  }

  const ReadOptions& options_;
  IgesRecords records_;
  PatchFile file_;
  std::vector<bool> part_;       // shown by another entity
  std::vector<bool> on_surface_; // named by a curve
};

} // namespace

PatchFile read_iges(TextInput& input, const ReadOptions& options) {
  return IgesReader(input, options).read();
}

} // namespace simdbezier::tools
