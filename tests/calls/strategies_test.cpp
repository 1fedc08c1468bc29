// Every strategy of grids is taken by some call, and none of them changes a bit: each call is made
// once more without each of the strategies that it takes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/choice/strategies.hpp"
#include "tests/calls/grid_cases.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::strategies_test {
namespace {

using detail::GridStrategy;
using detail::StrategySet;

enum class Kind { position, normal, derivatives, second };
constexpr Kind kKinds[] = {Kind::position, Kind::normal, Kind::derivatives, Kind::second};

constexpr std::size_t kPatches = 37;
/// Of large grids, few are enough.
constexpr std::size_t patches_of(std::size_t samples) { return samples > 400 ? 3 : kPatches; }

/// Outputs of all patches on a grid, as planes or triples that begin a cache line, or one value
/// behind that.
template <typename T>
class Memory {
public:
  explicit Memory(std::size_t samples) : samples_(samples), values_(kVectors * 3 * plane() + 64) {}

  Outputs<T> outputs(Kind kind, bool triples, std::size_t behind) {
    Outputs<T> out;
    out.position = next(triples, behind);
    if (kind == Kind::normal) {
      out.normal = next(triples, behind);
    }
    if (kind == Kind::derivatives || kind == Kind::second) {
      (kind == Kind::second ? out.duu : out.du) = next(triples, behind);
      (kind == Kind::second ? out.dvv : out.dv) = next(triples, behind);
    }
    return out;
  }
  /// All values from the first line on.
  [[nodiscard]] std::vector<T> values() const {
    return {first(), first() + kVectors * 3 * plane()};
  }

private:
  static constexpr std::size_t kVectors = 3;
  static constexpr std::size_t kLine = 64 / sizeof(T);

  [[nodiscard]] std::size_t plane() const { return (samples_ + 2 * kLine) / kLine * kLine; }

  Vectors<T> next(bool triples, std::size_t behind) {
    T* const begin = values_.data() + (first() - values_.data()) + behind + taken_ * 3 * plane();
    ++taken_;
    return triples ? Vectors<T>::xyz(begin)
                   : Vectors<T>::planes(begin, begin + plane(), begin + 2 * plane());
  }
  [[nodiscard]] const T* first() const {
    const std::size_t off = reinterpret_cast<std::uintptr_t>(values_.data()) % 64 / sizeof(T);
    return values_.data() + (kLine - off) % kLine;
  }

  std::size_t samples_;
  std::vector<T> values_;
  std::size_t taken_ = 0;
};

/// Lets calls take every strategy again.
struct AllStrategies {
  AllStrategies() { static_cast<void>(detail::take_strategies()); }
  ~AllStrategies() { detail::allow_strategies(StrategySet::all()); }
};

class StrategiesTest : public IsaTest {
protected:
  template <typename T>
  void all_calls() {
    PatchSet<T> set;
    const auto points = values_of<T>(wavy_nets(kPatches));
    ASSERT_TRUE(pack(ControlNets<T>::packed(std::span<const T>(points), 3, 3, 3), set));
    constexpr std::size_t kSizes[][2] = {{2, 2},   {2, 5},   {6, 2},   {3, 6},   {4, 4},   {5, 5},
                                         {8, 8},   {9, 9},   {12, 20}, {16, 16}, {17, 17}, {32, 32},
                                         {33, 33}, {40, 24}, {64, 20}, {128, 64}};
    for (const auto& size : kSizes) {
      for (const Kind kind : kKinds) {
        for (const Destination where : {Destination::cache, Destination::memory}) {
          for (unsigned how = 0; how < 4; ++how) {
            compare(set, size[0], size[1], kind, where, how % 2 != 0, how / 2);
          }
        }
      }
    }
  }

  [[nodiscard]] StrategySet reached() const { return reached_; }

private:
  template <typename T>
  static std::vector<T> values_of(const std::vector<Net>& nets) {
    std::vector<T> values;
    for (const Net& net : nets) {
      for (const auto& point : net.points) {
        for (const double value : {point[0], point[1], point[2]}) {
          values.push_back(static_cast<T>(value));
        }
      }
    }
    return values;
  }

  template <typename T>
  StrategySet evaluate_into(Memory<T>& memory, const PatchSet<T>& set, std::size_t nu,
                            std::size_t nv, Kind kind, Destination where, bool triples,
                            std::size_t behind) {
    grid(set, Grid<T>::uniform(nu, nv), memory.outputs(kind, triples, behind),
         CallOptions{.threads = 1, .destination = where, .patch_count = patches_of(nu * nv)});
    return detail::take_strategies();
  }

  template <typename T>
  void compare(const PatchSet<T>& set, std::size_t nu, std::size_t nv, Kind kind, Destination where,
               bool triples, std::size_t behind) {
    const std::size_t samples = patches_of(nu * nv) * nu * nv;
    Memory<T> expected(samples);
    const StrategySet taken = evaluate_into(expected, set, nu, nv, kind, where, triples, behind);
    for (std::size_t k = 0; k + 1 < detail::kGridStrategies; ++k) {
      const auto strategy = static_cast<GridStrategy>(k);
      if (!taken.has(strategy)) {
        continue;
      }
      reached_.add(strategy);
      StrategySet others = StrategySet::all();
      others.remove(strategy);
      detail::allow_strategies(others);
      Memory<T> found(samples);
      const StrategySet without = evaluate_into(found, set, nu, nv, kind, where, triples, behind);
      detail::allow_strategies(StrategySet::all());
      EXPECT_FALSE(without.has(strategy)) << name(strategy);
      EXPECT_EQ(expected.values(), found.values())
          << "without " << name(strategy) << ": " << nu << " x " << nv << ", outputs "
          << static_cast<int>(kind) << (triples ? ", triples" : ", planes");
    }
  }

  static std::string name(GridStrategy strategy) {
    return std::string(detail::kGridStrategyNames[static_cast<std::size_t>(strategy)]);
  }

  AllStrategies all_;
  StrategySet reached_;
};

std::string names_of(StrategySet set) {
  std::string names;
  for (std::size_t k = 0; k < detail::kGridStrategies; ++k) {
    if (set.has(static_cast<GridStrategy>(k))) {
      names += (names.empty() ? "" : " ") + std::string(detail::kGridStrategyNames[k]);
    }
  }
  return names;
}

/// What an instruction set has. Rows are put together across lines only if stores across these are
/// slow, which SIMDBEZIER_SPLIT_STORES may say in the test's environment.
std::string strategies_of(Isa isa) {
  const char* const split = std::getenv("SIMDBEZIER_SPLIT_STORES");
  const bool slow = split != nullptr && std::string(split) == "slow";
  switch (isa) {
  case Isa::avx512:
    return std::string(
               "squares_of_four small_across small_groups streamed_order records squares bands ") +
           (slow ? "across_lines strips" : "strips");
  case Isa::avx2:
    return "small_across streamed_order records streamed_rows squares bands components strips";
  case Isa::scalar:
    return "strips";
  default:
    return "bands components strips";
  }
}

TEST_P(StrategiesTest, AllAreReachedAndHaveTheSameBits) {
  all_calls<float>();
  all_calls<double>();
  StrategySet found = reached();
  if (std::getenv("SIMDBEZIER_SPLIT_STORES") == nullptr) {
    found.remove(GridStrategy::across_lines); // as this machine's stores are
  }
  EXPECT_EQ(names_of(found), strategies_of(isa()));
}

INSTANTIATE_FOR_EVERY_ISA(StrategiesTest);

} // namespace
} // namespace simdbezier::tests::strategies_test
