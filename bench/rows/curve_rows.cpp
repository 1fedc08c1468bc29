// curves/<outputs>/<type>/<isa>/<n>/<destination>/threads:<t>[/degree:N][/rational:on]: batches of
// curves on n common parameters each. They are cubics in space unless the name says otherwise.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/baselines/baselines.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/library_or_baseline.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;

/// The outputs of a row: positions, and what is asked for besides.
enum class CurveGroups { position, derivatives, tangent };

constexpr const char* kOutputNames[] = {"position", "position_derivatives", "position_tangent"};
/// The number of vectors that a sample has: position; position, d1, d2; position, tangent.
constexpr std::size_t kVectors[] = {1, 3, 2};

struct CurveRow {
  CurveGroups output = CurveGroups::position;
  bool library = true;
  Isa isa = Isa::automatic; ///< for the library only
  std::size_t n = 16;
  MemoryLevel level = MemoryLevel::cache;
  int threads = 1;
  Layout layout = Layout::planes;
  int degree = 3;
  bool rational = false;
};

template <typename T>
std::string name_of(const CurveRow& row) {
  std::string name = std::string("curves/") + kOutputNames[static_cast<int>(row.output)] +
                     (sizeof(T) == 4 ? "/f32/" : "/f64/") +
                     (row.library ? std::string(simdbezier::to_string(row.isa)) : "de_casteljau") +
                     "/" + std::to_string(row.n) +
                     (row.level == MemoryLevel::cache ? "/cache" : "/memory") +
                     "/threads:" + std::to_string(row.threads);
  name += row.layout == Layout::triples ? "/layout:aos" : "";
  name += row.degree != 3 ? "/degree:" + std::to_string(row.degree) : "";
  name += row.rational ? "/rational:on" : "";
  return name;
}

/// The number of curves: at most 1024 in cache, and as many as the output buffer holds in memory.
template <typename T>
std::size_t curves_of(const CurveRow& row) {
  const std::size_t bytes = row.n * 3 * kVectors[static_cast<int>(row.output)] * sizeof(T);
  return row.level == MemoryLevel::cache ? std::clamp<std::size_t>(kCacheBytes / bytes, 1, 1024)
                                         : kMemoryBytes / bytes;
}

template <typename T>
class TimedCurve final : public LibraryOrBaseline<CurveJob<T>> {
public:
  explicit TimedCurve(const CurveRow& row)
      : LibraryOrBaseline<CurveJob<T>>(row.library), row_(row), count_(curves_of<T>(row)),
        t_(uniform_parameters<T>(row.n)) {
    const std::size_t groups = kVectors[static_cast<int>(row.output)];
    job_.out = place_results<T>(groups == 1   ? OutputGroups::position
                                : groups == 2 ? OutputGroups::position_normal
                                              : OutputGroups::position_derivatives,
                                count_ * row.n, row.library ? row.layout : Layout::triples);
    make_points();
    job_.curves = count_;
    job_.n = row.n;
    job_.points = points_;
    job_.t = t_.data();
    if (!row.library) {
      baseline_ = widest_baselines<T>().de_casteljau_curves;
      return;
    }
    options_.threads = row.threads;
    options_.isa = row.isa;
    simdbezier::PackOptions packing;
    packing.threads = 0;
    packed_ = static_cast<bool>(simdbezier::pack(
        simdbezier::ControlCurves<T>::packed(points_, count_, row.degree, 3,
                                             row.rational ? simdbezier::Weights::cartesian
                                                          : simdbezier::Weights::none),
        set_, packing));
    const auto group = [this](std::size_t g) {
      T* const* const p = job_.out.component + 3 * g;
      return simdbezier::Vectors<T>{p[0], p[1], p[2], static_cast<std::ptrdiff_t>(job_.out.stride)};
    };
    outputs_.position = group(0);
    if (row.output == CurveGroups::derivatives) {
      outputs_.d1 = group(1);
      outputs_.d2 = group(2);
    } else if (row.output == CurveGroups::tangent) {
      outputs_.tangent = group(1);
    }
  }

  [[nodiscard]] double items() const { return static_cast<double>(count_ * row_.n); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * kVectors[static_cast<int>(row_.output)] * sizeof(T));
  }

private:
  using LibraryOrBaseline<CurveJob<T>>::job_;
  using LibraryOrBaseline<CurveJob<T>>::options_;
  using LibraryOrBaseline<CurveJob<T>>::baseline_;

  simdbezier::Status evaluate(const simdbezier::Options& options) const override {
    return simdbezier::evaluate(set_, simdbezier::CurveGrid<T>::uniform(row_.n), outputs_, options);
  }

  [[nodiscard]] bool is_packed() const override { return packed_; }

  void poison_results() override {
    for (std::size_t curve = 0; curve < count_; curve += step()) {
      poison(job_.out, curve * row_.n, (curve + 1) * row_.n);
    }
  }

  /// The number of curves from one that is checked to the next.
  [[nodiscard]] std::size_t step() const { return 1 + count_ / 64; }
  [[nodiscard]] std::size_t order() const { return static_cast<std::size_t>(row_.degree) + 1; }
  [[nodiscard]] std::size_t channels() const { return row_.rational ? 4 : 3; }

  /// The curves are rows of the shared nets; other shapes take the same values, with weights
  /// near 1.
  void make_points() {
    if (row_.degree == 3 && !row_.rational) {
      points_ = shared_nets<T>((count_ + 3) / 4);
      return;
    }
    const T* const nets = shared_nets<T>(1024);
    own_.resize(count_ * order() * channels());
    for (std::size_t k = 0; k < own_.size(); ++k) {
      const T value = nets[k % (1024 * kValuesPerPatch)];
      own_[k] = k % channels() == 3 ? 1 + value / 4 : value;
    }
    points_ = own_.data();
  }

  /// Compares the positions of some curves with a Bernstein sum in double.
  [[nodiscard]] std::string check_results() const override {
    for (std::size_t curve = 0; curve < count_; curve += step()) {
      for (std::size_t i = 0; i < row_.n; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(row_.n - 1);
        const T* const p = points_ + curve * order() * channels();
        double sum[4] = {0, 0, 0, 0};
        double binomial = 1;
        for (std::size_t k = 0; k < order(); ++k) {
          const double w = row_.rational ? static_cast<double>(p[4 * k + 3]) : 1.0;
          const double basis = w * binomial * std::pow(t, static_cast<double>(k)) *
                               std::pow(1 - t, static_cast<double>(order() - 1 - k));
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += basis * static_cast<double>(p[channels() * k + c]);
          }
          sum[3] += basis;
          binomial = binomial * static_cast<double>(order() - 1 - k) / static_cast<double>(k + 1);
        }
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = (curve * row_.n + i) * job_.out.stride;
          const double error =
              std::fabs(static_cast<double>(job_.out.component[c][at]) - sum[c] / sum[3]);
          if (!(error < (sizeof(T) == 4 ? 1e-5 : 1e-13))) {
            return "curve " + std::to_string(curve) + " sample " + std::to_string(i) + " is wrong";
          }
        }
      }
    }
    return {};
  }

  CurveRow row_;
  std::size_t count_;
  std::vector<T> t_;
  std::vector<T> own_;
  const T* points_ = nullptr;
  bool packed_ = false;
  simdbezier::CurveSet<T> set_;
  simdbezier::CurveOutputs<T> outputs_;
};

template <typename T>
void add(const CurveRow& row) {
  register_row(name_of<T>(row),
               row.level == MemoryLevel::cache ? benchmark::kMicrosecond : benchmark::kMillisecond,
               row.threads, [row] { return TimedCurve<T>(row); });
}

template <typename T>
void add_type() {
  const auto isas = simdbezier::available_isas();
  for (const std::size_t n : {4, 8, 16, 17, 32, 64}) {
    for (const MemoryLevel level : {MemoryLevel::cache, MemoryLevel::memory}) {
      CurveRow row;
      row.n = n;
      row.level = level;
      row.library = false;
      add<T>(row);
      row.library = true;
      for (const Isa isa : isas) {
        row.isa = isa;
        add<T>(row);
      }
      for (const CurveGroups output : {CurveGroups::derivatives, CurveGroups::tangent}) {
        row.output = output;
        add<T>(row);
      }
      row.output = CurveGroups::position;
      if (level == MemoryLevel::memory) {
        row.layout = Layout::triples;
        for (const Isa isa : isas) {
          row.isa = isa;
          add<T>(row);
        }
      }
      if (level == MemoryLevel::memory && n % 16 == 0) {
        for (row.threads = 2; row.threads <= max_threads(); ++row.threads) {
          row.layout = Layout::planes;
          add<T>(row);
          row.layout = Layout::triples;
          add<T>(row);
        }
      }
    }
  }
  CurveRow other;
  other.isa = isas.back();
  for (const int degree : {1, 2, 3, 4, 5, 6, 8, 15}) {
    other.degree = degree;
    for (const bool rational : {false, true}) {
      other.rational = rational;
      if (degree != 3 || rational) {
        add<T>(other);
      }
    }
  }
}

} // namespace

void register_curve_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
