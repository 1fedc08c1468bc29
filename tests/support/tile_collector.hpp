// A receiver of tiles that checks each of them as it arrives and puts the samples together again.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/call_options.hpp"
#include "tests/support/canvas.hpp"

namespace simdbezier::tests {

[[nodiscard]] inline TileFormat tile_format(GroupSet groups, bool status, TileLayout layout,
                                            std::size_t samples = 0) {
  TileFormat format;
  format.outputs = selection_of(groups);
  if (status) {
    format.outputs.add(Output::status);
  }
  format.layout = layout;
  format.samples = samples;
  return format;
}

/// Receives the tiles of one call over patches [first, first + patches) with nu x nv samples.
template <typename T>
class TileCollector {
public:
  TileCollector(GroupSet groups, const TileFormat& format, std::size_t first, std::size_t patches,
                std::size_t nu, std::size_t nv)
      : groups_(groups), format_(format), first_(first), patches_(patches), nu_(nu), nv_(nv),
        found_(patches * nu * nv, {.second = (groups & (kDuu | kDuv | kDvv)) != 0}),
        arrivals_(patches * nu * nv) {}

  void operator()(const Tile<T>& tile) {
    const bool known = tile.worker >= 0 && tile.worker < static_cast<int>(busy_.size());
    const auto worker = known ? static_cast<std::size_t>(tile.worker) : 0;
    if (!known || busy_[worker].exchange(true)) {
      complain("a worker number that another call has");
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++tiles_;
      most_workers_ = std::max(most_workers_, worker + 1);
      if (fits(tile)) {
        check_order(tile, worker);
        check_outputs(tile);
        take(tile);
      }
    }
    busy_[worker] = false;
  }

  /// Values, statuses and arrivals that are not as in the grid call's results.
  [[nodiscard]] std::size_t different_from(const Planes<T>& reference) const {
    std::size_t different = 0;
    for (std::size_t k = 0; k < arrivals_.size(); ++k) {
      different += arrivals_[k] == 1 ? 0 : 1;
    }
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      for (std::size_t c = 0; holds(groups_, g) && c < 3; ++c) {
        different += differing_bits(found_.plane(plane_group(g), c),
                                    reference.plane(plane_group(g), c) + first_ * nu_ * nv_,
                                    arrivals_.size());
      }
    }
    if (format_.outputs.holds(Output::status)) {
      different += differing_bits(found_.status().data(),
                                  reference.status().data() + first_ * nu_ * nv_, arrivals_.size());
    }
    return different;
  }

  [[nodiscard]] std::size_t tiles() const { return tiles_; }
  [[nodiscard]] std::size_t workers() const { return most_workers_; }
  /// What was wrong with single tiles, each kind once.
  [[nodiscard]] std::string complaints() const { return complaints_; }

private:
  void expect(bool condition, const char* what) {
    if (!condition) {
      complain(what);
    }
  }
  void complain(const std::string& what) {
    const std::lock_guard<std::recursive_mutex> lock(complaint_mutex_);
    if (complaints_.find(what) == std::string::npos) {
      complaints_ += what + "; ";
    }
  }

  /// The shape: whole patches, or whole rows of one; not more than was asked for.
  bool fits(const Tile<T>& tile) {
    const bool inside = tile.nu == nu_ && tile.patch_count > 0 && tile.row_count > 0 &&
                        tile.first_patch >= first_ &&
                        tile.first_patch + tile.patch_count <= first_ + patches_ &&
                        tile.first_row + tile.row_count <= nv_;
    expect(inside, "a tile outside of the grid");
    expect(tile.samples == tile.patch_count * tile.row_count * tile.nu, "a wrong sample count");
    const bool whole = tile.first_row == 0 && tile.row_count == nv_;
    expect(whole || tile.patch_count == 1, "several patches without all of their rows");
    if (format_.samples > 0) {
      expect(tile.samples <= std::max(format_.samples, nu_), "more samples than asked for");
      expect(whole || nu_ * nv_ > format_.samples, "a patch was cut that fits");
    }
    return inside && tile.samples == tile.patch_count * tile.row_count * tile.nu;
  }

  void check_order(const Tile<T>& tile, std::size_t worker) {
    auto& next = next_[worker];
    expect(std::pair(tile.first_patch, tile.first_row) >= next, "a worker's tiles do not ascend");
    next = {tile.first_patch + tile.patch_count - 1, tile.first_row + tile.row_count};
  }

  void check_outputs(const Tile<T>& tile) {
    Outputs<T> out = tile.out;
    const auto groups = groups_of(out);
    const T* base = nullptr;
    std::size_t members = 0;
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      members += holds(groups_, g) ? 1 : 0;
    }
    const auto width = static_cast<std::ptrdiff_t>(3 * members);
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      const Vectors<T>& group = *groups[g];
      expect(group.wanted() == holds(groups_, g), "other groups than asked for");
      if (!group.wanted()) {
        continue;
      }
      const bool triples = group.y == group.x + 1 && group.z == group.x + 2;
      switch (format_.layout) {
      case TileLayout::planes:
        expect(group.stride == 1 && aligned(group.x) && aligned(group.y) && aligned(group.z),
               "planes that are not aligned, or not planes");
        break;
      case TileLayout::xyz:
        expect(group.stride == 3 && triples && aligned(group.x), "triples that are not aligned");
        break;
      case TileLayout::interleaved:
        expect(group.stride == width && triples && (base == nullptr || group.x == base),
               "vertices whose members are not side by side in order");
        base = group.x + 3;
        break;
      }
    }
    expect(out.status.wanted() == format_.outputs.holds(Output::status),
           "a status not asked for, or none");
  }

  [[nodiscard]] static bool aligned(const T* pointer) {
    return reinterpret_cast<std::uintptr_t>(pointer) % 64 == 0;
  }

  /// Copies a tile, then spoils it: what the next tile holds may not depend on it.
  void take(const Tile<T>& tile) {
    const std::size_t first = ((tile.first_patch - first_) * nv_ + tile.first_row) * nu_;
    Outputs<T> from = tile.out;
    Outputs<T> to = found_.outputs();
    for (std::size_t k = 0; k < tile.samples; ++k) {
      arrivals_[first + k] = static_cast<unsigned char>(arrivals_[first + k] + 1);
    }
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      Vectors<T>& source = *groups_of(from)[g];
      const Vectors<T>& target = *groups_of(to)[g];
      for (std::size_t k = 0; source.wanted() && k < tile.samples; ++k) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) * source.stride;
        target.x[first + k] = std::exchange(source.x[at], T(-5));
        target.y[first + k] = std::exchange(source.y[at], T(-6));
        target.z[first + k] = std::exchange(source.z[at], T(-7));
      }
    }
    for (std::size_t k = 0; from.status.wanted() && k < tile.samples; ++k) {
      to.status[first + k] = std::exchange(from.status[k], static_cast<SampleStatus>(99));
    }
  }

  GroupSet groups_;
  TileFormat format_;
  std::size_t first_;
  std::size_t patches_;
  std::size_t nu_;
  std::size_t nv_;
  std::mutex mutex_;
  std::recursive_mutex complaint_mutex_;
  std::array<std::atomic<bool>, 64> busy_{};
  std::array<std::pair<std::size_t, std::size_t>, 64> next_{};
  Planes<T> found_;
  std::vector<unsigned char> arrivals_;
  std::size_t tiles_ = 0;
  std::size_t most_workers_ = 0;
  std::string complaints_;
};

} // namespace simdbezier::tests
