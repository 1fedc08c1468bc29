// Tables for fast/small_grids.hpp: in which lane of which register a sample of a small grid is
// computed.
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/outputs.hpp>

#include "kernels/simd/vector.hpp"
#include "src/storage/bicubic_layout.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples between edges that four groups, or four lanes of a group, have room for.
constexpr std::size_t kMostInner = 4;
constexpr std::size_t kLeastSmall = 1 + 2;
constexpr std::size_t kMostSmall = kMostInner + 2;

/// A code for every sample, row after row: 16 times the register plus the lane (see Assembly).
/// Registers are inner, border and a third one:
///   of positions     four corners, in each group
///   of derivatives   du at inner row r of edge u = 0, 1: group 0, 1, lane r; and tangents of the
///                    edges at their ends: group 2 at the first one, 3 at the second, lane e
class SmallGridSources {
public:
  static constexpr std::size_t kRegisters = (kMostSmall * kMostSmall + 15) / 16;

  constexpr SmallGridSources() = default;
  constexpr SmallGridSources(Output output, std::size_t nu, std::size_t nv) {
    for (std::size_t j = 0; j < nv; ++j) {
      for (std::size_t i = 0; i < nu; ++i) {
        codes_[j * nu + i] = static_cast<std::uint8_t>(code(output, i, nu, j, nv));
      }
    }
  }
  [[nodiscard]] constexpr const std::uint8_t* of_register(std::size_t k) const {
    return codes_ + 16 * k;
  }

private:
  static constexpr std::size_t kBorder = 16;
  static constexpr std::size_t kThird = 32;

  static constexpr std::size_t lane(std::size_t group, std::size_t in_group) {
    return 4 * group + in_group;
  }
  static constexpr std::size_t code(Output output, std::size_t i, std::size_t nu, std::size_t j,
                                    std::size_t nv) {
    const bool on_u = i == 0 || i + 1 == nu;
    const bool on_v = j == 0 || j + 1 == nv;
    const std::size_t u = i == 0 ? 0 : 1; // which of the two edges
    const std::size_t v = j == 0 ? 0 : 1;
    if (on_u && on_v) {
      return kThird + (output == Output::position ? detail::corner_index(u, v)
                       : output == Output::du     ? lane(2 + u, detail::kEdgeV0 + v)
                                                  : lane(2 + v, detail::kEdgeU0 + u));
    }
    if (on_u && output == Output::du) {
      return kThird + lane(u, j - 1);
    }
    return on_u   ? kBorder + lane(j - 1, detail::kEdgeU0 + u)
           : on_v ? kBorder + lane(i - 1, detail::kEdgeV0 + v)
                  : lane(i - 1, j - 1);
  }

  std::uint8_t codes_[16 * kRegisters] = {};
};

/// The tables of one size.
struct SmallGridTables {
  SmallGridSources position;
  SmallGridSources du;
  SmallGridSources dv;
};

/// The tables of all sizes.
class SmallGridSizes {
public:
  constexpr SmallGridSizes() {
    for (std::size_t nv = kLeastSmall; nv <= kMostSmall; ++nv) {
      for (std::size_t nu = kLeastSmall; nu <= kMostSmall; ++nu) {
        tables_[nv - kLeastSmall][nu - kLeastSmall] = {
            {Output::position, nu, nv}, {Output::du, nu, nv}, {Output::dv, nu, nv}};
      }
    }
  }
  [[nodiscard]] constexpr const SmallGridTables& of(std::size_t nu, std::size_t nv) const {
    return tables_[nv - kLeastSmall][nu - kLeastSmall];
  }

private:
  SmallGridTables tables_[kMostInner][kMostInner];
};

inline constexpr SmallGridSizes kSmallGrids;

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
