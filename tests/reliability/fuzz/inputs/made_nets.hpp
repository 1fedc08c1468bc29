// Control nets from bytes, side by side or strided in any way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/blocks.hpp"
#include "tests/reliability/fuzz/inputs/values.hpp"

namespace simdbezier::fuzz {

/// Nets of one shape, packed.
template <typename S>
struct Nets {
  int degree_u = 3;
  int degree_v = 3;
  int components = 3;
  Weights weights = Weights::none;
  std::size_t count = 1;
  bool moderate = true; ///< no overflow and no underflow is near
  std::vector<S> values;

  [[nodiscard]] bool rational() const { return weights != Weights::none; }
  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>(components) + (rational() ? 1 : 0);
  }
  [[nodiscard]] std::size_t points() const {
    return static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
  }
  [[nodiscard]] std::size_t values_per_patch() const { return points() * channels(); }
  [[nodiscard]] const S* point(std::size_t patch, int j, int i) const {
    const auto index = static_cast<std::size_t>(j * (degree_u + 1) + i);
    return values.data() + patch * values_per_patch() + index * channels();
  }
  [[nodiscard]] ControlNets<S> view() const {
    return ControlNets<S>::packed(values.data(), count, degree_u, degree_v, components, weights);
  }
};

/// All points of one side become its first one.
template <typename S>
void collapse(Nets<S>& nets, std::size_t patch, PatchEdge edge, bool with_weight) {
  const bool along_u = edge == PatchEdge::v0 || edge == PatchEdge::v1;
  const int j0 = edge == PatchEdge::v1 ? nets.degree_v : 0;
  const int i0 = edge == PatchEdge::u1 ? nets.degree_u : 0;
  const std::size_t kept = nets.channels() - (nets.rational() && !with_weight ? 1 : 0);
  for (int k = 1; k <= (along_u ? nets.degree_u : nets.degree_v); ++k) {
    const S* const to = nets.point(patch, along_u ? j0 : k, along_u ? k : i0);
    std::copy_n(nets.point(patch, j0, i0), kept, nets.values.begin() + (to - nets.values.data()));
  }
}

template <typename S>
[[nodiscard]] Nets<S> nets_of(ByteSource& bytes, int degree_u, int degree_v, int components,
                              Weights weights, std::size_t count) {
  Nets<S> nets{degree_u, degree_v, components, weights, count, true, {}};
  ValueSource<S> values(bytes);
  WeightSource<S> weight_values(bytes);
  nets.moderate = values.moderate() && (!nets.rational() || weight_values.moderate());
  for (std::size_t p = 0; p < count * nets.points(); ++p) {
    const S weight = nets.rational() ? weight_values.next() : S(1);
    for (int c = 0; c < components; ++c) {
      nets.values.push_back(values.next() * (weights == Weights::homogeneous ? weight : S(1)));
    }
    if (nets.rational()) {
      nets.values.push_back(weight);
    }
  }
  const std::uint8_t collapsed = bytes.byte(); // four sides, with or without the weight
  for (std::size_t e = 0; e < kPatchEdges; ++e) {
    for (std::size_t p = 0; (collapsed >> e & 1) != 0 && p < count; p += 2) {
      collapse(nets, p, static_cast<PatchEdge>(e), (collapsed & 16) == 0);
    }
  }
  return nets;
}

/// Degrees near 3, and all others as well.
[[nodiscard]] inline int degree(ByteSource& bytes) {
  static constexpr int kDegrees[] = {3, 3, 2, 1, 3, 4, 5, 6, 3, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  return bytes.pick(kDegrees);
}
[[nodiscard]] inline int components(ByteSource& bytes) {
  return bytes.rarely(80) ? bytes.between(1, kMostComponents) : 3;
}
[[nodiscard]] inline Weights weights(ByteSource& bytes) {
  return static_cast<Weights>(bytes.below(3));
}

template <typename S>
[[nodiscard]] Nets<S> any_nets(ByteSource& bytes, std::size_t most, int with_components) {
  const int u = degree(bytes);
  const int v = degree(bytes);
  const Weights form = weights(bytes);
  // Time should go into many inputs, not into large ones.
  constexpr std::size_t kValues = 6000;
  const auto each = static_cast<std::size_t>((u + 1) * (v + 1) * with_components);
  return nets_of<S>(bytes, u, v, with_components, form,
                    std::min(1 + bytes.below(most), kValues / each + 1));
}

/// The four directions of a view in some order of their strides, some of them backwards, with gaps.
struct Arrangement {
  std::size_t order[4] = {3, 2, 1, 0}; ///< patch, row, point, channel: the fastest first
  bool backwards[4] = {};
  std::size_t gap[4] = {}; ///< elements

  explicit Arrangement(ByteSource& bytes) {
    for (std::size_t k = 0; k < 4; ++k) {
      std::swap(order[k], order[k + bytes.below(4 - k)]);
      const std::uint8_t choice = bytes.byte();
      backwards[k] = (choice & 1) != 0;
      gap[k] = (choice & 14) == 14 ? choice / 16U : 0;
    }
  }
};

/// Room for nets with strides of any sign, in a block that ends where they do.
template <typename S>
class StridedNets {
public:
  static constexpr S kGap = std::numeric_limits<S>::quiet_NaN();

  StridedNets(const Nets<S>& like, const Arrangement& arrangement, Placement placement)
      : like_(like), extent_{like.count, static_cast<std::size_t>(like.degree_v + 1),
                             static_cast<std::size_t>(like.degree_u + 1), like.channels()},
        block_(lay_out(arrangement), placement, kGap) {}

  void fill(const std::vector<S>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      block_.data()[place(k)] = values[k];
    }
  }
  [[nodiscard]] std::vector<S> values() const {
    std::vector<S> all(extent_[0] * extent_[1] * extent_[2] * extent_[3]);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k] = block_.data()[place(k)];
    }
    return all;
  }
  void check_surroundings() const { block_.check_surroundings(); }

  [[nodiscard]] MutableNets<S> view() const {
    return {block_.data() + origin_,
            like_.count,
            like_.degree_u,
            like_.degree_v,
            stride_[0],
            stride_[1],
            stride_[2],
            stride_[3],
            like_.components,
            like_.weights};
  }

private:
  // Sets strides and origin; returns the number of elements.
  std::size_t lay_out(const Arrangement& arrangement) {
    std::size_t span = 1;
    for (const std::size_t k : arrangement.order) {
      const std::size_t stride = span + arrangement.gap[k];
      const std::size_t reach = stride * (extent_[k] - 1);
      stride_[k] = static_cast<std::ptrdiff_t>(stride);
      if (arrangement.backwards[k]) {
        origin_ += static_cast<std::ptrdiff_t>(reach);
        stride_[k] = -stride_[k];
      }
      span += reach;
    }
    return span;
  }

  [[nodiscard]] std::ptrdiff_t place(std::size_t value) const {
    std::ptrdiff_t at = origin_;
    for (std::size_t k = 4; k-- > 0; value /= extent_[k]) {
      at += static_cast<std::ptrdiff_t>(value % extent_[k]) * stride_[k];
    }
    return at;
  }

  Nets<S> like_; // its values are not looked at
  std::size_t extent_[4];
  std::ptrdiff_t stride_[4] = {};
  std::ptrdiff_t origin_ = 0;
  Block<S> block_;
};

} // namespace simdbezier::fuzz
