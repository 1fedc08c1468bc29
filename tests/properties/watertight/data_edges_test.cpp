// Every edge that two patches of a real model share bit-exactly is bit-exact in the output.
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/data_files.hpp"

namespace simdbezier::tests::data_edges_test {
namespace {

/// A file and how many pairs of edges it holds that are equal bit for bit and not collapsed, also
/// in float (the data's SOURCES.md counts sides, so twice as many). With fewer pairs the test
/// would miss a part of the model.
struct DataCase {
  const char* file;
  std::size_t least_pairs;
};

constexpr DataCase kDataCases[] = {{"teapot.bpt", 52},
                                   {"teapot28.bez", 44},
                                   {"teacup.bez", 46},
                                   {"teaspoon.bez", 28},
                                   {"gumbo.bez", 247},
                                   {"wavy_cube.bez", 12},
                                   {"sphere_lying_count.bez", 12},
                                   {"bigguy.bez.gz", 3977},
                                   {"pawn2.bez.gz", 1346},
                                   {"car4.bez.gz", 16013}};

struct Side {
  std::size_t patch = 0;
  Placement place;
};

/// Sides by their control points, in the lesser of the two directions.
template <typename T>
using SideMap = std::map<std::array<T, 12>, std::vector<Side>>;

template <typename T>
[[nodiscard]] std::array<T, 12> side_key(Net& net, Placement place) {
  std::array<T, 12> key;
  for (int k = 0; k <= 3; ++k) {
    const Vector3& point = side_point(net, place.side, place.reversed ? 3 - k : k);
    for (std::size_t c = 0; c < 3; ++c) {
      key[3 * static_cast<std::size_t>(k) + c] = static_cast<T>(point[c]) + T(0);
    }
  }
  return key;
}

template <typename T>
[[nodiscard]] SideMap<T> sides_of(std::vector<Net>& nets) {
  SideMap<T> sides;
  for (std::size_t p = 0; p < nets.size(); ++p) {
    for (int side = 0; side < 4; ++side) {
      const auto forward = side_key<T>(nets[p], {side, false});
      const auto backward = side_key<T>(nets[p], {side, true});
      const bool reversed = backward < forward;
      sides[reversed ? backward : forward].push_back({p, {side, reversed}});
    }
  }
  return sides;
}

[[nodiscard]] bool is_collapsed(Net& net, Placement place) {
  return side_point(net, place.side, 0) == side_point(net, place.side, 1) &&
         side_point(net, place.side, 0) == side_point(net, place.side, 2) &&
         side_point(net, place.side, 0) == side_point(net, place.side, 3);
}

class DataEdgesTest : public IsaTest {
protected:
  template <typename T>
  void expect_exact(const DataCase& data, std::size_t n) {
    std::vector<Net> nets = data_nets(data.file);
    if (nets.empty()) {
      GTEST_SKIP() << "no " << data.file << " in " << SIMDBEZIER_SHARED_DATA;
    }
    Planes<T> planes(nets.size() * n * n);
    grid(packed<T>(nets), Grid<T>::uniform(n, n), planes.outputs());
    std::size_t pairs = 0;
    std::size_t different = 0;
    for (const auto& [key, sides] : sides_of<T>(nets)) {
      const Side& first = sides.front();
      for (std::size_t s = 1; s < sides.size(); ++s) {
        pairs += is_collapsed(nets[first.patch], first.place) ? 0 : 1;
        different += differing_samples(planes, first, sides[s], n);
      }
    }
    EXPECT_GE(pairs, data.least_pairs) << data.file;
    EXPECT_EQ(different, 0u) << data.file << ", " << pairs << " pairs of edges";
    EXPECT_EQ(std::count_if(planes.values().begin(), planes.values().end(),
                            [](T value) { return value != value; }),
              0)
        << "NaN in " << data.file;
  }

  template <typename T>
  [[nodiscard]] static std::size_t differing_samples(const Planes<T>& planes, const Side& a,
                                                     const Side& b, std::size_t n) {
    std::size_t different = 0;
    for (std::size_t t = 0; t < n; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const T first = planes.at(0, c, a.patch * n * n + side_sample(a.place, t, n, n));
        const T second = planes.at(0, c, b.patch * n * n + side_sample(b.place, t, n, n));
        different += same_bits(first, second) ? 0 : 1;
      }
    }
    return different;
  }
};

TEST_P(DataEdgesTest, ExactFloat) {
  for (const DataCase& data : kDataCases) {
    expect_exact<float>(data, 16);
    expect_exact<float>(data, 9);
  }
}
TEST_P(DataEdgesTest, ExactDouble) {
  for (const DataCase& data : kDataCases) {
    expect_exact<double>(data, 11);
  }
}
INSTANTIATE_FOR_EVERY_ISA(DataEdgesTest);

} // namespace
} // namespace simdbezier::tests::data_edges_test
