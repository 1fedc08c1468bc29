// The arrays of one call of somebody else's evaluator, in memory that its process shares.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace simdbezier::tools {

/// Places arrays one after another, with fences before, between and behind them: bytes that nobody
/// may change.
class EvaluatorArrays {
public:
  /// Takes `memory`, whose first `used` bytes hold something else: arrays are placed behind them.
  EvaluatorArrays(std::span<unsigned char> memory, std::size_t used);

  /// Places a copy of an array. Returns where it begins, or 0 for an empty one. Throws Failure
  /// where the memory is too small. The arrays given have to outlive this object; `name` is a
  /// literal.
  template <typename T>
  std::size_t input(const char* name, std::span<const T> values) {
    return add({name, 0, values.size_bytes(), values.data(), nullptr});
  }
  /// Places an array that is to be written, and is all nan until then. Returns where it begins, or
  /// 0 for an empty one.
  template <typename T>
  std::size_t output(const char* name, std::span<T> values) {
    return add({name, 0, values.size_bytes(), nullptr, values.data()});
  }

  /// Returns "wrote before position", "wrote behind position", "changed net", or nothing.
  [[nodiscard]] std::string fault() const;
  /// Copies the outputs to where they were asked for.
  void copy_out() const;

private:
  struct Array {
    const char* name;
    std::size_t begin;
    std::size_t bytes;
    const void* source;
    void* target;
  };

  std::size_t add(Array array);
  static std::size_t end(const Array& array) noexcept { return array.begin + array.bytes; }
  /// Returns the first byte of a fence that is not as it was, or the fence's end.
  [[nodiscard]] std::size_t first_changed(std::size_t begin, std::size_t end) const;

  std::span<unsigned char> memory_;
  std::size_t used_;
  std::vector<Array> arrays_;
};

} // namespace simdbezier::tools
