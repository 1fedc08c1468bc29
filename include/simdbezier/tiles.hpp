// Tiles: a grid's samples, handed to the caller while they are still in the cache.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include <simdbezier/evaluate.hpp>

namespace simdbezier {

/// How the groups of a tile lie in memory.
enum class TileLayout : std::uint8_t {
  planes,     ///< SoA: every component a plane of its own, 64-byte aligned
  xyz,        ///< AoS: every group packed x y z triples, 64-byte aligned
  interleaved ///< one vertex a sample: the wanted groups' triples in the order of Outputs, no gaps
};

/// Which outputs a tile holds, and how.
struct TileFormat {
  OutputSelection outputs = {Output::position}; ///< curvatures are planes in every layout
  TileLayout layout = TileLayout::planes;
  /// The most samples in one tile; 0: what fits 24 KiB, half of a usual first-level cache. A tile
  /// holds whole patches if one fits, else whole rows of one patch, at least one.
  std::size_t samples = 0;
  int first_component = 0; ///< as in Outputs
};

/// Finished samples: rows [first_row, first_row + row_count) of patches [first_patch, first_patch +
/// patch_count), patch after patch, row after row, u fastest. If there are several, they are whole.
template <typename T>
struct Tile {
  std::size_t first_patch = 0; ///< index in the set
  std::size_t patch_count = 0;
  std::size_t first_row = 0;
  std::size_t row_count = 0;
  std::size_t nu = 0;      ///< samples in a row
  std::size_t samples = 0; ///< patch_count * row_count * nu
  int worker = 0;          ///< number of the thread, from 0; no two calls at once share it
  Outputs<T> out;          ///< the tile's own memory; the caller may change it, not keep it
};

template <typename T>
class TileFunction;

/// What a TileFunction can borrow. Another TileFunction is copied instead, and borrows the same.
template <typename F, typename T>
concept TileCallable =
    !std::same_as<std::remove_cvref_t<F>, TileFunction<T>> && std::invocable<F&, const Tile<T>&>;

/// A borrowed callable `void(const Tile<T>&)`. It must outlive the call and must not throw; it runs
/// in the library's floating-point environment (round to nearest, denormals kept).
template <typename T>
class TileFunction {
public:
  template <TileCallable<T> F>
  TileFunction(F&& function) noexcept // NOLINT: implicit on purpose
      : context_(address_of(function)), call_([](void* context, const Tile<T>& tile) {
          using Function = std::remove_reference_t<F>;
          if constexpr (std::is_function_v<Function>) {
            (*reinterpret_cast<Function*>(context))(tile);
          } else {
            (*static_cast<Function*>(context))(tile);
          }
        }) {}
  void operator()(const Tile<T>& tile) const { call_(context_, tile); }

private:
  template <typename F>
  static void* address_of(F& function) noexcept {
    if constexpr (std::is_function_v<F>) {
      return reinterpret_cast<void*>(&function);
    } else {
      return const_cast<void*>(static_cast<const void*>(std::addressof(function)));
    }
  }

  void* context_;
  void (*call_)(void*, const Tile<T>&);
};

/// Evaluates every patch of a range on one grid, tile by tile, and hands each tile to `function` on
/// the thread that made it, so that it is read from that thread's cache. Every sample arrives once;
/// each worker's tiles ascend, the order between workers is not fixed. Values are those of
/// evaluate(), bit for bit. Options::destination has no meaning. Allocation: one tile and its
/// staging a thread. Returns ok | null_output (the format wants no vector and no curvature) |
/// bad_components | bad_grid | bad_patch_range | size_overflow | the statuses of running. On an
/// error no tile was handed out.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_tiles(const PatchSet<T>& set, const Grid<T>& grid,
                                                   const TileFormat& format,
                                                   std::type_identity_t<TileFunction<T>> function,
                                                   const Options& options = {}) noexcept;

/// The samples of the largest tile that evaluate_tiles() will hand out; 0 if it will refuse them.
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t largest_tile(const PatchSet<T>& set, const Grid<T>& grid,
                                                      const TileFormat& format) noexcept;

} // namespace simdbezier
