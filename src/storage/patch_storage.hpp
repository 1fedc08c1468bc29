// The packed arrays behind a PatchSet. bicubic_layout.hpp and net_shape.hpp have their layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "src/storage/aligned_memory.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/storage/patch_arrays.hpp"

namespace simdbezier::detail {

/// Patches of one shape, whose points were given in one form.
template <typename T>
struct PatchStorage {
  NetShape shape;
  std::size_t count = 0;
  std::unique_ptr<void, FreeAligned> memory;
  std::size_t memory_bytes = 0;
  T* coefficients = nullptr; ///< count * shape.coefficients(), 64-byte aligned
  T* edges = nullptr;        ///< count * shape.edges(), 64-byte aligned
  GivenPoints given;         ///< count * shape.control_values(); read where a normal degenerates
  T* origins = nullptr;      ///< count * shape.origins(), or null
  /// count * shape.floors(): |du x dv|^2 above it needs no second look; with weights, what that
  /// floor is made of at a sample (pack/shape_floor.hpp).
  T* normal_floor = nullptr;
  /// No value of normal_floor is higher; infinity where these differ much.
  T common_floor = std::numeric_limits<T>::infinity();

  /// Bytes of one patch in all arrays.
  [[nodiscard]] std::size_t bytes_of_patch(bool with_origins) const noexcept {
    return (shape.coefficients() + shape.edges() + shape.floors() +
            (with_origins ? shape.origins() : 0)) *
               sizeof(T) +
           shape.control_values() * given.value_bytes();
  }
  [[nodiscard]] PatchArrays<T> arrays(std::size_t patch) const noexcept {
    return {.shape = &shape,
            .coefficients = coefficients + patch * shape.coefficients(),
            .edges = edges + patch * shape.edges(),
            .given = given.from(patch * shape.control_values()),
            .origins = origins == nullptr ? nullptr : origins + patch * shape.origins(),
            .normal_floor = normal_floor + patch * shape.floors()};
  }
};

/// The place of a patch in a set of several shapes.
struct PatchPlace {
  std::uint32_t bucket;
  std::size_t index;
};

/// What a PatchSet holds: one bucket for each shape and form of weights that occurs.
template <typename T>
struct SetStorage {
  std::size_t count = 0;
  std::vector<PatchStorage<T>> buckets; ///< at least one
  std::unique_ptr<PatchPlace[]> places; ///< of every patch; null where there is one bucket

  [[nodiscard]] PatchPlace place(std::size_t patch) const {
    return places == nullptr ? PatchPlace{0, patch} : places[patch];
  }
};

} // namespace simdbezier::detail
