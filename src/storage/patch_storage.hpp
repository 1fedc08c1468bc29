// The packed arrays behind a PatchSet, and their byte layout.
//
// Parameters inside the library are half-centred: X = u - 1/2 in [-1/2, 1/2]. Coefficients are
// those of the centred form times 2^(k+l), so every intermediate is an exact power of two times
// the one in x = 2u-1, and derivatives with respect to u and v need no factor 2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>

#include <vector>

#include "src/storage/patch_arrays.hpp"

namespace simdbezier::detail {

// The constants below are those of bicubic patches in space; NetShape has them for all others.
inline constexpr std::size_t kComponents = 3;
inline constexpr std::size_t kOrder = 4; // degree 3

/// Per patch [component][power k of X][power l of Y]: for float one cache line a component, in
/// which 128 bits hold the powers of Y that belong to one power of X.
inline constexpr std::size_t kCoefficients = kComponents * kOrder * kOrder;

/// Edges and corners of a patch, read for boundary samples only.
/// [component][power][edge v=0, v=1, u=0, u=1], then [component][corner], then padding to 64.
inline constexpr std::size_t kEdgeBlock = 64;
inline constexpr std::size_t kEdges = 4;
inline constexpr std::size_t kCornersAt = kComponents * kOrder * kEdges;
enum Edge : std::size_t { kEdgeV0, kEdgeV1, kEdgeU0, kEdgeU1 };

/// Per patch [component][8]: the patch's own origin, a place unused, of rational patches the
/// origins of the edges u=0, u=1 relative to it, the origins of the four edges in their order.
/// Present in sets packed with local origins only.
inline constexpr std::size_t kOriginBlock = 24;
inline constexpr std::size_t kOriginsPerComponent = 8;
inline constexpr std::size_t kRelativeOriginsAt = 2;
inline constexpr std::size_t kEdgeOriginsAt = 4;

/// Corner (u,v) stands at corner[v * 2 + u].
inline constexpr std::size_t corner_index(std::size_t u, std::size_t v) { return v * 2 + u; }

struct FreeAligned {
  void operator()(void* memory) const noexcept { ::operator delete (memory, std::align_val_t{64}); }
};

/// Patches of one shape, whose points were given in one form.
template <typename T>
struct PatchStorage {
  NetShape shape;
  std::size_t count = 0;
  std::unique_ptr<void, FreeAligned> memory;
  T* coefficients = nullptr; ///< count * shape.coefficients(), 64-byte aligned
  T* edges = nullptr;        ///< count * shape.edges(), 64-byte aligned
  GivenPoints given;         ///< count * shape.control_values(); read where a normal degenerates
  T* origins = nullptr;      ///< count * shape.origins(), or null
  /// count * shape.floors(): |du x dv|^2 above it needs no second look; with weights, what that
  /// floor is made of at a sample (pack/shape_floor.hpp).
  T* normal_floor = nullptr;
  /// No bicubic patch has a higher floor; infinity where floors differ much.
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

static_assert(NetShape{}.is_bicubic() && NetShape{}.coefficients() == kCoefficients &&
              NetShape{}.edges() == kEdgeBlock && NetShape{}.corners_at() == kCornersAt &&
              NetShape{}.origins() == kOriginBlock && NetShape{}.control_values() == kCoefficients);

} // namespace simdbezier::detail
