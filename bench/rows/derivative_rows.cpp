// derivatives/order_<n>/<type>/<isa>/16x16/cache/threads:1: evaluate_derivatives on grids of
// bicubic patches. All derivatives of orders up to n are computed together, (n+1)(n+2)/2 vectors a
// sample, as planes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "bench/rows/rows.hpp"
#include "bench/subjects/library_call.hpp"
#include "bench/subjects/place.hpp"
#include "bench/subjects/reference.hpp"
#include "bench/subjects/shared_data.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::Isa;
using simdbezier::PartialDerivative;
using simdbezier::Status;

constexpr std::size_t kSide = 16;
constexpr std::size_t kSamples = kSide * kSide;
constexpr int kDegree = 3;

/// Returns the derivative of that order of a cubic at t, by de Casteljau's scheme: differences of
/// the points, then interpolation of these.
double derivative_of(std::vector<double> points, int order, double t) {
  if (order > kDegree) {
    return 0;
  }
  for (int n = kDegree; n > 0; --n) {
    const bool differs = kDegree - n < order;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      points[i] =
          differs ? n * (points[i + 1] - points[i]) : points[i] + t * (points[i + 1] - points[i]);
    }
  }
  return points[0];
}

/// Returns component c of d^(a+b) S / du^a dv^b at (u, v).
template <typename T>
double reference(const T* net, const PartialDerivative<T>& wanted, std::size_t c, double u,
                 double v) {
  std::vector<double> across;
  for (std::size_t j = 0; j <= kDegree; ++j) {
    std::vector<double> row;
    for (std::size_t i = 0; i <= kDegree; ++i) {
      row.push_back(static_cast<double>(net[3 * (4 * j + i) + c]));
    }
    across.push_back(derivative_of(row, wanted.order_u, u));
  }
  return derivative_of(across, wanted.order_v, v);
}

template <typename T>
class TimedDerivative {
public:
  TimedDerivative(Isa isa, int order) {
    for (int b = 0; b <= order; ++b) {
      for (int a = 0; a + b <= order; ++a) {
        wanted_.push_back({a, b, {}});
      }
    }
    patches_ = cached_patches(kSamples * 3 * wanted_.size() * sizeof(T));
    // Each plane begins at a line's start, and not a power of two apart, as in place_results().
    plane_ = patches_ * kSamples + 5 * kLineBytes / sizeof(T);
    T* plane = reinterpret_cast<T*>(output_buffer());
    for (PartialDerivative<T>& one : wanted_) {
      one.out = simdbezier::Vectors<T>::planes(plane, plane + plane_, plane + 2 * plane_);
      plane += 3 * plane_;
    }
    set_ = &shared_patch_set<T>(patches_);
    options_.threads = 1;
    options_.isa = isa;
  }

  void operator()() { (void)evaluate(options_); }

  std::string check() {
    std::fill_n(wanted_.front().out.x, 3 * plane_ * wanted_.size(), T(NAN));
    std::string failure = run_verified(*set_, patches_, options_,
                                       [this](const auto& options) { return evaluate(options); });
    for (std::size_t k = 0; k < patches_ * kSamples && failure.empty(); ++k) {
      failure = is_checked(k / kSamples, patches_) ? check_sample(k) : failure;
    }
    return failure;
  }

  [[nodiscard]] double items() const { return static_cast<double>(patches_ * kSamples); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(3 * wanted_.size() * sizeof(T));
  }

private:
  Status evaluate(const simdbezier::Options& options) const {
    return simdbezier::evaluate_derivatives(
        *set_, simdbezier::Grid<T>::uniform(kSide, kSide, {0, patches_}), wanted_, options);
  }

  [[nodiscard]] std::string check_sample(std::size_t k) const {
    const T* const net = shared_nets<T>(patches_) + k / kSamples * kValuesPerPatch;
    const double u = static_cast<double>(k % kSide) / (kSide - 1);
    const double v = static_cast<double>(k % kSamples / kSide) / (kSide - 1);
    for (const PartialDerivative<T>& one : wanted_) {
      const T* const planes[] = {one.out.x, one.out.y, one.out.z};
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = reference(net, one, c, u, v);
        const double found = static_cast<double>(planes[c][k]);
        if (!(std::abs(found - expected) <= 1e-4 * (1 + std::abs(expected)))) {
          return "derivative (" + std::to_string(one.order_u) + ", " + std::to_string(one.order_v) +
                 ") of sample " + std::to_string(k) + " is off by " +
                 std::to_string(found - expected);
        }
      }
    }
    return {};
  }

  std::vector<PartialDerivative<T>> wanted_;
  std::size_t patches_ = 0;
  std::size_t plane_ = 0; ///< values from one plane to the next
  const simdbezier::PatchSet<T>* set_ = nullptr;
  simdbezier::Options options_;
};

template <typename T>
void add_type() {
  for (const int order : {2, 3}) {
    for (const Isa isa : simdbezier::available_isas()) {
      const std::string name = "derivatives/order_" + std::to_string(order) +
                               (sizeof(T) == 4 ? "/f32/" : "/f64/") +
                               std::string(simdbezier::to_string(isa)) + "/16x16/cache/threads:1";
      register_row(name, benchmark::kMicrosecond, 1,
                   [isa, order] { return TimedDerivative<T>(isa, order); });
    }
  }
}

} // namespace

void register_derivative_rows() {
  add_type<float>();
  add_type<double>();
}

} // namespace simdbezier_bench
