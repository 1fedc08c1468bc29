// The vertices in corners and on edges, in their places: those of patches of few cells from closed
// grids, edges of one or two patches by kernels that know edges, all others from samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/mesh/vertices/boundary_samples.hpp"
#include "src/mesh/vertices/waiting_vertices.hpp"

namespace simdbezier::detail {

/// The patch, of those at a vertex, that gives its position: the lowest of all, or, where the
/// vertex is split, the lowest of those that have this very one.
enum class ValuesOf : std::uint8_t { owner, own_patch };

/// One thread's boundary vertices on their way to memory. Many of them wait until finish().
template <typename T>
class BoundaryVertices {
public:
  [[nodiscard]] static std::size_t bytes(const MeshData& mesh) noexcept {
    return whole_lines(mesh.most_boundary_samples * sizeof(Member));
  }
  /// to: as for WaitingVertices.
  BoundaryVertices(const MeshData& mesh, BoundarySamples<T>& samples, WaitingVertices<T>& waiting,
                   ValuesOf values, bool normals, const VertexTarget<T>& to,
                   unsigned char* memory) noexcept
      : mesh_(mesh), merged_(mesh.normals()), topology_(*mesh.topology.data()), samples_(samples),
        waiting_(waiting), values_(values), normals_(normals), to_(to),
        members_(reinterpret_cast<Member*>(memory)) {}

  /// The vertices of some joined corners. lowest: the first of them.
  void put_corner(std::uint32_t lowest) noexcept {
    if (!mesh_.side_first.empty() && is_split_corner(mesh_, lowest)) {
      put_split(samples_.joined(lowest), is_split_corner(merged_, lowest), nullptr);
      return;
    }
    waiting_.put(samples_.corner(lowest), 1, mesh_.corners[lowest]);
    if (normals_) {
      const std::uint32_t* const next = topology_.next_corner.data();
      const bool all_agree = topology_.apart.empty();
      waiting_.add_all([&](const auto& add) {
        for (std::uint32_t corner = next[lowest]; corner != lowest; corner = next[corner]) {
          if (all_agree || !topology_.is_apart(corner, kApartCorner)) {
            add(samples_.corner(corner));
          }
        }
      });
    }
    if (to_.parameters.wanted()) {
      put_corner_parameters(lowest, mesh_.corners[lowest]);
    }
  }

  /// The vertices between the ends of an edge.
  void put_edge(std::uint32_t edge) noexcept {
    if (mesh_.segments[edge] == 1) {
      return;
    }
    const auto sides = topology_.sides_of(edge);
    const std::uint32_t own = sides.front();
    if (mesh_.is_split(own)) {
      run_jobs(); // the lines of their parameters may give way to others
      const BoundaryEntry<T> entry = samples_.edge(edge);
      put_split(entry, merged_.is_split(own), samples_.line_of(edge).shares);
      return;
    }
    if (sides.size() > 2 || !(put_small_edge(edge, sides) || add_job(edge, sides))) {
      run_jobs();
      put_samples(samples_.edge(edge), mesh_.edge_first[edge]);
    }
    if (to_.parameters.wanted()) {
      put_parameters(edge);
    }
  }

  /// The line of a patch's columns or rows.
  ParameterLine<T> line(std::uint32_t rate) noexcept {
    return rate <= ParameterLines<T>::kMost ? line(rate, rate) : samples_.lines().large_line(rate);
  }
  /// Writes all that waits.
  void finish() noexcept {
    waiting_.finish();
    run_jobs();
  }

private:
  static constexpr std::size_t kMostJobs = 64;

  /// One patch at an edge or in a corner.
  struct Member {
    std::uint32_t place; ///< a side, or 4 * patch + corner
    SampleRun<T> samples;
    bool apart;
    // Of the point in question:
    std::uint32_t vertex;
    std::uint32_t merged; ///< the vertex in the layout where normals are merged
  };

  [[nodiscard]] T sign_of(std::size_t patch) const noexcept {
    return topology_.is_turned(patch) ? T(-1) : T(1);
  }
  [[nodiscard]] bool is_split_corner(const MeshData& mesh, std::uint32_t lowest) const noexcept {
    std::uint32_t corner = lowest;
    do {
      corner = topology_.next_corner[corner];
    } while (mesh.corners[corner] == mesh.corners[lowest] && corner != lowest);
    return corner != lowest;
  }

  /// A line that edges may wait with.
  ParameterLine<T> line(std::uint32_t a, std::uint32_t b) noexcept {
    if (!samples_.lines().holds(a, b)) {
      run_jobs();
    }
    return samples_.lines().line(a, b);
  }

  /// An edge between patches of few cells. False where nothing is written.
  bool put_small_edge(std::uint32_t edge, std::span<const std::uint32_t> sides) noexcept {
    const std::uint32_t own = sides.front();
    const std::uint32_t other = sides.back();
    const std::uint32_t segments = mesh_.segments[edge];
    if (segments > ClosedGrids<T>::kMostRate || mesh_.rate(own) != segments ||
        mesh_.rate(other) != segments) {
      return false;
    }
    const std::size_t patch = own / kPatchEdges;
    const bool merges = normals_ && other != own && !topology_.is_apart(other, kApartSide);
    const ClosedGrid<T>& grid = samples_.grids().of(patch);
    const ClosedGrid<T>& beyond = samples_.grids().of(merges ? other / kPatchEdges : patch);
    if (grid.patch != patch || !grid.whole || !beyond.whole) {
      return false;
    }
    waiting_.put(grid.side(own, topology_.sides[own].reversed()), segments - 1,
                 mesh_.edge_first[edge]);
    if (merges) {
      waiting_.add(beyond.side(other, topology_.sides[other].reversed()), segments - 1);
    }
    return true;
  }

  /// Lets an edge wait for the kernel. False where it is none of those that kernels know.
  bool add_job(std::uint32_t edge, std::span<const std::uint32_t> sides) noexcept {
    PatchRunner<T>& runner = samples_.runner();
    const std::uint32_t rate = mesh_.rate(sides.front());
    const std::uint32_t other = mesh_.rate(sides.back());
    // No branches: in a mesh of many rates nothing predicts which of both is larger.
    const std::uint32_t low = std::min(rate, other);
    const std::uint32_t high = std::max(rate, other);
    const std::uint32_t bucket = runner.bucket_of(sides.front() / kPatchEdges);
    if (high > ParameterLines<T>::kMost || !runner.has_edges(bucket) ||
        bucket != runner.bucket_of(sides.back() / kPatchEdges)) {
      return false;
    }
    const T* const along = line(low, high).along;
    if (jobs_ == kMostJobs || bucket_ != bucket) {
      run_jobs();
    }
    bucket_ = bucket;
    EdgeJob<T>& job = job_[jobs_++];
    job.along = along;
    job.points = mesh_.segments[edge] - 1;
    job.place = mesh_.edge_first[edge] - to_.first;
    job.members = 0;
    for (const std::uint32_t side : sides) {
      if (job.members == 0 || (normals_ && !topology_.is_apart(side, kApartSide))) {
        const std::size_t patch = side / kPatchEdges;
        job.member[job.members++] = {runner.index_of(patch), side % kPatchEdges,
                                     topology_.sides[side].reversed() ? T(-1) : T(1),
                                     sign_of(patch)};
      }
    }
    return true;
  }
  void run_jobs() noexcept {
    if (jobs_ > 0) {
      samples_.runner().run_edges({job_, jobs_}, bucket_,
                                  {to_.position, to_.normal, to_.step, to_.drain});
      jobs_ = 0;
    }
  }

  void list_members(const BoundaryEntry<T>& entry) noexcept {
    std::size_t m = 0;
    const auto add = [&](std::size_t place, ApartFlag flag) {
      if (m < entry.members) {
        members_[m] = {static_cast<std::uint32_t>(place),
                       {entry.samples + m * entry.points, 1, sign_of(place / 4)},
                       topology_.is_apart(place, flag),
                       0,
                       0};
        ++m;
      }
    };
    if (entry.corner) {
      topology_.for_joined(entry.place, [&](std::size_t corner) { add(corner, kApartCorner); });
    } else {
      for (const std::uint32_t side : topology_.sides_of(entry.place)) {
        add(side, kApartSide);
      }
    }
  }
  /// The vertices of an edge that is not split.
  void put_samples(const BoundaryEntry<T>& entry, std::size_t vertex) noexcept {
    list_members(entry);
    std::size_t points = 0;
    for (std::size_t k = 0; k < entry.points; k += points) {
      points = std::min(entry.points - k, WaitingVertices<T>::kMost);
      for (std::size_t m = 0; m < entry.members; ++m) {
        const Member& member = members_[m];
        const SampleRun<T> run{member.samples.first + k, 1, member.samples.sign};
        if (m == 0) {
          waiting_.put(run, points, vertex + k);
        } else if (normals_ && !member.apart) {
          waiting_.add(run, points);
        }
      }
    }
  }
  /// The different vertices of each point of an entry. splits_normals: those in different patches
  /// have normals of their own; else those apart have. shares: of an edge's points.
  void put_split(const BoundaryEntry<T>& entry, bool splits_normals, const T* shares) noexcept {
    list_members(entry);
    const auto sample = [](const Member& member, std::uint32_t k) {
      return SampleRun<T>{member.samples.first + k, 0, member.samples.sign};
    };
    for (std::uint32_t k = 0; k < entry.points; ++k) {
      for_vertices(entry, k, [&](Member& member) {
        Member* first = members_;
        while (first->merged != member.merged) {
          ++first;
        }
        waiting_.put(sample(*first, k), 1, member.vertex);
        waiting_.move_to(sample(values_ == ValuesOf::owner ? *members_ : member, k).first[0]);
        for (Member* next = first + 1; normals_ && next != members_ + entry.members; ++next) {
          if (next->merged == first->merged && (splits_normals || !next->apart)) {
            waiting_.add(sample(*next, k), 1);
          }
        }
        if (to_.parameters.wanted() && entry.corner) {
          put_corner_parameters(member.place, member.vertex);
        } else if (to_.parameters.wanted()) {
          put_side_parameters(member.place, shares, entry.points, k, 1, member.vertex);
        }
      });
    }
  }
  /// Calls visit(the first member that has it) for the different vertices of a point.
  template <typename Visit>
  void for_vertices(const BoundaryEntry<T>& entry, std::uint32_t k, const Visit& visit) noexcept {
    for (Member* member = members_; member != members_ + entry.members; ++member) {
      const auto vertex_in = [&](const MeshData& mesh) {
        return entry.corner ? mesh.corners[member->place] : mesh.edge_vertex(member->place, k + 1);
      };
      member->vertex = vertex_in(mesh_);
      member->merged = vertex_in(merged_);
    }
    for (Member* member = members_; member != members_ + entry.members; ++member) {
      const auto has = [&](const Member& earlier) { return earlier.vertex == member->vertex; };
      if (std::none_of(members_, member, has)) {
        visit(*member);
      }
    }
  }

  /// A side that is a point has all parameters from 0 to 1, whose middle is near to all. Where both
  /// sides are, only one parameter is free: the middle of both would be inside of the patch.
  void put_corner_parameters(std::uint32_t corner, std::size_t vertex) const noexcept {
    const std::size_t patch = corner / kPatchCorners;
    const Side* const sides = &topology_.sides[kPatchEdges * patch];
    const bool any_u = sides[corner % 4 / 2].collapsed();
    const bool any_v = sides[2 + corner % 2].collapsed() && !any_u;
    const T u = any_u ? T(0.5) : T(corner % 2);
    const T v = any_v ? T(0.5) : T(corner % 4 / 2);
    to_.parameters.put(vertex - to_.parameters_first, static_cast<std::uint32_t>(patch), u, v);
  }
  /// Those of `count` of a side's points from `k` on, in the direction of its edge.
  void put_side_parameters(std::uint32_t side, const T* shares, std::size_t points, std::size_t k,
                           std::size_t count, std::size_t vertex) const noexcept {
    static constexpr T kEnds[] = {0, 1};
    const bool reversed = topology_.sides[side].reversed();
    const std::ptrdiff_t step = reversed ? -1 : 1;
    const T* const t = shares + (reversed ? points - 1 - k : k);
    const T* const end = kEnds + side % 2;
    const auto patch = static_cast<std::uint32_t>(side / kPatchEdges);
    vertex -= to_.parameters_first;
    if (runs_in_u(side)) {
      to_.parameters.put_run(vertex, count, patch, t, step, end, 0);
    } else {
      to_.parameters.put_run(vertex, count, patch, end, 0, t, step);
    }
  }
  void put_parameters(std::uint32_t edge) noexcept {
    const auto sides = topology_.sides_of(edge);
    const std::uint32_t points = mesh_.segments[edge] - 1;
    const auto [low, high] = std::minmax({mesh_.rate(sides.front()), mesh_.rate(sides.back())});
    const bool kept = sides.size() <= 2 && high <= ParameterLines<T>::kMost;
    const T* const shares = (kept ? line(low, high) : samples_.line_of(edge)).shares;
    put_side_parameters(sides.front(), shares, points, 0, points, mesh_.edge_first[edge]);
  }

  const MeshData& mesh_;
  const MeshData& merged_; ///< whose vertices have a normal each
  const TopologyData& topology_;
  BoundarySamples<T>& samples_;
  WaitingVertices<T>& waiting_;
  ValuesOf values_;
  bool normals_;
  const VertexTarget<T>& to_;
  Member* members_;
  std::size_t jobs_ = 0;
  std::uint32_t bucket_ = 0; ///< of all edges that wait
  EdgeJob<T> job_[kMostJobs];
};

} // namespace simdbezier::detail
