// See bounds.hpp. Computed from the packed values on demand: they are all it depends on.
#include <simdbezier/bounds.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/certificate/certificate_sums.hpp"
#include "src/certificate/position_bounds.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Bounds of one component.
struct Bound {
  double position = 0;
  double du = 0;
  double dv = 0;

  void include(const Bound& other) {
    position = std::max(position, other.position);
    du = std::max(du, other.du);
    dv = std::max(dv, other.dv);
  }
};

/// The certificates of patches of one shape.
template <typename T>
class Certificate {
public:
  /// derivatives: whether their bounds are wanted as well.
  Certificate(const PatchStorage<T>& storage, bool fused, bool derivatives)
      : Certificate(storage, {storage.shape.order_u(), storage.shape.cells_u() == 2, fused},
                    {storage.shape.order_v(), storage.shape.cells_v() == 2, fused}, derivatives) {}

  /// Goes to one of the storage's patches.
  void look_at(std::size_t index) {
    index_ = index;
    control_.net = storage_.given.net(index * shape_.control_values());
  }

  /// The bounds of one component of the patch.
  [[nodiscard]] Bound component(std::size_t c) const {
    Bound bound;
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      // A polynomial's edges have no terms beyond those of its matrix; a quotient's edges, around
      // an origin of their own, may have some. Terms of zero, as around points, are exact.
      bound.include(shape_.rational ? quotient(cell, c, matrix(cell, c), matrix(cell, weight()), 0)
                                    : polynomial(cell, c));
      for (std::size_t e = 0; shape_.rational && e < kEdges; ++e) {
        const TermSums h = edge(cell, c, e);
        if (h.size > 0) {
          bound.include(quotient(cell, c, h, edge(cell, weight(), e), kEdgeOriginsAt + e));
        }
      }
    }
    bound.du *= static_cast<double>(shape_.cells_u());
    bound.dv *= static_cast<double>(shape_.cells_v());
    if (storage_.given.weights == Weights::homogeneous) {
      add_merged(c, bound);
    }
    return bound;
  }

  /// Writes the bounds of all positions of the patch, which are those of component().
  void positions(PositionBound& out) const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape_.components); ++c) {
      out[c] = component(c).position;
    }
  }
  /// Whether several patches can be measured at once.
  [[nodiscard]] bool is_plain() const {
    return !shape_.rational && shape_.cells() == 1 && shape_.components == 3 &&
           storage_.origins == nullptr;
  }
  /// This is positions() of kMeasured plain patches from `index` on.
  void positions(std::size_t index, const MeasureKernels<T>& measures, PositionBound* out) {
    double sums[kComponents][kMeasured];
    measures.sums(storage_.coefficients + index * shape_.coefficients(), shape_.coefficients(),
                  matrix_.terms(), matrix_.weights(), sums);
    for (std::size_t p = 0; p < kMeasured; ++p) {
      for (std::size_t c = 0; c < kComponents; ++c) {
        // One cell has degrees of at most 5, so that the sum on the way is at most 2^10 times this.
        constexpr double kUsual = 0x1p-12 * static_cast<double>(std::numeric_limits<T>::max()) / 8;
        out[p][c] = kRoundings * sums[c][p] + kDenormals;
        if (!(sums[c][p] < kUsual)) [[unlikely]] {
          look_at(index + p);
          out[p][c] = component(c).position;
        }
      }
    }
  }

private:
  static constexpr double kUnit = std::numeric_limits<T>::epsilon() / 2;
  /// First order in u, and what the higher orders add.
  static constexpr double kRoundings = 1.01 * kUnit;
  static constexpr double kDenormals =
      64 * static_cast<double>(std::numeric_limits<T>::denorm_min());

  /// Edges are rounded as rows are.
  Certificate(const PatchStorage<T>& storage, const DirectionRoundings& u,
              const DirectionRoundings& v, bool derivatives)
      : storage_(storage), shape_(storage.shape), control_{storage.given.net(0), shape_.points(),
                                                           shape_.channels(), shape_.rational},
        matrix_(as_column(u), v), along_u_(u, DirectionRoundings()),
        along_v_(DirectionRoundings(), v), per_step_(u.fused ? 1 : 2), derivatives_(derivatives) {}

  static DirectionRoundings as_column(DirectionRoundings direction) {
    direction.column = true;
    return direction;
  }
  [[nodiscard]] std::size_t weight() const { return static_cast<std::size_t>(shape_.components); }

  /// This covers a polynomial's edges v = const as well. Their terms are sums of these; even and
  /// odd parts round each at most once more than a column does, and every row rounds its constant.
  [[nodiscard]] TermSums matrix(std::size_t cell, std::size_t channel) const {
    const T* const c = storage_.coefficients + index_ * shape_.coefficients() +
                       cell * shape_.cell_coefficients() + channel * shape_.matrix();
    const std::size_t order = shape_.order_v();
    return {matrix_, derivatives_, [&](std::size_t k, std::size_t l) { return c[k * order + l]; }};
  }
  [[nodiscard]] TermSums edge(std::size_t cell, std::size_t channel, std::size_t e) const {
    const T* const c = storage_.edges + index_ * shape_.edges() + cell * shape_.cell_edges() +
                       channel * shape_.edge_powers() * kEdges + e;
    const bool along_u = e == kEdgeV0 || e == kEdgeV1;
    return {along_u ? along_u_ : along_v_, derivatives_,
            [&](std::size_t k, std::size_t l) { return c[(k + l) * kEdges]; }};
  }
  [[nodiscard]] double origin(std::size_t cell, std::size_t channel, std::size_t at) const {
    return storage_.origins == nullptr
               ? 0
               : static_cast<double>(
                     storage_.origins[index_ * shape_.origins() + cell * shape_.cell_origins() +
                                      channel * kOriginsPerComponent + at]);
  }

  [[nodiscard]] double carried(double largest) const {
    return carried_error<T>(shape_.degree_u + shape_.degree_v, largest);
  }

  [[nodiscard]] Bound polynomial(std::size_t cell, std::size_t c) const {
    const TermSums sums = matrix(cell, c);
    double position = sums.value;
    if (storage_.origins != nullptr) {
      double most = 0;
      for (std::size_t i = 0; i < kOriginsPerComponent; ++i) {
        most = std::max(most, std::fabs(origin(cell, c, i)));
      }
      position += sums.size + most;
    }
    // In one cell, terms add up to all control values at least, whose higher orders cover this; of
    // derivatives, the largest value is no part of the terms.
    const bool halved = shape_.cells() > 1;
    const double lost = halved || derivatives_ ? carried(control_.largest(c)) : 0;
    const auto bound = [&](double sum, double factor, double way) {
      return unless_overflow<T>(kRoundings * sum + kDenormals + factor * lost, way);
    };
    return {bound(position, halved ? 1 : 0, sums.way + position),
            bound(sums.du, 2 * shape_.degree_u, sums.way_u),
            bound(sums.dv, 2 * shape_.degree_v, sums.way_v)};
  }

  /// Bounds of S = h / w around an origin O, S_u = (h_u - S w_u) / w and S_v, from those of h, w
  /// and their derivatives: each operation's error and what it inherits.
  [[nodiscard]] Bound quotient(std::size_t cell, std::size_t c, const TermSums& h,
                               const TermSums& w, std::size_t origin_at) const {
    const double around = origin(cell, c, origin_at);
    const double reach = control_.reach_from(around, c, kUnit); // bounds |S|
    const double most_w = control_.largest(weight());
    const double lost_w = carried(most_w);
    const double lost_h = carried((control_.largest(c) + std::fabs(around)) * most_w);
    const double error_h = kRoundings * h.value + kDenormals + lost_h;
    const double error_w = kRoundings * w.value + kDenormals + lost_w;
    const double lowest = lowest_weight(w, error_w);
    // From half as much on, packing lifts weights of edges that are points.
    if (!(lowest > error_w)) {
      constexpr double kUnknown = std::numeric_limits<double>::infinity();
      return {kUnknown, kUnknown, kUnknown};
    }
    // The reciprocal of w and its product with h round once each.
    const double error_s =
        (error_h + reach * error_w) / lowest + 2 * kRoundings * reach + kDenormals;
    const double way_s = h.way + w.way + reach;
    const auto slope = [&](double size_h, double size_w, double sum_h, double sum_w, int degree,
                           double way) {
      const double factor = 2.0 * degree;
      const double error_hu = kRoundings * sum_h + kDenormals + factor * lost_h;
      const double error_wu = kRoundings * sum_w + kDenormals + factor * lost_w;
      const double numerator = size_h + reach * size_w;
      const double error = error_hu + size_w * error_s + reach * error_wu +
                           kRoundings * per_step_ * numerator + kDenormals;
      const double most = numerator / lowest; // bounds |S_u|
      const double bound =
          1.01 * (error + most * error_w) / lowest + 2 * kRoundings * most + kDenormals;
      return unless_overflow<T>(bound, way + numerator + most + way_s);
    };
    Bound bound;
    bound.position = 1.01 * error_s;
    if (storage_.origins != nullptr) {
      const double size = std::fabs(around) + reach;
      // Corners are points; where halves meet, what h and w gave by three roundings.
      const double corner = (shape_.cells() == 1 ? 2 : 3) * kRoundings * size;
      bound.position = std::max(bound.position + kRoundings * size, corner);
    }
    bound.position = unless_overflow<T>(bound.position, way_s + std::fabs(around));
    bound.du = slope(h.size_u, w.size_u, h.du, w.du, shape_.degree_u, h.way_u + w.way_u);
    bound.dv = slope(h.size_v, w.size_v, h.dv, w.dv, shape_.degree_v, h.way_v + w.way_v);
    return bound;
  }

  /// Adds what edges that are points up to roundings lose when they become points. Let a be how far
  /// apart their points are, and R the ratio of the patch's weights: such an edge has moved by up
  /// to a, derivatives along it have been up to degree R a (M. S. Floater, Derivatives of rational
  /// Bezier curves, 1992), and those across it change by up to |w_u / w| a.
  void add_merged(std::size_t c, Bound& bound) const {
    const std::size_t order_u = shape_.order_u();
    const std::size_t order_v = shape_.order_v();
    const PointRun edges[] = {{0, 1, order_u},
                              {(order_v - 1) * order_u, 1, order_u},
                              {0, order_u, order_v},
                              {order_u - 1, order_u, order_v}};
    double apart = 0;
    for (const PointRun& edge : edges) {
      apart = std::max(apart, control_.merged_distance(edge, c));
    }
    const double slope = 1.01 * apart * control_.largest(weight()) / control_.least_weight();
    bound.position += 1.01 * apart;
    bound.du += shape_.degree_u * slope;
    bound.dv += shape_.degree_v * slope;
  }

  /// A lower bound of w as computed: the least of its control values, or what the other terms leave
  /// of its constant.
  [[nodiscard]] double lowest_weight(const TermSums& w, double error) const {
    return std::max(control_.least_weight() * (1 - 4 * kUnit), 2 * w.constant - w.size - error) -
           error;
  }

  const PatchStorage<T>& storage_;
  const NetShape& shape_;
  std::size_t index_ = 0;
  ControlValues control_;
  TermFactors matrix_;
  TermFactors along_u_; ///< of edges
  TermFactors along_v_;
  double per_step_;
  bool derivatives_;
};

} // namespace

template <typename T>
void find_position_bounds(const PatchSet<T>& set, Isa isa, std::size_t begin, std::size_t end,
                          PositionBound* out) noexcept {
  const MeasureKernels<T>& measures = separate_table<NetTable<T>>(isa).measures;
  const SetStorage<T>& all = *set.storage();
  while (begin < end) {
    const std::uint32_t bucket = all.place(begin).bucket;
    Certificate<T> certificate(all.buckets[bucket], fuses_multiply_add(isa), false);
    std::size_t count = 0;
    for (; begin < end && all.place(begin).bucket == bucket; begin += count, out += count) {
      const std::size_t index = all.place(begin).index;
      // Patches of one bucket are in order in it.
      const PatchPlace last = all.place(std::min(begin + kMeasured, end) - 1);
      if (certificate.is_plain() && last.bucket == bucket && last.index - index == kMeasured - 1) {
        certificate.positions(index, measures, out);
        count = kMeasured;
      } else {
        certificate.look_at(index);
        certificate.positions(*out);
        count = 1;
      }
    }
  }
}

template void find_position_bounds(const PatchSet<float>&, Isa, std::size_t, std::size_t,
                                   PositionBound*) noexcept;
template void find_position_bounds(const PatchSet<double>&, Isa, std::size_t, std::size_t,
                                   PositionBound*) noexcept;

} // namespace detail

template <typename T>
ErrorBounds error_bounds(const PatchSet<T>& set, std::size_t patch, Isa isa) noexcept {
  return detail::find_bounds<ErrorBounds>(set, patch, isa, [&](bool fuses, ErrorBounds& bounds) {
    const detail::PatchPlace place = set.storage()->place(patch);
    detail::Certificate<T> certificate(set.storage()->buckets[place.bucket], fuses, true);
    certificate.look_at(place.index);
    for (std::size_t c = 0; c < static_cast<std::size_t>(set.components()); ++c) {
      const detail::Bound bound = certificate.component(c);
      bounds.position[c] = bound.position;
      bounds.du[c] = bound.du;
      bounds.dv[c] = bound.dv;
    }
  });
}

template SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<float>&, std::size_t, Isa) noexcept;
template SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<double>&, std::size_t,
                                                 Isa) noexcept;

template <typename T>
double largest_position_bound(const PatchSet<T>& set, Isa isa) noexcept {
  Isa chosen = Isa::automatic;
  if (resolve_isa(isa, chosen) != Status::ok) {
    return set.empty() ? 0 : std::numeric_limits<double>::infinity();
  }
  const detail::DefaultFpEnvironment environment; // bounds may be denormal
  double largest = 0;
  for (std::size_t patch = 0; patch < set.size();) {
    constexpr std::size_t kBlock = 32;
    detail::PositionBound bounds[kBlock];
    const std::size_t end = std::min(set.size(), patch + kBlock);
    detail::find_position_bounds(set, chosen, patch, end, bounds);
    for (const detail::PositionBound* at = bounds; patch < end; ++patch, ++at) {
      largest = std::max(largest, *std::max_element(at->begin(), at->begin() + set.components()));
    }
  }
  return largest;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(largest_position_bound);

} // namespace simdbezier
