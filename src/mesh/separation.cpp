// Rates of 1 that would make triangles, or edges of triangles, coincide; see mesh_layout.hpp.
#include <algorithm>
#include <new>
#include <vector>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/topology_data.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Something of rate 1, named by what it joins: two things of one name coincide.
struct Item {
  std::uint64_t name;
  std::uint32_t number; ///< of an edge, or of a patch
  enum Kind : std::uint8_t { edge, patch_in_u, patch_in_v, whole_patch } kind;
};

std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

class Separation {
public:
  Separation(const TopologyData& topology, std::span<std::uint32_t> nu, std::span<std::uint32_t> nv)
      : topology_(topology), nu_(nu), nv_(nv), raised_(topology.patches()) {}

  /// Repeated until nothing changes: a raised rate leaves fewer items, so that it ends.
  std::size_t run() {
    do {
      changed_ = false;
      raise_closed_edges();
      raise_torn_cells();
      raise_coinciding(rails());
      raise_coinciding(chords());
    } while (changed_);
    return static_cast<std::size_t>(std::count(raised_.begin(), raised_.end(), true));
  }

private:
  [[nodiscard]] std::uint32_t rate(std::size_t side) const {
    return (runs_in_u(side) ? nu_ : nv_)[side / kPatchEdges];
  }
  void raise(std::size_t patch, bool in_u, std::uint32_t least) {
    std::uint32_t& n = (in_u ? nu_ : nv_)[patch];
    if (n < least) {
      n = least;
      raised_[patch] = changed_ = true;
    }
  }
  [[nodiscard]] std::uint32_t largest_rate(std::span<const std::uint32_t> sides) const {
    std::uint32_t largest = 0;
    for (const std::uint32_t side : sides) {
      largest = std::max(largest, rate(side));
    }
    return largest;
  }

  /// An edge that ends where it begins is a triangle at least.
  void raise_closed_edges() {
    for (std::size_t edge = 0; edge < topology_.edges(); ++edge) {
      const auto sides = topology_.sides_of(edge);
      if (topology_.corner_of(sides[0], 0) == topology_.corner_of(sides[0], 1) &&
          largest_rate(sides) < 3) {
        raise_edge(edge, 3);
      }
    }
  }

  /// Two corners in one cell that want its diagonal in both ways.
  void raise_torn_cells() {
    for (std::size_t patch = 0; patch < topology_.patches(); ++patch) {
      const std::uint8_t flags = topology_.flags[patch];
      for (std::size_t a = 0; a < kPatchCorners; ++a) {
        for (std::size_t b = a + 1; b < kPatchCorners; ++b) {
          const bool both = (flags >> a & 1) != 0 && (flags >> b & 1) != 0;
          const bool apart_u = (a & 1) != (b & 1);
          const bool apart_v = (a & 2) != (b & 2);
          if (both && falls(a) != falls(b) && (!apart_u || nu_[patch] == 1) &&
              (!apart_v || nv_[patch] == 1)) {
            raise(patch, apart_u, 2);
          }
        }
      }
    }
  }

  /// Patches of rate 1 in one direction between the same two edges.
  std::vector<Item> rails() const {
    std::vector<Item> items;
    for (std::uint32_t patch = 0; patch < topology_.patches(); ++patch) {
      for (const bool in_u : {true, false}) {
        if ((in_u ? nu_ : nv_)[patch] != 1 || (in_u ? nv_ : nu_)[patch] == 1) {
          continue;
        }
        const Side& a = topology_.sides[kPatchEdges * patch + (in_u ? 2 : 0)];
        const Side& b = topology_.sides[kPatchEdges * patch + (in_u ? 3 : 1)];
        if (!a.collapsed() && !b.collapsed()) {
          items.push_back(
              {pair_of(a.edge(), b.edge()), patch, in_u ? Item::patch_in_u : Item::patch_in_v});
        }
      }
    }
    return items;
  }

  /// Straight edges of the mesh between corners: edges of rate 1, both diagonals of patches of one
  /// cell.
  std::vector<Item> chords() const {
    std::vector<Item> items;
    for (std::uint32_t edge = 0; edge < topology_.edges(); ++edge) {
      const auto sides = topology_.sides_of(edge);
      if (largest_rate(sides) == 1) {
        items.push_back(
            {pair_of(topology_.corner_of(sides[0], 0), topology_.corner_of(sides[0], 1)), edge,
             Item::edge});
      }
    }
    for (std::uint32_t patch = 0; patch < topology_.patches(); ++patch) {
      if (nu_[patch] == 1 && nv_[patch] == 1) {
        const std::uint32_t* const corner = &topology_.corners[kPatchCorners * patch];
        items.push_back({pair_of(corner[0], corner[3]), patch, Item::whole_patch});
        items.push_back({pair_of(corner[1], corner[2]), patch, Item::whole_patch});
      }
    }
    return items;
  }

  /// Raises all items of a name that occurs twice or more.
  void raise_coinciding(std::vector<Item> items) {
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return a.name < b.name; });
    for (std::size_t k = 0; k < items.size(); ++k) {
      if ((k > 0 && items[k - 1].name == items[k].name) ||
          (k + 1 < items.size() && items[k + 1].name == items[k].name)) {
        raise(items[k]);
      }
    }
  }
  void raise(const Item& item) {
    if (item.kind == Item::edge) {
      raise_edge(item.number, 2);
      return;
    }
    if (item.kind != Item::patch_in_v) {
      raise(item.number, true, 2);
    }
    if (item.kind != Item::patch_in_u) {
      raise(item.number, false, 2);
    }
  }
  void raise_edge(std::size_t edge, std::uint32_t least) {
    for (const std::uint32_t side : topology_.sides_of(edge)) {
      raise(side / kPatchEdges, runs_in_u(side), least);
    }
  }

  const TopologyData& topology_;
  std::span<std::uint32_t> nu_;
  std::span<std::uint32_t> nv_;
  std::vector<bool> raised_;
  bool changed_ = false;
};

} // namespace
} // namespace detail

Status separate_vertices(const Topology& topology, std::span<std::uint32_t> nu,
                         std::span<std::uint32_t> nv, std::size_t& raised) noexcept try {
  const detail::TopologyData* const data = topology.data();
  const std::size_t patches = data == nullptr ? 0 : data->patches();
  const auto is_rate = [](std::uint32_t n) { return n >= 1 && n <= kMostSegments; };
  if (nu.size() != patches || nv.size() != patches || !std::all_of(nu.begin(), nu.end(), is_rate) ||
      !std::all_of(nv.begin(), nv.end(), is_rate)) {
    return Status::bad_rates;
  }
  raised = data == nullptr ? 0 : detail::Separation(*data, nu, nv).run();
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

} // namespace simdbezier
