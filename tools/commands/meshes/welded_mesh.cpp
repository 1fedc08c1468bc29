#include <tools/commands/meshes/welded_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tools/commands/meshes/mesh_links.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/patches/patch_rounding.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
std::span<const ControlNets<T>> views(const PatchNets<T>& nets) {
  return nets.nets;
}

} // namespace

template <typename T>
WeldedMesh<T>::WeldedMesh(ModelPart part, const Arguments& arguments, MeshStats& stats)
    : arguments_(arguments), stats_(stats), own_(part.own), name_(part.file.name), box_(part.box),
      numbers_(std::move(part.numbers)), numbered_(part.patches), faces_(arguments),
      places_(arguments.mesh) {
  plan(part);
  const Stopwatch watch(stats_.seconds.topology);
  find_links(part.lent);
  faces_.count(plan_.layout, own_);
  tell_stats();
}

template <typename T>
void WeldedMesh<T>::plan(ModelPart& part) {
  PatchNets<T> nets;
  std::vector<double> errors;
  {
    const Stopwatch watch(stats_.seconds.pack);
    expect_no_point<T>(box_, name_, arguments_.mesh.can_move);
    errors = point_errors<T>(part.file); // a patch that T cannot hold is named by its place
    nets = part.file.template nets<T>();
    if (!nets.in_file) {
      part.file = {};
    }
  }
  stats_.diagonal = diagonal_of(box_);
  const bool far = arguments_.mesh.can_move && is_far(box_);
  const PlannedModel model{name_, stats_.diagonal, far, numbers_};
  MeshOptions options = mesh_options(arguments_, model);
  options.rates.errors = errors;
  plan_ = plan_mesh<T>(views(nets), options);
  check_plan(plan_.report, plan_.fault, arguments_, model, 0);
  leave_room_for_storage(views(nets), options, model);
  part.file = {};
  if (!plan_.patches.empty()) { // of a whole model, whose patches are left out or cut
    own_ = {0, plan_.patches.size()};
    numbers_ = plan_.patches;
  }
  // Nothing is claimed to be exact, even if no rounding can be found.
  const auto own = std::span(plan_.deviations).subspan(own_.first, own_.count);
  deviation_ = std::max(std::ranges::max(own), std::numeric_limits<double>::min());
}

// The first plan leaves no room for what storing adds to distances, because it usually needs none.
template <typename T>
void WeldedMesh<T>::leave_room_for_storage(std::span<const ControlNets<T>> nets,
                                           MeshOptions options, const PlannedModel& model) {
  const double stored = storage_error<T>(arguments_.mesh.format, contents());
  if (!arguments_.mesh.adaptive() || stored == 0) {
    return;
  }
  const std::vector<double> room = tolerances_without(stored, nets, options);
  bool has_room = true;
  for (std::size_t k = 0; k < plan_.deviations.size(); ++k) {
    has_room &= plan_.deviations[k] <= room[plan_.patches.empty() ? k : plan_.patches[k]];
  }
  if (has_room) {
    return;
  }
  options.rates.tolerances = room;
  if (plan_.patches.empty()) {
    plan_again(nets, options, plan_);
  } else {
    plan_ = plan_mesh<T>(nets, options);
  }
  RateFault fault = plan_.fault;
  if (fault.limit != RateLimit::none) {
    fault.tolerance = tolerances_without(0, nets, options)[plan_.report.item];
  }
  check_plan(plan_.report, fault, arguments_, model, stored);
}

// Numbers of vertices that other parts share.
template <typename T>
void WeldedMesh<T>::find_links(const std::vector<ModelPart::Lent>& lent) {
  if (own_.first > 0 || own_.first + own_.count < plan_.set.size()) {
    MeshLinks found = find_mesh_links(plan_.layout, own_, numbers_, lent);
    links_ = std::move(found.links);
    faces_.name_before(std::move(found.before));
  }
}

template <typename T>
void WeldedMesh<T>::tell_stats() {
  stats_.seconds.pack += plan_.seconds.pack;
  stats_.seconds.topology += plan_.seconds.topology;
  stats_.seconds.rates += plan_.seconds.rates;
  stats_.patches = own_.count;
  stats_.joined = plan_.topology.counts(own_);
  if (arguments_.mesh.drop_repeated) {
    stats_.joined->repeated_patches += plan_.counts.repeated_patches;
  }
  if (arguments_.mesh.split_edges) {
    stats_.splits = plan_.splits;
  }
  stats_.open_edges = stats_.joined->open_edges;
  stats_.non_manifold_edges = stats_.joined->non_manifold_edges;
  const MeshContents mesh = contents();
  stats_.vertices = stats_.samples = mesh.vertices;
  stats_.triangles = 2 * mesh.faces - (mesh.corners == 3 ? mesh.faces : mesh.among_quads);
  stats_.deviation = stated_deviation<T>(arguments_.mesh.format, mesh);
}

template <typename T>
std::vector<T> WeldedMesh<T>::foreign_values() {
  const std::size_t stride = contents().stride();
  std::vector<T> values;
  StageSeconds ignored;
  if (own_.first > 0) {
    evaluate({0, own_.first}, stride, ignored);
  }
  const std::vector<std::uint32_t>& before = faces_.before();
  for (std::size_t vertex = 0; vertex < before.size(); ++vertex) {
    if (before[vertex] != kNoVertex) {
      const auto at = values_.begin() + static_cast<std::ptrdiff_t>(vertex * stride);
      values.insert(values.end(), at, at + static_cast<std::ptrdiff_t>(stride));
    }
  }
  return values;
}

template <typename T>
MeshContents WeldedMesh<T>::contents() const {
  const MeshArguments& mesh = arguments_.mesh;
  MeshContents contents;
  contents.vertices =
      plan_.layout.first_vertex(own_.first + own_.count) - plan_.layout.first_vertex(own_.first);
  contents.faces = faces_.count();
  contents.corners = mesh.quads ? 4 : 3;
  contents.among_quads = faces_.among_quads();
  contents.normals = mesh.normals;
  contents.uv = mesh.parameters;
  contents.storage = mesh.storage;
  contents.floats = mesh.floats;
  describe_vertices<T>(mesh, numbered_, contents);
  contents.origin = mesh.origin;
  contents.deviation = deviation_;
  contents.generator = program_version();
  // Positions may leave the control points' box by their errors, whose bounds may be far larger
  // than the model, or infinite, where weights differ much: what is computed stays close to the
  // box. What no longer fits a float is judged by the control points.
  const double largest = largest_coordinate(box_);
  const double most = std::max<double>(std::numeric_limits<float>::max(), largest);
  const auto own_errors = std::span(plan_.errors).subspan(own_.first, own_.count);
  const double margin = std::min(std::ranges::max(own_errors), largest);
  contents.box = box_;
  if (box_.low == box_.high) { // the box of a point stays one, whose size is not that of its errors
    contents.margin = margin;
    return contents;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    contents.box->low[c] = std::max(box_.low[c] - margin, -most);
    contents.box->high[c] = std::min(box_.high[c] + margin, most);
  }
  return contents;
}

// Returns a block of one patch at least, and of as many as have a moderate number of vertices and
// triangles.
template <typename T>
SetRange WeldedMesh<T>::block_from(std::size_t patch) const {
  const auto size = [&](std::size_t end) {
    return plan_.layout.first_vertex(end) - plan_.layout.first_vertex(patch) +
           (plan_.layout.first_triangle(end) - plan_.layout.first_triangle(patch)) / 2;
  };
  const std::size_t last = own_.first + own_.count;
  std::size_t end = std::min(patch + 1, last);
  while (end < last && end - patch < kBlockPatches && size(end + 1) <= kBlockSamples) {
    ++end;
  }
  return {patch, end - patch};
}

template <typename T>
void WeldedMesh<T>::write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) {
  const auto for_blocks = [&](auto&& visit) {
    for (SetRange block = block_from(own_.first); block.count > 0;
         block = block_from(block.first + block.count)) {
      visit(block);
    }
  };
  for_blocks([&](SetRange block) {
    write_vertices(block, writer, seconds);
    if (writer.takes_faces_early()) {
      write_faces(block, writer, seconds);
    }
    progress.advance(block.count);
  });
  if (!writer.takes_faces_early()) {
    for_blocks([&](SetRange block) { write_faces(block, writer, seconds); });
  }
}

template <typename T>
void WeldedMesh<T>::write_vertices(SetRange block, MeshWriter<T>& writer, StageSeconds& seconds) {
  const std::size_t stride = contents().stride();
  evaluate(block, stride, seconds);
  const Stopwatch watch(seconds.write);
  writer.vertices(places_.block(values_, stride));
}

template <typename T>
void WeldedMesh<T>::evaluate(SetRange block, std::size_t stride, StageSeconds& seconds) {
  const std::size_t vertices =
      plan_.layout.first_vertex(block.first + block.count) - plan_.layout.first_vertex(block.first);
  values_.resize(vertices * stride);
  MeshOutputs<T> out;
  places_.ask(vertices, out);
  if (vertices == 0) { // then there may be no memory that values could be in
    return;
  }
  out.position = Vectors<T>::xyz(values_.data(), static_cast<std::ptrdiff_t>(stride));
  if (arguments_.mesh.normals) {
    out.normal = Vectors<T>::xyz(values_.data() + 3, static_cast<std::ptrdiff_t>(stride));
  }
  const Options options{.threads = arguments_.threads};
  const Stopwatch watch(seconds.evaluate);
  check(evaluate_mesh(plan_.set, plan_.layout, out, options, block));
  places_.find_curvatures(plan_.set, plan_.topology, options);
  places_.find_in_file(plan_.pieces, numbers_);
}

template <typename T>
void WeldedMesh<T>::write_faces(SetRange block, MeshWriter<T>& writer, StageSeconds& seconds) {
  std::span<const std::uint32_t> corners;
  {
    const Stopwatch watch(seconds.topology);
    corners = faces_.corners(plan_.layout, block);
  }
  const Stopwatch watch(seconds.write);
  writer.faces(corners);
}

template class WeldedMesh<float>;
template class WeldedMesh<double>;

} // namespace simdbezier::tools
