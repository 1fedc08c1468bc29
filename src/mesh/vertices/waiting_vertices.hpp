// The places that the vertices of a mesh go to, and vertices whose samples are known, on their way
// there, with one normal for a vertex that several patches have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "src/mesh/vertices/vertex_samples.hpp"
#include "src/tables/kernel_table.hpp"
#include "src/tables/mesh_table.hpp"

namespace simdbezier::detail {

/// Attributes of vertices, in the caller's memory; null where not wanted.
template <typename T>
struct ParameterOutputs {
  T* u = nullptr;
  T* v = nullptr;
  std::ptrdiff_t stride = 1;
  std::uint32_t* patch = nullptr;

  [[nodiscard]] bool wanted() const noexcept { return u != nullptr || patch != nullptr; }
  void put(std::size_t vertex, std::uint32_t of_patch, T at_u, T at_v) const noexcept {
    if (u != nullptr) {
      u[static_cast<std::ptrdiff_t>(vertex) * stride] = at_u;
      v[static_cast<std::ptrdiff_t>(vertex) * stride] = at_v;
    }
    if (patch != nullptr) {
      patch[vertex] = of_patch;
    }
  }
  /// Those of vertices one after the other. u_step, v_step: from one value to the next, 1, -1 or 0.
  void put_run(std::size_t vertex, std::size_t count, std::uint32_t of_patch, const T* at_u,
               std::ptrdiff_t u_step, const T* at_v, std::ptrdiff_t v_step) const noexcept {
    if (u != nullptr) {
      put_values(at_u, u_step, count, u + static_cast<std::ptrdiff_t>(vertex) * stride);
      put_values(at_v, v_step, count, v + static_cast<std::ptrdiff_t>(vertex) * stride);
    }
    if (patch != nullptr) {
      std::fill_n(patch + vertex, count, of_patch);
    }
  }

private:
  /// Values of planes go in blocks, of which the last one ends with the last value: to start a
  /// function that copies takes as long as most rows.
  void put_values(const T* from, std::ptrdiff_t step, std::size_t count, T* to) const noexcept {
    constexpr std::size_t kBlock = PointBlock<T>::kPoints;
    if (stride != 1 || step < 0 || count < kBlock) {
      for (std::size_t k = 0; k < count; ++k, from += step, to += stride) {
        *to = *from;
      }
      return;
    }
    auto block = typename PointBlock<T>::Values{} + *from;
    for (std::size_t k = 0; k < count; k += kBlock) {
      const std::size_t at = std::min(k, count - kBlock);
      if (step != 0) {
        std::memcpy(&block, from + at, sizeof block);
      }
      std::memcpy(to + at, &block, sizeof block);
    }
  }
};

/// Planes that vertices go to: values of vertex k at [(k - first) * step] of a plane.
template <typename T>
struct VertexTarget {
  Planes<T> position;
  Planes<T> normal;
  std::size_t step = 1;
  std::size_t first = 0;
  ParameterOutputs<T> parameters; ///< of vertex k at k - parameters_first
  std::size_t parameters_first = 0;
  DrainQueue<T>* drain = nullptr; ///< what kernels pass on meanwhile
};

/// Turns sums of unit normals at some points into normals: sum * inverse + kept * first + 0, never
/// -0, where first is the first term. That is the sum's direction; a single term stays as it is,
/// and so does the first one where the sum is less than a thousandth of what it could be.
/// finish_sum() of the kernels for edges does the same operations. terms: of each sum.
template <typename Values>
void finish_sums(const Values (&first)[3], const Values (&sum)[3], const Values& terms,
                 Values (&normal)[3]) noexcept {
  using T = std::decay_t<decltype(terms[0])>;
  const Values square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
  const Values least = kLeastSum<T> * terms;
  const Values zero = square - square; // squares of sums of unit vectors are finite
  const Values one = zero + T(1);
  const Values none = zero + std::numeric_limits<T>::infinity();
  const auto merges = square >= (terms > one ? least * least : none);
  const Values kept = merges ? zero : one;
  Values roots = square + kept;
  for (std::size_t k = 0; k < sizeof roots / sizeof(T); ++k) {
    roots[k] = std::sqrt(roots[k]);
  }
  const Values inverse = (one - kept) / roots;
  for (std::size_t c = 0; c < 3; ++c) {
    normal[c] = sum[c] * inverse + kept * first[c] + T(0);
  }
}

/// Vertices that wait until many are finished at once, since roots and quotients of single ones
/// take longer than all the rest.
template <typename T>
class WaitingVertices {
public:
  static constexpr std::size_t kMost = 64;

  /// to: alive as long as this is, and the same as long as vertices wait.
  WaitingVertices(const VertexTarget<T>& to, bool normals) noexcept : to_(to), normals_(normals) {}

  /// At most kMost vertices with consecutive numbers: positions, and the first terms of normals.
  [[gnu::always_inline]] void put(const SampleRun<T>& run, std::size_t points,
                                  std::size_t vertex) noexcept {
    if (count_ + points > kMost) {
      finish();
    }
    const VertexSample<T>* sample = run.first;
    for (std::size_t k = 0; k < points; ++k, ++count_, sample += run.step) {
      position_[count_] = sample->position;
      place_[count_] = vertex - to_.first + k;
      if (normals_) {
        first_[count_] = sum_[count_] = run.sign * sample->normal;
        terms_[count_] = 1;
      }
    }
  }
  /// Adds more patches' normals to the vertex that was put last: those that visit(add) calls
  /// add(run) with.
  template <typename Visit>
  [[gnu::always_inline]] void add_all(const Visit& visit) noexcept {
    const std::size_t last = count_ - 1;
    typename FourOf<T>::type sum = sum_[last];
    T terms = terms_[last];
    visit([&](const SampleRun<T>& run) {
      sum += run.sign * run.first->normal;
      terms += 1;
    });
    sum_[last] = sum;
    terms_[last] = terms;
  }
  /// Adds one more patch's normals to the vertices that were put last.
  [[gnu::always_inline]] void add(const SampleRun<T>& run, std::size_t points) noexcept {
    const VertexSample<T>* sample = run.first;
    for (std::size_t k = count_ - points; k < count_; ++k, sample += run.step) {
      sum_[k] += run.sign * sample->normal;
      terms_[k] += 1;
    }
  }
  /// Gives the vertex that was put last the position of another sample.
  void move_to(const VertexSample<T>& sample) noexcept { position_[count_ - 1] = sample.position; }

  /// Writes all that wait.
  void finish() noexcept {
    for (std::size_t k = 0; k < count_; k += kBlock) {
      Block column[3];
      turn_to_components<T>(position_ + k, column);
      store(column, to_.position, k);
      if (normals_) {
        Block first[3];
        Block sum[3];
        turn_to_components<T>(first_ + k, first);
        turn_to_components<T>(sum_ + k, sum);
        Block terms;
        std::memcpy(&terms, terms_ + k, sizeof terms);
        Block normal[3];
        finish_sums(first, sum, terms, normal);
        store(normal, to_.normal, k);
      }
    }
    count_ = 0;
  }

private:
  using Four = typename FourOf<T>::type;

  static constexpr std::size_t kBlock = PointBlock<T>::kPoints;
  using Block = typename PointBlock<T>::Values;

  /// Writes components of the vertices of a block from k on, as far as there are so many.
  void store(const Block (&column)[3], const Planes<T>& planes, std::size_t k) const noexcept {
    const std::size_t* const place = place_ + k;
    const std::size_t count = std::min(kBlock, count_ - k);
    bool whole = to_.step == 1 && count == kBlock;
    for (std::size_t i = 1; i < kBlock; ++i) {
      whole = whole && place[i] == place[0] + i;
    }
    for (std::size_t c = 0; c < 3 && planes.component[c] != nullptr; ++c) {
      if (whole) {
        std::memcpy(planes.component[c] + place[0], &column[c], sizeof(Block));
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) {
        planes.component[c][place[i] * to_.step] = column[c][i];
      }
    }
  }

  const VertexTarget<T>& to_;
  bool normals_;
  std::size_t count_ = 0;
  Four position_[kMost] = {};
  Four first_[kMost] = {};
  Four sum_[kMost] = {};
  T terms_[kMost] = {};
  std::size_t place_[kMost] = {};
};

} // namespace simdbezier::detail
