// nets/<operation>/<type>/<isa>/3x3/cache/threads:1: operations on bicubic control nets. Items are
// patches. find_adjacency has no kernels and is called scalar.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::ControlNets;
using simdbezier::EdgeKind;
using simdbezier::EdgeLink;
using simdbezier::Isa;
using simdbezier::MutableNets;
using simdbezier::PatchEdge;
using simdbezier::Status;

constexpr std::size_t kPatches = 256; ///< nets and results of splitting: 245 KB in float
constexpr int kBoxLevels = 2;
constexpr int kHigher = 5; ///< the degree that nets are elevated to

/// Returns one component of a surface point of a net in double, by the Bernstein sum.
template <typename T>
double point_of(const T* net, int degree, std::size_t c, double u, double v) {
  const auto weights = [degree](double t) {
    std::vector<double> w(static_cast<std::size_t>(degree) + 1);
    double binomial = 1;
    for (int i = 0; i <= degree; ++i) {
      w[static_cast<std::size_t>(i)] = binomial * std::pow(t, i) * std::pow(1 - t, degree - i);
      binomial = binomial * (degree - i) / (i + 1);
    }
    return w;
  };
  const std::vector<double> wu = weights(u);
  const std::vector<double> wv = weights(v);
  double sum = 0;
  for (std::size_t j = 0; j < wv.size(); ++j) {
    for (std::size_t i = 0; i < wu.size(); ++i) {
      sum += wv[j] * wu[i] * static_cast<double>(net[(j * wu.size() + i) * 3 + c]);
    }
  }
  return sum;
}

/// The nets of an operation, and the memory of all its results.
template <typename T>
struct NetJob {
  ControlNets<T> nets{shared_nets<T>(kPatches), kPatches};
  std::vector<T> results = std::vector<T>(4 * kValuesPerPatch * kPatches);
  simdbezier::Options options;

  MutableNets<T> out(std::size_t quarter, int degree) {
    return MutableNets<T>::packed(results.data() + quarter * kValuesPerPatch * kPatches, kPatches,
                                  degree, degree);
  }
  /// Compares the surfaces of the results with the parts of the original surfaces that they stand
  /// for. Returns an empty string, or the first difference that is too large.
  std::string compare(std::size_t quarter, int degree, double u0, double v0, double size) {
    const auto stride = static_cast<std::size_t>((degree + 1) * (degree + 1) * 3);
    const T* const first = results.data() + quarter * kValuesPerPatch * kPatches;
    for (std::size_t p = 0; p < kPatches; ++p) {
      for (std::size_t k = 0; k < 3 * 9; ++k) {
        const double u = static_cast<double>(k / 9) / 2;
        const double v = static_cast<double>(k / 3 % 3) / 2;
        const double expected =
            point_of(nets.points + p * kValuesPerPatch, 3, k % 3, u0 + size * u, v0 + size * v);
        const double found = point_of(first + p * stride, degree, k % 3, u, v);
        if (!(std::abs(found - expected) <= 1e-5)) {
          return "patch " + std::to_string(p) + " is off by " + std::to_string(found - expected);
        }
      }
    }
    return {};
  }
};

template <typename T>
struct Split {
  static constexpr const char* kName = "split";
  static Status run(NetJob<T>& job, const simdbezier::Options& options) {
    return simdbezier::split(job.nets, T(0.5), T(0.5),
                             {job.out(0, 3), job.out(1, 3), job.out(2, 3), job.out(3, 3)}, options)
        .status;
  }
  static double bytes() { return 4 * kValuesPerPatch * sizeof(T); }
  static std::string check(NetJob<T>& job) {
    std::string failure;
    for (std::size_t k = 0; k < 4 && failure.empty(); ++k) {
      failure = job.compare(k, 3, k % 2 == 0 ? 0 : 0.5, k / 2 == 0 ? 0 : 0.5, 0.5);
    }
    return failure;
  }
};

template <typename T>
struct Elevate {
  static constexpr const char* kName = "elevate";
  static Status run(NetJob<T>& job, const simdbezier::Options& options) {
    return simdbezier::elevate(job.nets, job.out(0, kHigher), options).status;
  }
  static double bytes() { return (kHigher + 1) * (kHigher + 1) * 3 * sizeof(T); }
  static std::string check(NetJob<T>& job) { return job.compare(0, kHigher, 0, 0, 1); }
};

template <typename T>
struct TightBoxes {
  static constexpr const char* kName = "tight_boxes";
  static Status run(NetJob<T>& job, const simdbezier::Options& options) {
    T* const low = job.results.data();
    return simdbezier::tight_boxes(job.nets, kBoxLevels, {low, low + 3 * kPatches}, options).status;
  }
  static double bytes() { return 6 * sizeof(T); }
  static std::string check(NetJob<T>& job) {
    for (std::size_t k = 0; k < 3 * kPatches; ++k) {
      const T* const net = job.nets.points + k / 3 * kValuesPerPatch;
      double low = point_of(net, 3, k % 3, 0, 0);
      double high = low;
      for (int sample = 0; sample < 17 * 17; ++sample) {
        const double at = point_of(net, 3, k % 3, sample % 17 / 16.0, sample / 17 / 16.0);
        low = std::min(low, at);
        high = std::max(high, at);
      }
      const double below = low - static_cast<double>(job.results[k]);
      const double above = static_cast<double>(job.results[k + 3 * kPatches]) - high;
      // The samples are inside, up to their own rounding, and the box is little larger.
      if (!(std::min(below, above) >= -1e-12 &&
            std::max(below, above) <= 0.1 * (high - low) + 0.02)) {
        return "box " + std::to_string(k) + " is off";
      }
    }
    return {};
  }
};

template <typename T>
struct Flatness {
  static constexpr const char* kName = "flatness";
  static Status run(NetJob<T>& job, const simdbezier::Options& options) {
    return simdbezier::flatness(job.nets, job.results.data(), options).status;
  }
  static double bytes() { return sizeof(T); }
  static std::string check(NetJob<T>& job) {
    for (std::size_t p = 0; p < kPatches; ++p) {
      const T* const net = job.nets.points + p * kValuesPerPatch;
      double largest = 0;
      for (std::size_t k = 0; k < 16; ++k) {
        const double u = static_cast<double>(k % 4) / 3;
        const double v = static_cast<double>(k / 4) / 3;
        double squares = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const auto corner = [&](std::size_t j, std::size_t i) {
            return static_cast<double>(net[(j * 4 + i) * 3 + c]);
          };
          const double bilinear = (1 - v) * ((1 - u) * corner(0, 0) + u * corner(0, 3)) +
                                  v * ((1 - u) * corner(3, 0) + u * corner(3, 3));
          squares += std::pow(static_cast<double>(net[3 * k + c]) - bilinear, 2);
        }
        largest = std::max(largest, std::sqrt(squares));
      }
      if (!(std::abs(static_cast<double>(job.results[p]) - largest) <= 1e-5 * (1 + largest))) {
        return "patch " + std::to_string(p) + " is off";
      }
    }
    return {};
  }
};

template <typename T, template <typename> typename Operation>
class TimedNet {
public:
  explicit TimedNet(Isa isa) {
    job_.options.threads = 1;
    job_.options.isa = isa;
  }
  void operator()() { (void)Operation<T>::run(job_, job_.options); }
  std::string check() {
    std::fill(job_.results.begin(), job_.results.end(), T(NAN));
    const std::string failure = run_verified(
        job_.options, [&](const auto& options) { return Operation<T>::run(job_, options); });
    return failure.empty() ? Operation<T>::check(job_) : failure;
  }
  [[nodiscard]] double items() const { return kPatches; }
  [[nodiscard]] double bytes() const { return kPatches * Operation<T>::bytes(); }

private:
  NetJob<T> job_;
};

template <typename T, template <typename> typename Operation>
void add_operation(Isa isa) {
  const std::string name = std::string("nets/") + Operation<T>::kName +
                           (sizeof(T) == 4 ? "/f32/" : "/f64/") +
                           std::string(simdbezier::to_string(isa)) + "/3x3/cache/threads:1";
  register_row(name, benchmark::kMicrosecond, 1, [isa] { return TimedNet<T, Operation>(isa); });
}

/// find_adjacency on a square of patches, whose edges are known.
template <typename T>
class TimedAdjacency {
public:
  TimedAdjacency() : points_(kValuesPerPatch * kPatches), links_(4 * kPatches) {
    for (std::size_t k = 0; k < 16 * kPatches; ++k) {
      const std::size_t patch = k / 16;
      const std::size_t column = 3 * (patch % kSide) + k % 4;
      const std::size_t row = 3 * (patch / kSide) + k % 16 / 4;
      points_[3 * k] = static_cast<T>(column);
      points_[3 * k + 1] = static_cast<T>(row);
      points_[3 * k + 2] = static_cast<T>(column * row % 7);
    }
    options_.threads = 1;
  }
  void operator()() { (void)run(); }
  std::string check() {
    std::fill(links_.begin(), links_.end(), EdgeLink{EdgeKind::collapsed});
    const Status status = run();
    if (status != Status::ok) {
      return std::string(simdbezier::to_string(status));
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      if (links_[k] != expected(k / 4, static_cast<PatchEdge>(k % 4))) {
        return "edge " + std::to_string(k % 4) + " of patch " + std::to_string(k / 4) + " is wrong";
      }
    }
    return {};
  }
  [[nodiscard]] double items() const { return kPatches; }
  [[nodiscard]] double bytes() const {
    return static_cast<double>(links_.size() * sizeof(EdgeLink));
  }

private:
  static constexpr std::size_t kSide = 16;
  static_assert(kSide * kSide == kPatches);

  Status run() {
    return simdbezier::find_adjacency(ControlNets<T>{points_.data(), kPatches}, links_.data(),
                                      options_);
  }
  static EdgeLink expected(std::size_t patch, PatchEdge edge) {
    const std::size_t place =
        edge == PatchEdge::u0 || edge == PatchEdge::u1 ? patch % kSide : patch / kSide;
    const std::size_t step = edge == PatchEdge::u0 || edge == PatchEdge::u1 ? 1 : kSide;
    const bool back = edge == PatchEdge::u0 || edge == PatchEdge::v0;
    if (place == (back ? 0 : kSide - 1)) {
      return {EdgeKind::boundary};
    }
    constexpr PatchEdge kOpposite[] = {PatchEdge::v1, PatchEdge::v0, PatchEdge::u1, PatchEdge::u0};
    return {EdgeKind::shared, kOpposite[static_cast<std::size_t>(edge)], false,
            back ? patch - step : patch + step};
  }

  std::vector<T> points_;
  std::vector<EdgeLink> links_;
  simdbezier::Options options_;
};

template <typename T>
void add_type() {
  register_row(std::string("nets/find_adjacency") + (sizeof(T) == 4 ? "/f32" : "/f64") +
                   "/scalar/3x3/cache/threads:1",
               benchmark::kMicrosecond, 1, [] { return TimedAdjacency<T>(); });
  for (const Isa isa : simdbezier::available_isas()) {
    add_operation<T, Split>(isa);
    add_operation<T, Elevate>(isa);
    add_operation<T, TightBoxes>(isa);
    add_operation<T, Flatness>(isa);
  }
}

} // namespace

void register_net_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
