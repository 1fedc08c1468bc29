// Grids and options of evaluate calls from bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/blocks.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {

/// Instruction sets whose results have equal bits, the narrowest one first.
[[nodiscard]] inline std::vector<std::vector<Isa>> isa_classes() {
  std::vector<std::vector<Isa>> classes(2);
  for (const Isa isa : available_isas()) {
    classes[fuses_multiply_add(isa) ? 1 : 0].push_back(isa);
  }
  std::erase_if(classes, [](const auto& one) { return one.empty(); });
  return classes;
}

[[nodiscard]] inline std::string named(const char* call, Isa isa) {
  return std::string(call) + " on " + std::string(to_string(isa));
}

/// A parameter: an end, inside, on a seam, far outside or, rarely, not finite.
template <typename T>
[[nodiscard]] T parameter(ByteSource& bytes, Parameters form) {
  const bool centred = form == Parameters::centred;
  const std::uint8_t choice = bytes.byte();
  const T within = static_cast<T>(bytes.raw<std::uint16_t>()) / T(65535);
  switch (choice & 15) {
  case 0:
    return centred ? T(-1) : T(0);
  case 1:
    return T(1);
  case 2:
    return centred ? T(0) : T(0.5);
  case 3:
    return centred ? 2 * within - 1 : std::ldexp(within, -(choice / 16) * 8);
  case 4:
    return choice < 128 ? T(3) * within : -within;
  case 5:
    return choice < 192   ? within
           : choice < 224 ? std::numeric_limits<T>::quiet_NaN()
                          : std::numeric_limits<T>::infinity();
  case 6: {
    const T raw = bytes.raw<T>();
    // Twice as much has to be finite, too.
    return std::fabs(raw) < std::numeric_limits<T>::max() / 4 ? raw : T(0);
  }
  default:
    return centred ? 2 * within - 1 : within;
  }
}

/// A parameter as the library rounds it to the centred one.
template <typename T>
[[nodiscard]] T centred_of(T given, Parameters form) {
  return form == Parameters::centred ? given : T(2) * given - T(1);
}

/// One direction of a grid: uniform, or values in a block of their own.
template <typename T>
class Direction {
public:
  Direction(ByteSource& bytes, std::size_t most, Parameters form) : form_(form) {
    const std::uint8_t choice = bytes.byte();
    count_ = 1 + choice / 2U % most;
    if ((choice & 1) == 0) {
      count_ = std::max<std::size_t>(count_, 2);
      return;
    }
    values_.emplace(count_, placement(bytes));
    for (T& value : values_->span()) {
      value = parameter<T>(bytes, form);
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool uniform() const { return !values_; }
  [[nodiscard]] const T* data() const { return values_ ? values_->data() : nullptr; }
  [[nodiscard]] T centred(std::size_t k) const {
    if (values_) {
      return centred_of(values_->span()[k], form_);
    }
    const auto last = static_cast<int>(count_) - 1;
    return static_cast<T>(2 * static_cast<int>(k) - last) / static_cast<T>(last);
  }

private:
  Parameters form_;
  std::size_t count_ = 0;
  std::optional<Block<T>> values_;
};

template <typename T>
class AnyGrid {
public:
  AnyGrid(ByteSource& bytes, std::size_t most)
      : form_(bytes.flag() ? Parameters::centred : Parameters::unit), u_(bytes, most, form_),
        v_(bytes, most, form_) {}

  [[nodiscard]] Grid<T> view() const {
    return {u_.count(), v_.count(), u_.data(), v_.data(), form_, {}};
  }
  [[nodiscard]] bool uniform() const { return u_.uniform() && v_.uniform(); }
  [[nodiscard]] std::size_t samples() const { return u_.count() * v_.count(); }
  [[nodiscard]] T x(std::size_t sample) const { return u_.centred(sample % u_.count()); }
  [[nodiscard]] T y(std::size_t sample) const {
    return v_.centred(sample % samples() / u_.count());
  }

private:
  Parameters form_;
  Direction<T> u_;
  Direction<T> v_;
};

/// tests::CallOptions but for the instruction set and threads, which targets go through themselves.
[[nodiscard]] inline tests::CallOptions any_options(ByteSource& bytes, std::size_t patches,
                                                    int components) {
  tests::CallOptions options;
  const std::uint8_t choice = bytes.byte();
  options.threads = 1 + (choice & 1);
  options.watertight = (choice & 6) != 6;
  options.destination = static_cast<Destination>((choice >> 3) % 3);
  if (choice >= 128) {
    options.first_component = static_cast<int>(bytes.below(static_cast<std::size_t>(components)));
    options.first_patch = bytes.below(patches);
    options.patch_count = bytes.below(patches - options.first_patch + 1);
  }
  return options;
}
[[nodiscard]] inline std::size_t patches_of(const tests::CallOptions& options,
                                            std::size_t patches) {
  return std::min(options.patch_count, patches - options.first_patch);
}
[[nodiscard]] inline tests::CallOptions with(tests::CallOptions options, Isa isa, int threads) {
  options.isa = isa;
  options.threads = threads;
  return options;
}

} // namespace simdbezier::fuzz
