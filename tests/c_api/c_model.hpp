// A closed model for the C API and for C++, and its mesh.
#pragma once

#include "tests/c_api/c_values.hpp"

namespace simdbezier::tests {

/// A closed model: a periodic B-spline mesh of 4 x 5 control points.
template <typename T>
class CModel : public ::testing::Test {
protected:
  void SetUp() override {
    auto mesh = sized<simdbezier_spline_mesh>();
    mesh.points = mesh_points_.data();
    mesh.length = mesh_points_.size();
    mesh.rows = 4;
    mesh.columns = 5;
    mesh.row_stride = 15;
    mesh.point_stride = 3;
    mesh.component_stride = 1;
    mesh.components = 3;
    mesh.scalar = kCScalar<T>;
    mesh.periodic_u = mesh.periodic_v = 1;
    values_.resize(20 * 48);
    const simdbezier_mutable_nets room = c_room(values_, 3, 3);
    ASSERT_EQ(simdbezier_spline_to_bezier(&mesh, &room, nullptr), SIMDBEZIER_OK)
        << simdbezier_last_message();
    std::vector<T> expected(values_.size());
    ASSERT_TRUE(spline_to_bezier(
        SplineMesh<T>{mesh_points_.data(), 4, 5, 15, 3, 1, 3, Weights::none, true, true},
        MutableNets<T>::packed(std::span(expected), 20, 3, 3)));
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
    rates_.nu = nu_.data();
    rates_.nv = nv_.data();
    rates_.diagonals = diagonals_.data();
    rates_.deviation = deviation_.data();
    rates_.nu_length = rates_.nv_length = 20;
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
