#include "tests/reliability/fuzz/checks/blocks.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "tests/reliability/fuzz/checks/require.hpp"

namespace simdbezier::fuzz {

namespace {

constexpr std::uint8_t kCanary = 0xb5;
constexpr std::size_t kCanaries = 256; // four registers of any kind

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

} // namespace

/// Pages between two without access.
struct RawBlock::Region {
  std::uint8_t* begin = nullptr;
  std::size_t size = 0;

  // Mapping costs more than the calls that are tried, so regions are used again.
  static std::vector<Region*>& unused() {
    static auto& regions = *new std::vector<Region*>; // never too short a life for a leak check
    return regions;
  }

  static Region* take(std::size_t least) {
    auto& regions = unused();
    const auto found = std::ranges::find_if(
        regions, [least](const Region* region) { return region->size >= least; });
    if (found == regions.end()) {
      return map(least);
    }
    Region* const region = *found;
    regions.erase(found);
    return region;
  }

  static Region* map(std::size_t least) {
    const std::size_t page = page_size();
    const std::size_t size = (std::max(least, 16 * page) + page - 1) / page * page;
    void* const all = mmap(nullptr, size + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    auto* const begin = static_cast<std::uint8_t*>(all) + page;
    if (all == MAP_FAILED || mprotect(begin, size, PROT_READ | PROT_WRITE) != 0) {
      fail("no memory for a block between guard pages");
    }
    return new Region{begin, size};
  }
};

void RawBlock::Release::operator()(Region* region) const noexcept {
  Region::unused().push_back(region);
}

RawBlock::RawBlock(std::size_t size, Placement placement) : size_(size), placement_(placement) {
  if (placement == Placement::heap) {
    heap_.reset(new std::uint8_t[size]);
    data_ = heap_.get();
    return;
  }
  region_.reset(Region::take(size + kCanaries));
  const bool at_end = placement == Placement::ends_at_guard;
  data_ = at_end ? region_->begin + region_->size - size : region_->begin;
  std::fill_n(at_end ? data_ - kCanaries : data_ + size, kCanaries, kCanary);
}

RawBlock::~RawBlock() = default;

void RawBlock::check_surroundings() const {
  if (placement_ != Placement::heap) {
    const bool at_end = placement_ == Placement::ends_at_guard;
    const std::uint8_t* const canaries = at_end ? data_ - kCanaries : data_ + size_;
    require(std::all_of(canaries, canaries + kCanaries, [](auto b) { return b == kCanary; }),
            "bytes beside an output have been written");
  }
}

} // namespace simdbezier::fuzz
