// Triangles gathered into clusters.
#pragma once

#include <algorithm>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout/cells.hpp"

namespace simdbezier::detail {

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
