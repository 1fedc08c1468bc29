// See web_model.hpp.
#include "web/src/web_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <tools/commands/meshes/mesh_plan.hpp>
#include <tools/commands/meshes/welded_mesh.hpp>
#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/patches/patch_rounding.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::web {
namespace {

using tools::check;

std::optional<double> said(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

tools::Arguments arguments_of(const MeshWish& wish, tools::MeshFormat format) {
  tools::Arguments arguments;
  tools::MeshArguments& mesh = arguments.mesh;
  mesh.format = format;
  mesh.can_move = false;
  mesh.tolerance = said(wish.tolerance);
  mesh.relative = said(wish.relative);
  mesh.angle = said(wish.angle);
  mesh.crease = said(wish.crease);
  mesh.snap = said(wish.snap).value_or(0);
  mesh.normals = wish.normals != 0;
  mesh.parameters = wish.parameters != 0;
  mesh.orient = wish.orient != 0;
  mesh.flip = wish.flip != 0;
  mesh.thorough = wish.thorough != 0;
  mesh.storage = wish.bits == 8    ? tools::VertexStorage::quantised_8
                 : wish.bits == 16 ? tools::VertexStorage::quantised_16
                                   : tools::VertexStorage::full;
  if (!std::isnan(wish.nu)) {
    arguments.grid = {static_cast<std::size_t>(wish.nu), static_cast<std::size_t>(wish.nv)};
  }
  return arguments;
}

/// Memory that is filled by one call, and grows where a later one needs more.
template <typename V>
class Room {
public:
  V* for_values(std::size_t count) {
    if (count > capacity_ ||
        values_ == nullptr) { // a null pointer would be an output that is not wanted
      if (count > std::numeric_limits<std::size_t>::max() / sizeof(V)) {
        throw std::bad_alloc();
      }
      values_.reset(); // what was there is not needed
      capacity_ = 0;
      values_ = std::make_unique_for_overwrite<V[]>(count);
      capacity_ = count;
    }
    return values_.get();
  }

private:
  std::unique_ptr<V[]> values_;
  std::size_t capacity_ = 0;
};

std::size_t product(std::size_t a, std::size_t b) {
  const auto value = (tools::Count(a) * b).value();
  if (!value) {
    throw std::bad_alloc();
  }
  return *value;
}

double place_of(const void* memory) {
  return static_cast<double>(reinterpret_cast<std::uintptr_t>(memory));
}

template <typename T>
class TypedModel final : public Model {
public:
  explicit TypedModel(tools::PatchFile file);

  void tessellate(const MeshWish& wish) override;
  void grid(std::size_t nu, std::size_t nv, const SampleWish& wish) override;
  void samples(std::span<const std::uint32_t> patches, const void* u, const void* v,
               const SampleWish& wish) override;
  void write_file(tools::MeshFormat format, const MeshWish& wish) override;

private:
  [[nodiscard]] std::span<const ControlNets<T>> nets() const { return nets_.nets; }
  [[nodiscard]] tools::PlannedModel planned_model() const {
    return {file_.name, results_.diagonal, false, {}}; // nothing in the package moves it
  }
  void join(const tools::Arguments& arguments);
  void lay_out(const tools::Arguments& arguments);
  void evaluate_vertices(const tools::MeshArguments& mesh);
  void number_triangles();
  Outputs<T> outputs(std::size_t samples, const SampleWish& wish);

  tools::PatchFile file_;
  tools::MeshBox box_;
  tools::PatchNets<T> nets_;
  MeshPlan<T> plan_;
  TopologyOptions joined_; ///< how its topology was found
  std::vector<std::uint32_t> first_triangles_;
  Room<T> vertices_;
  Room<std::uint16_t> short_indices_;
  Room<std::uint32_t> indices_;
  Room<T> samples_;
  Room<SampleStatus> statuses_;
  std::vector<char> written_;
};

template <typename T>
TypedModel<T>::TypedModel(tools::PatchFile file)
    : file_(std::move(file)), box_(tools::box_of(file_)) {
  plan_.errors = tools::rounding_errors<T>(file_, 0, file_.count);
  nets_ = file_.template nets<T>();
  check(pack(nets(), plan_.set, PackOptions{}).status);
  results_.patches = static_cast<double>(file_.count);
  results_.diagonal = tools::diagonal_of(box_);
  std::ranges::copy(box_.low, results_.low);
  std::ranges::copy(box_.high, results_.high);
  results_.ignored_trims = static_cast<double>(file_.ignored_trims);
  join({});
}

/// Finds which edges patches share, unless that is known.
template <typename T>
void TypedModel<T>::join(const tools::Arguments& arguments) {
  const tools::MeshArguments& mesh = arguments.mesh;
  const TopologyOptions how{.orient = mesh.orient, .flip = mesh.flip, .snap = mesh.snap};
  if (plan_.topology.data() == nullptr || how.orient != joined_.orient ||
      how.flip != joined_.flip || how.snap != joined_.snap) {
    const Report report{find_topology(nets(), plan_.topology, how)};
    tools::check_plan(report, {}, arguments, planned_model(), 0);
    joined_ = how;
  }
  const TopologyCounts counts = plan_.topology.counts();
  results_.edges = static_cast<double>(counts.edges);
  results_.open_edges = static_cast<double>(counts.open_edges);
  results_.non_manifold_edges = static_cast<double>(counts.non_manifold_edges);
}

template <typename T>
void TypedModel<T>::lay_out(const tools::Arguments& arguments) {
  const tools::PlannedModel model = planned_model();
  static_cast<void>(plan_again(nets(), tools::mesh_options(arguments, model), plan_));
  tools::check_plan(plan_.report, plan_.fault, arguments, model, 0);
  first_triangles_.resize(file_.count + 1);
  for (std::size_t patch = 0; patch <= file_.count; ++patch) {
    first_triangles_[patch] = static_cast<std::uint32_t>(plan_.layout.first_triangle(patch));
  }
  // Nothing is claimed to be exact, even if no rounding can be found.
  results_.deviation = std::max(plan_.deviation, std::numeric_limits<double>::min());
  results_.vertices = static_cast<double>(plan_.layout.size().vertices);
  results_.triangles = static_cast<double>(plan_.layout.size().triangles);
  results_.deviation_data = place_of(plan_.deviations.data());
  results_.first_triangle_data = place_of(first_triangles_.data());
}

template <typename T>
void TypedModel<T>::evaluate_vertices(const tools::MeshArguments& mesh) {
  const std::size_t stride = 3 + (mesh.normals ? 3U : 0U) + (mesh.parameters ? 2U : 0U);
  const std::size_t vertices = plan_.layout.size().vertices;
  T* const values = vertices_.for_values(product(vertices, stride));
  const auto step = static_cast<std::ptrdiff_t>(stride);
  MeshOutputs<T> out;
  out.position = Vectors<T>::xyz(values, step);
  if (mesh.normals) {
    out.normal = Vectors<T>::xyz(values + 3, step);
  }
  if (mesh.parameters) {
    out.parameters = Vectors<T>::pairs(values + stride - 2, step);
  }
  if (vertices > 0) {
    check(evaluate_mesh(plan_.set, plan_.layout, out, Options{}));
  }
  results_.stride = static_cast<double>(stride);
  results_.vertex_data = place_of(values);
}

template <typename T>
void TypedModel<T>::number_triangles() {
  const std::size_t count = product(plan_.layout.size().triangles, 3);
  std::uint32_t* const corners = indices_.for_values(count);
  check(write_triangles<std::uint32_t>(plan_.layout, {corners, count}, {}));
  const bool few = plan_.layout.size().vertices <= std::numeric_limits<std::uint16_t>::max();
  results_.index_bytes = few ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
  results_.index_data = place_of(corners);
  if (few) { // the library's own writer of 16 bits would be more code
    std::uint16_t* const narrow = short_indices_.for_values(count);
    std::transform(corners, corners + count, narrow,
                   [](std::uint32_t corner) { return static_cast<std::uint16_t>(corner); });
    results_.index_data = place_of(narrow);
  }
}

template <typename T>
void TypedModel<T>::tessellate(const MeshWish& wish) {
  const tools::Arguments arguments = arguments_of(wish, tools::MeshFormat::ply);
  join(arguments);
  lay_out(arguments);
  evaluate_vertices(arguments.mesh);
  number_triangles();
}

/// Lays the vectors out one after the other, in the order of Output, or in records, and what has
/// one value a sample behind them.
template <typename T>
Outputs<T> TypedModel<T>::outputs(std::size_t samples, const SampleWish& wish) {
  std::vector<Output> vectors;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    if (wish.wants(static_cast<Output>(k))) {
      vectors.push_back(static_cast<Output>(k));
    }
  }
  const std::size_t each =
      3 * vectors.size() + (wish.wants(Output::curvature) ? kCurvatureKinds : 0);
  // One line lies between outputs, or lines of the same samples might all share one set of a cache.
  const std::size_t line = 64 / sizeof(T);
  const std::size_t step = 3 * samples + line;
  const std::size_t all = product(samples, each * sizeof(T)) / sizeof(T); // lines can be added
  T* const values = samples_.for_values(all + vectors.size() * line);
  Outputs<T> out;
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    T* const first = values + k * step;
    out[vectors[k]] =
        wish.layout == SampleWish::planes
            ? Vectors<T>::planes(first, first + samples, first + 2 * samples)
        : wish.layout == SampleWish::triples
            ? Vectors<T>::xyz(first)
            : Vectors<T>::xyz(values + 3 * k, static_cast<std::ptrdiff_t>(3 * vectors.size()));
  }
  for (std::size_t k = 0; wish.wants(Output::curvature) && k < kCurvatureKinds; ++k) {
    out.curvature[static_cast<Curvature>(k)] = values + vectors.size() * step + k * samples;
  }
  if (wish.wants(Output::status)) {
    out.status = statuses_.for_values(samples);
    results_.status_data = place_of(out.status.first);
  }
  results_.samples = static_cast<double>(samples);
  results_.sample_data = place_of(values);
  results_.sample_step = static_cast<double>(step);
  return out;
}

template <typename T>
void TypedModel<T>::grid(std::size_t nu, std::size_t nv, const SampleWish& wish) {
  const Outputs<T> out = outputs(product(product(file_.count, nu), nv), wish);
  check(evaluate(plan_.set, Grid<T>::uniform(nu, nv), out, {.watertight = wish.watertight != 0}));
}

template <typename T>
void TypedModel<T>::samples(std::span<const std::uint32_t> patches, const void* u, const void* v,
                            const SampleWish& wish) {
  const std::size_t count = patches.size();
  const Samples<T> where{
      patches, {static_cast<const T*>(u), count}, {static_cast<const T*>(v), count}};
  const Outputs<T> out = outputs(count, wish);
  check(evaluate(plan_.set, where, out, {.watertight = wish.watertight != 0}));
}

template <typename T>
void TypedModel<T>::write_file([[maybe_unused]] tools::MeshFormat format,
                               [[maybe_unused]] const MeshWish& wish) {
#if SIMDBEZIER_WEB_FILES
  tools::Arguments arguments = arguments_of(wish, format);
  arguments.out = "mesh." + tools::mesh_format_name(format);
  tools::MeshStats stats;
  tools::WeldedMesh<T> mesh(tools::whole_model(file_), arguments, stats);
  const tools::MeshContents contents =
      tools::stated_contents<T>(arguments.out, format, mesh.contents());
  tools::OutputInMemory memory(arguments.out);
  const auto writer = format == tools::MeshFormat::glb
                          ? tools::make_glb_writer<T>(arguments.out, contents)
                          : tools::make_ply_writer<T>(arguments.out, contents);
  tools::Progress progress("", "", 0, false);
  mesh.write(*writer, stats.seconds, progress);
  writer->finish();
  written_ = std::move(memory.bytes);
  results_.file_data = place_of(written_.data());
  results_.file_bytes = static_cast<double>(written_.size());
#else
  tools::bad_usage("expected no files, which the package has in its other modules, found file()");
#endif
}

} // namespace

std::unique_ptr<Model> make_model(tools::PatchFile file, bool doubles) {
  if (file.count == 0) {
    tools::bad_input(file.name + ": expected a patch at least, found none");
  }
  if (doubles) {
#if SIMDBEZIER_WEB_DOUBLES
    return std::make_unique<TypedModel<double>>(std::move(file));
#else
    tools::bad_usage("precision: expected f32, found f64, for which there is simdbezier/f64");
#endif
  }
  return std::make_unique<TypedModel<float>>(std::move(file));
}

} // namespace simdbezier::web
