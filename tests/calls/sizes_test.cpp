// Memory that knows its size: room for one sample too few is refused, and nothing is written; room
// for all is enough. Counts that callers make room by are those of the calls.
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::sizes_test {
namespace {

constexpr std::size_t kPatches = 3;
constexpr auto kTooMany = std::numeric_limits<std::size_t>::max();
const std::uint32_t kSides[kPatches] = {4, 2, 5};
const std::size_t kGaps[kPatches] = {3, 30, 60};

[[nodiscard]] const PatchSet<float>& patches() {
  static const PatchSet<float> set = packed<float>(mixed_nets(kPatches));
  return set;
}
[[nodiscard]] CurveSet<float> pack_three_curves() {
  const std::vector<float> points = {0, 0, 0, 1, 2, 0, 2, 2, 1, 3, 0, 0, 0, 1, 0, 1, 1, 2,
                                     2, 0, 2, 3, 1, 1, 5, 5, 5, 6, 5, 4, 6, 6, 3, 7, 7, 2};
  CurveSet<float> set;
  expect_packed(pack(ControlCurves<float>::packed(points), set));
  return set;
}
[[nodiscard]] const CurveSet<float>& curves() {
  static const CurveSet<float> set = pack_three_curves();
  return set;
}

/// Memory for one output, of exactly the length asked for, between guards that must stay as they
/// are.
struct Room {
  static constexpr float kUntouched = -777;
  static constexpr auto kNoStatus = static_cast<SampleStatus>(77);
  std::vector<float> values = std::vector<float>(4096, kUntouched);
  std::vector<SampleStatus> statuses = std::vector<SampleStatus>(512, kNoStatus);

  [[nodiscard]] std::span<float> part(std::size_t first, std::size_t count) {
    return std::span(values).subspan(first, count);
  }
  [[nodiscard]] bool untouched() const {
    return values == std::vector<float>(values.size(), kUntouched) &&
           statuses == std::vector<SampleStatus>(statuses.size(), kNoStatus);
  }
};

/// Gives one output of a call room for `samples`; the others none, or what they need.
template <typename Out>
struct OutputCase {
  const char* name;
  std::function<void(Out&, Room&, std::size_t samples, std::size_t all)> set;
};

template <typename Out>
[[nodiscard]] std::vector<OutputCase<Out>> layout_cases(Vectors<float> Out::*member) {
  return {{"triples",
           [member](Out& out, Room& room, std::size_t n, std::size_t) {
             out.*member = Vectors<float>::xyz(room.part(0, 3 * n));
           }},
          {"vertices",
           [member](Out& out, Room& room, std::size_t n, std::size_t) {
             out.*member = Vectors<float>::xyz(room.part(2, n == 0 ? 0 : 7 * (n - 1) + 3), 7);
           }},
          {"short_y", [member](Out& out, Room& room, std::size_t n, std::size_t all) {
             out.*member = Vectors<float>::planes(room.part(0, all), room.part(1000, n),
                                                  room.part(2000, all));
           }}};
}

template <typename Out>
void add_one_value_cases(std::vector<OutputCase<Out>>& cases) {
  cases.push_back({"status", [](Out& out, Room& room, std::size_t n, std::size_t all) {
                     out.position = Vectors<float>::xyz(room.part(0, 3 * all));
                     out.status = std::span(room.statuses).first(n);
                   }});
}

[[nodiscard]] std::vector<OutputCase<Outputs<float>>> surface_cases() {
  using Out = Outputs<float>;
  std::vector<OutputCase<Out>> cases;
  for (const auto member :
       {&Out::position, &Out::du, &Out::dv, &Out::duu, &Out::duv, &Out::dvv, &Out::normal}) {
    for (const OutputCase<Out>& layout : layout_cases<Out>(member)) {
      cases.push_back(layout);
    }
  }
  add_one_value_cases(cases);
  for (const auto member : {&Curvatures<float>::gaussian, &Curvatures<float>::mean,
                            &Curvatures<float>::minimum, &Curvatures<float>::maximum}) {
    cases.push_back({"curvature", [member](Out& out, Room& room, std::size_t n, std::size_t) {
                       out.curvature.*member = room.part(0, n);
                     }});
  }
  return cases;
}

[[nodiscard]] std::vector<OutputCase<CurveOutputs<float>>> curve_cases() {
  using Out = CurveOutputs<float>;
  std::vector<OutputCase<Out>> cases;
  for (const auto member : {&Out::position, &Out::d1, &Out::d2, &Out::tangent}) {
    for (const OutputCase<Out>& layout : layout_cases<Out>(member)) {
      cases.push_back(layout);
    }
  }
  add_one_value_cases(cases);
  cases.push_back({"curvature", [](Out& out, Room& room, std::size_t n, std::size_t) {
                     out.curvature = room.part(0, n);
                   }});
  return cases;
}

/// `samples` is the room that the call needs by sample_count().
template <typename Set, typename Where, typename Out>
void expect_sizes(const char* call, const Set& set, const Where& where, std::size_t samples,
                  const std::vector<OutputCase<Out>>& cases) {
  ASSERT_EQ(sample_count(set, where), samples) << call;
  for (const OutputCase<Out>& c : cases) {
    SCOPED_TRACE(testing::Message() << call << ", " << c.name);
    for (const std::size_t room_for : {std::size_t{0}, samples - 1}) {
      Room room;
      Out out;
      c.set(out, room, room_for, samples);
      EXPECT_EQ(to_string(evaluate(set, where, out)), to_string(Status::output_too_small));
      EXPECT_TRUE(room.untouched());
    }
    Room room;
    Out out;
    c.set(out, room, samples, samples);
    EXPECT_EQ(to_string(evaluate(set, where, out)), to_string(Status::ok));
    EXPECT_FALSE(room.untouched());
  }
}

const std::uint32_t kIndex[] = {0, 2, 1, 1, 0};
const float kParameter[] = {0, 0.5F, 0.25F, 1, 0.75F};

TEST(Sizes, of_surfaces) {
  const auto cases = surface_cases();
  expect_sizes("grid", patches(), Grid<float>::uniform(4, 3), 36, cases);
  expect_sizes("range", patches(), Grid<float>::uniform(4, 3, {1, 1}), 12, cases);
  expect_sizes("patch grids", patches(), PatchGrids{kSides, kSides}, 16 + 4 + 25, cases);
  expect_sizes("with gaps", patches(), PatchGrids{kSides, kSides, kGaps}, 60 + 25, cases);
  expect_sizes("samples", patches(), Samples<float>{kIndex, kParameter, kParameter}, 5, cases);
}

TEST(Sizes, of_curves) {
  const auto cases = curve_cases();
  expect_sizes("grid", curves(), CurveGrid<float>::uniform(5), 15, cases);
  expect_sizes("range", curves(), CurveGrid<float>::uniform(5, {2}), 5, cases);
  expect_sizes("grids", curves(), CurveGrids{kSides}, 4 + 2 + 5, cases);
  expect_sizes("with gaps", curves(), CurveGrids{kSides, kGaps}, 65, cases);
  expect_sizes("samples", curves(), CurveSamples<float>{kIndex, kParameter}, 5, cases);
}

TEST(Sizes, of_derivatives) {
  const auto refuse = [](const auto& where, std::size_t samples) {
    for (const std::size_t missing : {1U, 0U}) {
      Room room;
      const PartialDerivative<float> wanted[] = {
          {1, 2, Vectors<float>::xyz(room.part(0, 3 * samples))},
          {3, 0, Vectors<float>::xyz(room.part(2000, 3 * (samples - missing)))}};
      EXPECT_EQ(to_string(evaluate_derivatives(patches(), where, wanted)),
                to_string(missing == 0 ? Status::ok : Status::output_too_small));
      EXPECT_EQ(room.untouched(), missing != 0);
    }
  };
  refuse(Grid<float>::uniform(4, 3), 36);
  refuse(Samples<float>{kIndex, kParameter, kParameter}, 5);
}

TEST(Sizes, lengths_that_differ) {
  Room room;
  Outputs<float> out;
  out.position = Vectors<float>::xyz(room.values);
  const std::span<const std::uint32_t> index(kIndex);
  const std::span<const float> t(kParameter);
  for (const Samples<float>& samples :
       {Samples<float>{index.first(4), t, t}, {index, t.first(4), t}, {index, t, t.first(4)}}) {
    EXPECT_EQ(evaluate(patches(), samples, out), Status::unequal_lengths);
    const PartialDerivative<float> wanted[] = {{1, 1, out.position}};
    EXPECT_EQ(evaluate_derivatives(patches(), samples, wanted), Status::unequal_lengths);
  }
  CurveOutputs<float> of_curve;
  of_curve.position = out.position;
  for (const CurveSamples<float>& samples :
       {CurveSamples<float>{index.first(4), t}, {index, t.first(4)}}) {
    EXPECT_EQ(evaluate(curves(), samples, of_curve), Status::unequal_lengths);
  }
  const CurveGrids grids{kSides, std::span(kGaps).first(2)};
  EXPECT_EQ(evaluate(curves(), grids, of_curve), Status::unequal_lengths);
  EXPECT_TRUE(room.untouched());
}

TEST(SampleCount, is_nothing_where_the_call_refuses) {
  EXPECT_EQ(sample_count(patches(), Grid<float>::uniform(4, 4, {4})), 0U);
  EXPECT_EQ(sample_count(patches(), Grid<float>::uniform(4, 4, {1, 3})), 0U);
  EXPECT_EQ(sample_count(PatchSet<float>{}, Grid<float>::uniform(4, 4)), 0U);
  EXPECT_EQ(sample_count(patches(), PatchGrids{kSides, kSides, {}, 1}), 0U);
  EXPECT_EQ(sample_count(patches(), PatchGrids{kSides, std::span(kSides).first(2)}), 0U);
  EXPECT_EQ(sample_count(curves(), CurveGrid<float>::uniform(4, {4})), 0U);
  EXPECT_EQ(sample_count(curves(), CurveGrids{kSides, std::span(kGaps).first(2)}), 0U);
}

TEST(SampleCount, is_too_many_where_it_overflows) {
  const std::size_t far[kPatches] = {0, 16, kTooMany - 3};
  const std::uint32_t dense[kPatches] = {~0U, ~0U, ~0U};
  EXPECT_EQ(sample_count(patches(), Grid<float>::uniform(kTooMany, 2)), kTooMany);
  EXPECT_EQ(sample_count(patches(), Grid<float>::uniform(kTooMany / 2, 1)), kTooMany);
  EXPECT_EQ(sample_count(patches(), Grid<float>::uniform(kTooMany / 2, 1, {0, 1})), kTooMany / 2);
  EXPECT_EQ(sample_count(patches(), PatchGrids{kSides, kSides, far}), kTooMany);
  EXPECT_EQ(sample_count(patches(), PatchGrids{dense, dense}), kTooMany);
  EXPECT_EQ(sample_count(curves(), CurveGrid<float>::uniform(kTooMany / 2)), kTooMany);
  EXPECT_EQ(sample_count(curves(), CurveGrids{kSides, far}), kTooMany);
}

TEST(LargestTile, is_the_largest_that_comes) {
  for (const std::size_t most : {0U, 1U, 20U, 36U, 1000U}) {
    const TileFormat format{.outputs = {Output::position, Output::normal}, .samples = most};
    const auto grid = Grid<float>::uniform(12, 5);
    std::size_t largest = 0;
    const auto look = [&](const Tile<float>& tile) { largest = std::max(largest, tile.samples); };
    ASSERT_EQ(evaluate_tiles(patches(), grid, format, look, {.threads = 1}), Status::ok);
    EXPECT_EQ(largest_tile(patches(), grid, format), largest) << most;
  }
  EXPECT_EQ(largest_tile(patches(), Grid<float>::uniform(1, 5), {}), 0U);
  // Nothing is formed to measure a grid: these parameters would fill 16 GiB.
  EXPECT_EQ(largest_tile(patches(), Grid<float>::uniform(2, 0xffff0000), {}), 2048U);
  EXPECT_EQ(largest_tile(patches(), Grid<float>::uniform(4, 4), {.outputs = {}}), 0U);
}

} // namespace
} // namespace simdbezier::tests::sizes_test
