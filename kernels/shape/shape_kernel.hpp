// Kernels for patches of any shape: which plan a task takes, and the table of all of them.
#pragma once

#include "kernels/derivative/derivative_kernel.hpp"
#include "kernels/pack/shape_pack_kernel.hpp"
#include "kernels/shape/known_degrees.hpp"
#include "kernels/shape/shape_scattered.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns the outputs that a task wants, status apart: bit k stands for Output(k).
template <typename Task>
SIMDBEZIER_PART unsigned wanted_outputs(const Task& task) {
  unsigned wanted = wants_curvatures(task) ? 1U << output_index(Output::curvature) : 0;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    wanted |= task.out[k].wanted() ? 1U << k : 0;
  }
  return wanted;
}
/// Returns how far derivatives go for all outputs that a task wants.
template <typename Task>
SIMDBEZIER_PART int highest_derivative(const Task& task) {
  constexpr unsigned kFirst = detail::outputs_of_order(1).bits();
  constexpr unsigned kSecond = detail::outputs_of_order(2).bits();
  const unsigned wanted = wanted_outputs(task);
  return (wanted & kSecond) != 0 ? 2 : (wanted & kFirst) != 0 ? 1 : 0;
}

template <std::size_t kDepth, bool kRational>
using AnyPlan = ShapePlan<kDepth, kRational, 0, 0, 0>;

/// Calls run.operator()<ShapePlan>(), with a plan for the degree in v where there is one: rational
/// patches of degree 5 and more are too rare.
template <std::size_t kDepth, bool kRational, std::size_t kComponents, typename Run>
SIMDBEZIER_INLINE void with_order_v(const NetShape& shape, const Run& run) {
  const std::size_t order = shape.order_v();
  if (shape.cells() != 1 || order > (kRational ? 5 : 6)) {
    return run.template operator()<AnyPlan<kDepth, kRational>>();
  }
  const auto run_known = [&]<std::size_t kV>() SIMDBEZIER_INLINE_LAMBDA {
    run.template operator()<ShapePlan<kDepth, kRational, kComponents, 0, kV>>();
  };
  with_one_of<2, 3, 4, 5>(order, run_known);
  if constexpr (!kRational) {
    with_one_of<6>(order, run_known);
  }
}

/// Positions of common degrees, for which the compiler knows everything. Returns whether it ran.
template <typename Run>
SIMDBEZIER_INLINE bool with_common_degrees(const NetShape& shape, const Run& run) {
  const auto try_orders = [&]<std::size_t kU, std::size_t kV>() SIMDBEZIER_INLINE_LAMBDA {
    const bool same = shape.order_u() == kU && shape.order_v() == kV;
    if (same) {
      run.template operator()<ShapePlan<0, false, 3, kU, kV>>();
    }
    return same;
  };
  return try_orders.template operator()<2, 2>() || try_orders.template operator()<3, 3>() ||
         try_orders.template operator()<5, 5>() || try_orders.template operator()<6, 6>() ||
         try_orders.template operator()<4, 2>() || try_orders.template operator()<2, 4>();
}

/// Components that do not need each other go one after the other, which leaves registers for the
/// polynomials of derivatives; three that do have to go together.
template <std::size_t kDepth, bool kRational, typename Task, typename Run>
SIMDBEZIER_INLINE void with_grid_plan(const Task& task, const Run& run) {
  const NetShape& shape = *task.shape;
  const bool in_space = shape.components == 3 && task.first_component == 0;
  [[maybe_unused]] constexpr unsigned kSpace = detail::kSpaceOutputs.bits();
  if constexpr (!kCompactShapes && kDepth == 0 && !kRational) {
    if (in_space && with_common_degrees(shape, run)) {
      return;
    }
  }
  if constexpr (!kCompactShapes && (kDepth == 1 || (kDepth == 0 && kRational))) {
    if (in_space && (kRational || (wanted_outputs(task) & kSpace) != 0)) {
      return with_order_v<kDepth, kRational, 3>(shape, run);
    }
  }
  if constexpr (!kCompactShapes && kDepth < 2 && !kRational) {
    return with_order_v<kDepth, kRational, 1>(shape, run);
  }
  if constexpr (!kCompactShapes && kDepth == 2) {
    if (in_space && shape.cells() == 1 && shape.degree_v == 3) {
      return run.template operator()<ShapePlan<kDepth, kRational, 3, 0, 4>>();
    }
  }
  run.template operator()<AnyPlan<kDepth, kRational>>();
}

/// Calls run.operator()<kDepth, kRational>(). kFirst is the depth for first derivatives.
template <std::size_t kFirst, typename Task, typename Run>
SIMDBEZIER_INLINE void with_depth(const Task& task, const Run& run) {
  const auto with_weights = [&]<std::size_t kDepth>() SIMDBEZIER_INLINE_LAMBDA {
    task.shape->rational ? run.template operator()<kDepth, true>()
                         : run.template operator()<kDepth, false>();
  };
  switch (highest_derivative(task)) {
  case 0:
    return with_weights.template operator()<0>();
  case 1:
    return with_weights.template operator()<kFirst>();
  default:
    return with_weights.template operator()<2>();
  }
}

template <typename T>
SIMDBEZIER_KERNEL void shape_grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  with_depth<kCompactShapes ? 2 : 1>(task, [&]<std::size_t kDepth, bool kRational>() {
    with_grid_plan<kDepth, kRational>(task, [&]<typename P>() {
      if constexpr (P::kKnown && P::kDepth < 2) {
        sweep_known<P>(task);
      } else {
        sweep_shape<P>(task);
      }
    });
  });
}

template <typename T>
SIMDBEZIER_KERNEL void shape_scattered_kernel(ScatteredTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  with_depth<kCompact ? 2 : 1>(task, [&]<std::size_t kDepth, bool kRational>() {
    if constexpr (!kCompact && (!kCompactShapes || !kRational)) {
      const NetShape& shape = *task.shape;
      if (shape.components == 3 && task.first_component == 0 && shape.degree_u == 3 &&
          shape.degree_v == 3) {
        return scatter_shape<ShapePlan<kDepth, kRational, 3, 4, 4>>(task);
      }
    }
    scatter_shape<AnyPlan<kDepth, kRational>>(task);
  });
}

/// The table of what any shape of patch needs. Floats and doubles have an object each, since
/// together they take the compiler twice the memory.
template <typename T>
constexpr detail::ShapeTable<T> make_shape_table() {
  detail::ShapeTable<T> table{};
  table.grid = shape_grid_kernel<T>;
  table.scattered = shape_scattered_kernel<T>;
  table.derivatives = derivative_kernel<T>;
  table.pack_f32 = shape_pack_kernel<T, float>;
  table.pack_f64 = shape_pack_kernel<T, double>;
  return table;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
