// What edges and origins contribute to a register of columns of a patch. None of it depends on the
// degree in v.
//
// On an edge u = const, position, dv and dvv come from the edge, du and duv from the patch; on an
// edge v = const it is position, du and duu that come from the edge; corners are stored.
#pragma once

#include "kernels/shape/shape_cell.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Turns derivatives by the local X into those by u: the factors are 1, or 2 and 4.
template <std::size_t kDepth, typename V>
SIMDBEZIER_PART void scale_by_cells(Series<V>& s, std::size_t cells) {
  if (cells == 2) {
    if constexpr (kDepth > 0) {
      s.first = s.first + s.first;
    }
    if constexpr (kDepth > 1) {
      s.second = s.second * broadcast<V>(ScalarOf<V>(4));
    }
  }
}

template <typename P, typename V>
class ShapeEdges {
  using T = ScalarOf<V>;
  static constexpr std::size_t kDepth = P::kDepth;

public:
  /// Holds the edges of one row of cells. x is that of the columns in the whole patch.
  SIMDBEZIER_PART ShapeEdges(const NetShape& shape, const CellColumns<V>& columns, V x,
                             bool watertight, std::size_t first_component, const CellRow<T>& row)
      : shape_(P::shape(shape)), columns_(columns), x_(x), watertight_(watertight),
        first_component_(first_component), slots_(shape_, first_component), row_(&row) {}

  /// Goes on to another row of cells.
  SIMDBEZIER_PART void enter(const CellRow<T>& row) { row_ = &row; }

  /// Whether the set has origins.
  SIMDBEZIER_PART bool has_origins() const { return row_->low.origins != nullptr; }

  /// Whether an edge u = const of this row of cells has the mark of a point, in a rational patch.
  SIMDBEZIER_PART bool has_points() const {
    if constexpr (P::kWeighted) {
      const std::size_t marks = shape_.corners_at() + slots_.channel(P::Slots::kWeight) * 4;
      return columns_.local.on_edge &&
             (row_->low.edges[marks] != T(0) || row_->high.edges[marks + 1] != T(0));
    } else {
      return false;
    }
  }

  /// Finds origins; to be called where there are origins or points.
  SIMDBEZIER_PART void find_origins(ColumnOrigins<V>& found) const {
    ShapeEdges<typename P::ForOrigins, V>::all_origins(shape_, x_, watertight_, first_component_,
                                                       row_->low.edges, row_->low.origins,
                                                       row_->high.edges, row_->high.origins, found);
  }

  /// Replaces what an edge v = const has of its own: kEdgeV0 or kEdgeV1 of these cells.
  SIMDBEZIER_PART void replace_row(std::size_t edge, SampleJet<V>& jet) const {
    if constexpr (!P::kKnown || kDepth > 1) { // calls cost other known degrees 10 to 25 %
      SampleJet<V> own;                       // so that the caller's need not be in memory
      row_of_edge(edge, own);
      copy_row(own, jet);
    } else {
      compute_row(edge, jet);
    }
  }

  /// This is replace_row() of the lanes that are on the edge.
  SIMDBEZIER_PART void replace_lanes(std::size_t edge, MaskOf<V> on, SampleJet<V>& jet) const {
    SampleJet<V> own;
    row_of_edge(edge, own);
    for (std::size_t c = 0; c < P::Slots::kMost; ++c) {
      jet.position[c] = select_where<V>(on, own.position[c], jet.position[c]);
      if constexpr (kDepth > 0) {
        jet.du[c] = select_where<V>(on, own.du[c], jet.du[c]);
      }
      if constexpr (kDepth > 1) {
        jet.duu[c] = select_where<V>(on, own.duu[c], jet.duu[c]);
      }
    }
  }

  /// Finds positions of three components on an edge v = const, all at once. Returns false where
  /// there are other components.
  SIMDBEZIER_PART bool find_positions(std::size_t edge, V position[3]) const {
    if (P::kWeighted || !slots_.are_three() || has_origins() || takes_even_odd(shape_.order_u())) {
      return false;
    }
    const std::size_t powers = slots_.channel(0) * shape_.edge_powers() * 4 + edge;
    const std::size_t corners =
        shape_.corners_at() + slots_.channel(0) * 4 + detail::corner_index(0, edge);
    if (columns_.any_low && columns_.any_high) {
      const std::ptrdiff_t to_high = row_->high.edges - row_->low.edges;
      horner_positions(
          row_->low.edges + powers, position, [&](const T* c) SIMDBEZIER_INLINE_LAMBDA {
            return select_where<V>(columns_.low, broadcast<V>(c[0]), broadcast<V>(c[to_high]));
          });
      repeat<3>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        position[i] = replaced(position[i], corners + i * 4, &Cell<T>::edges);
      });
    } else {
      const T* const edges = columns_.any_low ? row_->low.edges : row_->high.edges;
      horner_positions(edges + powers, position,
                       [](const T* c) SIMDBEZIER_INLINE_LAMBDA { return broadcast<V>(*c); });
      repeat<3>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        position[i] = columns_.local.edges.replace(position[i], edges + corners + i * 4);
      });
    }
    return true;
  }

  /// find_origins() of edges that are made here, from single values: objects would have to be put
  /// together in memory, which the fast path pays as well.
  static SIMDBEZIER_RARE void all_origins(NetShape shape, V x, bool watertight,
                                          std::size_t first_component, const T* low_edges,
                                          const T* low_origins, const T* high_edges,
                                          const T* high_origins, ColumnOrigins<V>& found) {
    const CellColumns<V> columns(x, P::kOneCell ? 1 : shape.cells_u(), watertight);
    const CellRow<T> row({nullptr, low_edges, low_origins}, {nullptr, high_edges, high_origins});
    const ShapeEdges edges(shape, columns, x, watertight, first_component, row);
    edges.slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if (edges.has_origins()) {
        edges.find_origin(slot, found);
      } else {
        edges.find_point(slot, found);
      }
    });
  }

  /// Copies what replace_row() replaces.
  static SIMDBEZIER_PART void copy_row(const SampleJet<V>& from, SampleJet<V>& jet) {
    for (std::size_t c = 0; c < P::Slots::kMost; ++c) {
      jet.position[c] = from.position[c];
      if constexpr (kDepth > 0) {
        jet.du[c] = from.du[c];
      }
      if constexpr (kDepth > 1) {
        jet.duu[c] = from.duu[c];
      }
    }
  }

private:
  /// Horner's rule for an edge of three components, from the constant coefficient of the first one
  /// on. One index serves all of them.
  template <typename Load>
  SIMDBEZIER_INLINE void horner_positions(const T* first, V position[3], const Load& load) const {
    const std::size_t step = shape_.edge_powers() * 4;
    const T* const of[3] = {own_address(first), own_address(first + step),
                            own_address(first + 2 * step)};
    const V x = columns_.local.x;
    std::size_t at = (shape_.order_u() - 1) * 4;
    repeat<3>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { position[i] = load(of[i] + at); });
    do {
      at -= 4;
      repeat<3>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        position[i] = madd(position[i], x, load(of[i] + at));
      });
    } while (at != 0);
  }

  SIMDBEZIER_KERNEL void row_of_edge(std::size_t edge, SampleJet<V>& jet) const {
    compute_row(edge, jet);
  }

  SIMDBEZIER_PART void compute_row(std::size_t edge, SampleJet<V>& jet) const {
    Series<V> weight;
    if constexpr (P::kWeighted) {
      weight = edge_series(P::Slots::kWeight, edge);
      negate_slopes(weight);
    } else {
      weight.value = columns_.local.x; // not used
    }
    const Quotient<V> quotient = Quotient<V>::by(weight.value);
    slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      Series<V> at = edge_series(slot, edge);
      if constexpr (P::kWeighted) {
        divide_series<kDepth>(quotient, weight, at);
      }
      V position = at.value;
      if (has_origins()) {
        position =
            position + chosen(origin_at(slot) + detail::kEdgeOriginsAt + edge, &Cell<T>::origins);
      }
      jet.position[slot] = with_corners(slot, edge, position);
      if constexpr (kDepth > 0) {
        jet.du[slot] = at.first;
      }
      if constexpr (kDepth > 1) {
        jet.duu[slot] = at.second;
      }
    });
  }

  SIMDBEZIER_PART V with_corners(std::size_t slot, std::size_t edge, V position) const {
    const std::size_t corners = shape_.corners_at() + slots_.channel(slot) * 4;
    return replaced(position, corners + detail::corner_index(0, edge), &Cell<T>::edges);
  }

  SIMDBEZIER_PART void find_origin(std::size_t slot, ColumnOrigins<V>& found) const {
    const std::size_t at = origin_at(slot);
    const bool on_edge = columns_.local.on_edge;
    const V inside = chosen(at, &Cell<T>::origins);
    found.position[slot] =
        on_edge ? replaced(inside, at + detail::kEdgeOriginsAt + detail::kEdgeU0, &Cell<T>::origins)
                : inside;
    if constexpr (P::kWeighted && kDepth > 0) {
      const V zero = broadcast<V>(T(0));
      found.to_patch[slot] =
          on_edge ? replaced(zero, at + detail::kRelativeOriginsAt, &Cell<T>::origins) : zero;
    }
  }
  /// Finds the points of lanes on edges u = const that are points, in sets without origins:
  /// numerators are zero there, and points stand in the corners. Other lanes get -0, which adds
  /// nothing.
  SIMDBEZIER_PART void find_point(std::size_t slot, ColumnOrigins<V>& found) const {
    const V zero = broadcast<V>(T(0));
    const std::size_t corners = shape_.corners_at();
    const V marks =
        replaced(zero, corners + slots_.channel(P::Slots::kWeight) * 4, &Cell<T>::edges);
    const std::size_t points = corners + slots_.channel(slot) * 4;
    const V point =
        select_where<V>(marks > broadcast<V>(T(1)), replaced(zero, points + 2, &Cell<T>::edges),
                        replaced(zero, points, &Cell<T>::edges));
    found.position[slot] = found.to_patch[slot] =
        select_where<V>(marks > zero, point, broadcast<V>(T(-0.0)));
  }
  SIMDBEZIER_PART std::size_t origin_at(std::size_t slot) const {
    return slots_.channel(slot) * detail::kOriginsPerComponent;
  }

  static SIMDBEZIER_PART void negate_slopes(Series<V>& w) {
    if constexpr (kDepth > 0) {
      w.first = negated(w.first);
    }
    if constexpr (kDepth > 1) {
      w.second = negated(w.second);
    }
  }
  SIMDBEZIER_PART Series<V> edge_series(std::size_t slot, std::size_t edge) const {
    const std::size_t at = slots_.channel(slot) * shape_.edge_powers() * 4 + edge;
    const typename P::OrderU order(shape_.order_u());
    Series<V> s =
        row_series<kDepth>(order, columns_.local.x, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          return chosen(at + 4 * k, &Cell<T>::edges);
        });
    if constexpr (!P::kOneCell) {
      scale_by_cells<kDepth>(s, shape_.cells_u());
    }
    return s;
  }

  /// Returns a value of each lane's cell.
  SIMDBEZIER_PART V chosen(std::size_t at, const T* Cell<T>::*values) const {
    if constexpr (P::kOneCell) {
      return broadcast<V>((row_->low.*values)[at]);
    } else {
      return select_where<V>(columns_.low, broadcast<V>((row_->low.*values)[at]),
                             broadcast<V>((row_->high.*values)[at]));
    }
  }
  /// Returns `inside`, where the lanes on edges u = const get a value of their cell's: that of the
  /// pair at `at`.
  SIMDBEZIER_PART V replaced(V inside, std::size_t at, const T* Cell<T>::*values) const {
    const PairSelector<V>& edges = columns_.local.edges;
    const V low = edges.replace(inside, row_->low.*values + at);
    if constexpr (P::kOneCell) {
      return low;
    } else {
      return select_where<V>(columns_.low, low, edges.replace(inside, row_->high.*values + at));
    }
  }

  NetShape shape_;
  const CellColumns<V>& columns_;
  V x_;
  bool watertight_;
  std::size_t first_component_;
  typename P::Slots slots_;
  const CellRow<T>* row_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
