// Scattered samples among others: a call for many gives each the bits of a call for it alone.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::scattered_test {
namespace {

constexpr std::size_t kPatches = 24;

// In what order samples name their patches -----------------------------------------------------

struct Pattern {
  const char* name;
  std::size_t (*patch)(std::size_t k, std::size_t hash);
};

/// Runs of 1, 2, … 40 samples of one patch, then again.
std::size_t growing_runs(std::size_t k, std::size_t /*hash*/) {
  std::size_t run = 1;
  std::size_t id = 0;
  for (std::size_t end = run; end <= k; ++id) {
    run = run % 40 + 1;
    end += run;
  }
  return id;
}

const Pattern kPatterns[] = {
    {"equal", [](std::size_t, std::size_t) { return std::size_t{5}; }},
    {"growing_runs", growing_runs},
    {"runs_of_64", [](std::size_t k, std::size_t) { return k / 64; }},
    {"descending", [](std::size_t k, std::size_t) { return kPatches - 1 - k % kPatches; }},
    {"alternating", [](std::size_t k, std::size_t) { return k % 2; }},
    {"last_differs", [](std::size_t k, std::size_t) { return std::size_t{k % 16 == 15}; }},
    {"random", [](std::size_t, std::size_t hash) { return hash; }},
};

// Whose samples they are -------------------------------------------------------------------------

struct Shape {
  Degrees degrees;
  Weights weights;
};

/// Bicubic ones; what has code of its own beside them; what lanes of powers do not fill, or several
/// times; and cells in one direction, and in both.
const Shape kShapes[] = {{{3, 3}, Weights::none},        {{3, 3}, Weights::cartesian},
                         {{3, 3}, Weights::homogeneous}, {{2, 1}, Weights::none},
                         {{5, 4}, Weights::cartesian},   {{3, 8}, Weights::none},
                         {{7, 6}, Weights::cartesian}};

// What is special about some parameters --------------------------------------------------------

enum Special { kInside, kOnEdges, kOutside, kNotFinite, kAll, kSpecials };
constexpr const char* kSpecialNames[] = {"inside", "edges", "outside", "not_finite", "all"};

double ordinary(std::size_t hash) { return (static_cast<double>(hash % 4093) + 0.5) / 4093; }

template <typename T>
T parameter(Special special, std::size_t hash) {
  const std::size_t kind = hash / 4093 % 7;
  const auto inside = static_cast<T>(ordinary(hash));
  if ((special == kOnEdges || special == kAll) && (kind < 2 || kind == 4)) {
    return kind == 4 ? T(0.5) : static_cast<T>(kind); // edges, also of cells
  }
  if ((special == kOutside || special == kAll) && kind == 2) {
    return inside * 3 - 1;
  }
  if ((special == kNotFinite || special == kAll) && kind == 3) {
    constexpr T kValues[] = {std::numeric_limits<T>::quiet_NaN(),
                             std::numeric_limits<T>::infinity(),
                             -std::numeric_limits<T>::infinity()};
    return kValues[hash % 3];
  }
  return inside;
}

template <typename T>
SampleArrays<T> make_samples(std::size_t count, const Pattern& pattern, Special special) {
  Random random(count + 1);
  const auto hash = [&] { return static_cast<std::size_t>(random.below(1U << 30)); };
  SampleArrays<T> samples;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t patch = pattern.patch(k, hash()) % kPatches;
    const T u = parameter<T>(special, hash());
    samples.add(patch, u, parameter<T>(special, hash()));
  }
  return samples;
}

// What is asked for ----------------------------------------------------------------------------

/// Bits of a set of groups, in the order of Outputs: position du dv duu duv dvv normal curvature.
constexpr unsigned kGroupSets[] = {0b0000001, 0b1000001, 0b0000111, 0b1000000, 0b0000010, 0b0000100,
                                   0b1111111, 0b0111000, 0b0010001, 0b1000100, 0b10000001};
constexpr std::size_t kGroups = 7;               // of vectors
constexpr std::size_t kPlanes = 3 * kGroups + 4; // and all curvatures

/// Planes of all groups, prefilled, and `kGuard` values behind each that must stay as they are.
template <typename T>
struct Results {
  static constexpr std::size_t kGuard = 17;
  static constexpr T kUntouched = T(-777);

  std::size_t count;
  std::vector<T> values;
  std::vector<SampleStatus> status;

  explicit Results(std::size_t samples)
      : count(samples), values(kPlanes * (samples + kGuard), kUntouched),
        status(samples + kGuard, static_cast<SampleStatus>(77)) {}

  T* plane(std::size_t index) { return values.data() + index * (count + kGuard); }

  Outputs<T> outputs(unsigned groups, std::size_t first = 0) {
    Outputs<T> out;
    Vectors<T>* const all[kGroups] = {&out.position, &out.du,  &out.dv,    &out.duu,
                                      &out.duv,      &out.dvv, &out.normal};
    for (std::size_t g = 0; g < kGroups; ++g) {
      if ((groups >> g & 1U) != 0) {
        *all[g] = Vectors<T>::planes(plane(3 * g) + first, plane(3 * g + 1) + first,
                                     plane(3 * g + 2) + first);
      }
    }
    if ((groups >> kGroups & 1U) != 0) {
      T* const at = plane(3 * kGroups) + first;
      const std::size_t step = count + kGuard;
      out.curvature = {at, at + step, at + 2 * step, at + 3 * step};
    }
    out.status = status.data() + first;
    return out;
  }

  /// The first sample in which two results differ, or count + kGuard.
  std::size_t first_difference(Results& other) {
    for (std::size_t k = 0; k < count + kGuard; ++k) {
      for (std::size_t p = 0; p < kPlanes; ++p) {
        if (!same_bits(plane(p)[k], other.plane(p)[k])) {
          return k;
        }
      }
      if (status[k] != other.status[k]) {
        return k;
      }
    }
    return count + kGuard;
  }
};

// Checks ---------------------------------------------------------------------------------------

template <typename T>
class Scattered : public IsaTest {
protected:
  void make_sets(const Shape& shape = kShapes[0]) {
    Random random(11);
    std::vector<Net> nets;
    for (std::size_t i = 0; i < kPatches; ++i) {
      Net net = i % 6 == 5 ? shaped_signs_net(shape.degrees, random)
                           : shaped_wave_net(shape.degrees, random);
      for (int k = 1; k <= shape.degrees.u && i == 3; ++k) { // a pole: a second look at normals
        net.at(0, k) = net.at(0, 0);
      }
      net = shape.weights == Weights::none ? net : weighted(net, 4, random);
      nets.push_back(shape.weights == Weights::homogeneous ? homogeneous(net) : net);
    }
    plain_ = packed<T>(nets);
    origins_ = packed<T>(nets, {.local_origin = true});
  }

  /// Each sample of a call against a call for it alone.
  void check(std::size_t count, const Pattern& pattern, Special special, unsigned groups,
             bool watertight, bool origins) {
    const PatchSet<T>& set = origins ? origins_ : plain_;
    const SampleArrays<T> samples = make_samples<T>(count, pattern, special);
    const Samples<T> all = samples.view(Parameters::unit);
    Options options;
    options.watertight = watertight;
    options.threads = 1;
    Results<T> together(count);
    scattered(set, all, together.outputs(groups), options);
    Results<T> alone(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Samples<T> one{all.patch.subspan(k, 1), all.u.subspan(k, 1), all.v.subspan(k, 1),
                           all.parameters};
      scattered(set, one, alone.outputs(groups, k), options);
    }
    EXPECT_EQ(together.first_difference(alone), count + Results<T>::kGuard)
        << count << " samples, " << pattern.name << ", " << kSpecialNames[special] << ", groups "
        << groups << (watertight ? ", watertight" : ", open") << (origins ? ", origins" : "");
  }

  void check_all(const Shape& shape) {
    const std::size_t many = &shape == kShapes ? 1061 : 317;
    make_sets(shape);
    for (const Pattern& pattern : kPatterns) {
      for (std::size_t count = 1; count <= 100; ++count) {
        check(count, pattern, static_cast<Special>(count % kSpecials),
              kGroupSets[count % std::size(kGroupSets)], count % 3 != 0, count % 4 == 0);
      }
      for (const unsigned groups : kGroupSets) {
        for (int special = 0; special < kSpecials; ++special) {
          for (const bool watertight : {false, true}) {
            check(many, pattern, static_cast<Special>(special), groups, watertight, false);
          }
        }
        check(many, pattern, kAll, groups, true, true);
        check(many, pattern, kInside, groups, false, true);
      }
    }
  }

  void check_shapes() {
    for (const Shape& shape : kShapes) {
      SCOPED_TRACE("degrees " + std::to_string(shape.degrees.u) + " x " +
                   std::to_string(shape.degrees.v) + ", weights " +
                   std::to_string(static_cast<int>(shape.weights)));
      check_all(shape);
    }
  }

  /// One patch is larger than the others, whose normals must not change by that. Some samples, at
  /// most one in a register, are near poles, where normals take a second look or nearly do.
  void check_company_of(std::size_t large, double scale) {
    Random random(13);
    std::vector<Net> nets;
    std::vector<PatchSet<T>> single;
    for (std::size_t i = 0; i < kPatches; ++i) {
      nets.push_back(wave_net(random));
      for (Vector3& point : nets[i].points) {
        for (double& value : point) {
          value *= i == large ? scale : 1;
        }
      }
      for (int k = 1; k < 4; ++k) {
        nets[i].at(0, k) = nets[i].at(0, 0);
      }
      single.push_back(packed<T>({&nets[i], 1}));
    }
    SampleArrays<T> samples = make_samples<T>(4243, kPatterns[6], kInside);
    for (std::size_t k = 0; k < samples.v.size(); k += 17) {
      samples.v[k] = std::ldexp(samples.v[k], -static_cast<int>(k % 24));
    }
    const Samples<T> all = samples.view(Parameters::unit);
    Results<T> together(all.patch.size());
    scattered(packed<T>(nets), all, together.outputs(kGroupSets[1]));
    Results<T> alone(all.patch.size());
    constexpr std::uint32_t kFirst = 0;
    for (std::size_t k = 0; k < all.patch.size(); ++k) {
      const Samples<T> one{{&kFirst, 1}, all.u.subspan(k, 1), all.v.subspan(k, 1), all.parameters};
      scattered(single[all.patch[k]], one, alone.outputs(kGroupSets[1], k));
    }
    EXPECT_EQ(together.first_difference(alone), all.patch.size() + Results<T>::kGuard)
        << "patch " << large << " is " << scale << " times larger";
  }

  /// Calls of few samples without statuses, in each layout, have the bits of one call for all.
  void check_few() {
    make_sets();
    constexpr std::size_t kCount = 200;
    constexpr std::size_t kAfter = 4; // values that must stay as they are
    const SampleArrays<T> samples = make_samples<T>(kCount, kPatterns[1], kAll);
    const Samples<T> all = samples.view(Parameters::unit);
    for (const PatchSet<T>* set : {&plain_, &origins_}) {
      for (const unsigned groups : kGroupSets) {
        Results<T> together(kCount);
        scattered(*set, all, together.outputs(groups));
        for (std::size_t few = 1; few <= 17; ++few) {
          constexpr std::size_t kRecord = 3 * kGroups + 1; // of all groups, side by side
          for (const std::size_t stride :
               {std::size_t{0}, std::size_t{3}, std::size_t{7}, kRecord}) {
            const std::size_t first = few * 10;
            const std::size_t values = stride == 0 ? 3 * few : (few - 1) * stride + 3;
            const std::size_t apart = stride == kRecord ? 3 : values + kAfter; // of groups
            std::vector<T> memory(kGroups * apart + values + kAfter, Results<T>::kUntouched);
            std::vector<T> expected = memory;
            Outputs<T> out = together.outputs(groups); // which ones; their places are replaced
            out.status = {};
            out.curvature = {};
            for (std::size_t g = 0; g < kGroups; ++g) {
              T* const at = memory.data() + g * apart;
              Vectors<T>& to = out[static_cast<Output>(g)];
              if (to.wanted()) {
                to = stride == 0
                         ? Vectors<T>::planes(at, at + few, at + 2 * few)
                         : Vectors<T>{at, at + 1, at + 2, static_cast<std::ptrdiff_t>(stride), few};
              }
              for (std::size_t k = 0; (groups >> g & 1U) != 0 && k < 3 * few; ++k) {
                const std::size_t place = stride == 0 ? k : k % few * stride + k / few;
                expected[g * apart + place] = together.plane(3 * g + k / few)[first + k % few];
              }
            }
            Options options;
            options.isa = this->isa();
            ASSERT_EQ(evaluate(*set,
                               Samples<T>{all.patch.subspan(first, few), all.u.subspan(first, few),
                                          all.v.subspan(first, few), all.parameters},
                               out, options),
                      Status::ok);
            EXPECT_EQ(take_executed_isa(), this->isa());
            EXPECT_TRUE(std::equal(expected.begin(), expected.end(), memory.begin(), same_bits<T>))
                << few << " samples, stride " << stride << ", groups " << groups;
          }
        }
      }
    }
  }

  void check_companies() {
    for (const std::size_t large : {std::size_t{0}, std::size_t{15}, kPatches - 1}) {
      check_company_of(large, 2);    // one floor for all
      check_company_of(large, 1024); // none
    }
  }

  PatchSet<T> plain_;
  PatchSet<T> origins_;
};

using ScatteredF32 = Scattered<float>;
using ScatteredF64 = Scattered<double>;
INSTANTIATE_FOR_EVERY_ISA(ScatteredF32);
INSTANTIATE_FOR_EVERY_ISA(ScatteredF64);

TEST_P(ScatteredF32, samples_do_not_depend_on_their_company) { check_shapes(); }
TEST_P(ScatteredF64, samples_do_not_depend_on_their_company) { check_shapes(); }
TEST_P(ScatteredF32, few_samples_are_those_of_many) { check_few(); }
TEST_P(ScatteredF64, few_samples_are_those_of_many) { check_few(); }
TEST_P(ScatteredF32, normals_do_not_depend_on_other_patches) { check_companies(); }
TEST_P(ScatteredF64, normals_do_not_depend_on_other_patches) { check_companies(); }

/// Indices are checked before anything is written, wherever the bad one stands.
TEST(ScatteredIndices, one_bad_index_is_found_anywhere) {
  Random random(5);
  const std::vector<Net> nets(kPatches, wave_net(random));
  const PatchSet<float> set = packed<float>(nets);
  constexpr std::size_t kCount = 133;
  for (const std::uint32_t bad : {std::uint32_t{kPatches}, 0x7fffffffU, 0x80000000U, ~0U}) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{64}, kCount - 1}) {
      SampleArrays<float> samples = make_samples<float>(kCount, kPatterns[6], kInside);
      samples.patch[at] = bad;
      Results<float> results(kCount);
      EXPECT_EQ(
          to_string(evaluate(set, samples.view(Parameters::unit), results.outputs(kGroupSets[0]))),
          to_string(Status::bad_patch_index));
      EXPECT_EQ(results.values[0], Results<float>::kUntouched);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::scattered_test
