// Vertex formats decoded by formulas of the test's own, against the values that they stand for.
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include <simdbezier/evaluate_mesh.hpp>

#include "tests/mesh/support/ball_mesh.hpp"
#include "tests/mesh/support/format_decoding.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests::vertex_formats_test {
namespace {

/// The mesh of a ball, fine enough to have normals in nearly all directions.
EvaluatedMesh<float>& fine_ball() {
  static EvaluatedMesh<float> mesh(ball(), 1, 1);
  if (mesh.position.empty()) {
    std::fill(mesh.nu.begin(), mesh.nu.end(), 90U);
    std::fill(mesh.nv.begin(), mesh.nv.end(), 83U);
    EXPECT_EQ(lay_out_mesh(mesh.topology, {mesh.nu, mesh.nv, {}}, mesh.layout), Status::ok);
    mesh.evaluate_all();
  }
  return mesh;
}

struct PositionCase {
  VertexFormat format;
  double relative; ///< of the value
  double steps;    ///< of the box
};
constexpr PositionCase kPositions[] = {{VertexFormat::float32, 0, 0},
                                       {VertexFormat::half, 0x1p-11, 0},
                                       {VertexFormat::unorm16, 0, 0.5},
                                       {VertexFormat::snorm16, 0, 0.5}};

TEST(VertexFormats, positions_are_as_close_as_promised) {
  EvaluatedMesh<float>& mesh = fine_ball();
  for (const PositionCase& c : kPositions) {
    const bool boxed = c.steps > 0;
    const QuantisationBox box = boxed ? box_of(mesh, c.format) : QuantisationBox{};
    for (const std::size_t stride : {format_bytes(c.format, 3), std::size_t{17}}) {
      std::vector<unsigned char> bytes(stride * mesh.position.size(), 0xab);
      FormattedOutputs out;
      out.position = {bytes.data(), static_cast<std::ptrdiff_t>(stride), c.format,
                      mesh.position.size()};
      out.box = box;
      ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
      double worst = 0;
      for (std::size_t k = 0; k < mesh.position.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
          const auto exact = static_cast<double>(mesh.position[k][i]);
          const double error = std::fabs(decode(c.format, bytes, stride * k, i, box) - exact);
          const double most = c.relative * std::fabs(exact) + (c.relative > 0 ? 0x1p-25 : 0) +
                              (c.steps + 1e-9) * box.step;
          ASSERT_LE(error, most) << k;
          worst = std::max(worst, most > 0 ? error / most : 0);
        }
        for (std::size_t i = format_bytes(c.format, 3); i < stride; ++i) {
          ASSERT_EQ(bytes[stride * k + i], 0xab);
        }
      }
      EXPECT_EQ(worst > 0.9, c.format != VertexFormat::float32);
    }
  }
}

struct NormalCase {
  VertexFormat format;
  double degrees;
};
constexpr NormalCase kNormals[] = {{VertexFormat::float32, 1e-5},
                                   {VertexFormat::octahedral16, 0.0037},
                                   {VertexFormat::octahedral8, 0.95}};

TEST(VertexFormats, normals_are_as_close_as_promised) {
  EvaluatedMesh<float>& mesh = fine_ball();
  for (const NormalCase& c : kNormals) {
    const std::size_t size = format_bytes(c.format, 3);
    std::vector<unsigned char> bytes(size * mesh.normal.size());
    FormattedOutputs out;
    out.normal = {bytes.data(), 0, c.format, mesh.normal.size()};
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
    double worst = 0;
    for (std::size_t k = 0; k < mesh.normal.size(); ++k) {
      const Point n = {mesh.normal[k][0], mesh.normal[k][1], mesh.normal[k][2]};
      const Point decoded = decode_normal(c.format, bytes, size * k);
      const double angle = std::atan2(length(cross(n, decoded)), dot(n, decoded));
      worst = std::max(worst, angle * 180 / std::numbers::pi);
    }
    EXPECT_LE(worst, c.degrees);
    EXPECT_EQ(worst > c.degrees / 2, c.format != VertexFormat::float32) << worst;
  }
}

TEST(VertexFormats, parameters_are_as_close_as_promised) {
  EvaluatedMesh<float>& mesh = fine_ball();
  const QuantisationBox unit{{0, 0, 0}, 1.0 / 65535};
  for (const auto& [format, most] :
       std::map<VertexFormat, double>{{VertexFormat::float32, 0},
                                      {VertexFormat::half, 0x1p-12},
                                      {VertexFormat::unorm16, 0.51 / 65535}}) {
    const std::size_t size = format_bytes(format, 2);
    std::vector<unsigned char> bytes(size * mesh.position.size());
    FormattedOutputs out;
    out.parameters = {bytes.data(), 0, format, mesh.position.size()};
    ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
    for (std::size_t k = 0; k < mesh.position.size(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_NEAR(decode(format, bytes, size * k, i, unit),
                    static_cast<double>(mesh.parameters[k][i]), most);
      }
    }
  }
}

TEST(VertexFormats, bytes_are_equal_for_any_threads_and_instruction_set_of_a_class) {
  EvaluatedMesh<float>& mesh = fine_ball();
  std::vector<unsigned char> expected[2];
  for (const Isa isa : available_isas()) {
    for (const int threads : {1, 3}) {
      std::vector<unsigned char> bytes(14 * mesh.position.size());
      FormattedOutputs out;
      out.position = {bytes.data(), 14, VertexFormat::unorm16, mesh.position.size()};
      out.normal = {bytes.data() + 6, 14, VertexFormat::octahedral16, mesh.position.size()};
      out.parameters = {bytes.data() + 10, 14, VertexFormat::half, mesh.position.size()};
      out.box = box_of(mesh, VertexFormat::unorm16);
      Options options;
      options.isa = isa;
      options.threads = threads;
      ASSERT_EQ(evaluate_mesh(mesh.set, mesh.layout, out, options), Status::ok);
      auto& same = expected[fuses_multiply_add(isa) ? 1 : 0];
      same = same.empty() ? bytes : same;
      EXPECT_TRUE(same == bytes);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::vertex_formats_test
