// scattered_sorted|scattered_random/<outputs>/<type>/<isa>/1x1/<destination>/threads:<t>/patches:N
#include <cstdint>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/baselines/baselines.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/library_or_baseline.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

enum class Order { sorted, random };

constexpr std::size_t kSamples = std::size_t{1} << 20;
constexpr std::size_t kRun = 64; ///< samples of one patch that follow each other, sorted
constexpr std::size_t kRuns = kSamples / kRun;
constexpr OutputGroups kOutputs[] = {OutputGroups::position, OutputGroups::position_normal,
                                     OutputGroups::position_derivatives};

struct ScatteredRow {
  Order order;
  OutputGroups outputs;
  bool library;
  Isa isa; ///< for the library only
  std::size_t patches;
  int threads = 1;
};

/// Whether every sample's patch comes from memory. Sorted runs are cache rows, whatever the set.
MemoryLevel level_of(const ScatteredRow& row) {
  const bool many = row.patches * kValuesPerPatch * sizeof(float) > (std::size_t{64} << 20);
  return row.order == Order::random && many ? MemoryLevel::memory : MemoryLevel::cache;
}

template <typename T>
std::string name_of(const ScatteredRow& row) {
  RowName name{row.order == Order::sorted ? "scattered_sorted" : "scattered_random", row.outputs,
               sizeof(T) == 4};
  name.who = row.library ? std::string(simdbezier::to_string(row.isa)) : "de_casteljau";
  name.level = level_of(row);
  name.threads = row.threads;
  return name.text() + "/patches:" + std::to_string(row.patches);
}

/// Sorted samples ascend, again and again where there are more runs than patches, and otherwise are
/// spread over all patches.
std::vector<std::uint32_t> patch_indices(Order order, std::size_t patches) {
  std::vector<std::uint32_t> indices(kSamples);
  const std::vector<double> random = random_units(kSamples, 1);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const std::size_t run = k / kRun;
    const std::size_t index =
        order == Order::random ? static_cast<std::size_t>(random[k] * static_cast<double>(patches))
        : patches < kRuns      ? run % patches
                               : run * (patches - 1) / (kRuns - 1);
    indices[k] = static_cast<std::uint32_t>(index);
  }
  return indices;
}

template <typename T>
class TimedScattered final : public LibraryOrBaseline<ScatteredJob<T>> {
public:
  explicit TimedScattered(const ScatteredRow& row)
      : LibraryOrBaseline<ScatteredJob<T>>(row.library), row_(row),
        patch_(patch_indices(row.order, row.patches)), u_(random_parameters(2)),
        v_(random_parameters(3)) {
    job_.count = kSamples;
    job_.patch = patch_.data();
    job_.u = u_.data();
    job_.v = v_.data();
    job_.out =
        place_results<T>(row.outputs, kSamples, row.library ? Layout::planes : Layout::triples);
    if (row.library) {
      set_ = &shared_patch_set<T>(row.patches);
      outputs_ = library_outputs(job_.out);
      options_.threads = row.threads;
      options_.isa = row.isa;
    } else {
      job_.nets = shared_nets<T>(row.patches);
      baseline_ = widest_baselines<T>().de_casteljau_scattered;
    }
  }

  [[nodiscard]] double items() const { return kSamples; }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * group_count(row_.outputs) * sizeof(T));
  }

private:
  using LibraryOrBaseline<ScatteredJob<T>>::job_;
  using LibraryOrBaseline<ScatteredJob<T>>::options_;
  using LibraryOrBaseline<ScatteredJob<T>>::baseline_;

  simdbezier::Status evaluate(const simdbezier::Options& options) const override {
    const simdbezier::Samples<T> samples{
        {job_.patch, job_.count}, {job_.u, job_.count}, {job_.v, job_.count}};
    return simdbezier::evaluate(*set_, samples, outputs_, options);
  }

  [[nodiscard]] bool is_packed() const override { return set_->size() >= row_.patches; }
  void poison_results() override { poison_scattered(job_); }
  [[nodiscard]] std::string check_results() const override {
    return check_scattered(job_, shared_nets<T>(row_.patches));
  }

  static std::vector<T> random_parameters(std::uint64_t seed) {
    const std::vector<double> random = random_units(kSamples, seed);
    std::vector<T> values(kSamples);
    for (std::size_t k = 0; k < kSamples; ++k) {
      values[k] = static_cast<T>(random[k]);
    }
    return values;
  }

  ScatteredRow row_;
  std::vector<std::uint32_t> patch_;
  std::vector<T> u_;
  std::vector<T> v_;
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::Outputs<T> outputs_;
};

template <typename T>
void add(const ScatteredRow& row) {
  register_row(name_of<T>(row), benchmark::kMillisecond, row.threads,
               [row] { return TimedScattered<T>(row); });
}

template <typename T>
void add_type() {
  const auto isas = simdbezier::available_isas();
  for (const Order order : {Order::sorted, Order::random}) {
    for (const OutputGroups outputs : kOutputs) {
      for (const std::size_t patches : {std::size_t{2048}, std::size_t{1'000'000}}) {
        add<T>({order, outputs, false, Isa::automatic, patches});
        for (const Isa isa : isas) {
          add<T>({order, outputs, true, isa, patches});
        }
        for (int threads = 2; threads <= max_threads(); ++threads) {
          add<T>({order, outputs, true, isas.back(), patches, threads});
        }
      }
    }
  }
}

} // namespace

void register_scattered_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
