#include <tools/formats/surfaces/basis_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <tools/formats/surfaces/roundings.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr double kMostInteger = 0x1p53;

using Integers = std::array<std::uint64_t, kMostDegree + 1>;

Integers binomials(std::size_t degree) {
  Integers row = {1};
  for (std::size_t n = 1; n <= degree; ++n) {
    for (std::size_t k = n; k > 0; --k) {
      row[k] += row[k - 1];
    }
  }
  return row;
}

bool is_integer(double value) {
  return std::abs(value) < kMostInteger && value == std::nearbyint(value);
}

/// Divides a row and its denominator by what divides all of them. Rows that stand for the same
/// factors then have the same numerators, too.
void reduce(std::span<double> row, double& denominator) {
  auto common = static_cast<std::int64_t>(denominator);
  for (const double value : row) {
    common = std::gcd(common, static_cast<std::int64_t>(value));
  }
  for (double& value : row) {
    value /= static_cast<double>(common);
  }
  denominator /= static_cast<double>(common);
}

} // namespace

// The power t^k of degree n has the Bézier points C(i,k) / C(n,k). With the least common multiple
// of all C(n,k) as the denominator, factors of coefficients are integers below 2^53.
//
// A numerator of integers is exact. Any other one is a sum of `order` products: each of them is off
// by less than (order + 1) u of itself, and the denominator by u. Sums of `order` products of
// numerators and values add less than that, unless there is only one, with the factor 1.
BasisMatrix::BasisMatrix(const BasisFunctions& functions)
    : order_(static_cast<std::size_t>(functions.degree) + 1), numerators_(order_ * order_),
      denominators_(order_), sums_(order_), roundings_(order_) {
  const Integers powers = binomials(order_ - 1);
  std::uint64_t common = 1;
  for (std::size_t k = 0; k < order_; ++k) {
    common = std::lcm(common, powers[k]);
  }
  const double relative = (static_cast<double>(order_) + 2) * kUnit * kRounding;
  for (std::size_t i = 0; i < order_; ++i) {
    const Integers factors = binomials(i);
    const std::span<double> numerators = std::span(numerators_).subspan(i * order_, order_);
    std::vector<double> sizes(order_); // sums of absolute values
    bool is_exact = is_integer(functions.denominator * static_cast<double>(common));
    for (std::size_t j = 0; j < order_; ++j) {
      for (std::size_t k = 0; k <= i; ++k) {
        const double coefficient = functions.coefficients[k * order_ + j];
        const double term = static_cast<double>(factors[k] * (common / powers[k])) * coefficient;
        numerators[j] += term;
        sizes[j] += std::abs(term);
        is_exact = is_exact && is_integer(coefficient) && sizes[j] < kMostInteger;
      }
    }
    denominators_[i] = functions.denominator * static_cast<double>(common);
    if (is_exact) {
      reduce(numerators, denominators_[i]);
    }
    const auto zeros = static_cast<std::size_t>(std::ranges::count(numerators, 0.0));
    for (std::size_t j = 0; j < order_; ++j) {
      const double size = std::abs(numerators[j]);
      const bool is_copy = zeros + 1 == order_ && size == 1;
      sums_[i] += size;
      roundings_[i] += relative * ((is_copy ? 0 : size) + (is_exact ? 0 : sizes[j]));
      has_means_ = has_means_ && numerators[j] >= 0;
    }
    has_means_ = has_means_ && sums_[i] == denominators_[i];
  }
}

namespace {

/// Bézier points of one patch after the other.
class MeshPatches {
public:
  MeshPatches(PatchFile& file, const BasisMesh& mesh)
      : file_(file), mesh_(mesh), each_(mesh.weights == Weights::none ? 3 : 4) {
    find_rounding();
  }

  /// Adds one patch and returns how far rounding moves its surface at most.
  double add(std::size_t patch_u, std::size_t patch_v) {
    const std::size_t columns = mesh_.basis_u.order();
    const std::size_t rows = mesh_.basis_v.order();
    line_ = mesh_.lines[index(patch_u, 0, patch_v, 0)];
    values_ = {};
    sums_.resize(rows * columns * each_);
    for (std::size_t j = 0; j < rows; ++j) {
      add_row(patch_u, patch_v, j);
    }
    Reach reach;
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        reach.include(add_point(i, j), each_);
      }
    }
    file_.close_patch(mesh_.basis_u.degree(), mesh_.basis_v.degree(), mesh_.weights);
    return distance(reach);
  }

private:
  using Point = std::array<double, 4>;

  /// The points of a patch: the farthest one's coordinates, and the least weight.
  struct Reach {
    Point farthest = {};
    double least_weight = HUGE_VAL;

    void include(const Point& point, std::size_t each) {
      const double weight = each == 4 ? point[3] : 1;
      for (std::size_t c = 0; c < 3; ++c) {
        farthest[c] = std::max(farthest[c], std::abs(point[c] / weight));
      }
      least_weight = std::min(least_weight, weight);
    }
  };

  [[nodiscard]] std::size_t index(std::size_t patch_u, std::size_t i, std::size_t patch_v,
                                  std::size_t j) const {
    return mesh_.v.point(patch_v, j) * mesh_.u.points + mesh_.u.point(patch_u, i);
  }

  // A sum in u is off by rounding(i) max|value|; the sum in v of these, by that times sum(j) and by
  // rounding(j) (sum(i) + rounding(i)) max|value| more. Then the quotient and its denominator are
  // rounded once each. 2^-1060 is more than products that are too small can lose.
  void find_rounding() {
    for (std::size_t j = 0; j < mesh_.basis_v.order(); ++j) {
      for (std::size_t i = 0; i < mesh_.basis_u.order(); ++i) {
        const double divisor = mesh_.basis_u.denominator(i) * mesh_.basis_v.denominator(j);
        const double all = mesh_.basis_u.sum(i) + mesh_.basis_u.rounding(i);
        const double all_v = mesh_.basis_v.sum(j) + mesh_.basis_v.rounding(j);
        const double sums =
            mesh_.basis_u.rounding(i) * mesh_.basis_v.sum(j) + mesh_.basis_v.rounding(j) * all;
        const double quotient = divisor == 1 ? 0 : 2 * kUnit * all * all_v;
        rounding_ = std::max(rounding_, (sums + quotient) / divisor * kRounding);
        lost_ = std::max(lost_, (1 + (1 + all_v) / divisor) * 0x1p-1060);
      }
    }
    lost_ = rounding_ == 0 ? 0 : lost_;
  }

  /// Forms the sums in u of one row of values.
  void add_row(std::size_t patch_u, std::size_t patch_v, std::size_t j) {
    const std::size_t columns = mesh_.basis_u.order();
    std::array<const double*, kMostDegree + 1> value;
    for (std::size_t i = 0; i < columns; ++i) {
      value[i] = mesh_.points.data() + index(patch_u, i, patch_v, j) * each_;
      for (std::size_t c = 0; c < each_; ++c) {
        values_[c] = std::max(values_[c], std::abs(value[i][c]));
      }
    }
    for (std::size_t i = 0; i < columns; ++i) {
      const Point sum = combined(mesh_.basis_u.row(i), value.data());
      std::copy_n(sum.begin(), each_, sums_.data() + (j * columns + i) * each_);
    }
  }

  [[nodiscard]] Point combined(std::span<const double> factors, const double* const* values) const {
    Point sum = {};
    bool is_first = true;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (factors[k] != 0) {
        for (std::size_t c = 0; c < each_; ++c) {
          const double product = factors[k] * values[k][c];
          sum[c] = is_first ? product : sum[c] + product;
        }
        is_first = false;
      }
    }
    return sum;
  }

  /// Adds a point to the file.
  Point add_point(std::size_t i, std::size_t j) {
    const std::size_t columns = mesh_.basis_u.order();
    std::array<const double*, kMostDegree + 1> sum;
    for (std::size_t k = 0; k < mesh_.basis_v.order(); ++k) {
      sum[k] = sums_.data() + (k * columns + i) * each_;
    }
    Point point = combined(mesh_.basis_v.row(j), sum.data());
    const double divisor = mesh_.basis_u.denominator(i) * mesh_.basis_v.denominator(j);
    for (std::size_t c = 0; c < each_; ++c) {
      point[c] /= divisor;
      file_.points.push_back(point[c]);
    }
    file_.add_line(line_);
    const double weight = each_ == 4 ? point[3] : 1;
    if (!(weight > rounding_ * values_[3] + lost_)) {
      bad_input_at(file_.name, line_, "values whose Bézier points have weights above 0",
                   shortest(weight));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      if (!std::isfinite(point[c] / weight)) {
        bad_input_at(file_.name, line_, "values whose Bézier points are finite", "others");
      }
    }
    return point;
  }

  // With the exact surface N / W and the rounded one N' / W', whose points are means,
  //     N'/W' - N/W = ((N' - N) - N'/W' (W' - W)) / W.
  [[nodiscard]] double distance(const Reach& reach) const {
    Point apart;
    for (std::size_t c = 0; c < each_; ++c) {
      apart[c] = rounding_ * values_[c] + lost_;
    }
    const double weight = each_ == 4 ? apart[3] : 0;
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, apart[c] + reach.farthest[c] * weight);
    }
    return std::sqrt(3.0) * most / (reach.least_weight - weight) * kRounding;
  }

  PatchFile& file_;
  const BasisMesh& mesh_;
  std::size_t each_;
  double rounding_ = 0; // of Bézier points whose values are 1 at most
  double lost_ = 0;
  std::size_t line_ = 0;
  Point values_ = {}; // of the patch, the largest numbers
  std::vector<double> sums_;
};

} // namespace

double add_basis_mesh(PatchFile& file, const BasisMesh& mesh) {
  MeshPatches patches(file, mesh);
  double most = 0;
  for (std::size_t v = 0; v < mesh.v.patches; ++v) {
    for (std::size_t u = 0; u < mesh.u.patches; ++u) {
      most = std::max(most, patches.add(u, v));
    }
  }
  return most;
}

} // namespace simdbezier::tools
