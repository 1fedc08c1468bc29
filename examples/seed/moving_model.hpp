// A tessellator's frame: a B-spline surface that is deformed, seen by a camera, and meshed so that
// no point is seen more than a part of a pixel away. Edges are joined once; memory only grows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

namespace seed {

/// The model, and what stays from frame to frame.
class MovingModel {
public:
  static constexpr std::size_t kColumns = 128; ///< control points
  static constexpr std::size_t kRows = 163;
  static constexpr std::size_t kPatches = (kColumns - 3) * (kRows - 3);
  static constexpr std::ptrdiff_t kVertex = 8; ///< x y z, normal, u v

  explicit MovingModel(double pixels, const simdbezier::Options& run = {})
      : pixels_(pixels), run_(run) {
    pack_.threads = run.threads;
    pack_.isa = run.isa;
    pack_.reuse_memory = true;
    surface_.points = points_.front().data();
    surface_.rows = kRows;
    surface_.columns = kColumns;
    surface_.row_stride = 3 * kColumns;
  }

  /// One stage of a frame.
  struct Stage {
    const char* name;
    simdbezier::Status (MovingModel::*run)();
  };
  static std::span<const Stage> stages() {
    using M = MovingModel;
    static constexpr Stage kStages[] = {{"nets", &M::find_nets},
                                        {"pack", &M::pack_patches},
                                        {"errors", &M::find_errors},
                                        {"tolerances", &M::find_tolerances},
                                        {"rates", &M::choose},
                                        {"layout", &M::lay_out},
                                        {"vertices", &M::evaluate_vertices},
                                        {"triangles", &M::write}};
    return kStages;
  }

  /// Moves control points and camera. This is what a user's program does, and no stage.
  void move(double time) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const auto x = static_cast<double>(k % kColumns);
      const auto y = static_cast<double>(k / kColumns);
      const double z = 2 * std::sin(0.3 * x + time) * std::cos(0.2 * y + 0.7 * time);
      points_[k] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    }
    camera_.eye = {64 + 10 * std::sin(time), -60, 40};
    camera_.direction = {0, 1, -0.35};
    camera_.focal_length = 1500;
  }
  [[nodiscard]] simdbezier::MeshSize size() const { return layout_.size(); }
  [[nodiscard]] const std::vector<float>& vertices() const { return vertices_; }

private:
  [[nodiscard]] simdbezier::ControlNets<float> nets() const {
    return simdbezier::ControlNets<float>::packed(nets_.data(), kPatches, 3, 3);
  }

  simdbezier::Status find_nets() {
    const auto to = simdbezier::MutableNets<float>::packed(nets_.data(), kPatches, 3, 3);
    return simdbezier::to_bezier(surface_, to, {}, run_).status;
  }
  simdbezier::Status pack_patches() {
    const simdbezier::Status status = simdbezier::pack(nets(), set_, pack_).status;
    const bool joined = topology_.counts().patches > 0; // by the first frame
    return status && !joined ? simdbezier::find_topology(nets(), topology_) : status;
  }
  simdbezier::Status find_errors() { return simdbezier::position_errors(set_, errors_, run_); }
  simdbezier::Status find_tolerances() {
    return simdbezier::pixel_tolerances(nets(), camera_, pixels_, std::span(tolerances_), run_);
  }
  simdbezier::Status choose() {
    simdbezier::RateOptions options;
    options.tolerances = tolerances_;
    options.errors = errors_;
    const simdbezier::CertifiedRates rates{cells_u_, cells_v_, diagonals_, {}};
    return simdbezier::choose_rates(nets(), topology_, options, rates, run_).status;
  }
  simdbezier::Status lay_out() {
    const simdbezier::Status status =
        simdbezier::lay_out_mesh(topology_, {cells_u_, cells_v_, diagonals_}, layout_, run_);
    vertices_.resize(std::max(vertices_.size(), kVertex * size().vertices));
    triangles_.resize(std::max(triangles_.size(), 3 * size().triangles));
    return status;
  }
  simdbezier::Status evaluate_vertices() {
    const std::span<float> memory = vertices_;
    simdbezier::MeshOutputs<float> out;
    out.position = simdbezier::Vectors<float>::xyz(memory, kVertex);
    out.normal = simdbezier::Vectors<float>::xyz(memory.subspan(3), kVertex);
    out.parameters = {&memory[6], &memory[7], nullptr, kVertex, size().vertices};
    return simdbezier::evaluate_mesh(set_, layout_, out, run_);
  }
  simdbezier::Status write() {
    return simdbezier::write_triangles(layout_, std::span(triangles_), run_);
  }

  double pixels_;
  simdbezier::Options run_;
  simdbezier::PackOptions pack_;
  simdbezier::Camera camera_;
  std::vector<std::array<float, 3>> points_ = std::vector<std::array<float, 3>>(kColumns * kRows);
  simdbezier::SplineSurface<float> surface_;
  std::vector<float> nets_ = std::vector<float>(48 * kPatches);
  simdbezier::PatchSet<float> set_;
  simdbezier::Topology topology_;
  std::vector<double> errors_ = std::vector<double>(kPatches);
  std::vector<double> tolerances_ = std::vector<double>(kPatches);
  std::vector<std::uint32_t> cells_u_ = std::vector<std::uint32_t>(kPatches);
  std::vector<std::uint32_t> cells_v_ = std::vector<std::uint32_t>(kPatches);
  std::vector<std::uint16_t> diagonals_ = std::vector<std::uint16_t>(kPatches);
  simdbezier::MeshLayout layout_;
  std::vector<float> vertices_;
  std::vector<std::uint32_t> triangles_;
};

} // namespace seed
