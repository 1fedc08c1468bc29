// Outputs that share memory are refused before anything is written; those that only look as if they
// did are not.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/output/arena.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::overlap_test {
namespace {

struct OverlapCase {
  const char* name;
  Status status;
  Set set;
};
void PrintTo(const OverlapCase& item, std::ostream* out) { *out << item.name; }

std::vector<OverlapCase> overlap_cases() {
  return {
      {"SamePlaneTwice", kRefused,
       [](Arena& a, auto& out) { out.position = V::planes(a.at(0), a.at(0), a.at(N)); }},
      {"SamePlaneInTwoGroups", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(0), a.at(N), a.at(2 * N));
         out.duv = V::planes(a.at(3 * N), a.at(4 * N), a.at(N));
       }},
      {"SamePlaneAroundOnePastTheEndOfMemory", kRefused,
       [](Arena& a, auto& out) {
         auto* const last = reinterpret_cast<decltype(a.at(0))>(~std::uintptr_t{0} - 15);
         out.position = V::planes(a.at(0), last, a.at(0));
       }},
      {"PlanesOneTooClose", kRefused,
       [](Arena& a, auto& out) { out.du = V::planes(a.at(0), a.at(N - 1), a.at(2 * N)); }},
      {"PlanesOneTooCloseBelow", kRefused,
       [](Arena& a, auto& out) { out.dv = V::planes(a.at(N - 1), a.at(3 * N), a.at(0)); }},
      {"PlanesShiftedByOne", kRefused,
       [](Arena& a, auto& out) { out.dvv = V::planes(a.at(0), a.at(1), a.at(500)); }},
      {"MembersSharingOneElement", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(2), 6);
       }},
      {"MembersSharingAllElements", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(6), 6); // one vertex on
       }},
      {"MemberReachingIntoTheNextVertex", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(4), 6);
       }},
      {"BackwardMembersSharingOneElement", kRefused,
       [](Arena& a, auto& out) {
         out.duu = V::xyz(a.at(1000), -6);
         out.dvv = V::xyz(a.at(1004), -6);
       }},
      {"DifferentStrides", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(3), 12);
       }},
      {"StridesOfBothSigns", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(6 * (N - 1) + 3), -6);
       }},
      {"PlaneThroughVertices", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 8);
         out.du = V::planes(a.at(100), a.at(1000), a.at(1100));
       }},
      {"StatusInAPlane", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(0), a.at(N), a.at(2 * N));
         out.status = a.status_at(a.at(2 * N));
       }},
      {"StatusOnTheLastByteOfAPlane", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(0), a.at(N), a.at(2 * N));
         out.status = a.status_at(a.at(3 * N)) - 1;
       }},
      {"StatusEndingInAPlane", kRefused,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(100), a.at(200), a.at(300));
         out.status = a.status_at(a.at(100)) - N + 1;
       }},

      {"Vertices", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 8);
         out.normal = V::xyz(a.at(3), 8);
       }},
      {"VerticesOfAllMembers", Status::ok,
       [](Arena& a, auto& out) {
         for (std::size_t g = 0; g < kVectorGroups; ++g) {
           *groups_of(out)[6 - g] = V::xyz(a.at(static_cast<std::ptrdiff_t>(3 * g)), 21);
         }
       }},
      {"MembersOfLaterVertices", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0), 6);
         out.normal = V::xyz(a.at(3 + 12), 6);
       }},
      {"ComponentsInAnotherOrder", Status::ok,
       [](Arena& a, auto& out) {
         out.position = {a.at(5), a.at(1), a.at(3), 6};
         out.du = {a.at(0), a.at(2), a.at(4), 6};
       }},
      {"PlanesThatTouch", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(N), a.at(0), a.at(2 * N));
         out.dvv = V::planes(a.at(5 * N), a.at(4 * N), a.at(3 * N));
         out.status = a.status_at(a.at(6 * N));
       }},
      {"StatusThatTouchesFromBelow", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::planes(a.at(100), a.at(200), a.at(300));
         out.status = a.status_at(a.at(100)) - N;
       }},
      {"TriplesThatTouch", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(0));
         out.duv = V::xyz(a.at(3 * N));
         out.normal = V::xyz(a.at(6 * N), 4);
       }},
      {"BackwardsApart", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(3 * (N - 1)), -3);
         out.du = V::xyz(a.at(3 * N), 3);
         out.dv = {a.at(7 * N - 1), a.at(8 * N - 1), a.at(9 * N - 1), -1};
       }},
      {"BackwardVertices", Status::ok,
       [](Arena& a, auto& out) {
         out.position = V::xyz(a.at(6 * (N - 1)), -6);
         out.normal = V::xyz(a.at(6 * (N - 1) + 3), -6);
       }},

      {"TriplesOfStrideZero", Status::bad_stride,
       [](Arena& a, auto& out) { out.position = V::xyz(a.at(0), 0); }},
      {"TriplesOfStrideOne", Status::bad_stride,
       [](Arena& a, auto& out) { out.duu = V::xyz(a.at(0), 1); }},
      {"TriplesOfStrideTwo", Status::bad_stride,
       [](Arena& a, auto& out) { out.dvv = V::xyz(a.at(0), 2); }},
      {"TriplesOfStrideMinusTwo", Status::bad_stride,
       [](Arena& a, auto& out) { out.normal = V::xyz(a.at(500), -2); }},
      {"PlanesOfStrideZero", Status::bad_stride,
       [](Arena& a, auto& out) {
         out.duv = {a.at(0), a.at(N), a.at(2 * N), 0};
       }},
      {"HugeStride", Status::size_overflow,
       [](Arena& a, auto& out) {
         out.dvv = V::xyz(a.at(0), std::numeric_limits<std::ptrdiff_t>::max() / 8);
       }},
      {"HugeNegativeStride", Status::size_overflow,
       [](Arena& a, auto& out) {
         out.duu = V::xyz(a.at(0), std::numeric_limits<std::ptrdiff_t>::min());
       }},
  };
}

class OverlapTest : public ::testing::TestWithParam<OverlapCase> {};

TEST_P(OverlapTest, OnGrids) { expect_status(GetParam().status, GetParam().set, run_grid); }
TEST_P(OverlapTest, OnSamples) { expect_status(GetParam().status, GetParam().set, run_samples); }
TEST_P(OverlapTest, OnPatchGrids) {
  expect_status(GetParam().status, GetParam().set, run_patch_grids);
}
INSTANTIATE_TEST_SUITE_P(All, OverlapTest, ::testing::ValuesIn(overlap_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

// With one sample strides mean nothing, and only equal places are shared.
TEST(Overlap, OneSample) {
  const auto one = [](Arena& arena, const Outputs<float>& out) {
    const Grid<float> grid{1, 1, arena.at(3000), arena.at(3100), Parameters::unit, {0, 1}};
    return evaluate(patches(), grid, out);
  };
  const auto one_scattered = [](Arena& arena, const Outputs<float>& out) {
    Samples<float> samples = arena.samples;
    samples = {samples.patch.first(1), samples.u.first(1), samples.v.first(1)};
    return evaluate(patches(), samples, out);
  };
  const Set apart = [](Arena& a, Outputs<float>& out) {
    out.position = V::xyz(a.at(0), 1);
    out.du = V::xyz(a.at(3), -2);
    out.normal = V::planes(a.at(8), a.at(6), a.at(7));
  };
  const Set shared = [](Arena& a, Outputs<float>& out) {
    out.position = V::xyz(a.at(0), 6);
    out.du = V::xyz(a.at(2), 7);
  };
  expect_status(Status::ok, apart, one);
  expect_status(Status::ok, apart, one_scattered);
  expect_status(kRefused, shared, one);
  expect_status(kRefused, shared, one_scattered);
}

} // namespace
} // namespace simdbezier::tests::overlap_test
