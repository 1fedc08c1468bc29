// Little-endian numbers off the front of a byte string.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace simdbezier::tests {

class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t rest() const { return bytes_.size(); }
  std::string_view take_bytes(std::size_t size) {
    if (size > bytes_.size()) {
      ADD_FAILURE() << "the data end early";
      size = bytes_.size();
    }
    const std::string_view front = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return front;
  }
  template <typename T>
  T take() {
    const std::string_view front = take_bytes(sizeof(T));
    std::uint64_t bits = 0;
    for (std::size_t k = front.size(); k-- > 0;) {
      bits = bits << 8 | static_cast<unsigned char>(front[k]);
    }
    T value;
    std::memcpy(&value, &bits, sizeof value); // tests run on little-endian machines
    return value;
  }

private:
  std::string_view bytes_;
};

} // namespace simdbezier::tests
