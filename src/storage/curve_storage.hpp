// The packed arrays behind a CurveSet. curve_shape.hpp has their layout.
#pragma once

#include <cstddef>
#include <memory>

#include "src/storage/aligned_memory.hpp"
#include "src/storage/curve_shape.hpp"
#include "src/storage/given_points.hpp"

namespace simdbezier::detail {

/// What a CurveSet holds.
template <typename T>
struct CurveStorage {
  CurveShape shape;
  std::size_t count = 0;
  std::unique_ptr<void, FreeAligned> memory;
  T* values = nullptr;        ///< count * shape.values(), 64-byte aligned
  GivenPoints given;          ///< count * shape.control_values(); read where a tangent vanishes
  T* tangent_floor = nullptr; ///< count; see TangentFloor (pack/tangent_floor.hpp)
};

} // namespace simdbezier::detail
