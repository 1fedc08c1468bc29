// Outputs in any layout, in memory that ends where they do, and what a call wrote there.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/blocks.hpp"
#include "tests/reliability/fuzz/checks/require.hpp"

namespace simdbezier::fuzz {

inline constexpr std::size_t kVectorGroups = kVectorOutputs;
inline constexpr std::size_t kNormalGroup = 6;
inline constexpr std::size_t kCurvatures = 4;

/// What a call is asked for.
struct Wanted {
  unsigned vectors = 1; ///< bits in the order of Outputs
  unsigned curvatures = 0;
  bool status = false;
  int dimension = 3; ///< components of a vector

  Wanted(ByteSource& bytes, int components, int first_component)
      : vectors(bytes.byte() & 127U), dimension(std::min(components - first_component, 3)) {
    const std::uint8_t more = bytes.byte();
    status = (more & 1) != 0;
    if (components != 3 || first_component != 0) {
      vectors &= 63U;
    } else if ((more & 2) != 0) {
      curvatures = more >> 4 & 15U;
    }
    vectors |= vectors == 0 && curvatures == 0 ? 1U : 0U;
  }
  [[nodiscard]] bool group(std::size_t g) const { return (vectors >> g & 1U) != 0; }
  [[nodiscard]] bool curvature(std::size_t k) const { return (curvatures >> k & 1U) != 0; }
};

template <typename T>
[[nodiscard]] std::array<Vectors<T>*, kVectorGroups> groups_of(Outputs<T>& out) {
  std::array<Vectors<T>*, kVectorGroups> groups{};
  for (std::size_t g = 0; g < kVectorGroups; ++g) {
    groups[g] = &out[static_cast<Output>(g)];
  }
  return groups;
}
template <typename T>
[[nodiscard]] std::array<Values<T>*, kCurvatures> curvatures_of(Outputs<T>& out) {
  return {&out.curvature.gaussian, &out.curvature.mean, &out.curvature.minimum,
          &out.curvature.maximum};
}

/// Values sample by sample: [group][component], curvatures and statuses.
template <typename T>
struct Results {
  std::array<std::array<std::vector<T>, 3>, kVectorGroups> vector;
  std::array<std::vector<T>, kCurvatures> curvature;
  std::vector<SampleStatus> status;

  /// Sample k of what a call wrote, as sample `to` of these.
  void take(Outputs<T> out, std::size_t k, std::size_t to) {
    const auto at = static_cast<std::ptrdiff_t>(k);
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      const Vectors<T>& from = *groups_of(out)[g];
      const T* const component[3] = {from.x, from.y, from.z};
      for (std::size_t c = 0; c < 3; ++c) {
        put(vector[g][c], to, component[c] == nullptr ? nullptr : component[c] + at * from.stride);
      }
    }
    for (std::size_t c = 0; c < kCurvatures; ++c) {
      const T* const plane = curvatures_of(out)[c]->first;
      put(curvature[c], to, plane == nullptr ? nullptr : plane + at);
    }
    put(status, to, out.status.wanted() ? out.status.first + at : nullptr);
  }

  void reserve(std::size_t samples) {
    for (auto& group : vector) {
      for (auto& plane : group) {
        plane.resize(samples);
      }
    }
    for (auto& plane : curvature) {
      plane.resize(samples);
    }
    status.resize(samples);
  }

  /// Aborts at the first value of sample `mine` that is not the one of sample `other`.
  void require_same(std::size_t mine, const Results& others, std::size_t other,
                    const std::string& what) const {
    bool same = status[mine] == others.status[other];
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      for (std::size_t c = 0; c < 3; ++c) {
        same = same && same_bits(vector[g][c][mine], others.vector[g][c][other]);
      }
    }
    for (std::size_t c = 0; c < kCurvatures; ++c) {
      same = same && same_bits(curvature[c][mine], others.curvature[c][other]);
    }
    require(same, [&] { return what + ": other bits at sample " + std::to_string(mine); });
  }
  void require_same(const Results& others, const std::string& what) const {
    for (std::size_t k = 0; k < status.size(); ++k) {
      require_same(k, others, k, what);
    }
  }

private:
  template <typename V>
  static void put(std::vector<V>& to, std::size_t k, const V* value) {
    if (value != nullptr) {
      to[k] = *value;
    }
  }
};

/// Memory for the outputs of one call, in a layout that bytes choose.
template <typename T>
class OutputMemory {
public:
  static constexpr T kUntouched = T(-7.7e7);

  OutputMemory(const Wanted& wanted, std::size_t samples, ByteSource& bytes)
      : samples_(samples), place_(placement(bytes)) {
    const std::uint8_t choice = bytes.byte();
    const auto gap = static_cast<std::ptrdiff_t>((choice & 48) == 48 ? choice / 64 : 0);
    const bool backwards = (choice & 12) == 12;
    switch (choice & 3) {
    case 0:
      planes(wanted, gap, backwards);
      break;
    case 1:
      records(wanted, gap, backwards, false);
      break;
    default:
      records(wanted, gap, backwards, true);
      break;
    }
    for (std::size_t c = 0; c < kCurvatures; ++c) {
      if (wanted.curvature(c)) {
        *curvatures_of(out_)[c] = add_block(samples);
      }
    }
    if (wanted.status) {
      statuses_.emplace_back(samples, place_, kNoStatus);
      out_.status = statuses_.back().data();
    }
  }

  [[nodiscard]] const Outputs<T>& out() const { return out_; }

  /// What was written for all samples; nothing else may have been.
  [[nodiscard]] Results<T> collect() { return collect(std::vector<bool>(samples_, true)); }
  /// Collects what was written where only some samples belong to the call; the others keep zeros.
  [[nodiscard]] Results<T> collect(const std::vector<bool>& written) {
    Results<T> results;
    results.reserve(samples_);
    for (std::size_t k = 0; k < samples_; ++k) {
      if (written[k]) {
        results.take(out_, k, k);
      }
    }
    check_rest(written);
    return results;
  }

private:
  static constexpr auto kNoStatus = static_cast<SampleStatus>(77);

  T* add_block(std::size_t elements) {
    blocks_.emplace_back(elements, place_, kUntouched);
    return blocks_.back().data();
  }

  // First element of a record of `members` values, each `stride` from the next.
  T* add_records(std::ptrdiff_t members, std::ptrdiff_t stride, bool backwards) {
    const auto last = samples_ == 0 ? 0 : static_cast<std::ptrdiff_t>(samples_) - 1;
    T* const first =
        add_block(samples_ == 0 ? 0 : static_cast<std::size_t>(last * stride + members));
    return first + (backwards ? last * stride : 0);
  }

  void planes(const Wanted& wanted, std::ptrdiff_t gap, bool backwards) {
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      Vectors<T>& group = *groups_of(out_)[g];
      T** const component[3] = {&group.x, &group.y, &group.z};
      for (int c = 0; wanted.group(g) && c < wanted.dimension; ++c) {
        *component[c] = add_records(1, 1 + gap, backwards);
        group.stride = backwards ? -1 - gap : 1 + gap;
      }
    }
  }

  void records(const Wanted& wanted, std::ptrdiff_t gap, bool backwards, bool together) {
    std::ptrdiff_t members = 0;
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      members += wanted.group(g) && (together || members == 0) ? wanted.dimension : 0;
    }
    const std::ptrdiff_t stride = members + gap;
    T* next = nullptr;
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if (wanted.group(g)) {
        next = next == nullptr || !together ? add_records(members, stride, backwards) : next;
        *groups_of(out_)[g] = {next, wanted.dimension > 1 ? next + 1 : nullptr,
                               wanted.dimension > 2 ? next + 2 : nullptr,
                               backwards ? -stride : stride};
        next += wanted.dimension;
      }
    }
  }

  /// Clears what belongs to the written samples; the rest must be as it was.
  void check_rest(const std::vector<bool>& written) {
    for (std::size_t k = 0; k < samples_; ++k) {
      if (written[k]) {
        clear(static_cast<std::ptrdiff_t>(k));
      }
    }
    for (const Block<T>& block : blocks_) {
      block.check_surroundings();
      for (const T value : block.span()) {
        require(same_bits(value, kUntouched), "an element that is no output has been written");
      }
    }
    for (const Block<SampleStatus>& block : statuses_) {
      block.check_surroundings();
      for (const SampleStatus value : block.span()) {
        require(value == kNoStatus, "a status that is no output has been written");
      }
    }
  }

  void clear(std::ptrdiff_t sample) {
    for (Vectors<T>* const group : groups_of(out_)) {
      for (T* const component : {group->x, group->y, group->z}) {
        if (component != nullptr) {
          component[sample * group->stride] = kUntouched;
        }
      }
    }
    for (const Values<T>* const plane : curvatures_of(out_)) {
      if (plane->wanted()) {
        plane->first[sample] = kUntouched;
      }
    }
    if (out_.status.wanted()) {
      out_.status.first[sample] = kNoStatus;
    }
  }

  std::size_t samples_;
  Placement place_;
  std::vector<Block<T>> blocks_;
  std::vector<Block<SampleStatus>> statuses_;
  Outputs<T> out_;
};

} // namespace simdbezier::fuzz
