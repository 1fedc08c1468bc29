// tiles/<outputs>/<type>/<isa>/<n>x<n>/cache/threads:<t>[/patches:N][/layout:L][/consumer:none]
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using simdbezier::Tile;
using simdbezier::TileLayout;

constexpr std::size_t kSizes[] = {16, 32};
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives};
/// The size of the results of rows without `patches:`, which no cache, and no small machine's
/// memory, would hold.
constexpr std::size_t kWholeBytes = std::size_t{4} << 30;
constexpr std::size_t kBatch = 65536;

struct TileRow {
  OutputGroups outputs;
  Isa isa;
  std::size_t n;
  std::size_t patches; ///< 0 means as many as kWholeBytes hold
  int threads;
  TileLayout layout = TileLayout::planes;
  bool consumed = true; ///< false where the callback leaves tiles unread
};

template <typename T>
std::string name_of(const TileRow& row) {
  const RowName name{"tiles", row.outputs, sizeof(T) == 4,     std::string(to_string(row.isa)),
                     row.n,   row.n,       MemoryLevel::cache, row.threads};
  std::string text = name.text();
  text += row.patches == 0 ? "" : "/patches:" + std::to_string(row.patches);
  text += row.layout == TileLayout::xyz           ? "/layout:aos"
          : row.layout == TileLayout::interleaved ? "/layout:interleaved"
                                                  : "";
  return row.consumed ? text : text + "/consumer:none";
}

/// The least that a consumer does is to read every cache line of a tile. It reads integers, of
/// which one can be added each cycle.
template <typename T>
std::uint64_t read_lines(const T* first, std::size_t count) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(first);
  const std::size_t end = count * sizeof(T);
  std::uint64_t sum[2] = {0, 0};
  std::size_t at = 0;
  for (; at + 2 * kLineBytes <= end; at += 2 * kLineBytes) {
    std::uint32_t even;
    std::uint32_t odd;
    __builtin_memcpy(&even, bytes + at, sizeof even);
    __builtin_memcpy(&odd, bytes + at + kLineBytes, sizeof odd);
    sum[0] += even;
    sum[1] += odd;
  }
  for (; at < end; at += kLineBytes) {
    sum[0] += bytes[at];
  }
  return sum[0] + sum[1];
}

template <typename T>
class TimedTile {
public:
  explicit TimedTile(const TileRow& row) : row_(row) {
    const std::size_t bytes = row.n * row.n * 3 * group_count(row.outputs) * sizeof(T);
    patches_ = row.patches == 0 ? (kWholeBytes + bytes - 1) / bytes : row.patches;
    set_ = &shared_patch_set<T>(patches_);
    format_.outputs = {};
    for (const simdbezier::Output output : outputs_of(row.outputs)) {
      format_.outputs.add(output);
    }
    format_.layout = row.layout;
    options_.threads = row.threads;
    options_.isa = row.isa;
  }

  void operator()() {
    // Each thread has its sum in a line of its own.
    struct alignas(2 * kLineBytes) Sum {
      std::uint64_t value;
    };
    static Sum sums[256];
    (void)evaluate(options_, [&](const Tile<T>& tile) {
      sums[tile.worker % 256].value += row_.consumed ? read_tile(tile) : tile.samples;
    });
  }

  std::string check() {
    const T* const nets = shared_nets<T>(patches_);
    std::atomic<std::size_t> samples{0};
    std::mutex mutex;
    std::string wrong;
    std::string failure = run_verified(*set_, patches_, options_, [&](const auto& options) {
      return evaluate(options, [&](const Tile<T>& tile) {
        samples += tile.samples;
        const std::string found = check_tile(tile, nets);
        if (!found.empty()) {
          const std::lock_guard lock(mutex);
          wrong = found;
        }
      });
    });
    if (failure.empty() && samples != patches_ * row_.n * row_.n) {
      failure = "tiles hold " + std::to_string(samples) + " samples";
    }
    return failure.empty() ? wrong : failure;
  }

  [[nodiscard]] double items() const { return static_cast<double>(patches_ * row_.n * row_.n); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * group_count(row_.outputs) * sizeof(T));
  }

private:
  [[nodiscard]] std::uint64_t read_tile(const Tile<T>& tile) const {
    if (row_.layout == TileLayout::interleaved) {
      return read_lines(tile.out.position.x, tile.samples * 3 * group_count(row_.outputs));
    }
    std::uint64_t sum = 0;
    for (const simdbezier::Output output : outputs_of(row_.outputs)) {
      const simdbezier::Vectors<T>& group = tile.out[output];
      if (row_.layout == TileLayout::xyz) {
        sum += read_lines(group.x, 3 * tile.samples);
      } else {
        sum += read_lines(group.x, tile.samples) + read_lines(group.y, tile.samples) +
               read_lines(group.z, tile.samples);
      }
    }
    return sum;
  }

  template <typename Function>
  simdbezier::Status evaluate(const simdbezier::Options& options, Function&& function) const {
    return simdbezier::evaluate_tiles(*set_,
                                      simdbezier::Grid<T>::uniform(row_.n, row_.n, {0, patches_}),
                                      format_, simdbezier::TileFunction<T>(function), options);
  }

  std::string check_tile(const Tile<T>& tile, const T* nets) const {
    const Results<T> results = results_of(tile.out, row_.outputs);
    const std::size_t in_patch = tile.row_count * tile.nu;
    const auto last = static_cast<double>(row_.n - 1);
    std::string failure;
    for (std::size_t k = 0; k < tile.samples && failure.empty(); ++k) {
      const std::size_t patch = tile.first_patch + k / in_patch;
      if (!is_checked(patch, patches_)) {
        continue;
      }
      const std::size_t sample = tile.first_row * tile.nu + k % in_patch;
      failure =
          check_sample(results, k, nets + 48 * patch, static_cast<double>(sample % row_.n) / last,
                       static_cast<double>(sample / row_.n) / last, patch, sample);
    }
    return failure;
  }

  TileRow row_;
  std::size_t patches_ = 0;
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::TileFormat format_;
  simdbezier::Options options_;
};

template <typename T>
void add(const TileRow& row) {
  register_row(name_of<T>(row), benchmark::kMillisecond, row.threads,
               [row] { return TimedTile<T>(row); });
}

template <typename T>
void add_type() {
  for (const OutputGroups outputs : kOutputs) {
    for (const std::size_t n : kSizes) {
      for (const Isa isa : simdbezier::available_isas()) {
        add<T>({outputs, isa, n, 0, 1});
        add<T>({.outputs = outputs,
                .isa = isa,
                .n = n,
                .patches = 0,
                .threads = 1,
                .consumed = false});
        for (const TileLayout layout : {TileLayout::xyz, TileLayout::interleaved}) {
          if (layout == TileLayout::xyz || group_count(outputs) > 1) {
            add<T>({outputs, isa, n, kBatch, 1, layout});
          }
        }
        for (int threads = 1; threads <= max_threads(); ++threads) {
          add<T>({outputs, isa, n, kBatch, threads});
        }
      }
    }
  }
}

} // namespace

void register_tile_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
