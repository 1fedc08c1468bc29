// The values of a patch's edge, wherever they lie, and comparisons of them.
//
// Points without a weight, and those of weight 1 in either form, are the same where their
// coordinates are: evaluation multiplies and divides by 1 there, so that bits are equal as well.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/curves.hpp>

#include "src/nets/net_views.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {

template <typename S>
using BitsOf = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

/// A value by which control points are compared: its bits, -0 as +0.
template <typename S>
BitsOf<S> compared_bits(S value) noexcept {
  const auto bits = std::bit_cast<BitsOf<S>>(value);
  constexpr BitsOf<S> kSign = BitsOf<S>{1} << (8 * sizeof(S) - 1);
  return bits == kSign ? 0 : bits;
}

/// Where one edge lies in all nets of a view.
struct EdgeForm {
  std::ptrdiff_t first;  ///< its first point, from the first value of the patch
  std::ptrdiff_t stride; ///< from one point to the next
  std::ptrdiff_t component_stride;
  std::ptrdiff_t degree;
  std::ptrdiff_t components; ///< a weight, if there is one, stands behind them
  Weights weights;

  template <typename S>
  EdgeForm(const ControlNets<S>& nets, PatchEdge edge) noexcept
      : component_stride(nets.component_stride), components(nets.components),
        weights(nets.weights) {
    const ControlCurves<S> curves = boundary_curves(nets, edge);
    first = curves.points - nets.points;
    stride = curves.point_stride;
    degree = curves.degree;
  }
};

/// The values of one edge, in its own direction or against it.
template <typename S>
class EdgeValues {
public:
  EdgeValues() noexcept = default;
  EdgeValues(const EdgeForm& form, const S* net) noexcept
      : form_(&form), first_(net + form.first), stride_(form.stride) {}

  /// The edge from its other end on, or as it is.
  [[nodiscard]] EdgeValues turned(bool turn) const noexcept {
    // Without a branch, since neighbours run either way.
    const std::ptrdiff_t all = turn ? -1 : 0;
    EdgeValues edge = *this;
    edge.first_ += form_->degree * stride_ & all;
    edge.stride_ = (stride_ ^ all) - all;
    return edge;
  }

  /// Whether the other direction has the smaller bits where both first differ: for exactly one
  /// direction, or for none where both have the same values.
  [[nodiscard]] bool runs_against() const noexcept {
    const std::ptrdiff_t channels = form_->components + (is_polynomial() ? 0 : 1);
    for (std::ptrdiff_t k = 0; k <= form_->degree / 2; ++k) {
      for (std::ptrdiff_t c = 0; c < channels; ++c) {
        const auto forward = bits(k, c);
        const auto backward = bits(form_->degree - k, c);
        if (forward != backward) {
          return backward < forward;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool operator==(const EdgeValues& other) const noexcept {
    const EdgeForm& a = *form_;
    const EdgeForm& b = *other.form_;
    if (a.degree != b.degree || a.components != b.components) {
      return false;
    }
    // Edges that are compared are equal nearly always, and have the same zeros nearly always.
    const bool whole = a.component_stride == 1 && b.component_stride == 1 && a.components == 3 &&
                       a.weights == b.weights;
    return (whole && has_bytes_of(other)) || same_but_for_zeros(other);
  }

  /// Whether all points are one, whatever their weights. Values of homogeneous ones that are not
  /// finite are no points; others are compared by their bits.
  [[nodiscard]] bool collapsed() const noexcept {
    if (form_->weights == Weights::homogeneous) {
      return are_one_point(first_, stride_, static_cast<std::size_t>(form_->degree + 1),
                           static_cast<std::size_t>(form_->components), form_->component_stride,
                           Weights::homogeneous);
    }
    for (std::ptrdiff_t k = 1; k <= form_->degree; ++k) {
      for (std::ptrdiff_t c = 0; c < form_->components; ++c) {
        if (bits(k, c) != bits(0, c)) {
          return false;
        }
      }
    }
    return true;
  }

  void prefetch() const noexcept {
    __builtin_prefetch(first_);
    __builtin_prefetch(first_ + form_->degree * stride_);
  }

private:
  [[nodiscard]] bool is_polynomial() const noexcept { return form_->weights == Weights::none; }
  /// Value c of point k.
  [[nodiscard]] BitsOf<S> bits(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    return compared_bits(first_[k * stride_ + c * form_->component_stride]);
  }
  [[nodiscard]] BitsOf<S> weight_bits(std::ptrdiff_t k) const noexcept {
    return is_polynomial() ? compared_bits(S(1)) : bits(k, form_->components);
  }

  /// Of points whose three values, and weights, are side by side: whether they have the same bytes.
  [[nodiscard]] bool has_bytes_of(const EdgeValues& other) const noexcept {
    for (std::ptrdiff_t k = 0; k <= form_->degree; ++k) {
      const S* const a = first_ + k * stride_;
      const S* const b = other.first_ + k * other.stride_;
      if (std::memcmp(a, b, 3 * sizeof(S)) != 0 ||
          (!is_polynomial() && std::memcmp(a + 3, b + 3, sizeof(S)) != 0)) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard, gnu::noinline, gnu::cold]] bool
  same_but_for_zeros(const EdgeValues& other) const noexcept {
    for (std::ptrdiff_t k = 0; k <= form_->degree; ++k) {
      const BitsOf<S> weight = weight_bits(k);
      const bool formless = weight == compared_bits(S(1));
      if (weight != other.weight_bits(k) || !(formless || form_->weights == other.form_->weights)) {
        return false;
      }
      for (std::ptrdiff_t c = 0; c < form_->components; ++c) {
        if (bits(k, c) != other.bits(k, c)) {
          return false;
        }
      }
    }
    return true;
  }

  const EdgeForm* form_;
  const S* first_;
  std::ptrdiff_t stride_;
};

/// The edges of all patches of all views.
template <typename S>
class AllEdges {
public:
  explicit AllEdges(std::span<const ControlNets<S>> nets) : views_(nets) {
    places_.reserve(kPatchEdges * nets.size());
    std::size_t start = 0;
    for (const ControlNets<S>& view : nets) {
      for (std::size_t edge = 0; edge < kPatchEdges; ++edge) {
        places_.push_back(
            {{view, static_cast<PatchEdge>(edge)}, view.points, view.patch_stride, start});
      }
      start += view.count;
    }
  }
  [[nodiscard]] const NetViews<S>& views() const noexcept { return views_; }
  [[nodiscard]] const EdgeForm& form(std::size_t view, std::size_t edge) const noexcept {
    return places_[kPatchEdges * view + edge].form;
  }
  /// The values of side 4 * patch + PatchEdge.
  [[nodiscard]] EdgeValues<S> operator[](std::size_t side) const noexcept {
    const std::size_t patch = side / kPatchEdges;
    const Place& at = places_[kPatchEdges * views_.view_of(patch) + side % kPatchEdges];
    return {at.form, at.points + static_cast<std::ptrdiff_t>(patch - at.start) * at.patch_stride};
  }

private:
  /// What leads to one edge of any patch of a view.
  struct Place {
    EdgeForm form;
    const S* points;
    std::ptrdiff_t patch_stride;
    std::size_t start; ///< the number of the view's first patch
  };

  NetViews<S> views_;
  std::vector<Place> places_; ///< [4 * view + PatchEdge]
};

} // namespace simdbezier::detail
