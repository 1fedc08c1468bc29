// Memory for the outputs of calls for curves, in blocks that end where they do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/blocks.hpp"
#include "tests/reliability/fuzz/checks/require.hpp"

namespace simdbezier::fuzz {

/// [group][component][sample] in blocks of their own: position, d1, d2, tangent.
template <typename T>
class CurveMemory {
public:
  CurveMemory(std::uint8_t groups, bool curvature, std::size_t dimension, std::size_t samples,
              Placement place, bool packed)
      : dimension_(dimension), samples_(samples), packed_(packed),
        curvature_(curvature ? samples : 0, place, kUntouched), status_(samples, place) {
    for (std::size_t g = 0; g < 4; ++g) {
      blocks_.emplace_back((groups >> g & 1) != 0 ? samples * dimension : 0, place, kUntouched);
      if ((groups >> g & 1) != 0) {
        T* const first = blocks_.back().data();
        const std::size_t step = packed ? 1 : samples;
        out_[static_cast<CurveOutput>(g)] = {first, dimension > 1 ? first + step : nullptr,
                                             dimension > 2 ? first + 2 * step : nullptr,
                                             static_cast<std::ptrdiff_t>(packed ? dimension : 1)};
      }
    }
    out_.curvature = curvature ? curvature_.data() : nullptr;
    out_.status = status_.data();
  }

  [[nodiscard]] const CurveOutputs<T>& out() const { return out_; }
  [[nodiscard]] bool wanted(std::size_t g) const { return blocks_[g].size() > 0; }
  [[nodiscard]] T value(std::size_t g, std::size_t c, std::size_t k) const {
    return blocks_[g].data()[packed_ ? k * dimension_ + c : c * samples_ + k];
  }
  [[nodiscard]] SampleStatus status(std::size_t k) const { return status_.data()[k]; }

  void require_same(std::size_t k, const CurveMemory& other, std::size_t to,
                    const std::string& what) const {
    bool same = status(k) == other.status(to);
    for (std::size_t g = 0; g < 4; ++g) {
      for (std::size_t c = 0; c < dimension_ && wanted(g); ++c) {
        same = same && same_bits(value(g, c, k), other.value(g, c, to));
      }
    }
    if (out_.curvature.wanted()) {
      same = same && same_bits(curvature_.data()[k], other.curvature_.data()[to]);
    }
    require(same, [&] { return what + ": other bits at sample " + std::to_string(k); });
  }
  void check_surroundings() const {
    for (const Block<T>& block : blocks_) {
      block.check_surroundings();
    }
    curvature_.check_surroundings();
    status_.check_surroundings();
  }

private:
  static constexpr T kUntouched = T(-7.7e7);

  std::size_t dimension_;
  std::size_t samples_;
  bool packed_;
  std::vector<Block<T>> blocks_;
  Block<T> curvature_;
  Block<SampleStatus> status_;
  CurveOutputs<T> out_;
};

} // namespace simdbezier::fuzz
