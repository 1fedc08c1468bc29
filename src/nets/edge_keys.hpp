// Hashes of the four edges of a patch, from one reading of its boundary.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <simdbezier/control_nets.hpp>

#include "src/nets/edge_values.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// A key for every control point of a net's boundary, and what follows from the keys of an edge.
/// Points that EdgeValues takes for the same have the same key; others hardly ever, unless they are
/// made to.
///
/// kDegree, kComponents: those of a net, in both directions, or 0 where they are known at run time
/// only. kWeighted: whether it may have weights.
template <typename S, int kDegree, int kComponents, bool kWeighted>
class EdgeKeys {
public:
  explicit EdgeKeys(const ControlNets<S>& nets) noexcept {
    for (std::size_t edge = 0; edge < kPatchEdges; ++edge) {
      const EdgeForm form(nets, static_cast<PatchEdge>(edge));
      first_[edge] = form.first;
      stride_[edge] = form.stride;
      degree_[edge] = form.degree;
      seed_[edge] = static_cast<std::uint64_t>(form.degree) * 64 +
                    static_cast<std::uint64_t>(form.components);
      components_ = form.components;
      component_stride_ = form.component_stride;
      weights_ = form.weights;
    }
  }

  void read(const S* net) noexcept {
    for (std::size_t far = 0; far < 2; ++far) {
      read_points(net, far, 0, degree(0) + 1);
      read_points(net, 2 + far, 1, degree(2));
    }
    for (std::size_t far = 0; far < 2; ++far) {
      keys_[2 + far][0] = keys_[0][far == 0 ? 0 : degree(0)];
      keys_[2 + far][degree(2)] = keys_[1][far == 0 ? 0 : degree(0)];
    }
  }

  /// Whether both ends have the same key.
  [[nodiscard]] bool may_be_closed(std::size_t edge) const noexcept {
    return keys_[edge][0] == keys_[edge][degree(edge)];
  }
  /// Whether the end has a smaller key than the beginning.
  [[nodiscard]] bool runs_against(std::size_t edge) const noexcept {
    return keys_[edge][degree(edge)] < keys_[edge][0];
  }
  /// The same whichever way the edge runs: points that change places then are taken together.
  [[nodiscard]] std::uint64_t hash(std::size_t edge) const noexcept {
    std::uint64_t state = seed_[edge];
    for (std::ptrdiff_t k = 0; k <= degree(edge) / 2; ++k) {
      state = (state ^ keys_[edge][k] * keys_[edge][degree(edge) - k]) * 0xff51afd7ed558ccdULL;
    }
    state = (state ^ state >> 33) * 0xc4ceb9fe1a85ec53ULL;
    return state ^ state >> 33;
  }

private:
  [[nodiscard]] std::ptrdiff_t degree(std::size_t edge) const noexcept {
    return kDegree > 0 ? kDegree : degree_[edge];
  }

  void read_points(const S* net, std::size_t edge, std::ptrdiff_t begin,
                   std::ptrdiff_t end) noexcept {
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      keys_[edge][k] = key_of(net + first_[edge] + k * stride_[edge]);
    }
  }
  [[nodiscard]] std::uint64_t key_of(const S* point) const noexcept {
    const std::ptrdiff_t components = kComponents > 0 ? kComponents : components_;
    std::uint64_t key = 0;
    for (std::ptrdiff_t c = 0; c < components; ++c) {
      key = with_value(key, point[c * component_stride_]);
    }
    if (kWeighted && weights_ != Weights::none) {
      const S weight = point[components * component_stride_];
      if (weight != 1) { // where it is 1, its form does not matter either
        key = with_value(key, weight) + static_cast<std::uint64_t>(weights_);
      }
    }
    return key | 1; // products by odd numbers keep what the other factor is
  }
  [[nodiscard]] static std::uint64_t with_value(std::uint64_t key, S value) noexcept {
    std::uint64_t bits = compared_bits(value);
    if constexpr (sizeof(S) == 8) {
      bits = std::rotl(bits, 32); // the low half of round numbers is 0, and would be of products
    }
    return (key + bits) * 0x9e3779b97f4a7c15ULL;
  }

  std::ptrdiff_t first_[kPatchEdges]; ///< as in EdgeForm
  std::ptrdiff_t stride_[kPatchEdges];
  std::ptrdiff_t degree_[kPatchEdges];
  std::ptrdiff_t component_stride_;
  std::ptrdiff_t components_;
  Weights weights_;
  std::uint64_t seed_[kPatchEdges];
  std::uint64_t keys_[kPatchEdges][kMostOrder]; ///< [edge][point]
};

/// Calls use(keys) with those of a view.
template <typename S, typename Use>
void with_keys(const ControlNets<S>& nets, const Use& use) {
  if (nets.degree_u != 3 || nets.degree_v != 3 || nets.components != 3) {
    use(EdgeKeys<S, 0, 0, true>(nets));
  } else if (nets.weights != Weights::none) {
    use(EdgeKeys<S, 3, 3, true>(nets));
  } else {
    use(EdgeKeys<S, 3, 3, false>(nets));
  }
}

} // namespace simdbezier::detail
