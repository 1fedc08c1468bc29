// The stages of a mesh, one by one, and the sheet of patches that rows make meshes of.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/subjects/patches.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {

using simdbezier::Options;
using simdbezier::Status;

/// What the stages of a mesh produce, one after the other.
template <typename T>
struct MeshStages {
  BatchShape shape;
  std::vector<T> nets;
  simdbezier::PatchSet<T> set;
  simdbezier::Topology topology;
  std::vector<std::uint32_t> cells_u, cells_v, samples_u, samples_v;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviations;
  double tolerance = 0;
  simdbezier::MeshLayout layout;
  HugeMemory vertices; ///< positions, then normals from a line's start on
  HugeMemory triangles;
  std::size_t normals_at = 0;

  [[nodiscard]] simdbezier::ControlNets<T> views() const {
    return simdbezier::ControlNets<T>::packed(std::span<const T>(nets), shape.degree_u,
                                              shape.degree_v, 3, weights_of(shape));
  }
  [[nodiscard]] std::size_t patches() const { return cells_u.size(); }

  Status join(const Options& how) { return simdbezier::find_topology(views(), topology, {}, how); }
  Status choose(const Options& how) {
    simdbezier::RateOptions options;
    options.tolerance = tolerance;
    const simdbezier::CertifiedRates rates{cells_u, cells_v, diagonals, deviations};
    return simdbezier::choose_rates(views(), topology, options, rates, how).status;
  }
  Status lay_out(const Options& how) {
    return simdbezier::lay_out_mesh(topology, {cells_u, cells_v, diagonals}, layout, how);
  }
  /// Makes room for the samples of grids, and for the vertices and triangles of a mesh.
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
    return simdbezier::write_triangles(layout, std::span(to, 3 * layout.size().triangles), how);
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

inline constexpr std::size_t kColumns = 192;
inline constexpr std::size_t kRows = 128;

/// Tessellators that take their time get the first rows of the sheet only, so many.
inline constexpr std::size_t kPeerRows = 16;
inline constexpr std::size_t kPeerPatches = kPeerRows * kColumns;

/// A sheet whose waves grow from one side to the other. Patches of all shapes are as large.
template <typename T>
std::vector<T> sheet_nets(BatchShape shape) {
  const auto du = static_cast<std::size_t>(shape.degree_u);
  const auto dv = static_cast<std::size_t>(shape.degree_v);
  const std::size_t points = du * kColumns + 1; // of a row of the sheet
  const std::vector<double> noise = random_units(points * (dv * kRows + 1), 5);
  std::vector<T> nets;
  for (std::size_t patch = 0; patch < kColumns * kRows; ++patch) {
    for (std::size_t k = 0; k < (du + 1) * (dv + 1); ++k) {
      const std::size_t column = du * (patch % kColumns) + k % (du + 1);
      const std::size_t row = dv * (patch / kColumns) + k / (du + 1);
      const double at = noise[row * points + column];
      const double x = 3 * static_cast<double>(column) / shape.degree_u;
      nets.push_back(static_cast<T>(x + 0.3 * at));
      nets.push_back(static_cast<T>(3 * static_cast<double>(row) / shape.degree_v));
      nets.push_back(static_cast<T>(1.5 * x / kColumns * at));
      if (shape.rational) {
        nets.push_back(static_cast<T>(1 + 0.3 * at));
      }
    }
  }
  return nets;
}

/// Which mesh of a sheet.
struct MeshKind {
  bool adaptive;
  BatchShape shape = {};
};

/// Returns the stages of a mesh that is packed and laid out; null where something failed.
template <typename T>
std::shared_ptr<MeshStages<T>> make_stages(const MeshKind& kind) {
  auto stages = std::make_shared<MeshStages<T>>();
  MeshStages<T>& s = *stages;
  s.shape = kind.shape;
  s.nets = sheet_nets<T>(kind.shape);
  Options how;
  how.threads = 1;
  simdbezier::PackOptions near;
  near.local_origin = s.shape.rational; // the sheet is wide: far normals are looked at closely
  if (!simdbezier::pack(s.views(), s.set, near) || !s.join(how)) {
    return nullptr;
  }
  const std::size_t patches = s.set.size();
  s.cells_u.assign(patches, 15);
  s.cells_v.assign(patches, 15);
  s.diagonals.assign(patches, 0);
  s.deviations.assign(patches, 0);
  for (double low = 1e-4, high = 1; kind.adaptive && high / low > 1.01;) {
    s.tolerance = std::sqrt(low * high);
    if (!s.choose(how)) {
      return nullptr;
    }
    double cells = 0;
    for (std::size_t p = 0; p < patches; ++p) {
      cells += static_cast<double>(s.cells_u[p]) * s.cells_v[p] / static_cast<double>(patches);
    }
    (cells > 7 * 7 ? low : high) = s.tolerance;
  }
  if (!s.lay_out(how)) {
    return nullptr;
  }
  for (std::size_t p = 0; p < patches; ++p) {
    s.samples_u.push_back(s.cells_u[p] + 1);
    s.samples_v.push_back(s.cells_v[p] + 1);
  }
  return s.make_room() ? stages : nullptr;
}

/// Returns the stages of the kind that was asked for last: one at a time is kept, since they take
/// much memory.
template <typename T>
std::shared_ptr<MeshStages<T>> shared_stages(const MeshKind& kind) {
  static std::shared_ptr<MeshStages<T>> stages;
  static MeshKind kept{};
  const bool has_shape = kept.shape.degree_u == kind.shape.degree_u &&
                         kept.shape.degree_v == kind.shape.degree_v &&
                         kept.shape.rational == kind.shape.rational;
  if (stages == nullptr || kept.adaptive != kind.adaptive || !has_shape) {
    stages = nullptr; // before the next ones take memory
    stages = make_stages<T>(kind);
    kept = kind;
  }
  return stages;
}

} // namespace simdbezier_bench
