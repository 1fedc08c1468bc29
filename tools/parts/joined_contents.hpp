// What the whole mesh has of what its parts have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/parts/part_links.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

/// Sums and largest values over parts.
class JoinedContents {
public:
  void add(const MeshContents& part) {
    if (!any_) {
      contents_ = part;
      any_ = true;
      return;
    }
    contents_.vertices += part.vertices;
    contents_.faces += part.faces;
    contents_.among_quads += part.among_quads;
    contents_.margin = std::max(contents_.margin, part.margin);
    if (contents_.deviation) {
      contents_.deviation = std::max(*contents_.deviation, part.deviation.value_or(0));
    }
    for (std::size_t c = 0; c < 3 && contents_.box; ++c) {
      contents_.box->low[c] = std::min(contents_.box->low[c], part.box->low[c]);
      contents_.box->high[c] = std::max(contents_.box->high[c], part.box->high[c]);
    }
  }
  [[nodiscard]] const MeshContents& contents() const noexcept { return contents_; }

private:
  MeshContents contents_;
  bool any_ = false;
};

/// Where the vertices of patches begin in the whole mesh, as far as other parts ask for them.
class VertexDirectory {
public:
  /// Parts are added in their order, or all that one part needs, ascending. first: the number of
  /// the first vertex of the part that lends.
  void add(std::span<const LentVertices> lent, std::uint64_t first) {
    const std::size_t before = lent_.size();
    lent_.insert(lent_.end(), lent.begin(), lent.end());
    for (LentVertices& each : std::span(lent_).subspan(before)) {
      for (std::uint32_t& number : each.begins) {
        number += number == kNoVertex ? 0 : static_cast<std::uint32_t>(first);
      }
    }
  }
  /// Returns what is known of a patch that lends.
  [[nodiscard]] const LentVertices& of(std::uint32_t patch) const {
    return *std::ranges::lower_bound(lent_, patch, {}, &LentVertices::patch);
  }
  /// Throws Failure where nobody tells a vertex.
  [[nodiscard]] std::vector<std::uint32_t> numbers(std::span<const ForeignVertex> foreign) const {
    std::vector<std::uint32_t> numbers;
    for (const ForeignVertex& vertex : foreign) {
      const auto at = std::ranges::lower_bound(lent_, vertex.patch, {}, &LentVertices::patch);
      const bool known = at != lent_.end() && at->patch == vertex.patch;
      const std::uint32_t begin = known ? at->begins[vertex.slot] : kNoVertex;
      if (begin == kNoVertex) {
        bad_input("expected parts that agree on what they share, found a vertex of patch " +
                  std::to_string(vertex.patch) + " that it does not own");
      }
      numbers.push_back(begin + vertex.offset);
    }
    return numbers;
  }

private:
  std::vector<LentVertices> lent_;
};

} // namespace simdbezier::tools
