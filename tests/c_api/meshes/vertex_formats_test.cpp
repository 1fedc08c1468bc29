// Formatted vertices through simdbezier.h: the bytes of the C++ calls.
#include "tests/c_api/support/c_model.hpp"

namespace simdbezier::tests::vertex_formats_test {
namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CMesh, Scalars);

/// Where one output stands in a vertex, and how.
struct Member {
  VertexFormat format = VertexFormat::float32;
  int offset = -1; ///< -1: not asked for
};
/// Vertices of `stride` bytes with positions, normals and parameters.
struct Vertex {
  const char* name;
  int stride;
  Member position;
  Member normal;
  Member parameters;
};
const Vertex kVertices[] = {
    {"floats",
     32,
     {VertexFormat::float32, 0},
     {VertexFormat::float32, 12},
     {VertexFormat::float32, 24}},
    {"small",
     12,
     {VertexFormat::snorm16, 0},
     {VertexFormat::octahedral8, 6},
     {VertexFormat::unorm16, 8}},
    {"odd addresses",
     15,
     {VertexFormat::half, 1},
     {VertexFormat::octahedral16, 7},
     {VertexFormat::half, 11}},
    {"with a gap", 24, {VertexFormat::unorm16, 0}, {VertexFormat::float32, 8}, {}},
    {"packed normals", 0, {}, {VertexFormat::octahedral16, 0}, {}}};

FormattedOutput output(const Member& member, int stride, std::vector<unsigned char>& bytes,
                       std::size_t vertices) {
  return member.offset < 0
             ? FormattedOutput{}
             : FormattedOutput{bytes.data() + member.offset, stride, member.format, vertices};
}
simdbezier_formatted_output c_output(const Member& member, int stride,
                                     std::vector<unsigned char>& bytes, std::size_t vertices) {
  return member.offset < 0
             ? simdbezier_formatted_output{}
             : simdbezier_formatted_output{bytes.data() + member.offset, vertices, stride,
                                           static_cast<simdbezier_vertex_format>(member.format)};
}

TYPED_TEST(CMesh, HasFormattedVertices) {
  using T = TypeParam;
  const auto nets = ControlNets<T>::packed(this->values_);
  PatchSet<T> set;
  ASSERT_TRUE(pack(nets, set));
  const CPatchSet c_set = c_pack<T>(this->c_nets_);
  for (const Vertex& vertex : kVertices) {
    for (const std::size_t first : {0U, 7U}) {
      const std::size_t patches = first == 0 ? 0 : 5;
      const std::size_t vertices =
          first == 0 ? this->layout_.size().vertices
                     : this->layout_.first_vertex(12) - this->layout_.first_vertex(7);
      FormattedOutputs out;
      auto c_out = sized<simdbezier_formatted_outputs>();
      const VertexFormat boxed = vertex.position.format == VertexFormat::snorm16
                                     ? VertexFormat::snorm16
                                     : VertexFormat::unorm16;
      ASSERT_TRUE(quantisation_box(std::span(&nets, 1), boxed, out.box));
      EXPECT_C_OK(simdbezier_find_quantisation_box(
          &this->c_nets_, 1, static_cast<simdbezier_vertex_format>(boxed), &c_out.box));
      EXPECT_TRUE(std::equal(out.box.low.begin(), out.box.low.end(), c_out.box.low));
      EXPECT_EQ(out.box.step, c_out.box.step);

      const std::size_t bytes = vertices * static_cast<std::size_t>(vertex.stride + 4);
      std::vector<unsigned char> expected(bytes, 0xa5);
      std::vector<unsigned char> got(bytes, 0xa5);
      out.position = output(vertex.position, vertex.stride, expected, vertices);
      out.normal = output(vertex.normal, vertex.stride, expected, vertices);
      out.parameters = output(vertex.parameters, vertex.stride, expected, vertices);
      c_out.position = c_output(vertex.position, vertex.stride, got, vertices);
      c_out.normal = c_output(vertex.normal, vertex.stride, got, vertices);
      c_out.parameters = c_output(vertex.parameters, vertex.stride, got, vertices);
      const SetRange range = {first, first == 0 ? SetRange::kToTheEnd : patches};
      ASSERT_TRUE(evaluate_mesh(set, this->layout_, out, {}, range)) << vertex.name;
      EXPECT_C_OK(simdbezier_evaluate_formatted_mesh(c_set.get(), this->c_layout_, &c_out, nullptr,
                                                     first, patches))
          << vertex.name;
      expect_same_bits(got, expected, vertex.name);
      EXPECT_NE(got, std::vector<unsigned char>(bytes, 0xa5)) << vertex.name;

      // Room for one vertex less.
      c_out.normal.capacity -= 1;
      EXPECT_EQ(simdbezier_evaluate_formatted_mesh(c_set.get(), this->c_layout_, &c_out, nullptr,
                                                   first, patches),
                SIMDBEZIER_OUTPUT_TOO_SMALL);
      auto fault = sized<simdbezier_fault>();
      ASSERT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
      EXPECT_STREQ(fault.argument, "out->normal");
      expect_same_bits(got, expected, "a refused call");
    }
  }
}

TEST(CVertexFormats, HaveTheSizesOfCpp) {
  for (simdbezier_vertex_format format = SIMDBEZIER_FORMAT_FLOAT32;
       format <= SIMDBEZIER_FORMAT_OCTAHEDRAL8; ++format) {
    for (const std::size_t components : {2U, 3U}) {
      EXPECT_EQ(simdbezier_format_bytes(format, components),
                format_bytes(static_cast<VertexFormat>(format), components));
    }
  }
  EXPECT_EQ(simdbezier_format_bytes(-1, 3), 0U);
  EXPECT_EQ(simdbezier_format_bytes(SIMDBEZIER_FORMAT_OCTAHEDRAL8 + 1, 3), 0U);
}

} // namespace
} // namespace simdbezier::tests::vertex_formats_test
