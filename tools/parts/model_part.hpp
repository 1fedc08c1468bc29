// Some patches of a model, with all that their mesh depends on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/parts/patch_source.hpp>

namespace simdbezier::tools {

/// Patches of its own, between ghosts before and behind them (mesh_layout.hpp); or a whole model,
/// which has no ghosts.
struct ModelPart {
  PatchFile file;                     ///< own patches and ghosts, in the order of the model
  SetRange own;                       ///< among them
  std::vector<std::uint32_t> numbers; ///< of all of them in the model; empty where it is whole
  std::size_t patches = 0;            ///< of the model
  MeshBox box;                        ///< of all control points of the model
  /// An own patch (its number in the model) that owns what a later patch, which is not an own one,
  /// may share; ascending.
  struct Lent {
    std::uint32_t patch;
    std::uint32_t to;
    auto operator<=>(const Lent&) const = default;
  };
  std::vector<Lent> lent;

  /// The numbers of ghosts in the model.
  [[nodiscard]] std::vector<std::uint32_t> ghosts() const;
  /// Of the first own patch in the model.
  [[nodiscard]] std::size_t first_patch() const {
    return numbers.empty() ? own.first : numbers[own.first];
  }
};

/// Returns the model as one part.
[[nodiscard]] ModelPart whole_model(PatchFile file);

/// Returns consecutive patches, and as ghosts those that own ones, or other ghosts, share places
/// with, as far as these decide how many cells an own patch or its neighbours get. T: the type in
/// which points are compared.
template <typename T>
[[nodiscard]] ModelPart joined_part(const PatchSource& source, SetRange own);
/// Reads the same part again. ghosts: those that it had.
[[nodiscard]] ModelPart part_with(const PatchSource& source, SetRange own,
                                  std::vector<std::uint32_t> ghosts);
/// Returns the patches alone, whose meshes meet no others.
[[nodiscard]] ModelPart loose_part(const PatchSource& source, SetRange own);

/// Returns the patches of one of so many shards, which cover the model in its order.
[[nodiscard]] inline SetRange shard_range(std::size_t patches, std::size_t shard,
                                          std::size_t shards) {
  const auto begin = [&](std::size_t k) { // without a product that could overflow
    return patches / shards * k + patches % shards * k / shards;
  };
  return {begin(shard), begin(shard + 1) - begin(shard)};
}

} // namespace simdbezier::tools
