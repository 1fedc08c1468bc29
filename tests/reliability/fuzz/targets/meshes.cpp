// Meshes of patches, some of which lie along halves of others: the same for any threads, sound
// triangles, pieces that make up their patches.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/made_nets.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class MeshCase {
public:
  explicit MeshCase(ByteSource& bytes) : nets_(any_nets<T>(bytes, 2, 3)) {
    const std::uint8_t choice = bytes.byte();
    options_.split_edges = (choice & 1) != 0;
    options_.parameters = (choice & 2) != 0;
    options_.drop_repeated = (choice & 4) != 0;
    options_.topology.flip = (choice & 8) != 0;
    options_.topology.orient = (choice & 48) == 48;
    options_.local_origin = (choice & 64) != 0;
    options_.normals = (choice & 128) != 0; // exact ones of degenerate nets take long
    const std::uint8_t more = bytes.byte();
    options_.topology.snap = (more & 3) == 3 ? static_cast<double>(bytes.raw<float>()) : 0;
    options_.topology.point_size = (more & 12) == 12 ? std::ldexp(1.0, bytes.between(-30, 3)) : 0;
    options_.crease_degrees = (more & 48) == 48 ? 60 * bytes.between(0, 3) : kUnlimited;
    options_.short_indices = (more & 64) != 0;
    // Weights that are far apart would ask for many cells.
    if ((more & 128) != 0 && nets_.moderate && !nets_.rational()) {
      options_.relative_tolerance = 0.05;
    } else {
      options_.nu = static_cast<std::uint32_t>(2 + bytes.below(3));
      options_.nv = static_cast<std::uint32_t>(2 + bytes.below(3));
    }
    views_.push_back(nets_.view());
    for (std::size_t k = bytes.below(3); k > 0; --k) {
      add_neighbour(bytes);
    }
  }

  void run() {
    const std::span<const ControlNets<T>> views(views_);
    options_.threads = 1;
    const MeshPlan<T> plan = plan_mesh<T, T>(views, options_);
    const Mesh<T> mesh = tessellate<T, T>(views, options_);
    options_.threads = 2;
    const Mesh<T> same = tessellate<T, T>(views, options_);
    require_status(mesh.report.status,
                   {Status::ok, Status::bad_weight, Status::non_finite_input,
                    Status::coefficient_overflow, Status::bad_tolerance, Status::snap_too_large,
                    Status::not_orientable},
                   "tessellate");
    require(plan.report.status == mesh.report.status && same.report.status == mesh.report.status,
            "statuses differ");
    require(mesh.report.status == Status::ok || mesh.report.status == Status::not_orientable ||
                options_.topology.snap != 0 || options_.topology.point_size != 0 || !nets_.moderate,
            "tessellate refuses moderate nets");
    if (mesh.report.status != Status::ok) {
      return;
    }
    require_equal(flat(mesh.positions), flat(same.positions), "positions");
    require_equal(flat(mesh.normals), flat(same.normals), "normals");
    require_equal(flat(mesh.triangles), flat(same.triangles), "triangles");
    require_equal(mesh.deviations, same.deviations, "deviations");
    require(mesh.splits.splits == same.splits.splits &&
                mesh.splits.unjoined == same.splits.unjoined &&
                same_bits(mesh.splits.largest_gap, same.splits.largest_gap),
            "splits depend on threads");
    judge(mesh);
    judge(plan, mesh);
  }

private:
  template <typename V, std::size_t N>
  static std::vector<V> flat(const std::vector<std::array<V, N>>& values) {
    std::vector<V> all;
    for (const auto& value : values) {
      all.insert(all.end(), value.begin(), value.end());
    }
    return all;
  }

  /// A patch beside side v = 1 of the first one, whose control points along it are the same, or
  /// those backwards; or the two parts of one that is cut there.
  void add_neighbour(ByteSource& bytes) {
    const std::uint8_t choice = bytes.byte();
    const std::size_t row = static_cast<std::size_t>(nets_.degree_u + 1) * nets_.channels();
    std::vector<T>& net = memory_.emplace_back(
        nets_.values.begin(),
        nets_.values.begin() + static_cast<std::ptrdiff_t>(nets_.values_per_patch()));
    std::rotate(net.begin(), net.end() - static_cast<std::ptrdiff_t>(row), net.end());
    for (std::size_t k = row; k < net.size(); ++k) {
      net[k] += (choice & 1) != 0 && k % nets_.channels() == 2 ? T(1) : T(0);
    }
    auto whole =
        ControlNets<T>::packed(net.data(), 1, nets_.degree_u, nets_.degree_v, 3, nets_.weights);
    std::vector<T>& other = memory_.emplace_back(net.size());
    const auto turned =
        MutableNets<T>::packed(other.data(), 1, nets_.degree_u, nets_.degree_v, 3, nets_.weights);
    if ((choice & 2) != 0 && reverse_u(whole, turned)) {
      whole = turned;
    }
    constexpr T kPlaces[] = {T(0.5), T(0.25), T(1) / T(3), T(0.75), T(0.99), T(0x1p-20)};
    const T at = kPlaces[(choice >> 4) % std::size(kPlaces)];
    std::vector<T>& parts = memory_.emplace_back(2 * net.size());
    const auto part = [&](std::size_t k) {
      return MutableNets<T>::packed(parts.data() + k * net.size(), 1, nets_.degree_u,
                                    nets_.degree_v, 3, nets_.weights);
    };
    if ((choice & 4) != 0 && split_u(whole, at, part(0), part(1))) {
      views_.push_back(ControlNets<T>::packed(parts.data(), 2, nets_.degree_u, nets_.degree_v, 3,
                                              nets_.weights));
    } else {
      views_.push_back(whole);
    }
  }

  [[nodiscard]] std::size_t given() const {
    std::size_t patches = 0;
    for (const ControlNets<T>& view : views_) {
      patches += view.count;
    }
    return patches;
  }

  void judge(const Mesh<T>& mesh) const {
    const auto corners = [&](const auto& triangles) {
      for (const auto& [a, b, c] : triangles) {
        require(std::max({a, b, c}) < mesh.positions.size(), "a triangle has no such vertex");
        require(a != b && b != c && c != a, "a triangle has one vertex twice");
      }
    };
    corners(mesh.triangles);
    corners(mesh.short_triangles);
    require(mesh.deviations.size() == given(), "deviations of other patches");
    require(mesh.deviation == *std::max_element(mesh.deviations.begin(), mesh.deviations.end()),
            "the deviation is not that of a patch");
    require(mesh.patches.size() == mesh.parameters.size() &&
                mesh.parameters.size() == (options_.parameters ? mesh.positions.size() : 0),
            "parameters of other vertices");
    for (std::size_t k = 0; k < mesh.parameters.size(); ++k) {
      const auto [u, v] = mesh.parameters[k];
      require(mesh.patches[k] < given() && u >= 0 && u <= 1 && v >= 0 && v <= 1,
              "a vertex outside of its patch");
    }
    require(options_.split_edges || mesh.splits.splits + mesh.splits.unjoined == 0,
            "edges are split that were not to be");
    require(mesh.splits.unjoined > 0 || mesh.splits.largest_gap == 0, "a gap of no edge");
  }

  /// Pieces make up the patches that were given, each of them once.
  void judge(const MeshPlan<T>& plan, const Mesh<T>& mesh) const {
    const std::size_t patches = plan.set.size();
    require(plan.pieces.empty() ? plan.splits.splits == 0
                                : options_.split_edges && plan.pieces.size() == patches,
            "pieces of other patches");
    require(plan.splits.splits == mesh.splits.splits, "the plan's splits are others");
    std::vector<double> area(given());
    for (const PatchPiece& piece : plan.pieces) {
      require(piece.u0 >= 0 && piece.u0 < piece.u1 && piece.u1 <= 1 && piece.v0 >= 0 &&
                  piece.v0 < piece.v1 && piece.v1 <= 1 && piece.error >= 0,
              "a piece is no part of its patch");
      area[piece.patch] += (piece.u1 - piece.u0) * (piece.v1 - piece.v0);
    }
    for (std::size_t patch = 0; patch < area.size() && !plan.pieces.empty(); ++patch) {
      const bool left_out = area[patch] == 0 && options_.drop_repeated;
      require(left_out || std::fabs(area[patch] - 1) < 1e-5, "pieces are not all of their patch");
    }
  }

  Nets<T> nets_;
  std::deque<std::vector<T>> memory_; ///< of views
  std::vector<ControlNets<T>> views_;
  MeshOptions options_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::MeshCase>(data, size);
}
