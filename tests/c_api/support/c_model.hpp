// A closed model for the C API and for C++, and its mesh.
#pragma once

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests {

/// A closed model: a periodic B-spline mesh of 4 x 5 control points.
template <typename T>
class CModel : public ::testing::Test {
protected:
  void SetUp() override {
    auto surface = simdbezier_packed_spline_surface_of(mesh_points_.data(), mesh_points_.size(), 4,
                                                       5, 3, 3, 3, 0, kCScalar<T>);
    surface.periodic_u = surface.periodic_v = 1;
    values_.resize(20 * 48);
    const simdbezier_mutable_nets room = c_room(values_, 3, 3);
    ASSERT_EQ(simdbezier_spline_to_bezier(&surface, 1, &room, nullptr, 0, nullptr), SIMDBEZIER_OK)
        << simdbezier_last_message();
    std::vector<T> expected(values_.size());
    SplineSurface<T> same{mesh_points_.data(), 4, 5, 15};
    same.periodic_u = same.periodic_v = true;
    ASSERT_TRUE(to_bezier(same, MutableNets<T>::packed(std::span(expected), 20, 3, 3)));
    expect_same_bits(values_, expected, "pieces of a spline");
    c_nets_ = c_nets(values_, 3, 3);
    ASSERT_EQ(simdbezier_find_topology(&c_nets_, 1, nullptr, &c_topology_), SIMDBEZIER_OK);
    ASSERT_TRUE(find_topology(ControlNets<T>::packed(values_), topology_));
  }
  void TearDown() override { simdbezier_topology_free(c_topology_); }

  std::vector<T> mesh_points_ = random_values<T>(4 * 5 * 3, 13);
  std::vector<T> values_;
  simdbezier_nets c_nets_{};
  Topology topology_;
  simdbezier_topology* c_topology_ = nullptr;
};

/// The model with its rates, and the numbering of its vertices.
template <typename T>
class CMesh : public CModel<T> {
protected:
  void SetUp() override {
    CModel<T>::SetUp();
    rates_.cells_u = nu_.data();
    rates_.cells_v = nv_.data();
    rates_.diagonals = diagonals_.data();
    rates_.deviation = deviation_.data();
    rates_.cells_u_length = rates_.cells_v_length = 20;
    rates_.diagonals_length = rates_.deviation_length = 20;
    auto options = sized<simdbezier_rate_options>();
    options.tolerance = 1e-3;
    EXPECT_C_OK(simdbezier_choose_rates(&this->c_nets_, 1, this->c_topology_, &options, &rates_));
    ASSERT_TRUE(lay_out_mesh(this->topology_, {nu_, nv_, diagonals_}, layout_));
    EXPECT_C_OK(simdbezier_lay_out_mesh(this->c_topology_, &rates_, nullptr, &c_layout_));
    ASSERT_EQ(simdbezier_mesh_layout_vertices(c_layout_), layout_.size().vertices);
    ASSERT_EQ(simdbezier_mesh_layout_triangles(c_layout_), layout_.size().triangles);
  }
  void TearDown() override {
    simdbezier_mesh_layout_free(c_layout_);
    CModel<T>::TearDown();
  }

  std::vector<std::uint32_t> nu_ = std::vector<std::uint32_t>(20);
  std::vector<std::uint32_t> nv_ = std::vector<std::uint32_t>(20);
  std::vector<std::uint16_t> diagonals_ = std::vector<std::uint16_t>(20);
  std::vector<double> deviation_ = std::vector<double>(20);
  simdbezier_rates rates_ = sized<simdbezier_rates>();
  MeshLayout layout_;
  simdbezier_mesh_layout* c_layout_ = nullptr;
};

} // namespace simdbezier::tests
