// Scattered samples on patches of any shape: lanes are consecutive samples, of one patch or of any.
//
// A register has one formula. It is that of samples off the edges, unless all lanes are on one
// patch and the compiler does not know its degrees; the others are rare, and are evaluated again.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredTask;

/// The half-centred form of a parameter as it was given. It is exact where the parameter is
/// centred, and rounded once where it is not: one of shift and scale leaves values as they are, so
/// that one operation does.
template <typename V>
SIMDBEZIER_PART V half_centred(const ScatteredTask<ScalarOf<V>>& task, V given) {
  return madd(given, broadcast<V>(task.scale), broadcast<V>(-task.shift));
}

/// This is half_centred(), but nan where the parameter is not finite.
template <typename T>
SIMDBEZIER_PART T finite_half_centred(const ScatteredTask<T>& task, T given) {
  return given - given == T(0) ? half_centred(task, given) : static_cast<T>(__builtin_nan(""));
}

/// The samples [first, first + count) of a task, at most a register of them; further lanes repeat
/// the last.
template <typename V>
struct SampleLanes {
  using T = ScalarOf<V>;
  static constexpr std::size_t kN = kLanes<V>;

  const std::uint32_t* patch; ///< of each lane
  V x;                        ///< half-centred; of a single sample nan where it is not finite
  V y;

  SIMDBEZIER_PART SampleLanes(const ScatteredTask<T>& task, std::size_t first, std::size_t count)
      : patch(task.patch + first) {
    const T* u = task.u + first;
    const T* v = task.v + first;
    if (count == 1) {
      std::fill_n(patches_, kN, *patch);
      patch = patches_;
      x = broadcast<V>(finite_half_centred(task, *u));
      y = broadcast<V>(finite_half_centred(task, *v));
      return;
    }
    if (count < kN) {
      for (std::size_t i = 0; i < kN; ++i) {
        const std::size_t from = i < count ? i : count - 1;
        patches_[i] = patch[from];
        values_[0][i] = u[from];
        values_[1][i] = v[from];
      }
      patch = patches_;
      u = values_[0];
      v = values_[1];
    }
    x = half_centred(task, load_vector<V>(u));
    y = half_centred(task, load_vector<V>(v));
  }
  SampleLanes(const SampleLanes&) = delete;

private:
  std::uint32_t patches_[kN];
  alignas(64) T values_[2][kN];
};

/// Finds the origins of lanes off edges in any cells.
template <typename P, typename V>
SIMDBEZIER_RARE void find_mixed_origins(const ScatteredTask<ScalarOf<V>>& task,
                                        const NetShape& shape, const std::size_t* cell,
                                        ColumnOrigins<V>& found) {
  const typename P::Slots slots(shape, task.first_component);
  slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
    const ScalarOf<V>* const origins =
        task.origins + slots.channel(slot) * detail::kOriginsPerComponent;
    found.position[slot] = from_lanes<V>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      return origins[cell[i] * shape.cell_origins()];
    });
    found.to_patch[slot] = broadcast<V>(ScalarOf<V>(0));
  });
}

/// Builds the columns of lanes off edges in any cells of any patches. Calls built(slot) for each
/// channel that is there.
template <typename P, typename V, typename Built>
SIMDBEZIER_INLINE void build_mixed(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                   const SampleLanes<V>& lanes, ShapeColumns<P, V>& columns,
                                   ColumnOrigins<V>& room, const Built& built) {
  using T = ScalarOf<V>;
  alignas(64) T x[kLanes<V>];
  alignas(64) T y[kLanes<V>];
  std::size_t cell[kLanes<V>];
  const T* from[kLanes<V>];
  if (shape.cells() > 1) {
    store_vector(x, lanes.x);
    store_vector(y, lanes.y);
  }
  for (std::size_t i = 0; i < kLanes<V>; ++i) {
    cell[i] = lanes.patch[i];
    if (shape.cells() > 1) {
      const bool high_u = shape.cells_u() == 2 && !(x[i] < T(0));
      const bool high_v = shape.cells_v() == 2 && !(y[i] < T(0));
      cell[i] = cell[i] * shape.cells() + high_v * shape.cells_u() + high_u;
    }
    from[i] = own_address(task.coefficients + cell[i] * shape.cell_coefficients());
  }
  const bool origins = task.origins != nullptr;
  if (origins) [[unlikely]] {
    find_mixed_origins<P>(task, shape, cell, room);
  }
  columns.build_mixed(from, origins ? &room : nullptr, built);
}

/// This is build_mixed() of a patch that is one cell. Lanes are often in the same one.
template <typename P, typename V, typename Built>
SIMDBEZIER_INLINE void build_known(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                   const SampleLanes<V>& lanes, ShapeColumns<P, V>& columns,
                                   ColumnOrigins<V>& room, const Built& built) {
  const std::size_t patch = *lanes.patch;
  if (task.origins != nullptr || !all_equal<kLanes<V>>(lanes.patch, *lanes.patch)) {
    return build_mixed(task, shape, lanes, columns, room, built);
  }
  columns.build_inside(task.coefficients + patch * shape.cell_coefficients(), nullptr, built);
}

/// Stores what a task wants of one component.
template <typename P, typename V>
SIMDBEZIER_PART void store_slot(const ScatteredTask<ScalarOf<V>>& task, const SampleRange<V>& range,
                                const SampleJet<V>& jet, std::size_t slot) {
  const auto store = [&](Output output, V value) SIMDBEZIER_INLINE_LAMBDA {
    ScalarOf<V>* const plane = task.out[output_index(output)].component[slot];
    if (plane != nullptr) {
      range.store(plane, value);
    }
  };
  store(Output::position, jet.position[slot]);
  if constexpr (P::kDepth > 0) {
    store(Output::du, jet.du[slot]);
    store(Output::dv, jet.dv[slot]);
  }
  if constexpr (P::kDepth > 1) {
    store(Output::duu, jet.duu[slot]);
    store(Output::duv, jet.duv[slot]);
    store(Output::dvv, jet.dvv[slot]);
  }
}

/// Stores normals and curvatures before any second look.
template <typename P, typename V>
SIMDBEZIER_PART void store_joint(const ScatteredTask<ScalarOf<V>>& task,
                                 const SampleRange<V>& range, const SampleJet<V>& jet) {
  if constexpr (P::kDepth > 0) {
    if (task.out[output_index(Output::normal)].wanted()) {
      store_first_normals(task, range, jet);
    }
  }
  if constexpr (P::kDepth > 1) {
    if (wants_curvatures(task)) {
      CurvatureFrame<V> frame;
      frame.find(jet);
      V curvature[kCurvatureKinds];
      curvatures(jet, frame, curvature);
      store_curvature(task.curvature, false, range, curvature);
    }
  }
}

/// Returns what |du x dv|^2 of lanes inside of their patches has to be above, or (kCommon) a bound
/// on that. To read what belongs to each patch is many accesses to memory, for values that seldom
/// matter.
template <typename P, bool kCommon, typename V>
SIMDBEZIER_PART V floors_of(const ScatteredTask<ScalarOf<V>>& task, const SampleLanes<V>& lanes,
                            const SampleJet<V>& jet, V squared) {
  using T = ScalarOf<V>;
  constexpr std::size_t kStep = P::kWeighted ? 2 : 1;
  const auto floor = [&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
    return kCommon ? broadcast<V>(task.common_floor)
                   : gather_lanes<V>(task.normal_floor + i, lanes.patch, kStep);
  };
  if constexpr (P::kWeighted) {
    return rational_floor(floor(0), floor(1), broadcast<V>(kLeastSquare<T>), jet, squared);
  } else {
    return floor(0);
  }
}

/// Which lanes are strictly inside of their cells, by one local parameter.
template <typename V>
SIMDBEZIER_PART MaskOf<V> are_inside(V local) {
  using T = ScalarOf<V>;
  const MaskOf<V> above = local > broadcast<V>(T(-0.5));
  const MaskOf<V> below = local < broadcast<V>(T(0.5));
  return above & below;
}

template <std::size_t kDepth, bool kRational, typename T>
SIMDBEZIER_KERNEL void evaluate_together(const ScatteredTask<T>& task, std::size_t k,
                                         std::size_t count);

/// Finishes samples [first, first + count) of which not all are usual: those that are on edges
/// which are not done, or not finite, are evaluated alone; normals that do not pass take the second
/// look. Nothing comes by address, or the fast path would have to keep it in memory.
template <typename P, typename V>
SIMDBEZIER_RARE void finish_unusual(const ScatteredTask<ScalarOf<V>>& task, std::size_t first,
                                    std::size_t count, bool edges_done, V squared, V floor) {
  using T = ScalarOf<V>;
  const SampleLanes<V> lanes(task, first, count);
  if (P::kKnown && all_equal<kLanes<V>>(lanes.patch, *lanes.patch)) { // edges have formulas there
    return evaluate_together<P::kDepth, P::kWeighted>(task, first, count);
  }
  const NetShape& shape = *task.shape;
  const V vectors[] = {CellColumns<V>(lanes.x, shape.cells_u(), false).local.x,
                       CellColumns<V>(lanes.y, shape.cells_v(), false).local.x, squared, floor};
  alignas(64) T value[4][kLanes<V>];
  for (int i = 0; i < 4; ++i) {
    store_vector(value[i], vectors[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = first + i;
    const T u = value[0][i];
    const T v = value[1][i];
    const bool edge = !edges_done && (edge_of_cell(u) < kEdges || edge_of_cell(v) < kEdges);
    const bool finite = u - u == T(0) && v - v == T(0);
    if (edge || (!finite && count > 1)) {
      evaluate_together<P::kDepth, P::kWeighted>(task, k, 1);
      continue;
    }
    if (!finite && task.status != nullptr) {
      task.status[k] = SampleStatus::non_finite;
    }
    if (!(value[2][i] > value[3][i])) {
      const UncertainNormals one{i, kLanes<V>, 1, 1, k, 0, 1};
      resolve_normals(task, lanes.patch[i], one, lanes.x, lanes.y, squared, floor);
    }
  }
}

/// Asks for the coefficients of a sample that comes soon.
template <typename T>
SIMDBEZIER_PART void prefetch_sample(const ScatteredTask<T>& task, const NetShape& shape,
                                     std::size_t k) {
  constexpr std::size_t kAhead = 48;
  if (k + kAhead < task.count) {
    const std::size_t next = k + kAhead;
    const bool high_u = shape.cells_u() == 2 && half_centred(task, task.u[next]) >= T(0);
    const bool high_v = shape.cells_v() == 2 && half_centred(task, task.v[next]) >= T(0);
    const std::size_t cell = task.patch[next] * shape.cells() + high_v * shape.cells_u() + high_u;
    const T* const from = task.coefficients + cell * shape.cell_coefficients();
    for (std::size_t i = 0; i < shape.cell_coefficients(); i += 64 / sizeof(T)) {
      prefetch_operand(from + i); // on a Zen 5 faster than prefetch_line(): docs/experiments.md
    }
  }
}

/// Asks for what is read of the samples that come soon. They lie in order, but prefetchers do not
/// follow them between the lines of random patches.
template <typename T>
SIMDBEZIER_PART void prefetch_places(const ScatteredTask<T>& task, std::size_t k) {
  constexpr std::size_t kAhead = 128;
  if (k + kAhead < task.count) {
    prefetch_line(task.u + k + kAhead);
    prefetch_line(task.v + k + kAhead);
    prefetch_line(task.patch + k + kAhead);
  }
}

/// Evaluates samples [k, k + count), as SampleLanes has them.
template <typename P, typename V>
SIMDBEZIER_PART void evaluate_block(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                    std::size_t k, std::size_t count) {
  using T = ScalarOf<V>;
  const SampleLanes<V> lanes(task, k, count);
  const bool with_edges = !P::kKnown && task.watertight;
  const CellColumns<V> columns(lanes.x, shape.cells_u(), with_edges);
  const CellColumns<V> rows(lanes.y, shape.cells_v(), with_edges);
  ShapeColumns<P, V> polynomials(shape, columns, task.first_component);
  const SampleRange<V> range{0, k, count, 0, lanes.x, lanes.y, {}};
  ColumnOrigins<V> origins;
  SampleJet<V> jet;
  const bool one_row =
      !P::kKnown && (kIsScalar<V> || (all_equal<kLanes<V>>(lanes.patch, *lanes.patch) &&
                                      !(rows.any_low && rows.any_high)));
  if constexpr (P::kKnown) { // a component is stored as soon as it is there, where it can be
    build_known(task, shape, lanes, polynomials, origins,
                [&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
                  for (std::size_t i = slot; task.prefetch && i < count; i += P::Slots::kSlots) {
                    prefetch_sample(task, shape, k + i);
                  }
                  if constexpr (!P::kWeighted) {
                    polynomials.polynomials().template evaluate_slot<1>(
                        slot, polynomials.order_v(), &rows.local.x, polynomials.origins(), &jet);
                    store_slot<P>(task, range, jet, slot);
                  }
                });
    if constexpr (P::kWeighted) {
      polynomials.template evaluate<1>(&rows.local.x, &jet);
    }
  } else if (one_row) {
    const CellRow<T> cells(task, shape, *lanes.patch, rows.any_low ? 0 : 1);
    const typename ShapeColumns<P, V>::Edges edges(shape, columns, lanes.x, task.watertight,
                                                   task.first_component, cells);
    build_columns(polynomials, cells, edges, origins);
    polynomials.template evaluate<1>(&rows.local.x, &jet);
    for (const detail::Edge edge : {detail::kEdgeV0, detail::kEdgeV1}) {
      const MaskOf<V> on = rows.local.x == broadcast<V>(T(edge == detail::kEdgeV0 ? -0.5 : 0.5));
      if (task.watertight && any_of<V>(on)) [[unlikely]] {
        edges.replace_lanes(edge, on, jet);
      }
    }
  } else if constexpr (!kIsScalar<V>) {
    build_mixed(task, shape, lanes, polynomials, origins,
                [](std::size_t) SIMDBEZIER_INLINE_LAMBDA {});
    polynomials.template evaluate<1>(&rows.local.x, &jet);
  }
  for (std::size_t slot = 0; (!P::kKnown || P::kWeighted) && slot < P::Slots::kMost; ++slot) {
    store_slot<P>(task, range, jet, slot);
  }
  store_joint<P>(task, range, jet);

  const MaskOf<V> inside_u = are_inside(columns.local.x);
  const MaskOf<V> inside_v = are_inside(rows.local.x);
  const MaskOf<V> inside = inside_u & inside_v;
  V squared = broadcast<V>(T(1)); // what passes
  V floor = broadcast<V>(T(0));
  const auto all_pass = [&]() SIMDBEZIER_INLINE_LAMBDA {
    const MaskOf<V> pass = squared > floor;
    return all_of<V>(inside & pass);
  };
  if (P::kDepth > 0 &&
      (task.out[output_index(Output::normal)].wanted() || wants_curvatures(task))) {
    V n[3];
    squared = cross_product(jet.du, jet.dv, n);
    floor = floors_of<P, true>(task, lanes, jet, squared);
    if (!all_pass()) {
      floor = floors_of<P, false>(task, lanes, jet, squared);
      floor = floor_inside(lanes.y, floor_inside(lanes.x, floor));
    }
  }
  if (!all_pass()) [[unlikely]] {
    finish_unusual<P>(task, k, count, one_row || !task.watertight, squared, floor);
  }
}

/// This is evaluate_block() for any degrees.
template <std::size_t kDepth, bool kRational, typename T>
SIMDBEZIER_KERNEL void evaluate_together(const ScatteredTask<T>& task, std::size_t k,
                                         std::size_t count) {
  using P = ShapePlan<kDepth, kRational, 0, 0, 0>;
  evaluate_block<P, vec<T>>(task, P::shape(*task.shape), k, count);
}

/// Evaluates the positions of two registers of samples inside of one bicubic patch, which share the
/// loads of coefficients: with one of them, loads would be the limit. Returns whether the samples
/// from number k on are such.
template <typename T>
SIMDBEZIER_PART bool evaluate_two(const ScatteredTask<T>& task, std::size_t k) {
  using V = vec<T>;
  constexpr std::size_t kN = kLanes<V>;
  const Order<kOrder> order(kOrder);
  const std::uint32_t* const patch = task.patch + k;
  if (k + 2 * kN > task.count || task.origins != nullptr || !all_equal<2 * kN>(patch, *patch)) {
    return false;
  }
  V x[2];
  V y[2];
  MaskOf<V> inside(true);
  repeat<2>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
    x[r] = half_centred(task, load_vector<V>(task.u + k + r * kN));
    y[r] = half_centred(task, load_vector<V>(task.v + k + r * kN));
    const MaskOf<V> inside_u = are_inside(x[r]);
    const MaskOf<V> inside_v = are_inside(y[r]);
    inside = inside & inside_u & inside_v;
  });
  if (!all_of<V>(inside)) {
    return false;
  }
  const T* matrix = task.coefficients + *patch * detail::kCoefficients;
  for (T* const plane : task.out[output_index(Output::position)].component) {
    V power[2][kOrder];
    repeat<kOrder>([&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
      const auto load = [&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        return broadcast<V>(matrix[i * kOrder + l]);
      };
      Series<V> s[2];
      horner_rows<0, 2>(order, x, load, s);
      repeat<2>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA { power[r][l] = s[r].value; });
    });
    matrix += kOrder * kOrder;
    repeat<2>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      const auto load = [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA { return power[r][l]; };
      store_vector(plane + k + r * kN, row_series<0>(order, y[r], load).value);
    });
  }
  return true;
}

template <typename P, typename T>
SIMDBEZIER_KERNEL void scatter_shape(const ScatteredTask<T>& task) {
  constexpr std::size_t kN = kLanes<vec<T>>;
  const NetShape shape = P::shape(*task.shape);
  for (std::size_t k = 0; k < task.count; k += kN) {
    const std::size_t count = task.count - k < kN ? task.count - k : kN;
    prefetch_places(task, k);
    if constexpr (P::kKnown) {
      if constexpr (P::kDepth == 0 && !P::kWeighted) {
        if (task.out[output_index(Output::position)].wanted() && evaluate_two(task, k)) {
          k += kN;
          continue;
        }
      }
      if (count == kN) {
        evaluate_block<P, vec<T>>(task, shape, k, kN);
        continue;
      }
    }
    for (std::size_t i = 0; task.prefetch && i < count; ++i) {
      prefetch_sample(task, shape, k + i);
    }
    evaluate_together<P::kDepth, P::kWeighted>(task, k, count);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
