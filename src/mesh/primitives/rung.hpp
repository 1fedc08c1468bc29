// Where cells at a side of a patch begin and end, and fans between.
//
// A side and the row of inner points next to it are like the rails of a ladder: each cell lies
// between two rungs. It is a fan of the side's segments around the inner vertex of one rung, and a
// triangle of both vertices of the other rung and this inner vertex. A rung is kept in a register,
// so that a fan is a few shuffles and sums, however many triangles it has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace simdbezier::detail {

/// In which order fans name their vertices: that of cut_half() where the side is the first leg of
/// the fan's half, or the second.
struct FanOrder {
  bool side_first;
  bool turned;

  static constexpr int kApex = -1;

  /// Number k of the fan's numbers: the vertex so many steps along the side, or kApex.
  [[nodiscard]] constexpr int step(std::size_t k) const {
    const int triangle = static_cast<int>(k / 3);
    const std::size_t at = turned && k % 3 > 0 ? 3 - k % 3 : k % 3;
    if (side_first) {
      return at == 2 ? kApex : triangle + static_cast<int>(at);
    }
    // Only the first triangle has the corner of the half, and begins there.
    return triangle == 0 ? (at == 1 ? kApex : static_cast<int>(at / 2))
                         : (at == 0 ? kApex : triangle + (at == 1 ? 1 : 0));
  }
  /// Whether the other triangle of the cell ends with the side's vertex.
  [[nodiscard]] constexpr bool ends_at_side() const { return side_first != turned; }
};

/// The steps of a fan's numbers along an ascending side, and along a descending one.
template <typename Index>
struct FanSteps {
  alignas(16) Index ways[2][16];

  explicit constexpr FanSteps(FanOrder order) : ways{} {
    for (std::size_t k = 0; k < 16; ++k) {
      const int step = order.step(k) == FanOrder::kApex ? 0 : order.step(k);
      ways[0][k] = static_cast<Index>(step);
      ways[1][k] = static_cast<Index>(-step);
    }
  }
};
template <typename Index, bool kSideFirst, bool kTurned>
inline constexpr FanSteps<Index> kFanSteps(FanOrder{kSideFirst, kTurned});

/// A vertex of a side and one of the row of inner points next to it.
template <typename Index>
class Rung {
public:
  /// The most triangles of a fan in registers.
  static constexpr std::uint32_t kTogether = 4;
  /// The most segments of a cell that after() knows.
  static constexpr std::uint32_t kMostInTable = 63;

  Rung(std::uint32_t side, std::uint32_t inner)
      : lanes_(fill(static_cast<Index>(side), static_cast<Index>(inner))) {}

  /// The rung after a cell of n segments of a side whose numbers ascend or descend.
  [[nodiscard]] Rung after(std::uint32_t n, bool descending, const Rung& inner_step) const {
    Lanes steps;
    std::memcpy(&steps, kSteps.lanes[descending ? 1 : 0][n], sizeof steps);
    return Rung(lanes_ + steps + inner_step.lanes_);
  }

  /// Writes the first kTogether triangles of the fan that begins here, as 16 numbers at most,
  /// whether it has as many or not.
  template <bool kSideFirst, bool kTurned>
  void put_fan(bool descending, Index* to) const {
    const Index* const steps = kFanSteps<Index, kSideFirst, kTurned>.ways[descending ? 1 : 0];
    for_registers<kSideFirst, kTurned>(steps, to, std::make_index_sequence<kRegisters>());
  }
  /// Writes the other triangle of a cell whose fan begins at `start` and ends at `far`, and a
  /// register's further numbers.
  template <bool kEndsAtSide>
  static void put_other(const Rung& start, const Rung& far, Index* to) {
    constexpr std::size_t kSecond = kLanes;
    const Lanes triangle =
        kEndsAtSide ? pick(far.lanes_, start.lanes_, kAll, Picks<2, kSecond + 2, 3, kSecond + 3>())
                    : pick(far.lanes_, start.lanes_, kAll, Picks<1, 0, kSecond + 1, kSecond>());
    std::memcpy(to, &triangle, sizeof triangle);
  }
  [[nodiscard]] std::uint32_t side() const { return lanes_[0]; }
  [[nodiscard]] std::uint32_t inner() const { return lanes_[1]; }

private:
  typedef Index Lanes __attribute__((vector_size(16)));
  static constexpr std::size_t kLanes = 16 / sizeof(Index);
  static constexpr std::size_t kRegisters = (3 * kTogether + kLanes - 1) / kLanes;
  static constexpr auto kAll = std::make_index_sequence<kLanes>();
  template <std::size_t... kFrom>
  struct Picks {
    static constexpr std::size_t kLane[] = {kFrom...};
  };

  explicit Rung(Lanes lanes) : lanes_(lanes) {}

  /// Whether a lane holds the inner vertex: side, inner, inner, side, and so on, which is what
  /// put_other() likes.
  static constexpr bool is_inner(std::size_t lane) { return (lane + 1) / 2 % 2 != 0; }

  static Lanes fill(Index side, Index inner) {
    // As one value: left to itself, g++ moves and joins each lane.
    typedef std::uint64_t Words __attribute__((vector_size(16)));
    const Words both{side | std::uint64_t{inner} << 8 * sizeof(Index), 0};
    Lanes pair;
    std::memcpy(&pair, &both, sizeof pair);
    return pick(pair, pair, kAll, Picks<0, 1, 1, 0>());
  }
  template <std::size_t... kLane, typename Pick>
  static Lanes pick(Lanes a, Lanes b, std::index_sequence<kLane...>, Pick) {
    return __builtin_shufflevector(a, b, Pick::kLane[kLane % 4]...);
  }

  /// What after() adds.
  struct Steps {
    alignas(16) Index lanes[2][kMostInTable + 1][kLanes];

    constexpr Steps() : lanes{} {
      for (std::uint32_t n = 0; n <= kMostInTable; ++n) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          lanes[0][n][k] = static_cast<Index>(is_inner(k) ? 0 : n);
          lanes[1][n][k] = static_cast<Index>(is_inner(k) ? 0 : 0 - n);
        }
      }
    }
  };
  static constexpr Steps kSteps{};

  template <bool kSideFirst, bool kTurned, std::size_t kRegister, std::size_t... kLane>
  [[nodiscard]] Lanes spread(std::index_sequence<kLane...>) const {
    constexpr FanOrder kFan{kSideFirst, kTurned};
    return __builtin_shufflevector(
        lanes_, lanes_, (kFan.step(kRegister * kLanes + kLane) == FanOrder::kApex ? 1 : 0)...);
  }
  template <bool kSideFirst, bool kTurned, std::size_t... kRegister>
  void for_registers(const Index* steps, Index* to, std::index_sequence<kRegister...>) const {
    const auto put = [&](Lanes lanes, std::size_t k) {
      Lanes along;
      std::memcpy(&along, steps + k * kLanes, sizeof along);
      lanes += along;
      std::memcpy(to + k * kLanes, &lanes, sizeof lanes);
    };
    (put(spread<kSideFirst, kTurned, kRegister>(kAll), kRegister), ...);
  }

  Lanes lanes_;
};

} // namespace simdbezier::detail
