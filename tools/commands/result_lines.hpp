// Values at samples on their way to lines of text, whoever writes these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/csv.hpp>
#include <tools/patches/grid_blocks.hpp>
#include <tools/patches/library_status.hpp>

namespace simdbezier::tools {

/// Vectors lie side by side, as their columns do, with one row a sample. The library writes
/// curvatures as planes, which follow the rows.
template <typename T>
class ResultTable {
public:
  explicit ResultTable(const std::vector<Output>& outputs)
      : outputs_(outputs), row_(column_count(outputs)) {
    curvature_ = !outputs_.empty() && outputs_.back() == Output::curvature;
    stride_ = row_.size() - (curvature_ ? kCurvatureKinds : 0);
  }

  Outputs<T> resize(std::size_t samples) {
    samples_ = samples;
    values_.resize(samples * row_.size());
    Outputs<T> out;
    for (std::size_t k = 0; 3 * k < stride_; ++k) {
      out[outputs_[k]] =
          Vectors<T>::xyz(values_.data() + 3 * k, static_cast<std::ptrdiff_t>(stride_));
    }
    for (std::size_t k = 0; curvature_ && k < kCurvatureKinds; ++k) {
      out.curvature[static_cast<Curvature>(k)] = values_.data() + samples * (stride_ + k);
    }
    return out;
  }
  /// Returns a sample's values in the order of the columns. They are valid until the next call.
  [[nodiscard]] std::span<const T> row(std::size_t sample) {
    std::copy_n(values_.data() + sample * stride_, stride_, row_.data());
    for (std::size_t k = stride_; k < row_.size(); ++k) {
      row_[k] = values_[samples_ * k + sample];
    }
    return row_;
  }

private:
  std::vector<Output> outputs_;
  std::vector<T> row_;
  bool curvature_ = false;
  std::size_t stride_ = 0; // how many values the vectors of a sample have
  std::size_t samples_ = 0;
  std::vector<T> values_;
};

/// i/N in double: the u that belongs to the grid's x_i = (2i-N)/N.
inline double grid_parameter(std::size_t i, std::size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

/// Writes a block of a grid. first_patch: the number of the evaluator's first patch.
template <typename T>
void write_grid_block(GridEvaluator<T>& evaluator, const GridBlock& block, const GridSize& grid,
                      std::size_t first_patch, ResultTable<T>& table, ResultWriter& writer) {
  evaluator.evaluate(block, table.resize(block.samples(grid)));
  std::size_t k = 0;
  for (std::size_t p = block.first_patch; p < block.first_patch + block.patch_count; ++p) {
    for (std::size_t j = block.first_row; j < block.first_row + block.row_count; ++j) {
      for (std::size_t i = 0; i < grid.nu; ++i, ++k) {
        const CsvSample sample{static_cast<std::uint32_t>(first_patch + p),
                               grid_parameter(i, grid.nu), grid_parameter(j, grid.nv)};
        writer.line(sample, table.row(k));
      }
    }
  }
}

/// The least that the lines of so many samples take.
[[nodiscard]] inline std::uint64_t least_bytes(std::uint64_t samples, std::size_t columns) {
  return samples * (6 + 2 * columns); // "0,0,0" and ",0" a column
}

/// The samples of one call, as many as fit into it.
template <typename T>
struct SampleBlock {
  static constexpr std::size_t kMost = std::size_t{1} << 14;
  std::vector<CsvSample> given;
  std::vector<std::uint32_t> patch;
  std::vector<T> x;
  std::vector<T> y;

  /// Returns false at the end of the file.
  bool read(SampleReader& reader) {
    given.clear(), patch.clear(), x.clear(), y.clear();
    while (given.size() < kMost) {
      const auto sample = reader.next();
      if (!sample) {
        break;
      }
      given.push_back(*sample);
      patch.push_back(sample->patch);
      x.push_back(centred(reader, sample->u));
      y.push_back(centred(reader, sample->v));
    }
    return !given.empty();
  }

private:
  static T centred(const SampleReader& reader, double u) {
    const T x = reader.centred() ? static_cast<T>(u) : to_centred<T>(u);
    if (!std::isfinite(x)) {
      reader.refuse(u, sizeof(T) == sizeof(float) ? "f32" : "f64");
    }
    return x;
  }
};

/// Evaluates blocks of samples. Where there are many patches, only those of the block's samples are
/// packed.
template <typename T>
class BlockEvaluator {
public:
  /// Packs patches of these numbers, ascending.
  using Pack = std::function<PatchSet<T>(std::span<const std::uint32_t>)>;
  /// all: the set of all patches, where there is one.
  BlockEvaluator(Pack pack, int threads, PatchSet<T> all = {})
      : pack_(std::move(pack)), set_(std::move(all)), all_(set_.size() > 0) {
    options_.threads = threads;
  }

  void evaluate(const SampleBlock<T>& block, const Outputs<T>& out) {
    std::vector<std::uint32_t> patch = block.patch;
    if (!all_) {
      pack_those_of(block.patch);
      for (std::uint32_t& number : patch) {
        const auto at = std::ranges::lower_bound(packed_, number);
        number = static_cast<std::uint32_t>(at - packed_.begin());
      }
    }
    const Samples<T> samples{patch, block.x, block.y, Parameters::centred};
    check(simdbezier::evaluate(set_, samples, out, options_));
  }

private:
  void pack_those_of(const std::vector<std::uint32_t>& patches) {
    std::vector<std::uint32_t> wanted = patches;
    std::ranges::sort(wanted);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    if (wanted != packed_) {
      packed_ = std::move(wanted);
      set_ = PatchSet<T>(); // frees memory that the next set may take
      set_ = pack_(packed_);
    }
  }

  Pack pack_;
  Options options_;
  PatchSet<T> set_;
  bool all_;                          // whether the set has all patches
  std::vector<std::uint32_t> packed_; // the patches that it has if not
};

/// Writes a block of samples.
template <typename T>
void write_sample_block(BlockEvaluator<T>& evaluator, const SampleBlock<T>& block,
                        ResultTable<T>& table, ResultWriter& writer) {
  evaluator.evaluate(block, table.resize(block.given.size()));
  for (std::size_t k = 0; k < block.given.size(); ++k) {
    writer.line(block.given[k], table.row(k));
  }
}

} // namespace simdbezier::tools
