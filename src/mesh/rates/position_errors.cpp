// position_errors() of rates.hpp and flatten.hpp.
#include <algorithm>

#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>

#include "src/certificate/position_bounds.hpp"
#include "src/runtime/batch.hpp"
#include "src/storage/vector_length.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// most: components of a position.
template <typename Set>
Status find_errors(const Set& set, int most, std::span<double> out,
                   const RunOptions& options) noexcept {
  if (out.size() < set.size()) {
    return Status::output_too_small;
  }
  Isa chosen = Isa::automatic;
  if (const Status status = resolve_isa(options.isa, chosen); !status) {
    return status;
  }
  const auto components = static_cast<std::size_t>(std::min(set.components(), most));
  constexpr std::size_t kBlock = 256;
  const std::size_t blocks = (set.size() + kBlock - 1) / kBlock;
  auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
    PositionBound bounds[kBlock];
    const std::size_t last = std::min(set.size(), end * kBlock);
    for (std::size_t first = begin * kBlock; first < last; first += kBlock) {
      const std::size_t count = std::min(kBlock, last - first);
      find_position_bounds(set, chosen, first, first + count, bounds);
      for (std::size_t k = 0; k < count; ++k) {
        const double length = vector_length(std::span(bounds[k]).first(components));
        out[first + k] = length * (1 + 0x1p-40); // its roundings
      }
    }
  };
  divide_work(blocks, 100 * kBlock, options.threads, body);
  return Status::ok;
}

} // namespace
} // namespace detail

template <typename T>
Status position_errors(const PatchSet<T>& set, std::span<double> out,
                       const RunOptions& options) noexcept {
  return detail::find_errors(set, 3, out, options);
}
template <typename T>
Status position_errors(const CurveSet<T>& set, std::span<double> out,
                       const RunOptions& options) noexcept {
  return detail::find_errors(set, kMostComponents, out, options);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status position_errors(const PatchSet<T>&, std::span<double>,            \
                                                 const RunOptions&) noexcept;                      \
  template SIMDBEZIER_API Status position_errors(const CurveSet<T>&, std::span<double>,            \
                                                 const RunOptions&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
