#include <tools/commands/meshes/bezier_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/patches/edge_counts.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

constexpr std::uint8_t kBezierQuadrilateral = 77;

// Calls visit(number of the point in the patch's rows) in the order in which VTK has the points of
// a cell: the corners around it, the inner points of its sides (v = 0, u = 1, v = 1, u = 0, each
// with u or v ascending), and the inner rows.
template <typename Visit>
void for_cell_points(int degree_u, int degree_v, Visit&& visit) {
  const auto n = static_cast<std::size_t>(degree_u);
  const auto m = static_cast<std::size_t>(degree_v);
  const auto at = [&](std::size_t i, std::size_t j) { visit(j * (n + 1) + i); };
  at(0, 0);
  at(n, 0);
  at(n, m);
  at(0, m);
  const auto row = [&](std::size_t j) {
    for (std::size_t i = 1; i < n; ++i) {
      at(i, j);
    }
  };
  const auto column = [&](std::size_t i) {
    for (std::size_t j = 1; j < m; ++j) {
      at(i, j);
    }
  };
  row(0);
  column(n);
  row(m);
  column(0);
  for (std::size_t j = 1; j < m; ++j) {
    row(j);
  }
}

double weight_of(const ControlNets<double>& nets, const double* point) {
  return nets.weights == Weights::none ? 1 : point[3];
}

// A coordinate without its weight, and 0 for -0.
double coordinate(const ControlNets<double>& nets, const double* point, std::size_t c) {
  return (nets.weights == Weights::homogeneous ? point[c] / point[3] : point[c]) + 0.0;
}

// How far the quotient x / w may be from q, to which it has been rounded; 0 where it is exact.
double quotient_error(double x, double w, double q) {
  constexpr double kLeast = 0x1p-960; // of products whose error a double can hold
  const bool exact = std::abs(x) > kLeast && std::fma(q, w, -x) == 0;
  return exact || x == 0 || w == 1 ? 0 : std::abs(q) * 0x1p-53 + 0x1p-1074;
}

} // namespace

template <typename Stored>
BezierCells<Stored>::BezierCells(const PatchFile& file, const Arguments& arguments,
                                 MeshStats& stats)
    : file_(file), path_(arguments.out) {
  const Stopwatch watch(stats.seconds.pack);
  MeshContents contents;
  double deviation = 0;
  for_patches([&](const Patch& patch) {
    contents.vertices += patch.points();
    rational_ = rational_ || patch.nets->weights != Weights::none;
    deviation = std::max(deviation, deviation_of(patch));
  });
  points_ = contents.vertices;
  contents.faces = file.count;
  contents.floats = std::is_same_v<Stored, float>;
  contents.origin = arguments.mesh.origin;
  contents.box = box_of(file);
  contents.generator = program_version();
  contents.deviation = deviation + file.moved_error;
  check_contents<double>(path_, arguments.mesh.format, contents);
  out_.emplace(path_, contents, file.count, sections());
  stats.patches = file.count;
  stats.vertices = points_;
  stats.deviation = *contents.deviation;
  stats.diagonal = diagonal_of(*contents.box);
  if (arguments.mesh.stats != StatsForm::none) {
    stats.open_edges = kPatchEdges * file.count - joined_counts(file).collapsed_sides;
  }
}

template <typename Stored>
template <typename Visit>
void BezierCells<Stored>::for_patches(Visit&& visit) const {
  for (std::size_t first = 0; first < file_.count; first += kBlockPatches) {
    const PatchNets<double> block = file_.nets<double>(first, kBlockPatches);
    for (const ControlNets<double>& nets : block.nets) {
      for (std::size_t k = 0; k < nets.count; ++k) {
        visit(Patch{&nets, nets.points + static_cast<std::ptrdiff_t>(k) * nets.patch_stride});
      }
    }
  }
}

// Where weights change by at most a share r of each, S = sum w_i P_i B_i / sum w_i B_i moves by
//     sum (w'_i - w_i) B_i (P_i - S) / sum w'_i B_i,
// at most r / (1 - r) times the distance of S from a control point, since sum w_i B_i (P_i - S) is
// 0. Points that move then move S no farther than themselves.
template <typename Stored>
double BezierCells<Stored>::deviation_of(const Patch& patch) const {
  double moved = 0;
  double share = 0;
  MeshBox box;
  box.low.fill(HUGE_VAL);
  box.high.fill(-HUGE_VAL);
  for (std::size_t k = 0; k < patch.points(); ++k) {
    const double* const point = patch.point(k);
    const double w = weight_of(*patch.nets, point);
    const auto stored_w = static_cast<double>(static_cast<Stored>(w));
    if (!(stored_w >= std::numeric_limits<Stored>::min() && std::isfinite(stored_w))) {
      bad_input(path_ + ": expected weights that " +
                (std::is_same_v<Stored, float> ? "a float" : "a double") +
                " can hold with all digits, found " + shortest(w));
    }
    share = std::max(share, std::abs(stored_w - w) / w);
    double error = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double q = coordinate(*patch.nets, point, c);
      const double divided =
          patch.nets->weights == Weights::homogeneous ? quotient_error(point[c], w, q) : 0;
      const double rounded = std::abs(static_cast<double>(static_cast<Stored>(q)) - q);
      error += (divided + rounded) * (divided + rounded);
      box.low[c] = std::min(box.low[c], q);
      box.high[c] = std::max(box.high[c], q);
    }
    moved = std::max(moved, std::sqrt(error));
  }
  constexpr double kRounding = 1 + 0x1p-40; // of this computation
  return (moved + share / (1 - share) * diagonal_of(box)) * kRounding;
}

template <typename Stored>
std::vector<VtuSection> BezierCells<Stored>::sections() const {
  const NumberType real = number_type<Stored>();
  const NumberType index = number_type<std::int64_t>();
  VtuSection weights{"PointData", "", {}};
  if (rational_) { // VTK goes by the attribute, not by the name
    weights.attributes = R"( RationalWeights="RationalWeights")";
    weights.arrays = {{"RationalWeights", real, 1, points_}};
  }
  return {{"Points", "", {{"Points", real, 3, points_}}},
          weights,
          {"Cells",
           "",
           {{"connectivity", index, 1, points_},
            {"offsets", index, 1, file_.count},
            {"types", number_type<std::uint8_t>(), 1, file_.count}}},
          {"CellData",
           R"( HigherOrderDegrees="HigherOrderDegrees")",
           {{"HigherOrderDegrees", number_type<std::int32_t>(), 3, file_.count}}}};
}

template <typename Stored>
void BezierCells<Stored>::write(Progress& progress) {
  out_->begin_array();
  write_points(progress);
  if (rational_) {
    out_->begin_array();
    write_weights();
  }
  out_->begin_array();
  for (std::uint64_t k = 0; k < points_; ++k) {
    out_->number(static_cast<std::int64_t>(k));
  }
  out_->begin_array();
  std::int64_t end = 0;
  for_patches(
      [&](const Patch& patch) { out_->number(end += static_cast<std::int64_t>(patch.points())); });
  out_->begin_array();
  for (std::size_t k = 0; k < file_.count; ++k) {
    out_->number(kBezierQuadrilateral);
  }
  out_->begin_array();
  for_patches([&](const Patch& patch) {
    for (const int degree : {patch.nets->degree_u, patch.nets->degree_v, 0}) {
      out_->number(static_cast<std::int32_t>(degree));
    }
  });
}

template <typename Stored>
void BezierCells<Stored>::write_points(Progress& progress) {
  for_patches([&](const Patch& patch) {
    for_cell_points(patch.nets->degree_u, patch.nets->degree_v, [&](std::size_t k) {
      for (std::size_t c = 0; c < 3; ++c) {
        out_->number(static_cast<Stored>(coordinate(*patch.nets, patch.point(k), c)));
      }
    });
    progress.advance(1);
  });
}

template <typename Stored>
void BezierCells<Stored>::write_weights() {
  for_patches([&](const Patch& patch) {
    for_cell_points(patch.nets->degree_u, patch.nets->degree_v, [&](std::size_t k) {
      out_->number(static_cast<Stored>(weight_of(*patch.nets, patch.point(k))));
    });
  });
}

template class BezierCells<float>;
template class BezierCells<double>;

} // namespace simdbezier::tools
