// Equal bits whatever the output layout, alignment, lane of a sample, and groups asked for; and
// nothing written between or around the outputs.
#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::layout_bits_test {
namespace {

constexpr std::size_t kPatches = 19;

/// Where position, du, dv and normal lie in one array of vertices; -1: not asked for.
struct LayoutCase {
  const char* name;
  std::ptrdiff_t stride;
  std::ptrdiff_t offsets[4];
};

constexpr LayoutCase kLayouts[] = {{"xyz", 3, {0, -1, -1, -1}},
                                   {"xyz_padded", 4, {0, -1, -1, -1}},
                                   {"position_normal", 6, {0, -1, -1, 3}},
                                   {"position_normal_uv", 8, {0, -1, -1, 3}},
                                   {"normal_position", 7, {3, -1, -1, 0}},
                                   {"tangents_only", 6, {-1, 0, 3, -1}},
                                   {"everything", 12, {0, 3, 6, 9}},
                                   {"everything_padded", 17, {1, 5, 9, 13}}};

/// Vertices with guard values everywhere that no output belongs.
template <typename T>
class Vertices {
public:
  static constexpr T kGuard = static_cast<T>(-12345);

  Vertices(const LayoutCase& layout, std::size_t count, std::size_t shift)
      : layout_(layout), count_(count), shift_(shift + 16),
        values_(count * static_cast<std::size_t>(layout.stride) + shift + 48, kGuard) {}

  [[nodiscard]] Outputs<T> outputs() {
    Outputs<T> out;
    Vectors<T>* groups[] = {&out.position, &out.du, &out.dv, &out.normal};
    for (std::size_t g = 0; g < 4; ++g) {
      if (layout_.offsets[g] >= 0) {
        *groups[g] = Vectors<T>::xyz(values_.data() + shift_ + layout_.offsets[g], layout_.stride);
      }
    }
    return out;
  }

  /// Values that differ from the reference, and guards that were written to.
  [[nodiscard]] std::size_t defects(const Planes<T>& reference) const {
    std::vector<T> expected(values_.size(), kGuard);
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t g = 0; g < 4; ++g) {
        for (std::size_t c = 0; layout_.offsets[g] >= 0 && c < 3; ++c) {
          const std::size_t vertex = shift_ + k * static_cast<std::size_t>(layout_.stride);
          expected[vertex + static_cast<std::size_t>(layout_.offsets[g]) + c] =
              reference.at(g, c, k);
        }
      }
    }
    std::size_t defects = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      defects += same_bits(values_[k], expected[k]) ? 0 : 1;
    }
    return defects;
  }

private:
  LayoutCase layout_;
  std::size_t count_;
  std::size_t shift_;
  std::vector<T> values_;
};

class LayoutTest : public IsaTest {
protected:
  template <typename T>
  void expect_equal_layouts() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (const auto& [nu, nv] : kWorkGrids) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      Planes<T> reference(kPatches * nu * nv);
      grid(set, samples, reference.outputs());
      for (const LayoutCase& layout : kLayouts) {
        for (const std::size_t shift : {0u, 1u, 3u}) {
          Vertices<T> vertices(layout, reference.count(), shift);
          grid(set, samples, vertices.outputs());
          EXPECT_EQ(vertices.defects(reference), 0u)
              << layout.name << ", shift " << shift << ", grid " << nu << " x " << nv;
        }
      }
    }
  }

  template <typename T>
  void expect_equal_scattered_layouts() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    const SampleArrays<T> samples = random_samples<T>(kPatches, 1003);
    Planes<T> reference(samples.patch.size());
    scattered(set, samples.view(Parameters::centred), reference.outputs());
    for (const LayoutCase& layout : kLayouts) {
      Vertices<T> vertices(layout, reference.count(), 1);
      scattered(set, samples.view(Parameters::centred), vertices.outputs());
      EXPECT_EQ(vertices.defects(reference), 0u) << layout.name;
    }
  }

  /// Planes that start `shift` elements after a 64-byte boundary, each plane at another one.
  template <typename T>
  void expect_equal_alignments() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (const auto& [nu, nv] : kWorkGrids) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      Planes<T> reference(kPatches * nu * nv);
      grid(set, samples, reference.outputs());
      for (std::size_t shift = 0; shift < 17; ++shift) {
        // A stride of 1 sample in planes of count + shift elements moves plane p by p * shift.
        const std::size_t pitch = reference.count() + shift;
        std::vector<T> values(12 * pitch + 64, Vertices<T>::kGuard);
        T* first = values.data() + shift;
        Outputs<T> out;
        Vectors<T>* groups[] = {&out.position, &out.du, &out.dv, &out.normal};
        for (std::size_t g = 0; g < 4; ++g) {
          T* group = first + 3 * g * pitch;
          *groups[g] = Vectors<T>::planes(group, group + pitch, group + 2 * pitch);
        }
        grid(set, samples, out);
        EXPECT_EQ(plane_defects(values, reference, shift, pitch), 0u)
            << "shift " << shift << ", grid " << nu << " x " << nv;
      }
    }
  }

  template <typename T>
  [[nodiscard]] static std::size_t plane_defects(const std::vector<T>& values,
                                                 const Planes<T>& reference, std::size_t shift,
                                                 std::size_t pitch) {
    std::vector<T> expected(values.size(), Vertices<T>::kGuard);
    for (std::size_t plane = 0; plane < 12; ++plane) {
      for (std::size_t k = 0; k < reference.count(); ++k) {
        expected[shift + plane * pitch + k] = reference.at(plane / 3, plane % 3, k);
      }
    }
    std::size_t defects = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      defects += same_bits(values[k], expected[k]) ? 0 : 1;
    }
    return defects;
  }

  /// Every subset of the groups gives the bits of all groups together, and leaves the rest alone.
  template <typename T>
  void expect_equal_groups() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (const auto& [nu, nv] : kWorkGrids) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      Planes<T> all(kPatches * nu * nv);
      grid(set, samples, all.outputs());
      for (unsigned subset = 1; subset < 16; ++subset) {
        Planes<T> some(all.count(), {(subset & 1) != 0, (subset & 2) != 0, (subset & 4) != 0,
                                     (subset & 8) != 0});
        if ((subset & 7) == 0) {
          continue; // the status alone is not a call
        }
        grid(set, samples, some.outputs());
        EXPECT_EQ(group_defects(some, all), 0u)
            << "subset " << subset << ", grid " << nu << " x " << nv;
      }
    }
  }

  template <typename T>
  [[nodiscard]] static std::size_t group_defects(const Planes<T>& some, const Planes<T>& all) {
    const Wanted wanted = some.wanted();
    const bool asked[] = {wanted.position, wanted.tangents, wanted.tangents, wanted.normal};
    std::size_t defects = 0;
    for (std::size_t k = 0; k < all.count(); ++k) {
      for (std::size_t plane = 0; plane < 12; ++plane) {
        const T value = some.at(plane / 3, plane % 3, k);
        const T expected =
            asked[plane / 3] ? all.at(plane / 3, plane % 3, k) : static_cast<T>(-777);
        defects += same_bits(value, expected) ? 0 : 1;
      }
      // Without normals nobody has looked whether the normal exists.
      if (wanted.status && wanted.normal) {
        defects += some.status()[k] == all.status()[k] ? 0 : 1;
      }
    }
    return defects;
  }

  /// A given grid that starts `shift` values later puts each sample into another lane.
  template <typename T>
  void expect_equal_lanes() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    constexpr std::size_t kCount = 67;
    Random random(5);
    std::vector<T> x;
    for (std::size_t k = 0; k < kCount; ++k) {
      x.push_back(boundary_centred<T>(random));
    }
    const std::vector<T> y{T(-1), static_cast<T>(0.3), T(1)};
    const auto evaluate = [&](std::size_t first, std::size_t count) {
      Planes<T> planes(kPatches * count * y.size());
      grid(set, Grid<T>{count, y.size(), x.data() + first, y.data(), Parameters::centred},
           planes.outputs());
      return planes;
    };
    const Planes<T> reference = evaluate(0, kCount);
    for (std::size_t shift = 0; shift < 33; ++shift) {
      const std::size_t count = shift % 2 == 0 ? kCount - shift : 1 + shift;
      const Planes<T> planes = evaluate(shift, count);
      std::size_t different = 0;
      for (std::size_t row = 0; row < kPatches * y.size(); ++row) {
        for (std::size_t k = 0; k < 12 * count; ++k) {
          const std::size_t plane = k / count;
          const std::size_t column = k % count;
          different += same_bits(planes.at(plane / 3, plane % 3, row * count + column),
                                 reference.at(plane / 3, plane % 3, row * kCount + shift + column))
                           ? 0
                           : 1;
        }
      }
      EXPECT_EQ(different, 0u) << "shift " << shift << ", " << count << " columns";
    }
  }
};

TEST_P(LayoutTest, GridFloat) { expect_equal_layouts<float>(); }
TEST_P(LayoutTest, GridDouble) { expect_equal_layouts<double>(); }
TEST_P(LayoutTest, ScatteredFloat) { expect_equal_scattered_layouts<float>(); }
TEST_P(LayoutTest, ScatteredDouble) { expect_equal_scattered_layouts<double>(); }
TEST_P(LayoutTest, AlignmentsFloat) { expect_equal_alignments<float>(); }
TEST_P(LayoutTest, AlignmentsDouble) { expect_equal_alignments<double>(); }
TEST_P(LayoutTest, GroupsFloat) { expect_equal_groups<float>(); }
TEST_P(LayoutTest, GroupsDouble) { expect_equal_groups<double>(); }
TEST_P(LayoutTest, LanesFloat) { expect_equal_lanes<float>(); }
TEST_P(LayoutTest, LanesDouble) { expect_equal_lanes<double>(); }
INSTANTIATE_FOR_EVERY_ISA(LayoutTest);

} // namespace
} // namespace simdbezier::tests::layout_bits_test
