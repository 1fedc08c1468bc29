// Memory of one call's outputs in T, and its way into a Sheet.
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/properties/metamorphic/meta_set.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests {

/// The memory of one call: as many planes as are asked for, and where they belong.
template <typename T>
class Memory {
public:
  explicit Memory(std::size_t samples) : samples_(samples) {}

  /// `planes` of 3 components; the pointers stay valid.
  [[nodiscard]] Vectors<T> vectors(int planes) {
    T* const first = block(3);
    return {first, planes > 1 ? first + samples_ : nullptr,
            planes > 2 ? first + 2 * samples_ : nullptr, 1};
  }
  [[nodiscard]] T* block(std::size_t planes) {
    blocks_.push_back(std::make_unique<std::vector<T>>(planes * samples_, T(-777)));
    return blocks_.back()->data();
  }

private:
  std::size_t samples_;
  std::vector<std::unique_ptr<std::vector<T>>> blocks_;
};

template <typename T>
void take(const Vectors<T>& from, std::size_t samples, int components, int first,
          std::vector<double>& to) {
  to.resize(samples * static_cast<std::size_t>(components));
  const T* const planes[] = {from.x, from.y, from.z};
  for (int c = 0; c < 3 && planes[c] != nullptr; ++c) {
    for (std::size_t k = 0; k < samples; ++k) {
      to[k * static_cast<std::size_t>(components) + static_cast<std::size_t>(first + c)] =
          static_cast<double>(planes[c][k]);
    }
  }
}

/// The centred parameters of a uniform grid.
template <typename T>
[[nodiscard]] std::vector<T> parameters(std::size_t n) {
  std::vector<T> list;
  for (std::size_t i = 0; i < n; ++i) {
    list.push_back(uniform_centred<T>(static_cast<int>(i), static_cast<int>(n) - 1));
  }
  return list;
}

/// The iso-curves of a set: every column (row) of the grid is that of all patches at its parameter.
template <typename T>
[[nodiscard]] Status evaluate_iso(const PatchSet<T>& set, Call call, const CallOptions& options,
                                  Sheet& sheet);

[[nodiscard]] inline PackOptions pack_options(const Placement& placement, Isa isa) {
  PackOptions options;
  options.local_origin = placement.local_origin;
  std::copy(placement.relative_to.begin(), placement.relative_to.end(), options.relative_to);
  options.isa = isa;
  return options;
}

/// evaluate(options, sheet) for three components after three.
template <typename Evaluate>
[[nodiscard]] Status in_triples(int components, CallOptions options, Sheet& sheet,
                                const Evaluate& evaluate) {
  options.threads = 1;
  Status status = Status::ok;
  for (int first = 0; first < components && status == Status::ok; first += 3) {
    options.first_component = first;
    status = evaluate(options, sheet);
  }
  return status;
}

} // namespace simdbezier::tests
