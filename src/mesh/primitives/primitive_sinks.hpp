// What cells become: triangles, polygons, strips, clusters. Every sink counts where it has no
// memory to write to.
#pragma once

#include <algorithm>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/index_stream.hpp"

namespace simdbezier::detail {

/// Vertex numbers one after the other, or only their count.
template <typename Index>
class IndexWriter {
public:
  explicit IndexWriter(Index* to) : to_(to) {}

  template <typename... Vertices>
  void put(Vertices... vertices) {
    if (to_ != nullptr) {
      ((*to_++ = static_cast<Index>(vertices)), ...);
    }
    count_ += sizeof...(vertices);
  }
  [[nodiscard]] std::size_t count() const { return count_; }

private:
  Index* to_;
  std::size_t count_ = 0;
};

/// Triangles, three numbers each.
template <typename Index>
class TriangleSink {
public:
  TriangleSink(IndexStream<Index>& stream, bool turned)
      : stream_(stream), to_(stream.cursor()), turned_(turned) {}

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    put(a, b, c);
    to_ = stream_.make_room(to_);
  }
  void cell(const CellCorners& c, bool falling) {
    put_halves(c, falling, [&](auto... vertices) { put(vertices...); });
    to_ = stream_.make_room(to_);
  }
  void cells(const CellCorners& first, const VertexSteps& steps, std::uint32_t count,
             bool falling) {
    constexpr std::uint32_t kMost = IndexStream<Index>::kMostNumbers / 6;
    CellCorners c = first;
    while (count > 0) {
      const std::uint32_t n = std::min(count, kMost);
      const CellRun<Index> run(c.at[0], c.at[2], steps, falling, turned_);
      to_ = stream_.make_room(run.write(0, n, to_));
      c.at[0] += n * steps.below;
      c.at[2] += n * steps.above;
      count -= n;
    }
  }
  [[nodiscard]] Index* end() const { return to_; }

private:
  void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    to_[0] = static_cast<Index>(a);
    to_[1] = static_cast<Index>(turned_ ? c : b);
    to_[2] = static_cast<Index>(turned_ ? b : c);
    to_ += 3;
  }

  IndexStream<Index>& stream_;
  Index* to_;
  bool turned_;
};

/// Quads where cells have four vertices, triangles elsewhere. A quad begins at an end of its cell's
/// diagonal, so that cutting it from its first to its third vertex gives the certified mesh.
template <typename Index>
class PolygonSink {
public:
  PolygonSink(Index* indices, std::uint8_t* sizes, bool turned)
      : indices_(indices), sizes_(sizes), turned_(turned) {}

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices_.put(a, turned_ ? c : b, turned_ ? b : c);
    sizes_.put(3);
  }
  void cell(const CellCorners& c, bool falling) {
    const std::uint32_t first = falling ? c.at[1] : c.at[0];
    const std::uint32_t second = falling ? c.at[3] : c.at[1];
    const std::uint32_t third = falling ? c.at[2] : c.at[3];
    const std::uint32_t fourth = falling ? c.at[0] : c.at[2];
    indices_.put(first, turned_ ? fourth : second, third, turned_ ? second : fourth);
    sizes_.put(4);
  }
  PolygonSize finish() const { return {sizes_.count(), indices_.count()}; }

private:
  IndexWriter<Index> indices_;
  IndexWriter<std::uint8_t> sizes_;
  bool turned_;
};

/// Triangle strips, each of which ends with the largest number. Cells side by side whose diagonals
/// run the same way are one strip:
///
///     a0 - a1 - a2        a0 b0 a1 b1 a2 b2: triangles a0 b0 a1, a1 b0 b1, a1 b1 a2, …
///     |  / |  / |         Falling diagonals need the opposite orientation, which repeating a
///     b0 - b1 - b2        vertex gives: b0 b0 a0 b1 a1 b2 a2.
template <typename Index>
class StripSink {
public:
  StripSink(Index* to, bool turned) : indices_(to), turned_(turned) {}

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    end_strip();
    indices_.put(a, turned_ ? c : b, turned_ ? b : c);
    open_ = true;
    continues_ = false;
  }
  void cell(const CellCorners& c, bool falling) {
    if (!(open_ && continues_ && falling == falling_ && c.at[0] == last_[0] &&
          c.at[2] == last_[1])) {
      end_strip();
      if (falling == !turned_) {
        indices_.put(falling ? c.at[0] : c.at[2]);
      }
      put_column(c.at[0], c.at[2], falling);
    }
    put_column(c.at[1], c.at[3], falling);
    open_ = continues_ = true;
    falling_ = falling;
    last_[0] = c.at[1];
    last_[1] = c.at[3];
  }
  std::size_t finish() {
    end_strip();
    return indices_.count();
  }

private:
  static constexpr Index kRestart = static_cast<Index>(-1);

  void end_strip() {
    if (open_) {
      indices_.put(kRestart);
      open_ = false;
    }
  }
  void put_column(std::uint32_t below, std::uint32_t above, bool falling) {
    indices_.put(falling ? below : above, falling ? above : below);
  }

  IndexWriter<Index> indices_;
  bool turned_;
  bool open_ = false;
  bool continues_ = false; ///< the open strip is one of cells
  bool falling_ = false;
  std::uint32_t last_[2] = {0, 0};
};

/// Counts clusters, and writes them where it has memory. A cluster ends where the next cell's
/// triangles would be too many.
class ClusterSink {
public:
  /// first: what the patches before have filled.
  ClusterSink(const ClusterOutputs* out, const ClusterSize& first, std::uint32_t patch, bool turned)
      : out_(out), size_(first), patch_(patch), turned_(turned) {}

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    make_room(1, 3);
    put(a, b, c);
  }
  void cell(const CellCorners& c, bool falling) {
    make_room(2, 4);
    put_halves(c, falling, [this](auto... vertices) { put(vertices...); });
  }
  const ClusterSize& finish() {
    end_cluster();
    return size_;
  }

private:
  void end_cluster() {
    if (cluster_.triangles == 0) {
      return;
    }
    cluster_.patch = patch_;
    if (out_ != nullptr) {
      out_->clusters[size_.clusters] = cluster_;
    }
    ++size_.clusters;
    cluster_ = {};
  }
  void make_room(std::uint32_t triangles, std::uint32_t vertices) {
    if (cluster_.triangles + triangles > kMostClusterTriangles ||
        cluster_.vertices + vertices > kMostClusterVertices) {
      end_cluster();
    }
    if (cluster_.triangles == 0) {
      cluster_.first_vertex = static_cast<std::uint32_t>(size_.vertices);
      cluster_.first_triangle = static_cast<std::uint32_t>(size_.triangles);
    }
  }
  void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint8_t corners[3] = {number(a), number(turned_ ? c : b), number(turned_ ? b : c)};
    if (out_ != nullptr) {
      std::copy_n(corners, 3, &out_->corners[3 * size_.triangles]);
    }
    ++size_.triangles;
    ++cluster_.triangles;
  }
  /// The cluster's own number of a vertex; the search begins with those that came last.
  std::uint8_t number(std::uint32_t vertex) {
    for (std::uint32_t k = cluster_.vertices; k-- > 0;) {
      if (vertices_[k] == vertex) {
        return static_cast<std::uint8_t>(k);
      }
    }
    vertices_[cluster_.vertices] = vertex;
    if (out_ != nullptr) {
      out_->vertices[size_.vertices] = vertex;
    }
    ++size_.vertices;
    return static_cast<std::uint8_t>(cluster_.vertices++);
  }

  const ClusterOutputs* out_;
  ClusterSize size_;
  std::uint32_t patch_;
  bool turned_;
  MeshCluster cluster_;
  std::uint32_t vertices_[kMostClusterVertices];
};

} // namespace simdbezier::detail
