// Kernels for patches of any shape: which plan a task takes.
#pragma once

#include "kernels/shape_positions.hpp"
#include "kernels/shape_scattered.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename Task>
SIMDBEZIER_INLINE std::size_t highest_derivative(const Task& task) {
  bool second = task.out[detail::kDuuGroup].wanted() || task.out[detail::kDuvGroup].wanted() ||
                task.out[detail::kDvvGroup].wanted();
  for (std::size_t k = 0; k < detail::kCurvatures; ++k) {
    second = second || task.curvature[k] != nullptr;
  }
  const bool first = task.out[detail::kDuGroup].wanted() || task.out[detail::kDvGroup].wanted() ||
                     task.out[detail::kNormalGroup].wanted();
  return second ? 2 : first ? 1 : 0;
}

/// Calls run.operator()<Plan>() with the plan of a task. kFixed: degrees that are common have code
/// of their own for positions in space. Components of other sets come with all derivatives or none.
template <bool kFixed, bool kRational, typename Task, typename Run>
SIMDBEZIER_INLINE void with_plan_of(const Task& task, const Run& run) {
  const NetShape& shape = *task.shape;
  const std::size_t depth = highest_derivative(task);
  if (shape.components != 3 || task.first_component != 0) {
    depth == 0 ? run.template operator()<Plan<0, kRational, false, 0, 0>>()
               : run.template operator()<Plan<2, kRational, false, 0, 0>>();
    return;
  }
  const auto with_orders = [&]<std::size_t kU, std::size_t kV>() SIMDBEZIER_INLINE_LAMBDA {
    run.template operator()<Plan<0, kRational, true, kU, kV>>();
  };
  if (depth == 2) {
    return run.template operator()<Plan<2, kRational, true, 0, 0>>();
  }
  if (depth == 1) {
    return run.template operator()<Plan<1, kRational, true, 0, 0>>();
  }
  if constexpr (kFixed) {
    switch (shape.degree_u * 16 + shape.degree_v) {
    case 0x11:
      return with_orders.template operator()<2, 2>();
    case 0x22:
      return with_orders.template operator()<3, 3>();
    case 0x33:
      return with_orders.template operator()<4, 4>();
    case 0x44:
      return with_orders.template operator()<5, 5>();
    case 0x55:
      return with_orders.template operator()<6, 6>();
    case 0x31:
      return with_orders.template operator()<4, 2>();
    case 0x13:
      return with_orders.template operator()<2, 4>();
    default:
      break;
    }
  }
  with_orders.template operator()<0, 0>();
}

template <bool kFixed, typename Task, typename Run>
SIMDBEZIER_INLINE void with_plan(const Task& task, const Run& run) {
  task.shape->rational ? with_plan_of<kFixed, true>(task, run)
                       : with_plan_of<kFixed, false>(task, run);
}

template <typename T>
void shape_grid_kernel(GridTask<T>& task, Scheme scheme) {
  task.executed = Isa::SIMDBEZIER_ISA;
  const bool watertight = is_watertight(scheme);
  with_plan<true>(task, [&]<typename P>() {
    if constexpr (P::kKnown) {
      sweep_position_patches<P>(task, watertight);
    } else {
      sweep_shape<P>(task, watertight);
    }
  });
}

template <typename T>
void shape_scattered_kernel(ScatteredTask<T>& task, Scheme scheme) {
  task.executed = Isa::SIMDBEZIER_ISA;
  with_plan<false>(task, [&]<typename P>() { scatter_shape<P>(task, is_watertight(scheme)); });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
