// The values of a patch's edge, wherever they lie, and comparisons of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/patch_edge.hpp>

#include "src/nets/net_views.hpp"
#include "src/storage/net_shape.hpp"

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
  std::ptrdiff_t channels;
  Weights weights;

  template <typename S>
  EdgeForm(const ControlNets<S>& nets, PatchEdge edge) noexcept
      : first(edge == PatchEdge::v1   ? nets.degree_v * nets.row_stride
              : edge == PatchEdge::u1 ? nets.degree_u * nets.point_stride
                                      : 0),
        component_stride(nets.component_stride),
        channels(static_cast<std::ptrdiff_t>(shape_of(nets).channels())), weights(nets.weights) {
    const bool in_u = edge == PatchEdge::v0 || edge == PatchEdge::v1;
    stride = in_u ? nets.point_stride : nets.row_stride;
    degree = in_u ? nets.degree_u : nets.degree_v;
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
    for (std::ptrdiff_t k = 0; k <= form_->degree / 2; ++k) {
      for (std::ptrdiff_t c = 0; c < form_->channels; ++c) {
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
    if (a.degree != b.degree || a.channels != b.channels || a.weights != b.weights) {
      return false;
    }
    // Edges that are compared are equal nearly always, and have the same zeros nearly always.
    const bool whole = a.component_stride == 1 && b.component_stride == 1 && a.channels == 3;
    return (whole && has_bytes_of(other)) || same_but_for_zeros(other);
  }

  /// Whether all points are equal, whatever their weights.
  [[nodiscard]] bool collapsed() const noexcept {
    const bool polynomial = form_->weights == Weights::none;
    const std::ptrdiff_t components = polynomial ? form_->channels : form_->channels - 1;
    for (std::ptrdiff_t k = 1; k <= form_->degree; ++k) {
      for (std::ptrdiff_t c = 0; c < components; ++c) {
        if (!same_coordinate(k, c)) {
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
  /// Value c of point k.
  [[nodiscard]] S value(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    return first_[k * stride_ + c * form_->component_stride];
  }
  [[nodiscard]] BitsOf<S> bits(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    return compared_bits(value(k, c));
  }

  /// Of points whose three values are side by side: whether they have the same bytes.
  [[nodiscard]] bool has_bytes_of(const EdgeValues& other) const noexcept {
    for (std::ptrdiff_t k = 0; k <= form_->degree; ++k) {
      if (std::memcmp(first_ + k * stride_, other.first_ + k * other.stride_, 3 * sizeof(S)) != 0) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard, gnu::noinline, gnu::cold]] bool
  same_but_for_zeros(const EdgeValues& other) const noexcept {
    for (std::ptrdiff_t k = 0; k <= form_->degree; ++k) {
      for (std::ptrdiff_t c = 0; c < form_->channels; ++c) {
        if (bits(k, c) != other.bits(k, c)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Whether point k has the coordinate of point 0.
  [[nodiscard]] bool same_coordinate(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    if (form_->weights != Weights::homogeneous) {
      return bits(k, c) == bits(0, c);
    }
    const auto coordinate = [&](std::ptrdiff_t i) {
      return value(i, c) / value(i, form_->channels - 1);
    };
    return coordinate(k) == coordinate(0);
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
