// The caller's structs, which carry their size, and numbers that stand for names and types.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "src/c_api/fault.hpp"

namespace simdbezier::c_api {

/// The size of a struct in the first version that had it. A member that is added goes to the end,
/// behind any padding, and the struct gets a specialisation with the size that it had before.
template <typename S>
inline constexpr std::size_t kFirstSize = sizeof(S);

/// No struct will ever be larger; a larger struct_size is one that was never set.
inline constexpr std::size_t kMostSize = 4096;

/// Whether some version of S can have that size: one that is no multiple of its alignment would
/// leave the next element of an array where none can lie.
template <typename S>
bool is_size(std::size_t size) noexcept {
  return size >= kFirstSize<S> && size <= kMostSize && size % alignof(S) == 0;
}

/// A struct that was read, and what the caller calls it.
template <typename S>
struct Given : S {
  Path path;
};

/// The caller's struct in the size that is known here. Members that the caller did not know become
/// zero; members that are not known here have to be zero.
template <typename S>
Given<S> read(const S* given, const Path& path) {
  static_assert(std::is_trivially_copyable_v<S>);
  require(given != nullptr, SIMDBEZIER_NULL_INPUT, path);
  const std::size_t size = given->struct_size;
  require(is_size<S>(size), SIMDBEZIER_BAD_STRUCT_SIZE, path / "struct_size");
  Given<S> known{{}, path};
  std::memcpy(static_cast<S*>(&known), given, std::min(size, sizeof(S)));
  if (size > sizeof(S)) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    require(std::all_of(bytes + sizeof(S), bytes + size, [](unsigned char b) { return b == 0; }),
            SIMDBEZIER_BAD_STRUCT_SIZE, path / "struct_size");
  }
  return known;
}

/// Reads a struct of options, for which null stands for zeros.
template <typename S>
Given<S> read_options(const S* given, const Path& path) {
  return given == nullptr ? Given<S>{{}, path} : read(given, path);
}

/// Element k of an array of structs, all of which have the size of the first.
template <typename S>
Given<S> read_element(const S* array, std::size_t k, const char* name) {
  const Path path{name, k};
  require(array != nullptr, SIMDBEZIER_NULL_INPUT, {name});
  const std::size_t size = array->struct_size;
  require(is_size<S>(size), SIMDBEZIER_BAD_STRUCT_SIZE, Path{name, 0} / "struct_size");
  const auto* const bytes = reinterpret_cast<const unsigned char*>(array) + k * size;
  const auto* const element = reinterpret_cast<const S*>(bytes);
  require(element->struct_size == size, SIMDBEZIER_BAD_STRUCT_SIZE, path / "struct_size");
  return read(element, path);
}

/// Whether a struct of results can be written; to be asked before the work is done.
template <typename S>
void require_writable(const S* result, const Path& path) {
  require(result != nullptr, SIMDBEZIER_NULL_OUTPUT, path);
  require(is_size<S>(result->struct_size), SIMDBEZIER_BAD_STRUCT_SIZE, path / "struct_size");
}

/// Writes what the caller's struct has room for; members that are not known here become zero.
template <typename S>
void write(S* result, S known) noexcept {
  const std::size_t size = result->struct_size;
  known.struct_size = size;
  auto* const bytes = reinterpret_cast<unsigned char*>(result);
  std::memcpy(bytes, &known, std::min(size, sizeof(S)));
  if (size > sizeof(S)) {
    std::fill(bytes + sizeof(S), bytes + size, static_cast<unsigned char>(0));
  }
}

/// The caller's number for one of the names up to `last`.
template <typename Enum>
Enum choice(std::int32_t value, Enum last, const Path& path) {
  require(value >= 0 && value <= static_cast<std::int32_t>(last), SIMDBEZIER_BAD_VALUE, path);
  return static_cast<Enum>(value);
}

template <typename T>
inline constexpr simdbezier_scalar kScalar =
    std::is_same_v<T, float> ? SIMDBEZIER_F32 : SIMDBEZIER_F64;

/// Calls body.operator()<T>() with the type that a number names.
template <typename Body>
auto with_scalar(simdbezier_scalar scalar, const Path& path, Body body) {
  require(scalar == SIMDBEZIER_F32 || scalar == SIMDBEZIER_F64, SIMDBEZIER_BAD_SCALAR, path);
  return scalar == SIMDBEZIER_F32 ? body.template operator()<float>()
                                  : body.template operator()<double>();
}

template <typename T>
void require_scalar(simdbezier_scalar scalar, const Path& path) {
  require(scalar == kScalar<T>, SIMDBEZIER_BAD_SCALAR, path / "scalar");
}

/// The caller's memory of numbers of type T, refused where such numbers cannot lie: some ways to
/// memory crash there.
template <typename T, typename Void>
auto numbers_at(Void* memory, const Path& path) {
  require(reinterpret_cast<std::uintptr_t>(memory) % alignof(T) == 0, SIMDBEZIER_BAD_ALIGNMENT,
          path);
  using Number = std::conditional_t<std::is_const_v<Void>, const T, T>;
  return static_cast<Number*>(memory);
}

/// The caller's span; a null pointer with a length is refused.
template <typename V>
std::span<V> span_of(V* first, std::size_t length, const Path& path) {
  require(first != nullptr || length == 0,
          std::is_const_v<V> ? SIMDBEZIER_NULL_INPUT : SIMDBEZIER_NULL_OUTPUT, path);
  return first == nullptr ? std::span<V>() : std::span<V>(first, length);
}

// Arrays of a struct that was read are pairs of members called x and x_length; arrays that are
// arguments are pairs of these.
#define SIMDBEZIER_SPAN(given, x) span_of((given).x, (given).x##_length, (given).path / #x)
#define SIMDBEZIER_ARRAY(x) span_of(x, x##_length, {#x})

} // namespace simdbezier::c_api
