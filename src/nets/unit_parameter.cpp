// Roundings of UnitParameter, where no flag of a caller's compiler reaches them.
#include <simdbezier/nets.hpp>

namespace simdbezier::detail {

template <typename T>
T one_less(T t) noexcept {
  return T(1) - t;
}

template <typename T>
T quotient(std::int64_t i, std::int64_t n) noexcept {
  return static_cast<T>(i) / static_cast<T>(n);
}

template SIMDBEZIER_API float one_less(float) noexcept;
template SIMDBEZIER_API double one_less(double) noexcept;
template SIMDBEZIER_API float quotient(std::int64_t, std::int64_t) noexcept;
template SIMDBEZIER_API double quotient(std::int64_t, std::int64_t) noexcept;

} // namespace simdbezier::detail
