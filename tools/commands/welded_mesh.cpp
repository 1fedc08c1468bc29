#include <tools/commands/welded_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <tools/commands/mesh_links.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/patches/patch_rounding.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
std::span<const ControlNets<T>> views(const PatchNets<T>& nets) {
  return nets.nets;
}

// Frees the object's memory, which assigning an empty one might keep.
template <typename T>
void set_free(T& object) {
  const T freed = std::exchange(object, T());
}

} // namespace

template <typename T>
WeldedMesh<T>::WeldedMesh(ModelPart part, const Arguments& arguments, MeshStats& stats)
    : arguments_(arguments), stats_(stats), patches_(part.file.count), own_(part.own),
      name_(part.file.name), box_(part.box), numbers_(std::move(part.numbers)),
      numbered_(part.patches), faces_(arguments), places_(arguments.mesh) {
  stats_.patches = own_.count;
  {
    const Stopwatch watch(stats_.seconds.pack);
    take_points(std::move(part.file));
  }
  {
    const Stopwatch watch(stats_.seconds.topology);
    join();
  }
  {
    const Stopwatch watch(stats_.seconds.rates);
    choose_cells();
  }
  {
    const Stopwatch watch(stats_.seconds.topology);
    lay_out();
  }
  {
    const Stopwatch watch(stats_.seconds.pack);
    pack_all();
  }
  const Stopwatch watch(stats_.seconds.topology);
  if (arguments_.mesh.crease) {
    check(split_creases(set_, layout_, *arguments_.mesh.crease, layout_,
                        {.threads = arguments_.threads}));
  }
  if (arguments_.mesh.parameters) {
    check(split_parameters(layout_, layout_));
  }
  const std::size_t end = own_.first + own_.count;
  if (own_.first > 0 || end < patches_) {
    MeshLinks found = find_mesh_links(layout_, own_, numbers_, part.lent);
    links_ = std::move(found.links);
    faces_.name_before(std::move(found.before));
  }
  faces_.count(layout_, own_);
  const MeshContents mesh = contents();
  stats_.vertices = stats_.samples = mesh.vertices;
  stats_.triangles = 2 * mesh.faces - (mesh.corners == 3 ? mesh.faces : mesh.among_quads);
  stats_.deviation = stated_deviation<T>(arguments_.mesh.format, mesh);
}

// A patch that T cannot hold is found here, where its place in the file is still known; what
// rounding does to every patch is found as well.
template <typename T>
void WeldedMesh<T>::take_points(PatchFile file) {
  stats_.diagonal = diagonal_of(box_);
  expect_no_point<T>(box_, name_);
  errors_.resize(patches_);
  for (std::size_t first = 0; first < patches_; first += kBlockPatches) {
    const std::size_t count = std::min(kBlockPatches, patches_ - first);
    std::ranges::copy(rounding_errors<T>(file, first, count),
                      errors_.begin() + static_cast<std::ptrdiff_t>(first));
  }
  file_ = std::make_unique<PatchFile>(std::move(file));
  nets_ = file_->template nets<T>();
  if (!nets_.in_file) {
    file_.reset();
  }
}

template <typename T>
void WeldedMesh<T>::join() {
  const MeshArguments& mesh = arguments_.mesh;
  std::size_t repeated = 0;
  if (mesh.drop_repeated) {
    find_edges(false);
    repeated = topology_.counts().repeated_patches;
  }
  if (repeated > 0) {
    leave_out_repeated();
  }
  if (mesh.split_edges) {
    split();
  }
  if (!mesh.drop_repeated || repeated > 0 || mesh.orient || mesh.split_edges) {
    find_edges(mesh.orient);
  }
  stats_.joined = topology_.counts(own_);
  stats_.joined->repeated_patches += repeated;
  stats_.open_edges = stats_.joined->open_edges;
  stats_.non_manifold_edges = stats_.joined->non_manifold_edges;
}

template <typename T>
void WeldedMesh<T>::split() {
  SplitOptions how;
  how.snap = arguments_.mesh.snap;
  check(split_edges(views(nets_), pieces_, how, {.threads = arguments_.threads}));
  nets_.nets = pieces_.nets;
  patches_ = own_.count = pieces_.pieces.size(); // of a whole model
  stats_.splits = pieces_.counts;
  std::vector<double> errors;
  std::vector<std::uint32_t> numbers;
  for (const PatchPiece& piece : pieces_.pieces) {
    errors.push_back(errors_[piece.patch] + piece.error);
    numbers.push_back(numbers_.empty() ? piece.patch : numbers_[piece.patch]);
  }
  errors_ = std::move(errors);
  numbers_ = std::move(numbers);
}

template <typename T>
void WeldedMesh<T>::leave_out_repeated() {
  DistinctNets<T> distinct;
  check(find_distinct_nets(views(nets_), topology_, distinct));
  nets_.nets = std::move(distinct.nets);
  numbers_ = std::move(distinct.patches);
  patches_ = own_.count = stats_.patches = numbers_.size(); // of a whole model
  std::ranges::transform(numbers_, errors_.begin(), [&](std::uint32_t n) { return errors_[n]; });
  errors_.resize(patches_);
}

template <typename T>
void WeldedMesh<T>::find_edges(bool orient) {
  TopologyOptions how;
  how.orient = orient;
  how.flip = arguments_.mesh.flip;
  how.snap = std::max(arguments_.mesh.snap, pieces_.snap);
  how.point_size = arguments_.mesh.point_size;
  const Status status =
      find_topology(views(nets_), topology_, how, {.threads = arguments_.threads});
  if (status == Status::not_orientable) {
    bad_input("--orient: expected patches that can be turned to agree with their neighbours, found "
              "a surface of one side in " +
              name_);
  }
  check(status);
}

template <typename T>
void WeldedMesh<T>::choose_cells() {
  rates_ = choose_mesh_rates<T>({views(nets_), topology_, errors_, own_, stats_.diagonal,
                                 storage_error<T>(arguments_.mesh.format, contents()), is_far(box_),
                                 name_, numbers_},
                                arguments_);
}

template <typename T>
void WeldedMesh<T>::lay_out() {
  const Status status = lay_out_mesh(topology_, {rates_.cells_u, rates_.cells_v, rates_.diagonals},
                                     layout_, {.threads = arguments_.threads});
  if (status == Status::size_overflow) {
    bad_input(resolution_options(arguments_.mesh) + ": expected at most " +
              std::to_string(kMostMeshVertices) + " vertices, found more");
  }
  check(status);
  deviation_ = rates_.deviation;
  set_free(rates_); // the layout has its own
}

template <typename T>
void WeldedMesh<T>::pack_all() {
  check(pack(views(nets_), set_, {.threads = arguments_.threads}).status);
  set_free(nets_);
  pieces_.nets.clear();
  set_free(pieces_.memory);
  file_.reset();
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
      layout_.first_vertex(own_.first + own_.count) - layout_.first_vertex(own_.first);
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
  const auto own_errors = std::span(errors_).subspan(own_.first, own_.count);
  const double margin = std::min(std::ranges::max(own_errors), largest);
  contents.box = box_;
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
    return layout_.first_vertex(end) - layout_.first_vertex(patch) +
           (layout_.first_triangle(end) - layout_.first_triangle(patch)) / 2;
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
      layout_.first_vertex(block.first + block.count) - layout_.first_vertex(block.first);
  values_.resize(vertices * stride);
  MeshOutputs<T> out;
  out.position = Vectors<T>::xyz(values_.data(), static_cast<std::ptrdiff_t>(stride));
  if (arguments_.mesh.normals) {
    out.normal = Vectors<T>::xyz(values_.data() + 3, static_cast<std::ptrdiff_t>(stride));
  }
  places_.ask(vertices, out);
  const Options options{.threads = arguments_.threads};
  if (vertices > 0) {
    const Stopwatch watch(seconds.evaluate);
    check(evaluate_mesh(set_, layout_, out, options, block));
    places_.find_curvatures(set_, topology_, options);
    places_.find_in_file(pieces_.pieces, numbers_);
  }
}

template <typename T>
void WeldedMesh<T>::write_faces(SetRange block, MeshWriter<T>& writer, StageSeconds& seconds) {
  std::span<const std::uint32_t> corners;
  {
    const Stopwatch watch(seconds.topology);
    corners = faces_.corners(layout_, block);
  }
  const Stopwatch watch(seconds.write);
  writer.faces(corners);
}

template class WeldedMesh<float>;
template class WeldedMesh<double>;

} // namespace simdbezier::tools
