// Normals, their statuses and curvatures where du x dv vanishes, against exact Taylor coefficients:
// every call, type, form of weights and choice of origins on every instruction set.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>

#include "tests/properties/limits/known_normals.hpp"
#include "tests/properties/limits/limit_tally.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/oracle/oracle_arithmetic.hpp"

namespace simdbezier::tests::normal_limits_test {
namespace {

constexpr std::size_t kGridOfNet = kLimitGrid * kLimitGrid;

/// Made once for all instruction sets.
[[nodiscard]] const std::vector<LimitNet>& cases_of(LimitTypes types) {
  static std::map<int, std::vector<LimitNet>> made;
  const int key = (types.values_double ? 1 : 0) + (types.points_double ? 2 : 0);
  auto [place, isNew] = made.try_emplace(key);
  if (isNew) {
    place->second = limit_nets(types, limit_net_count(), 71 + static_cast<std::uint64_t>(key));
  }
  return place->second;
}

template <typename T>
[[nodiscard]] FoundDirection found_at(const Planes<T>& planes, std::size_t k) {
  FoundDirection found;
  for (std::size_t c = 0; c < 3; ++c) {
    found.direction[c] = static_cast<double>(planes.at(3, c, k));
  }
  found.status = planes.status()[k];
  if (planes.wanted().curvature) {
    found.nan_curvatures = 0;
    for (std::size_t which = 0; which < 4; ++which) {
      found.nan_curvatures += std::isnan(planes.curvature(which, k)) ? 1 : 0;
    }
  }
  return found;
}

constexpr double kAway[] = {3, -2, 1.5};

/// The nets from which kAway can be subtracted exactly, so that they stay what they are.
[[nodiscard]] std::vector<LimitNet> without_roundings(const std::vector<LimitNet>& nets) {
  std::vector<LimitNet> exact;
  std::copy_if(nets.begin(), nets.end(), std::back_inserter(exact), [](const LimitNet& entry) {
    const auto& points = entry.net.points;
    return !entry.net.homogeneous &&
           std::all_of(points.begin(), points.end(), [](const Vector3& point) {
             return two_sum(point[0], -kAway[0]).lo == 0 && two_sum(point[1], -kAway[1]).lo == 0 &&
                    two_sum(point[2], -kAway[2]).lo == 0;
           });
  });
  return exact;
}

class NormalLimits : public IsaTest {
protected:
  template <typename T, typename S>
  void judge(const char* title) {
    nets_ = &cases_of({sizeof(T) == 8, sizeof(S) == 8});
    tally_ = LimitTally(allowed_angles(sizeof(T) == 8));
    for (const bool origins : {false, true}) {
      const PatchSet<T> set = packed_from<T, S>({.local_origin = origins, .isa = isa()});
      judge_scattered(set);
      judge_grids(set);
      judge_tiles(set);
    }
    const std::vector<LimitNet> moved = without_roundings(*nets_);
    nets_ = &moved;
    const PatchSet<T> set =
        packed_from<T, S>({.relative_to = {kAway[0], kAway[1], kAway[2]}, .isa = isa()});
    judge_scattered(set);
    judge_grids(set);
    tally_.report(std::string(to_string(isa())) + ", " + title);
  }

  static constexpr Wanted kAll{true, true, true, true, true, true};
  static constexpr Wanted kNormals{false, false, true, true};

  template <typename T, typename S>
  [[nodiscard]] PatchSet<T> packed_from(const PackOptions& options) const {
    std::vector<Net> nets;
    for (const LimitNet& entry : *nets_) {
      nets.push_back(entry.net);
    }
    std::vector<std::vector<S>> points;
    std::vector<ControlNets<S>> entries;
    for (const Net& net : nets) {
      points.push_back(packed_points<S>(std::span(&net, 1)));
      entries.push_back(control_nets<S>(std::span(&net, 1), points.back()));
    }
    PatchSet<T> set;
    expect_packed(pack(std::span<const ControlNets<S>>(entries), set, options));
    return set;
  }

  template <typename T>
  void judge_scattered(const PatchSet<T>& set) {
    SampleArrays<T> arrays;
    for (std::size_t p = 0; p < nets_->size(); ++p) {
      for (const LimitSample& sample : (*nets_)[p].samples) {
        arrays.add(p, static_cast<T>(sample.x), static_cast<T>(sample.y));
      }
    }
    Planes<T> planes(arrays.patch.size(), kNormals);
    scattered(set, arrays.view(Parameters::centred), planes.outputs());
    std::size_t k = 0;
    for (const LimitNet& net : *nets_) {
      for (const LimitSample& sample : net.samples) {
        tally_.add(net, sample, found_at(planes, k++), "scattered");
      }
    }
  }

  template <typename T>
  void add_grid(const Planes<T>& planes, const char* call) {
    for (std::size_t p = 0; p < nets_->size(); ++p) {
      for (std::size_t k = 0; k < kGridOfNet; ++k) {
        tally_.add((*nets_)[p], (*nets_)[p].samples[k], found_at(planes, p * kGridOfNet + k), call);
      }
    }
  }

  template <typename T>
  void judge_grids(const PatchSet<T>& set) {
    Planes<T> whole(set.size() * kGridOfNet, kAll);
    grid(set, Grid<T>::uniform(kLimitGrid, kLimitGrid), whole.outputs());
    add_grid(whole, "grid");
    Planes<T> own(set.size() * kGridOfNet);
    const std::vector<std::uint32_t> n(set.size(), kLimitGrid);
    patch_grids(set, {n, n}, own.outputs());
    add_grid(own, "patch grids");
  }

  template <typename T>
  void judge_tiles(const PatchSet<T>& set) {
    Planes<T> planes(set.size() * kGridOfNet, kNormals);
    const Outputs<T> out = planes.outputs();
    std::mutex mutex;
    TileFormat format;
    format.outputs = {Output::normal, Output::status};
    tiles<T>(set, Grid<T>::uniform(kLimitGrid, kLimitGrid), format, [&](const Tile<T>& tile) {
      const std::lock_guard<std::mutex> lock(mutex);
      const std::size_t first = (tile.first_patch * kLimitGrid + tile.first_row) * kLimitGrid;
      for (std::size_t k = 0; k < tile.samples; ++k) {
        out.normal.x[first + k] = tile.out.normal.x[k];
        out.normal.y[first + k] = tile.out.normal.y[k];
        out.normal.z[first + k] = tile.out.normal.z[k];
        out.status[first + k] = tile.out.status[k];
      }
    });
    add_grid(planes, "tiles");
  }

  const std::vector<LimitNet>* nets_ = nullptr;
  LimitTally tally_{allowed_angles(false)};
};

TEST_P(NormalLimits, KnownNets) {
  std::vector<LimitNet> nets;
  for (const KnownNormal& known : known_normals()) {
    const SampleStatus status = known.order == 0  ? SampleStatus::regular
                                : known.order > 0 ? SampleStatus::limit
                                                  : SampleStatus::degenerate;
    nets.push_back(
        {known.name, known.net, 3, {{known.x, known.y, status, unit(known.direction), 1}}});
  }
  nets_ = &nets;
  tally_ = LimitTally(allowed_angles(true));
  judge_scattered(packed_from<double, double>({.isa = isa()}));
  tally_.report(std::string(to_string(isa())) + ", known nets");
}
TEST_P(NormalLimits, Float) { judge<float, float>("float"); }
TEST_P(NormalLimits, Double) { judge<double, double>("double"); }
TEST_P(NormalLimits, FloatFromDouble) { judge<float, double>("float from double"); }
INSTANTIATE_FOR_EVERY_ISA(NormalLimits);

} // namespace
} // namespace simdbezier::tests::normal_limits_test
