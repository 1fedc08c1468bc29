// Memory that notices every access behind its ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"

namespace simdbezier::fuzz {

/// Where a block lies. Address sanitizers see what they instrument touch the bytes around a block
/// of the heap; pages without access stop everything, at one end of the block, and bytes with a
/// known value show stores behind the other.
enum class Placement : std::uint8_t { heap, ends_at_guard, begins_at_guard };

[[nodiscard]] inline Placement placement(ByteSource& bytes) {
  return static_cast<Placement>(bytes.below(3));
}

/// Exactly that many bytes; values whose size divides it are aligned.
class RawBlock {
public:
  RawBlock(std::size_t size, Placement placement);
  RawBlock(RawBlock&& other) noexcept = default;
  ~RawBlock();

  [[nodiscard]] std::uint8_t* data() const noexcept { return data_; }
  /// Aborts where bytes beside the block have changed.
  void check_surroundings() const;

private:
  struct Region;
  struct Release {
    void operator()(Region* region) const noexcept;
  };
  std::unique_ptr<std::uint8_t[]> heap_;
  std::unique_ptr<Region, Release> region_;
  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
  Placement placement_;
};

/// Exactly `count` values, all of them `fill` at first.
template <typename T>
class Block {
public:
  Block(std::size_t count, Placement placement, T fill = T())
      : raw_(count * sizeof(T), placement), count_(count) {
    std::uninitialized_fill_n(data(), count, fill);
  }

  [[nodiscard]] T* data() const noexcept { return reinterpret_cast<T*>(raw_.data()); }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::span<T> span() const noexcept { return {data(), count_}; }
  void check_surroundings() const { raw_.check_surroundings(); }

private:
  RawBlock raw_;
  std::size_t count_;
};

} // namespace simdbezier::fuzz
