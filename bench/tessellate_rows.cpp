// tessellate/position_normal/<type>/<isa>/<nu>x<nv>/memory/threads:<t>/part:<part>: meshes of a
// sheet of patches that share edges, with merged normals and 32-bit triangles.
//
//   16x16          uniform: every patch has 15 x 15 cells. mesh: vertices and triangles.
//   8x8            adaptive, 7 x 7 cells in the mean. mesh: rates, layout, vertices, triangles;
//   all:
//                  edges that are one, too; grids: evaluate() on the grids of the same rates.
//
// Items are samples: vertices of meshes, samples of grids, patches of rates, topology and layout.
// Bytes are those of the output.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/library_call.hpp"
#include "bench/rows.hpp"
#include "bench/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using simdbezier::Options;
using simdbezier::Status;

/// Whatever stages of a mesh produce, one after the other.
template <typename T>
struct MeshStages {
  std::vector<T> nets;
  simdbezier::PatchSet<T> set;
  simdbezier::Topology topology;
  std::vector<std::uint32_t> nu, nv, samples_u, samples_v;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviations;
  double tolerance = 0;
  simdbezier::MeshLayout layout;
  HugeMemory vertices; ///< positions, then normals from a line's start on
  HugeMemory triangles;
  std::size_t normals_at = 0;

  [[nodiscard]] simdbezier::ControlNets<T> views() const {
    return simdbezier::ControlNets<T>::packed(std::span<const T>(nets));
  }
  [[nodiscard]] std::size_t patches() const { return nu.size(); }

  Status join(const Options& how) {
    simdbezier::TopologyOptions options;
    options.threads = how.threads;
    return simdbezier::find_topology(views(), topology, options);
  }
  Status choose(const Options& how) {
    simdbezier::RateOptions options;
    options.tolerance = tolerance;
    options.threads = how.threads;
    const auto nets_of = views();
    return simdbezier::choose_rates(std::span<const simdbezier::ControlNets<T>>(&nets_of, 1),
                                    topology, options, {nu, nv, diagonals, deviations})
        .status;
  }
  Status lay_out(const Options& /*how*/) {
    return simdbezier::lay_out_mesh(topology, {nu, nv, diagonals}, layout);
  }
  /// Room for the samples of grids, and for the vertices and triangles of a mesh.
  bool make_room() {
    constexpr std::size_t kLine = kLineBytes / sizeof(T);
    normals_at = (3 * static_cast<std::size_t>(grid_samples()) + kLine - 1) / kLine * kLine;
    vertices = HugeMemory(2 * normals_at * sizeof(T));
    triangles = HugeMemory(3 * layout.size().triangles * sizeof(std::uint32_t));
    return vertices.get() != nullptr && triangles.get() != nullptr;
  }
  [[nodiscard]] simdbezier::Vectors<T> triples(std::size_t at, std::size_t count) const {
    return simdbezier::Vectors<T>::xyz(
        std::span(reinterpret_cast<T*>(vertices.get()) + at, 3 * count));
  }
  Status evaluate_vertices(const Options& how) {
    simdbezier::MeshOutputs<T> out;
    out.position = triples(0, layout.size().vertices);
    out.normal = triples(normals_at, layout.size().vertices);
    return simdbezier::evaluate_mesh(set, layout, out, how);
  }
  Status write(const Options& how) {
    auto* const to = reinterpret_cast<std::uint32_t*>(triangles.get());
    return simdbezier::write_triangles(layout, std::span(to, 3 * layout.size().triangles),
                                       how.threads, {}, how.destination);
  }
  Status evaluate_grids(const Options& how) {
    simdbezier::Outputs<T> out;
    const auto samples = static_cast<std::size_t>(grid_samples());
    out.position = triples(0, samples);
    out.normal = triples(normals_at, samples);
    return simdbezier::evaluate(set, simdbezier::PatchGrids{samples_u, samples_v}, out, how);
  }
  [[nodiscard]] double grid_samples() const {
    double sum = 0;
    for (std::size_t p = 0; p < patches(); ++p) {
      sum += static_cast<double>(samples_u[p]) * samples_v[p];
    }
    return sum;
  }
};

constexpr std::size_t kColumns = 192;
constexpr std::size_t kRows = 128;

/// A sheet whose waves grow from one side to the other.
template <typename T>
std::vector<T> sheet_nets() {
  const std::vector<double> noise = random_units((3 * kColumns + 1) * (3 * kRows + 1), 5);
  std::vector<T> nets;
  for (std::size_t patch = 0; patch < kColumns * kRows; ++patch) {
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t column = 3 * (patch % kColumns) + k % 4;
      const std::size_t row = 3 * (patch / kColumns) + k / 4;
      const double height = 1.5 * static_cast<double>(column) / kColumns;
      const double at = noise[row * (3 * kColumns + 1) + column];
      nets.push_back(static_cast<T>(static_cast<double>(column) + 0.3 * at));
      nets.push_back(static_cast<T>(row));
      nets.push_back(static_cast<T>(height * at));
    }
  }
  return nets;
}

/// Packed and laid out; null where something failed.
template <typename T>
std::shared_ptr<MeshStages<T>> make_stages(bool adaptive) {
  auto stages = std::make_shared<MeshStages<T>>();
  MeshStages<T>& s = *stages;
  s.nets = sheet_nets<T>();
  Options how;
  how.threads = 1;
  if (!simdbezier::pack(s.views(), s.set) || !s.join(how)) {
    return nullptr;
  }
  const std::size_t patches = s.set.size();
  s.nu.assign(patches, 15);
  s.nv.assign(patches, 15);
  s.diagonals.assign(patches, 0);
  s.deviations.assign(patches, 0);
  for (double low = 1e-4, high = 1; adaptive && high / low > 1.01;) {
    s.tolerance = std::sqrt(low * high);
    if (!s.choose(how)) {
      return nullptr;
    }
    double cells = 0;
    for (std::size_t p = 0; p < patches; ++p) {
      cells += static_cast<double>(s.nu[p]) * s.nv[p] / static_cast<double>(patches);
    }
    (cells > 7 * 7 ? low : high) = s.tolerance;
  }
  if (!s.lay_out(how)) {
    return nullptr;
  }
  for (std::size_t p = 0; p < patches; ++p) {
    s.samples_u.push_back(s.nu[p] + 1);
    s.samples_v.push_back(s.nv[p] + 1);
  }
  return s.make_room() ? stages : nullptr;
}

template <typename T>
const std::shared_ptr<MeshStages<T>>& shared_stages(bool adaptive) {
  static std::shared_ptr<MeshStages<T>> stages[2];
  auto& wanted = stages[adaptive ? 1 : 0];
  if (wanted == nullptr) {
    stages[adaptive ? 0 : 1] = nullptr; // one at a time: they take much memory
    wanted = make_stages<T>(adaptive);
  }
  return wanted;
}

/// One part of the work: which stages run, in their order.
template <typename T>
struct Part {
  const char* name;
  std::vector<Status (MeshStages<T>::*)(const Options&)> stages;
  enum Items { vertices, triangles, patches, samples } items;
  bool has_isa; ///< whether the last stage says which instruction set ran
};

template <typename T>
class MeshRow {
public:
  MeshRow(const Part<T>& part, bool adaptive, Isa isa, int threads)
      : part_(part), stages_(shared_stages<T>(adaptive)) {
    options_.isa = isa;
    options_.destination = simdbezier::Destination::memory;
    options_.threads = threads;
  }
  void operator()() { (void)run(options_); }
  std::string check() {
    if (stages_ == nullptr) {
      return "the sheet could not be laid out";
    }
    if (const Status status = run(options_); !part_.has_isa) {
      return status ? std::string() : std::string(simdbezier::to_string(status));
    }
    return run_verified(options_, [&](const Options& how) { return run(how); });
  }
  [[nodiscard]] double items() const {
    const simdbezier::MeshSize size = stages_->layout.size();
    switch (part_.items) {
    case Part<T>::vertices:
      return static_cast<double>(size.vertices);
    case Part<T>::triangles:
      return static_cast<double>(size.triangles);
    case Part<T>::samples:
      return stages_->grid_samples();
    default:
      return static_cast<double>(stages_->patches());
    }
  }
  [[nodiscard]] double bytes() const {
    const simdbezier::MeshSize size = stages_->layout.size();
    const auto has = [&](auto stage) { return std::ranges::count(part_.stages, stage) > 0; };
    double bytes = 0;
    if (has(&MeshStages<T>::evaluate_vertices)) {
      bytes += 6.0 * sizeof(T) * static_cast<double>(size.vertices);
    }
    if (has(&MeshStages<T>::write)) {
      bytes += 12.0 * static_cast<double>(size.triangles);
    }
    if (has(&MeshStages<T>::evaluate_grids)) {
      bytes += 6.0 * sizeof(T) * stages_->grid_samples();
    }
    return bytes;
  }

private:
  Status run(const Options& how) {
    for (const auto stage : part_.stages) {
      if (const Status status = (*stages_.*stage)(how); !status) {
        return status;
      }
    }
    return Status::ok;
  }

  Part<T> part_;
  std::shared_ptr<MeshStages<T>> stages_;
  Options options_;
};

template <typename T>
std::vector<Part<T>> parts_of(bool adaptive) {
  using S = MeshStages<T>;
  using P = Part<T>;
  std::vector<P> parts = {{"vertices", {&S::evaluate_vertices}, P::vertices, true},
                          {"triangles", {&S::write}, P::triangles, false},
                          {"grids", {&S::evaluate_grids}, P::samples, true}};
  if (adaptive) {
    parts.push_back({"topology", {&S::join}, P::patches, false});
    parts.push_back({"rates", {&S::choose}, P::patches, false});
    parts.push_back({"layout", {&S::lay_out}, P::patches, false});
    parts.push_back(
        {"mesh", {&S::choose, &S::lay_out, &S::write, &S::evaluate_vertices}, P::vertices, true});
    parts.push_back(parts.back());
    parts.back().name = "all";
    parts.back().stages.insert(parts.back().stages.begin(), &S::join);
  } else {
    parts.push_back({"mesh", {&S::write, &S::evaluate_vertices}, P::vertices, true});
  }
  return parts;
}

template <typename T>
void add_meshes(Isa isa) {
  for (const bool adaptive : {false, true}) {
    for (const Part<T>& part : parts_of<T>(adaptive)) {
      for (int threads = 1; threads <= max_threads(); ++threads) {
        const std::size_t n = adaptive ? 8 : 16;
        RowName name{"tessellate",
                     OutputGroups::position_normal,
                     sizeof(T) == 4,
                     std::string(simdbezier::to_string(isa)),
                     n,
                     n,
                     Place::memory,
                     threads};
        register_row(name.text() + "/part:" + part.name, benchmark::kMillisecond, threads,
                     [=] { return MeshRow<T>(part, adaptive, isa, threads); });
      }
    }
  }
}

} // namespace

void register_tessellate_rows() {
  for (const Isa isa : simdbezier::available_isas()) {
    add_meshes<float>(isa);
    add_meshes<double>(isa);
  }
}

} // namespace simdbezier_bench
