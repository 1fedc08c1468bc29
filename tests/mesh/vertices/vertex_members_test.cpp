// Members of formatted vertices at any place, boxes of any size, and what is refused.
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <simdbezier/evaluate_mesh.hpp>

#include "tests/mesh/support/ball_mesh.hpp"

namespace simdbezier::tests::vertex_members_test {
namespace {

/// Whether two outputs of some vertices with equal strides have a common byte.
bool share_bytes(const FormattedOutput& a, const FormattedOutput& b, std::size_t vertices) {
  std::set<const unsigned char*> bytes;
  const auto visit = [&](const FormattedOutput& out, const auto& take) {
    for (std::size_t k = 0; k < vertices; ++k) {
      const auto* const first =
          static_cast<const unsigned char*>(out.first) + k * static_cast<std::size_t>(out.stride);
      for (std::size_t i = 0; i < format_bytes(out.format, 3); ++i) {
        take(first + i);
      }
    }
  };
  bool shared = false;
  visit(a, [&](const unsigned char* byte) { bytes.insert(byte); });
  visit(b, [&](const unsigned char* byte) { shared = shared || bytes.contains(byte); });
  return shared;
}

/// Positions and normals at all places of a vertex and of its neighbours, in either order; the
/// strides are powers of two, multiples of 4 and neither.
TEST(VertexMembers, members_of_a_vertex_may_stand_in_any_order) {
  const EvaluatedMesh<float> mesh(ball(), 1, 1);
  const std::size_t vertices = mesh.layout.size().vertices;
  std::size_t accepted = 0;
  for (const std::size_t stride : {10U, 12U, 13U, 16U}) {
    std::vector<unsigned char> bytes(stride * (vertices + 3));
    const auto place = [&](std::size_t offset, VertexFormat format) {
      return FormattedOutput{bytes.data() + offset, static_cast<std::ptrdiff_t>(stride), format,
                             vertices};
    };
    for (std::size_t at = 0; at <= 2 * stride; ++at) {
      for (std::size_t other = 0; other <= 2 * stride; ++other) {
        FormattedOutputs out;
        out.position = place(at, VertexFormat::half);
        out.normal = place(other, VertexFormat::octahedral16);
        const bool shared = share_bytes(out.position, out.normal, vertices);
        // Outputs that meet only beyond the first and the last vertex are not worth a distinction.
        const bool wrapped = at / stride != other / stride;
        const Status status = evaluate_mesh(mesh.set, mesh.layout, out);
        if (shared || !wrapped) {
          EXPECT_EQ(to_string(status), to_string(shared ? Status::overlapping_outputs : Status::ok))
              << "stride " << stride << ", position " << at << ", normal " << other;
        }
        accepted += status == Status::ok ? 1 : 0;
      }
    }
  }
  EXPECT_GT(accepted, 100U);
}

struct Refused {
  const char* what;
  Status status;
  void (*change)(FormattedOutputs&);
};
const Refused kRefused[] = {
    {"nothing", Status::null_output, [](FormattedOutputs& o) { o = {}; }},
    {"octahedral position", Status::bad_components,
     [](FormattedOutputs& o) { o.position.format = VertexFormat::octahedral16; }},
    {"half normal", Status::bad_components,
     [](FormattedOutputs& o) { o.normal.format = VertexFormat::half; }},
    {"snorm parameters", Status::bad_components,
     [](FormattedOutputs& o) { o.parameters.format = VertexFormat::snorm16; }},
    {"no box", Status::bad_tolerance, [](FormattedOutputs& o) { o.box.step = 0; }},
    {"stride", Status::bad_stride, [](FormattedOutputs& o) { o.position.stride = 5; }},
    {"negative stride", Status::bad_stride, [](FormattedOutputs& o) { o.normal.stride = -14; }},
    {"small", Status::output_too_small, [](FormattedOutputs& o) { --o.normal.capacity; }},
    {"overlap", Status::overlapping_outputs,
     [](FormattedOutputs& o) { o.normal.first = o.position.first; }},
    {"half of an overlap", Status::overlapping_outputs,
     [](FormattedOutputs& o) {
       o.normal.first = static_cast<unsigned char*>(o.position.first) + 5;
     }},
    {"strides differ", Status::overlapping_outputs,
     [](FormattedOutputs& o) { o.normal.stride = 16; }}};

TEST(VertexMembers, bad_input_is_a_status) {
  EvaluatedMesh<float> mesh(ball(), 3, 1);
  const std::size_t vertices = mesh.layout.size().vertices;
  std::vector<unsigned char> bytes(16 * vertices);
  FormattedOutputs out;
  out.position = {bytes.data(), 14, VertexFormat::unorm16, vertices};
  out.normal = {bytes.data() + 6, 14, VertexFormat::octahedral16, vertices};
  out.parameters = {bytes.data() + 10, 14, VertexFormat::unorm16, vertices};
  out.box = box_of(mesh, VertexFormat::unorm16);
  EXPECT_EQ(evaluate_mesh(mesh.set, mesh.layout, out), Status::ok);
  for (const Refused& refused : kRefused) {
    FormattedOutputs changed = out;
    refused.change(changed);
    EXPECT_EQ(to_string(evaluate_mesh(mesh.set, mesh.layout, changed)), to_string(refused.status))
        << refused.what;
  }
  EXPECT_EQ(evaluate_mesh(PatchSet<float>(), mesh.layout, out), Status::unequal_lengths);
  EXPECT_EQ(evaluate_mesh(mesh.set, mesh.layout, out, {}, {0, 99}), Status::bad_patch_range);
  QuantisationBox box;
  std::vector<double> points(48, 1.0);
  const auto status = [&](VertexFormat format) {
    const auto nets = ControlNets<double>::packed(std::span<const double>(points));
    return quantisation_box(std::span<const ControlNets<double>>(&nets, 1), format, box);
  };
  EXPECT_EQ(status(VertexFormat::unorm16), Status::bad_tolerance) << "one point";
  EXPECT_EQ(status(VertexFormat::half), Status::bad_tolerance);
  points[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status(VertexFormat::snorm16), Status::non_finite_input);
  points[5] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(status(VertexFormat::unorm16), Status::non_finite_input);
}

struct FarBox {
  double low;
  double high;
  Status status;
};
constexpr FarBox kFarBoxes[] = {{0, 1, Status::ok},
                                {1e308, 1.5e308, Status::ok}, // sums of coordinates overflow
                                {-1e308, 1e308, Status::bad_tolerance},
                                {0, 1e-310, Status::ok},
                                {0, 1e-320, Status::bad_tolerance}}; // the step would be 0

TEST(VertexMembers, boxes_have_a_step_or_are_refused) {
  for (const FarBox& c : kFarBoxes) {
    std::vector<double> points(48, c.low);
    points[47] = c.high;
    const auto nets = ControlNets<double>::packed(std::span<const double>(points));
    for (const VertexFormat format : {VertexFormat::unorm16, VertexFormat::snorm16}) {
      QuantisationBox box;
      EXPECT_EQ(to_string(quantisation_box(std::span(&nets, 1), format, box)), to_string(c.status))
          << c.low << " to " << c.high;
      EXPECT_EQ(box.step > 0, c.status == Status::ok);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::vertex_members_test
