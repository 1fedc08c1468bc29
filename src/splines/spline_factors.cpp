// See src/splines/spline_factors.hpp. The factors are those of the blossom (L. Ramshaw, Blossoming,
// 1987): de Boor's triangle on unit vectors instead of points.
#include "src/splines/spline_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {
namespace {

/// De Boor's triangle of one span on its way: vector j stands for a value that is a mean of the
/// span's points j - stage to j, by the factors that it holds.
class Triangle {
public:
  Triangle(const SplineKnots& knots, std::size_t first) noexcept
      : degree_(static_cast<std::size_t>(knots.degree())) {
    for (std::size_t j = 0; j <= degree_; ++j) {
      for (std::size_t c = 0; c <= degree_; ++c) {
        vector(j)[c] = {j == c ? 1.0 : 0.0, 0};
      }
    }
    for (std::size_t k = 1; k <= 2 * degree_; ++k) {
      knots_[k] = knots.knot(first + k);
    }
  }
  /// Copies what there is, and not the room for the highest degree.
  Triangle(const Triangle& other) noexcept : degree_(other.degree_), stage_(other.stage_) {
    std::copy_n(other.knots_, 2 * degree_ + 1, knots_);
    std::copy_n(other.vectors_, (degree_ + 1) * (degree_ + 1), vectors_);
  }
  Triangle& operator=(const Triangle&) = delete;

  /// Takes `times` stages with the argument x, which lies in the span:
  ///     v_j <- ((t_(j+p+1-r) - x) v_(j-1) + (x - t_j) v_j) / (t_(j+p+1-r) - t_j)
  void take(const TwoDoubles& x, std::size_t times) noexcept {
    for (const std::size_t last = stage_ + times; stage_ < last;) {
      ++stage_;
      for (std::size_t j = degree_; j >= stage_; --j) {
        const TwoDoubles& low = knots_[j];
        const TwoDoubles& high = knots_[j + degree_ + 1 - stage_];
        TwoDoubles* const here = vector(j);
        const TwoDoubles* const previous = vector(j - 1);
        if (x == high) { // a copy is a copy
          continue;
        }
        if (x == low) {
          std::copy_n(previous, degree_ + 1, here);
          continue;
        }
        const TwoDoubles length = high - low;
        const TwoDoubles left = quotient(high - x, length);
        const TwoDoubles right = quotient(x - low, length);
        for (std::size_t c = j - stage_; c <= j; ++c) {
          here[c] = left * previous[c] + right * here[c];
        }
      }
    }
  }

  /// The factors, when all stages have been taken.
  [[nodiscard]] const TwoDoubles* factors() const noexcept {
    return vectors_ + degree_ * (degree_ + 1);
  }

private:
  [[nodiscard]] TwoDoubles* vector(std::size_t j) noexcept { return vectors_ + j * (degree_ + 1); }

  std::size_t degree_;
  std::size_t stage_ = 0;
  TwoDoubles knots_[2 * kMostOrder]; ///< [k]: T_(first + k)
  TwoDoubles vectors_[kMostOrder * kMostOrder];
};

/// Whole numbers that are `numbers` times `common`, divided by what they share; false where they
/// are no whole numbers, up to roundings.
bool as_whole_numbers(const TwoDoubles* numbers, std::size_t count, std::int64_t common,
                      double* out, double& divisor) noexcept {
  std::int64_t shared = common;
  std::int64_t whole[kMostOrder];
  for (std::size_t k = 0; k < count; ++k) {
    const TwoDoubles scaled = numbers[k] * TwoDoubles{static_cast<double>(common), 0};
    const double nearest = std::nearbyint(scaled.high);
    const double apart = std::abs((scaled.high - nearest) + scaled.low);
    if (!(apart <= 0x1p-80 * nearest)) {
      return false;
    }
    whole[k] = static_cast<std::int64_t>(nearest);
    shared = std::gcd(shared, whole[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    out[k] = static_cast<double>(whole[k] / shared);
  }
  divisor = static_cast<double>(common / shared);
  return true;
}

std::int64_t factorial(std::size_t n) noexcept {
  return n < 2 ? 1 : static_cast<std::int64_t>(n) * factorial(n - 1);
}

} // namespace

void SplineFactors::add_mean(const TwoDoubles* factors, std::size_t first) {
  std::size_t begin = 0;
  std::size_t end = order_;
  const auto is_zero = [&](std::size_t k) { return factors[k].high == 0; };
  while (is_zero(begin)) {
    ++begin;
  }
  while (is_zero(end - 1)) {
    --end;
  }
  SplineMean mean{first + begin, factors_.size(), end - begin, 1};
  double whole[kMostOrder];
  const bool is_whole =
      as_whole_numbers(factors + begin, mean.terms, factorial(order_ - 1), whole, mean.divisor);
  for (std::size_t k = 0; k < mean.terms; ++k) {
    factors_.push_back(is_whole ? whole[k] : factors[begin + k].high);
  }
  means_.push_back(mean);
}

/// The order of the arguments is part of what makes bits equal: the begin of the span comes first
/// where it counts more often, its end where that does, and where both count alike the mean of both
/// orders is taken, so that mirrored spans have mirrored factors.
void SplineFactors::add_span(const SplineKnots& knots, std::size_t span) {
  const SplineSpan& here = knots.spans()[span];
  const std::size_t degree = order_ - 1;
  const TwoDoubles ends[2] = {{here.interval.begin, 0}, {here.interval.end, 0}};
  TwoDoubles found[kMostOrder][kMostOrder];
  for (std::size_t k = 0; k <= degree; ++k) {
    std::fill_n(found[k], degree + 1, TwoDoubles{0, 0}); // most splines are of low degrees
  }
  for (std::size_t side = 0; side < 2; ++side) {
    Triangle triangle(knots, here.first);
    for (std::size_t own = 0; own <= degree; ++own) { // times that this side's end counts
      const std::size_t other = degree - own;
      if (own >= other) {
        Triangle whole = triangle;
        whole.take(ends[1 - side], other);
        TwoDoubles* const factors = found[side == 0 ? other : own];
        for (std::size_t c = 0; c <= degree; ++c) {
          const TwoDoubles sum = factors[c] + whole.factors()[c];
          const double share = own == other && side == 1 ? 0.5 : 1;
          factors[c] = {share * sum.high, share * sum.low};
        }
      }
      triangle.take(ends[side], own < degree ? 1 : 0);
    }
  }
  const std::size_t shared = span > 0 && knots.joins_previous(span) ? 1 : 0;
  begins_.push_back(means_.size() - shared);
  for (std::size_t k = shared; k <= degree; ++k) {
    const bool closes = k == degree && span + 1 == knots.spans().size() && knots.joins_previous(0);
    if (closes && span > 0) {
      SplineMean begin = means_.front(); // the last knot is the first one, but for roundings
      begin.first += period_;
      means_.push_back(begin);
    } else {
      add_mean(found[k], here.first);
    }
  }
}

Status SplineFactors::build(const SplineAxis& axis, std::size_t& knot) {
  SplineKnots knots;
  if (const Status status = knots.build(axis, knot); !status) {
    return status;
  }
  order_ = static_cast<std::size_t>(axis.degree) + 1;
  period_ = knots.period();
  for (std::size_t span = 0; span < knots.spans().size(); ++span) {
    intervals_.push_back(knots.spans()[span].interval);
    add_span(knots, span);
  }
  return Status::ok;
}

void SplineFactors::build_point() {
  intervals_ = {{0, 1}};
  means_ = {{0, 0, 1, 1}};
  begins_ = {0};
  factors_ = {1};
}

} // namespace simdbezier::detail
