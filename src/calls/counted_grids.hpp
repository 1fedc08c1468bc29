// Grids of each patch's or curve's own: their sizes, places and parameters, and the call on them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <simdbezier/curves.hpp>

#include "src/calls/call.hpp"
#include "src/calls/grid_plan.hpp"

namespace simdbezier::detail {

/// The sizes of a call, and where the samples of each patch or curve begin.
class CountedGrids {
public:
  explicit CountedGrids(const PatchGrids& grids) noexcept
      : nu_(grids.nu), nv_(grids.nv), given_offset_(grids.offset),
        equal_lengths_(grids.nu.size() == grids.nv.size() && matches(grids.offset) &&
                       matches(grids.patches)) {}
  /// Curves are grids of one row.
  explicit CountedGrids(const CurveGrids& grids) noexcept
      : nu_(grids.n), given_offset_(grids.offset), rows_of_one_(true),
        equal_lengths_(matches(grids.offset) && matches(grids.curves)) {}

  /// Counts the samples; to be called before anything else.
  /// ok | null_input | unequal_lengths | bad_grid | bad_offsets | size_overflow | out_of_memory
  [[nodiscard]] Status count() noexcept;

  /// The memory of the sizes, which outputs may not overlap.
  [[nodiscard]] std::array<MemoryRange, 3> inputs() const noexcept {
    return {MemoryRange(nu_), MemoryRange(nv_), MemoryRange(given_offset_)};
  }
  [[nodiscard]] std::size_t size() const noexcept { return nu_.size(); }
  [[nodiscard]] std::size_t nu(std::size_t k) const noexcept { return nu_[k]; }
  [[nodiscard]] std::size_t nv(std::size_t k) const noexcept { return rows_of_one_ ? 1 : nv_[k]; }
  /// Samples in the grids before this one, counted without gaps; total() for k = size().
  [[nodiscard]] std::size_t before(std::size_t k) const noexcept {
    return of_one_size_ ? k * before_[1] : before_[k];
  }
  [[nodiscard]] std::size_t total() const noexcept { return before(size()); }
  /// The index of its first sample in the caller's memory.
  [[nodiscard]] std::size_t offset(std::size_t k) const noexcept {
    return given_offset_.empty() ? before(k) : given_offset_[k];
  }
  /// One more than the highest index.
  [[nodiscard]] std::size_t extent() const noexcept {
    return given_offset_.empty() ? total() : extent_;
  }
  [[nodiscard]] std::size_t least_nu() const noexcept { return least_nu_; }
  [[nodiscard]] std::size_t most_nu() const noexcept { return most_nu_; }
  [[nodiscard]] std::size_t most_nv() const noexcept { return most_nv_; }

  /// The grid that sample `sample`, counted without gaps, is part of.
  [[nodiscard]] std::size_t grid_of(std::size_t sample) const noexcept {
    if (of_one_size_) {
      return sample / before_[1];
    }
    const std::size_t* const first = before_.get();
    return static_cast<std::size_t>(std::upper_bound(first, first + size(), sample) - first - 1);
  }

  /// How many grids from k on go to a kernel together: at most so many of one size, which end by
  /// sample `end` and lie one behind the other in the caller's memory. 1 where there are no others.
  [[nodiscard]] std::size_t alike(std::size_t k, std::size_t end, std::size_t most) const noexcept {
    const std::size_t samples = nu(k) * nv(k);
    if (of_one_size_) {
      return std::max<std::size_t>(std::min({most, size() - k, (end - before(k)) / samples}), 1);
    }
    std::size_t count = 1;
    while (count < most && k + count < size() && nu(k + count) == nu(k) && nv(k + count) == nv(k) &&
           before(k + count + 1) <= end && offset(k + count) == offset(k) + count * samples) {
      ++count;
    }
    return count;
  }

private:
  [[nodiscard]] bool matches(std::span<const std::size_t> offset) const noexcept {
    return offset.empty() || offset.size() == nu_.size();
  }
  [[nodiscard]] bool matches(const SetRange& range) const noexcept {
    return range.count == SetRange::kToTheEnd || range.count == nu_.size();
  }

  std::span<const std::uint32_t> nu_;
  std::span<const std::uint32_t> nv_;
  std::span<const std::size_t> given_offset_;
  bool rows_of_one_ = false;
  bool equal_lengths_;
  bool of_one_size_ = false;              ///< all grids, which lie one behind the other
  std::unique_ptr<std::size_t[]> before_; ///< of the first two where that is so
  std::size_t extent_ = 0;
  std::size_t least_nu_ = ~std::size_t(0);
  std::size_t most_nu_ = 0;
  std::size_t most_nv_ = 0;
};

/// Plans by size: neighbours often share theirs. Grids too large for a plan's own room share one
/// piece of memory, so that nothing can fail once samples are being written.
template <typename T>
class PlanCache {
public:
  /// Bytes of the memory, for grids of up to these sizes.
  [[nodiscard]] static std::size_t memory_bytes(const CountedGrids& grids) noexcept {
    return GridPlan<T>::memory_values(grids.most_nu(), grids.most_nv()) * sizeof(T);
  }
  explicit PlanCache(void* memory) noexcept : memory_(static_cast<T*>(memory)) {}

  /// The uniform grid; of one row where nv is 1.
  const GridPlan<T>& find(std::size_t nu, std::size_t nv) noexcept {
    GridPlan<T>& plan =
        GridPlan<T>::fits_inline(nu, nv) ? plan_[(nu * 5 + nv) % kPlans] : large_plan_;
    if (plan.nu() != nu || plan.nv() != nv) {
      const Grid<T> grid = nv == 1 ? as_grid(CurveGrid<T>::uniform(nu)) : Grid<T>::uniform(nu, nv);
      [[maybe_unused]] const Status built = plan.build(grid, memory_);
    }
    return plan;
  }

private:
  static constexpr std::size_t kPlans = 16;
  T* memory_;
  GridPlan<T> large_plan_;
  GridPlan<T> plan_[kPlans];
};

/// The call on grids of each patch's or curve's own. Work: made of what is given, what is resolved,
/// the counted grids and a way to write.
template <CallName kName, typename T, template <typename> typename Set, typename Where,
          typename Work>
class CountedGridsCall : public OutputCall<T, Set, Where> {
public:
  template <typename Out>
  CountedGridsCall(const Set<T>& set, const Where& where, const Out& out,
                   const Options& options) noexcept
      : OutputCall<T, Set, Where>(set, where, out, options), counted_(where) {}

  Status check() noexcept {
    const Status counted = counted_.count();
    return counted ? this->check_given(counted_.extent(), counted_.inputs()) : counted;
  }
  [[nodiscard]] Work plan(Way way) const noexcept {
    return {this->in_, this->request_, counted_, way};
  }
  [[nodiscard]] std::size_t written() const noexcept {
    return written_bytes(this->in_.out, counted_.total());
  }
  [[nodiscard]] CallKind kind() const noexcept {
    return kind_of_call(kName, this->in_, this->request_);
  }

private:
  CountedGrids counted_;
};

} // namespace simdbezier::detail
