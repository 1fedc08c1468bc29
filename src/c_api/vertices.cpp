// Vertices of meshes of simdbezier.h.
#include <algorithm>

#include <simdbezier/evaluate_mesh.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"
#include "src/mesh/vertices/formatted_columns.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kSet{"set"};
constexpr Path kLayout{"layout"};
constexpr Path kOut{"out"};

constexpr VertexFormat kLastFormat = VertexFormat::octahedral8;
static_assert(SIMDBEZIER_FORMAT_OCTAHEDRAL8 == static_cast<int>(VertexFormat::octahedral8));
static_assert(SIMDBEZIER_FORMAT_OCTAHEDRAL8 == static_cast<int>(kLastFormat));

/// visit(member in C, member in C++, name, components) for every vector output of a vertex.
template <typename Out, typename Visit>
void for_outputs(simdbezier_mesh_outputs& known, Out& out, Visit visit) {
  visit(known.position, out.position, "position", 3);
  visit(known.normal, out.normal, "normal", 3);
  visit(known.parameters, out.parameters, "parameters", 2);
}

template <typename T>
MeshOutputs<T> outputs_of(const simdbezier_mesh_outputs* given) {
  auto known = read(given, kOut);
  MeshOutputs<T> out;
  for_outputs(known, out, [](const auto& from, auto& to, const char* name, int /*components*/) {
    to = output_of<T>(from, kOut / name);
  });
  if (known.patch != nullptr || known.patch_length != 0) {
    out.patch = SIMDBEZIER_SPAN(known, patch);
  }
  return out;
}

/// unequal_lengths is about the number of patches in the set, not about the range asked for.
Path blamed_in_mesh(Status status) {
  return blamed(status,
                {{{Status::unequal_lengths, Status::bad_components}, kSet},
                 {{Status::bad_patch_range}, {"first_patch or patch_count"}}},
                blamed_in_call(status, kLayout));
}

/// How many vertices a call for some patches writes.
std::size_t vertices_of(const MeshLayout& layout, std::size_t patches, SetRange range) {
  const std::size_t last =
      range.count > patches - range.first ? patches : range.first + range.count;
  return layout.first_vertex(last) - layout.first_vertex(range.first);
}

/// One of the outputs, where it alone is at fault.
template <typename T>
Path blamed_output(const MeshOutputs<T>& out, Status status, std::size_t vertices) {
  Path blamed;
  simdbezier_mesh_outputs unread{};
  for_outputs(unread, out, [&](const auto&, const auto& output, const char* name, int components) {
    if (blamed.member == nullptr && is_at_fault(output, status, vertices, components)) {
      blamed = blamed_plane(status, kOut / name);
    }
  });
  if (blamed.member == nullptr && is_at_fault(out.patch, status, vertices, 1)) {
    return kOut / "patch";
  }
  return blamed.member == nullptr ? blamed_in_mesh(status) : blamed;
}

/// What vertex_formats.h says of an output, and what C++ makes of it.
constexpr struct {
  simdbezier_formatted_output simdbezier_formatted_outputs::*given;
  FormattedOutput FormattedOutputs::*output;
  const char* name;
} kFormatted[] = {
    {&simdbezier_formatted_outputs::position, &FormattedOutputs::position, "position"},
    {&simdbezier_formatted_outputs::normal, &FormattedOutputs::normal, "normal"},
    {&simdbezier_formatted_outputs::parameters, &FormattedOutputs::parameters, "parameters"}};

template <typename T>
FormattedOutputs outputs_of(const simdbezier_formatted_outputs* given) {
  const auto known = read(given, kOut);
  FormattedOutputs out;
  for (const auto& [member, output, name] : kFormatted) {
    const simdbezier_formatted_output& one = known.*member;
    if (one.first == nullptr && one.capacity == 0) {
      continue;
    }
    require(one.first != nullptr, SIMDBEZIER_NULL_OUTPUT, kOut / name / "first");
    out.*output = {one.first, one.stride, choice(one.format, kLastFormat, kOut / name / "format"),
                   one.capacity};
  }
  std::copy_n(known.box.low, 3, out.box.low.begin());
  out.box.step = known.box.step;
  return out;
}

/// The first output that would be refused in the same way if it were the only one.
Path blamed_output(const FormattedOutputs& out, Status status, std::size_t vertices) {
  if (status == Status::bad_tolerance) {
    return kOut / "box";
  }
  for (const auto& [member, output, name] : kFormatted) {
    FormattedOutputs alone;
    alone.*output = out.*output;
    alone.box = out.box;
    if ((out.*output).first != nullptr &&
        detail::FormattedColumns(alone).check(alone, vertices) == status) {
      return blamed(status,
                    {{{Status::bad_components}, kOut / name / "format"},
                     {{Status::bad_stride}, kOut / name / "stride"}},
                    kOut / name);
    }
  }
  return blamed_in_mesh(status);
}

/// evaluate_mesh() into vectors or formats.
template <typename Out>
simdbezier_status evaluate_vertices(const char* function, const simdbezier_patch_set* set,
                                    const simdbezier_mesh_layout* layout, const Out* out,
                                    const simdbezier_options* options, std::size_t first_patch,
                                    std::size_t patch_count) noexcept {
  return answer(function, [&] {
    const MeshLayout& numbers = object_of(layout, kLayout);
    with_object(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const auto to = outputs_of<T>(out);
      const Options how = call_options_of(options);
      const SetRange range = range_of(first_patch, patch_count);
      require_ok(evaluate_mesh(patches, numbers, to, how, range), [&](Status status) {
        return blamed_output(to, status, vertices_of(numbers, patches.size(), range));
      });
    });
  });
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_evaluate_mesh(const simdbezier_patch_set* set,
                                           const simdbezier_mesh_layout* layout,
                                           const simdbezier_mesh_outputs* out,
                                           const simdbezier_options* options, size_t first_patch,
                                           size_t patch_count) {
  return evaluate_vertices(__func__, set, layout, out, options, first_patch, patch_count);
}

simdbezier_status simdbezier_evaluate_mesh_attributes(const simdbezier_patch_set* set,
                                                      const simdbezier_mesh_layout* layout,
                                                      const simdbezier_vectors* out,
                                                      int32_t first_component,
                                                      const simdbezier_options* options,
                                                      size_t first_patch, size_t patch_count) {
  return answer(__func__, [&] {
    const MeshLayout& numbers = object_of(layout, kLayout);
    require(out != nullptr, SIMDBEZIER_NULL_OUTPUT, kOut);
    with_object(set, kSet, [&]<typename T>(const PatchSet<T>& patches) {
      const Vectors<T> to = output_of<T>(*out, kOut);
      const Options how = call_options_of(options);
      require_ok(evaluate_mesh_attributes(patches, numbers, to, first_component, how,
                                          range_of(first_patch, patch_count)),
                 [](Status status) {
                   return status == Status::bad_components
                              ? Path{"first_component"}
                              : blamed_plane(status, blamed_in_mesh(status));
                 });
    });
  });
}

simdbezier_status simdbezier_split_creases(const simdbezier_patch_set* set,
                                           const simdbezier_mesh_layout* layout, double degrees,
                                           const simdbezier_options* options,
                                           simdbezier_mesh_layout** split) {
  return answer(__func__, [&] {
    require_place(split, {"split"});
    const MeshLayout& numbers = object_of(layout, kLayout);
    with_object(set, kSet, [&](const auto& patches) {
      const Options how = call_options_of(options);
      MeshLayout made;
      require_ok(split_creases(patches, numbers, degrees, made, how), [](Status status) {
        return status == Status::bad_tolerance ? Path{"degrees"} : blamed_in_mesh(status);
      });
      give(split, std::move(made));
    });
  });
}

simdbezier_status simdbezier_split_parameters(const simdbezier_mesh_layout* layout,
                                              simdbezier_mesh_layout** split) {
  return answer(__func__, [&] {
    require_place(split, {"split"});
    MeshLayout made;
    require_ok(split_parameters(object_of(layout, kLayout), made), blamed_in_mesh);
    give(split, std::move(made));
  });
}

size_t simdbezier_format_bytes(simdbezier_vertex_format format, size_t components) {
  return format < 0 || format > static_cast<int>(kLastFormat)
             ? 0
             : format_bytes(static_cast<VertexFormat>(format), components);
}

simdbezier_status simdbezier_find_quantisation_box(const simdbezier_nets* nets, size_t length,
                                                   simdbezier_vertex_format format,
                                                   simdbezier_quantisation_box* box) {
  return answer(__func__, [&] {
    require(box != nullptr, SIMDBEZIER_NULL_OUTPUT, {"box"});
    const auto as = choice(format, kLastFormat, {"format"});
    with_net_array(nets, length, [&](const auto& views) {
      QuantisationBox found;
      require_ok(quantisation_box(views, as, found), [&](Status status) -> Path {
        if (status == Status::bad_tolerance) {
          const bool has_box = as == VertexFormat::unorm16 || as == VertexFormat::snorm16;
          return {has_box ? "nets" : "format"};
        }
        return blamed_nets(status, {"nets"});
      });
      std::copy_n(found.low.begin(), 3, box->low);
      box->step = found.step;
    });
  });
}

simdbezier_status simdbezier_evaluate_formatted_mesh(const simdbezier_patch_set* set,
                                                     const simdbezier_mesh_layout* layout,
                                                     const simdbezier_formatted_outputs* out,
                                                     const simdbezier_options* options,
                                                     size_t first_patch, size_t patch_count) {
  return evaluate_vertices(__func__, set, layout, out, options, first_patch, patch_count);
}
