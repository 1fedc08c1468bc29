// Which of two neighbours vertex formats store, on every instruction set.
#include <cmath>

#include <simdbezier/evaluate_mesh.hpp>

#include "tests/mesh/support/ball_mesh.hpp"
#include "tests/mesh/support/format_decoding.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::vertex_rounding_test {
namespace {

class VertexRoundingTest : public IsaTest {
protected:
  /// Formats values, each of which is all coordinates of the only vertex of a patch.
  template <typename T>
  std::vector<unsigned char> format(const std::vector<double>& values, FormattedOutputs out) {
    std::vector<T> points;
    for (const double value : values) {
      points.insert(points.end(), 48, static_cast<T>(value));
    }
    PatchSet<T> set;
    Topology topology;
    MeshLayout layout;
    const auto nets = ControlNets<T>::packed(std::span<const T>(points));
    EXPECT_TRUE(pack(nets, set));
    EXPECT_EQ(find_topology(nets, topology), Status::ok);
    const std::vector<std::uint32_t> ones(values.size(), 1);
    EXPECT_EQ(lay_out_mesh(topology, {ones, ones, {}}, layout), Status::ok);
    EXPECT_EQ(layout.size().vertices, values.size());
    std::vector<unsigned char> bytes(6 * values.size());
    (out.normal.stride > 0 ? out.normal : out.position).first = bytes.data();
    run(Options{}, [&](const Options& forced) { return evaluate_mesh(set, layout, out, forced); });
    return bytes;
  }
};

/// Doubles next to a middle, which floats between them would be.
TEST_P(VertexRoundingTest, halves_of_doubles_are_rounded_once) {
  std::vector<double> values;
  std::vector<std::uint32_t> expected;
  for (std::uint32_t bits = 0; bits < 0x7bff; bits += 13) {
    const double low = from_half(static_cast<std::uint16_t>(bits));
    const double middle = (low + from_half(static_cast<std::uint16_t>(bits + 1))) / 2;
    values.insert(values.end(), {std::nextafter(middle, 0.0), -std::nextafter(middle, 1e9)});
    expected.insert(expected.end(), {bits, 0x8000 + bits + 1});
  }
  FormattedOutputs out;
  out.position.format = VertexFormat::half;
  const std::vector<unsigned char> bytes = format<double>(values, out);
  for (std::size_t k = 0; k < values.size(); ++k) {
    ASSERT_EQ(read<std::uint16_t>(bytes, 6 * k), expected[k]) << values[k];
  }
}

/// Numbers that are halves, middles between two of them, and what is next to these.
TEST_P(VertexRoundingTest, halves_are_the_nearest) {
  std::vector<double> values = {65519, 65520, 1e20, -1e20};
  std::vector<std::uint32_t> expected = {0x7bff, 0x7c00, 0x7c00, 0xfc00};
  for (std::uint32_t bits = 0; bits < 0x7bff; bits += 7) {
    const double low = from_half(static_cast<std::uint16_t>(bits));
    const double high = from_half(static_cast<std::uint16_t>(bits + 1));
    const auto middle = static_cast<float>((low + high) / 2);
    for (const double value : {low, -high, static_cast<double>(middle),
                               static_cast<double>(std::nextafter(middle, 0.0F)),
                               static_cast<double>(std::nextafter(middle, 1e9F))}) {
      values.push_back(value);
    }
    const std::uint32_t even = bits % 2 == 0 ? bits : bits + 1;
    expected.insert(expected.end(), {bits, 0x8000 + bits + 1, even, bits, bits + 1});
  }
  FormattedOutputs out;
  out.position.format = VertexFormat::half;
  for (const std::vector<unsigned char>& bytes :
       {format<float>(values, out), format<double>(values, out)}) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      ASSERT_EQ(read<std::uint16_t>(bytes, 6 * k), expected[k]) << values[k];
    }
  }
}

struct StepCase {
  VertexFormat format;
  double low;
  double step;
  double apart; ///< of numbers that are next to a middle, in steps
};
/// Nearness to middles that products with reciprocals cannot tell, steps without a reciprocal, and
/// boxes so far away that products have no correct digit.
constexpr StepCase kSteps[] = {{VertexFormat::unorm16, 0, 0x1p-10, 0x1p-19},
                               {VertexFormat::snorm16, 0, 0x1p-10, 0x1p-19},
                               {VertexFormat::unorm16, 0, 0x1p-1030, 0x1p-19},
                               {VertexFormat::snorm16, 0, 0x1p-1030, 0x1p-19},
                               {VertexFormat::unorm16, -0x1p20 - 1, 0x3p-28, 0x1p-4},
                               {VertexFormat::snorm16, 0x1p20 + 5, 0x3p-28, 0x1p-4}};

/// Middles between numbers go upwards, what is next to them does not, and all that is outside of
/// the box comes to its border. Whether roundings may decide is found for many vertices at once, so
/// that middles stand apart from the others.
TEST_P(VertexRoundingTest, steps_are_the_nearest) {
  for (const StepCase& c : kSteps) {
    const bool centred = c.format == VertexFormat::snorm16;
    const int least = centred ? -32767 : 0;
    const int most = centred ? 32767 : 65535;
    std::vector<double> values[2]; // the second ones are near middles
    std::vector<int> expected[2];
    const auto add = [&](bool near, double steps, int stored) {
      values[near ? 1 : 0].push_back(c.low + steps * c.step);
      expected[near ? 1 : 0].push_back(stored);
    };
    for (int k = least; k < most; k += std::abs(k) < 20 ? 1 : 500) {
      for (const double more : {0.0, 0.25, 0.75}) {
        add(false, k + more, more < 0.5 ? k : k + 1);
      }
      for (const double more : {0.5 - c.apart, 0.5, 0.5 + c.apart}) {
        add(true, k + more, more < 0.5 ? k : k + 1);
      }
    }
    for (const double steps : {1e5, 1e9, 1e15}) {
      add(false, steps, most);
      add(false, -steps, least);
    }
    FormattedOutputs out;
    out.position.format = c.format;
    out.box = {{c.low, c.low, c.low}, c.step};
    for (const int near : {0, 1}) {
      const std::vector<unsigned char> bytes = format<double>(values[near], out);
      for (std::size_t k = 0; k < values[near].size(); ++k) {
        const int stored =
            centred ? read<std::int16_t>(bytes, 6 * k + 4) : read<std::uint16_t>(bytes, 6 * k + 4);
        ASSERT_EQ(stored, expected[near][k]) << "low " << c.low << " step " << c.step << " " << k;
      }
    }
  }
}

/// A patch that is a point has no normal.
TEST_P(VertexRoundingTest, zero_normals_are_upright) {
  for (const VertexFormat oct : {VertexFormat::octahedral16, VertexFormat::octahedral8}) {
    FormattedOutputs out;
    out.normal.format = oct;
    out.normal.stride = 6;
    const std::vector<unsigned char> bytes = format<float>({1, 2, 3}, out);
    EXPECT_EQ(bytes, std::vector<unsigned char>(bytes.size()));
  }
}

/// Normals of a ball: many directions, and those of the axes.
TEST_P(VertexRoundingTest, octahedral_normals_are_the_nearest) {
  const EvaluatedMesh<float> mesh(ball(), 31, 29);
  const std::size_t vertices = mesh.layout.size().vertices;
  std::vector<unsigned char> bytes(4 * vertices);
  FormattedOutputs out;
  out.normal = {bytes.data(), 0, VertexFormat::octahedral16, vertices};
  run(Options{},
      [&](const Options& forced) { return evaluate_mesh(mesh.set, mesh.layout, out, forced); });
  std::vector<float> normals(3 * vertices);
  MeshOutputs<float> plain;
  plain.normal = Vectors<float>::xyz(normals.data());
  run(Options{},
      [&](const Options& forced) { return evaluate_mesh(mesh.set, mesh.layout, plain, forced); });
  for (std::size_t k = 0; k < vertices; ++k) {
    const long double x = normals[3 * k];
    const long double y = normals[3 * k + 1];
    const long double z = normals[3 * k + 2];
    const long double sum = std::fabs(x) + std::fabs(y) + std::fabs(z);
    const bool lower = z < 0;
    const long double s = lower ? std::copysign(sum - std::fabs(y), x) : x;
    const long double t = lower ? std::copysign(sum - std::fabs(x), y) : y;
    ASSERT_LE(std::fabs(32767 * s / sum - read<std::int16_t>(bytes, 4 * k)), 0.5L + 1e-9L) << k;
    ASSERT_LE(std::fabs(32767 * t / sum - read<std::int16_t>(bytes, 4 * k + 2)), 0.5L + 1e-9L) << k;
  }
}

INSTANTIATE_FOR_EVERY_ISA(VertexRoundingTest);

} // namespace
} // namespace simdbezier::tests::vertex_rounding_test
