// evaluate(set, where, {Output::position, …}): results in std::vectors of the right size.
//
//     const auto samples = evaluate(set, Grid<float>::uniform(17, 17), {Output::position});
//     if (samples) { use(samples.position[k][0]); }
//
// These calls are the short way. They allocate anew every time, which costs more than most
// evaluations; the calls of evaluate.hpp write to existing memory in any layout.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <new>
#include <stdexcept>
#include <vector>

#include <simdbezier/evaluate.hpp>

namespace simdbezier {

/// One value a sample in each vector that was asked for. The others are empty; on an error, all.
template <typename T>
struct SurfaceSamples {
  Status status;
  std::vector<std::array<T, 3>> position;
  std::vector<std::array<T, 3>> du;
  std::vector<std::array<T, 3>> dv;
  std::vector<std::array<T, 3>> duu;
  std::vector<std::array<T, 3>> duv;
  std::vector<std::array<T, 3>> dvv;
  std::vector<std::array<T, 3>> normal;
  std::vector<SampleStatus> sample_status;
  std::vector<T> gaussian;
  std::vector<T> mean;
  std::vector<T> minimum;
  std::vector<T> maximum;

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(status); }

  /// The vector output of a name, which has to be one before Output::curvature.
  [[nodiscard]] std::vector<std::array<T, 3>>& operator[](Output output) noexcept {
    std::vector<std::array<T, 3>>* const members[] = {&position, &du,  &dv,    &duu,
                                                      &duv,      &dvv, &normal};
    static_assert(std::size(members) == kVectorOutputs, "every vector output has a member");
    return *members[static_cast<std::size_t>(output)];
  }
  [[nodiscard]] std::vector<T>& operator[](Curvature curvature) noexcept {
    std::vector<T>* const members[] = {&gaussian, &mean, &minimum, &maximum};
    static_assert(std::size(members) == kCurvatureKinds);
    return *members[static_cast<std::size_t>(curvature)];
  }
};

namespace detail {

/// Makes room for `count` samples, and says where it is. May throw what std::vector throws.
template <typename T>
Outputs<T> make_room(SurfaceSamples<T>& samples, const OutputSelection& wanted, std::size_t count) {
  Outputs<T> out;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    const auto output = static_cast<Output>(k);
    if (wanted.holds(output)) {
      samples[output].resize(count);
      out[output] = Vectors<T>::xyz(samples[output]);
    }
  }
  if (wanted.holds(Output::curvature)) {
    for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
      const auto curvature = static_cast<Curvature>(k);
      samples[curvature].resize(count);
      out.curvature[curvature] = samples[curvature];
    }
  }
  if (wanted.holds(Output::status)) {
    samples.sample_status.resize(count);
    out.status = samples.sample_status;
  }
  return out;
}

} // namespace detail

/// Evaluates patches as evaluate(set, where, out, options) does, and returns its statuses. Patches
/// of one or two components are bad_components; of more than three, positions and derivatives are
/// the first three. where: a Grid<T>, PatchGrids or Samples<T>.
template <typename T, typename Where>
[[nodiscard]] SurfaceSamples<T> evaluate(const PatchSet<T>& set, const Where& where,
                                         const OutputSelection& wanted,
                                         const Options& options = {}) noexcept {
  SurfaceSamples<T> samples;
  try {
    const Outputs<T> out = detail::make_room(samples, wanted, sample_count(set, where));
    samples.status = evaluate(set, where, out, options);
  } catch (const std::bad_alloc&) {
    samples.status = Status::out_of_memory;
  } catch (const std::length_error&) {
    samples.status = Status::size_overflow;
  }
  if (samples) {
    return samples;
  }
  SurfaceSamples<T> none;
  none.status = samples.status;
  return none;
}

} // namespace simdbezier
