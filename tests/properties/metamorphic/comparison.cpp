// See comparison.hpp.
#include "tests/properties/metamorphic/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {
namespace {

struct Sample {
  std::size_t net;
  std::size_t iu;
  std::size_t iv;
};

[[nodiscard]] bool is_reversal(Relation relation) {
  return relation == Relation::reversed_u || relation == Relation::reversed_v;
}

/// One sample on both sides of a relation.
class SampleComparison {
public:
  SampleComparison(const Comparison& what, const MetaEntry& entry, const Sample& at,
                   const AllowedErrors& bounds, const Sheet& from, const Sheet& to, Table& table)
      : what_(what), entry_(entry), at_(at), bounds_(bounds), from_(from), to_(to), table_(table) {
    const std::size_t iu = what.relation == Relation::reversed_u ? from.nu - 1 - at.iu : at.iu;
    const std::size_t iv = what.relation == Relation::reversed_v ? from.nv - 1 - at.iv : at.iv;
    index_ = (at.net * from.nv + at.iv) * from.nu + at.iu;
    related_index_ = what.relation == Relation::transposed ? (at.net * to.nv + iu) * to.nu + iv
                                                           : (at.net * to.nv + iv) * to.nu + iu;
  }

  void run() {
    for (std::size_t a = 0; a < kOrders; ++a) {
      for (std::size_t b = 0; b < kOrders; ++b) {
        if (!from_.derivatives[a][b].empty()) {
          compare_derivative(a, b);
        }
      }
    }
    if (!from_.status.empty()) {
      compare_status();
      compare_directions();
      compare_curvatures();
    }
  }

private:
  [[nodiscard]] double unit() const {
    return what_.is_double ? kUnitRoundoff<double> : kUnitRoundoff<float>;
  }
  [[nodiscard]] bool is_curve() const { return entry_.net.degree_v == 0; }
  [[nodiscard]] bool on_u_edge() const { return at_.iu == 0 || at_.iu == from_.nu - 1; }
  [[nodiscard]] bool on_v_edge() const { return at_.iv == 0 || at_.iv == from_.nv - 1; }
  [[nodiscard]] bool on_own_side() const {
    const bool on[] = {at_.iv == 0, at_.iv == from_.nv - 1, at_.iu == 0, at_.iu == from_.nu - 1};
    return on[entry_.side];
  }

  // --- what the related results should be --------------------------------------------------------

  [[nodiscard]] std::size_t related_component(std::size_t c) const {
    return tests::related_component(what_.relation, from_.components, c);
  }
  [[nodiscard]] bool equal_bits(std::size_t a, std::size_t b) const {
    switch (what_.relation) {
    case Relation::scaled:
    case Relation::permuted:
      return true;
    case Relation::elevated:
    case Relation::translated: // corners are control points
      return a + b == 0 && on_u_edge() && (is_curve() || on_v_edge()) && !is_iso_call(what_.call);
    case Relation::reweighted:
      return false;
    default:
      return a + b == 0 && (what_.call == Call::iso_u   ? on_u_edge()
                            : what_.call == Call::iso_v ? on_v_edge()
                                                        : is_curve() || on_u_edge() || on_v_edge());
    }
  }

  // --- bounds ------------------------------------------------------------------------------------

  struct Uncertain {
    Vector3 value{};
    double error = 0; ///< in length
    [[nodiscard]] double size() const { return std::hypot(value[0], value[1], value[2]); }
  };
  [[nodiscard]] Uncertain derivative(std::size_t a, std::size_t b) const {
    Uncertain result;
    const auto d = static_cast<std::size_t>(from_.components);
    for (std::size_t c = 0; c < std::min<std::size_t>(d, 3); ++c) {
      result.value[c] = from_.derivatives[a][b][index_ * d + c];
      result.error += bounds_.of[a][b][c];
    }
    return result;
  }

  // --- comparisons -------------------------------------------------------------------------------

  void compare_derivative(std::size_t a, std::size_t b) {
    const bool swapped = what_.relation == Relation::transposed;
    const auto d = static_cast<std::size_t>(from_.components);
    const double* const expected = &from_.derivatives[a][b][index_ * d];
    const double* const found =
        &(swapped ? to_.derivatives[b][a] : to_.derivatives[a][b])[related_index_ * d];
    const double factor = sign_and_scale(what_.relation, a, b);
    const double bounded = equal_bits(a, b) ? 0 : std::abs(factor);
    const bool moved = what_.relation == Relation::translated && a + b == 0;
    const Output output = output_of(a, b);
    for (std::size_t c = 0; c < d; ++c) {
      const double e = factor * expected[c] + (moved && c < 3 ? kTranslation[c] : 0);
      // Where the translation is added here, in double, one rounding of T is left.
      const double allowed = bounded * bounds_.of[a][b][c] + (moved ? 2 * unit() * std::abs(e) : 0);
      judge(output, e, found[related_component(c)], allowed);
    }
    fill(output);
  }

  [[nodiscard]] static Output output_of(std::size_t a, std::size_t b) {
    constexpr Output kLow[3][3] = {{Output::position, Output::dv, Output::dvv},
                                   {Output::du, Output::duv, Output::any_order},
                                   {Output::duu, Output::any_order, Output::any_order}};
    return a < 3 && b < 3 ? kLow[a][b] : Output::any_order;
  }

  void compare_status() {
    judge(Output::status, static_cast<double>(from_.status[index_]),
          static_cast<double>(to_.status[related_index_]), 0);
    fill(Output::status);
  }

  /// How far both directions may be apart, in radians.
  [[nodiscard]] double direction_bound() const {
    if (from_.status[index_] != SampleStatus::regular) {
      return 2 * (what_.is_double ? 1e-9 : 1e-3) * 3.15 / 180;
    }
    const Uncertain du = derivative(1, 0);
    if (is_curve()) {
      return du.error / du.size() + 8 * unit();
    }
    const Uncertain dv = derivative(0, 1);
    return (du.error * dv.size() + dv.error * du.size()) / area() + 8 * unit();
  }
  /// |du x dv|
  [[nodiscard]] double area() const {
    const Vector3 a = derivative(1, 0).value;
    const Vector3 b = derivative(0, 1).value;
    return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]);
  }

  void compare_directions() {
    const double sign =
        (what_.relation == Relation::transposed || is_reversal(what_.relation)) ? -1 : 1;
    const double allowed = what_.relation == Relation::scaled ? 0 : direction_bound();
    if (!(allowed < kUseless)) {
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      judge(Output::normal, sign * from_.direction[3 * index_ + c],
            to_.direction[3 * related_index_ + related_component(c)], allowed);
    }
    fill(Output::normal);
  }

  /// First-order errors of L, M, N and the curvatures made of them.
  struct CurvatureBounds {
    double of[4] = {};
  };
  [[nodiscard]] CurvatureBounds curvature_bounds() const {
    const Uncertain du = derivative(1, 0);
    const Uncertain duu = derivative(2, 0);
    if (is_curve()) {
      const double speed = du.size();
      return {{4 * (du.error * duu.size() + speed * duu.error) / (speed * speed * speed) *
                   (1 + 3 * du.error / speed) +
               16 * unit() * duu.size() / (speed * speed)}};
    }
    const Uncertain dv = derivative(0, 1);
    const double angle = direction_bound();
    const double squared = area() * area();
    const auto part = [&](const Uncertain& d) { // {|L|, its error}
      return std::pair(d.size(), d.error + d.size() * angle);
    };
    const auto [l, dl] = part(duu);
    const auto [m, dm] = part(derivative(1, 1));
    const auto [n, dn] = part(derivative(0, 2));
    const double e = du.size();
    const double g = dv.size();
    const double gaussian = ((l + dl) * dn + (n + dn) * dl + 2 * (m + dm) * dm) / squared +
                            4 * angle * (l * n + m * m) / squared;
    const double slopes = e * g > 0 ? du.error / e + dv.error / g : HUGE_VAL;
    const double mean =
        (e * e * dn + 2 * e * g * dm + g * g * dl) / squared +
        (4 * angle + 4 * slopes) * (e * e * n + 2 * e * g * m + g * g * l) / squared;
    const double h = std::abs(from_.curvature[4 * index_ + 1]);
    const double root = std::sqrt(2 * h * mean + mean * mean + gaussian);
    return {{4 * gaussian, 4 * mean, 4 * (mean + root), 4 * (mean + root)}};
  }

  void compare_curvatures() {
    const double* const a = &from_.curvature[4 * index_];
    const double* const b = &to_.curvature[4 * related_index_];
    const bool flipped =
        !is_curve() && (what_.relation == Relation::transposed || is_reversal(what_.relation));
    const double shrunk = what_.relation == Relation::scaled ? 1 / kScale : 1;
    const double expected[4] = {a[0] * shrunk * (is_curve() ? 1 : shrunk),
                                flipped ? -a[1] : a[1] * shrunk, flipped ? -a[3] : a[2] * shrunk,
                                flipped ? -a[2] : a[3] * shrunk};
    const bool regular = from_.status[index_] == SampleStatus::regular;
    const CurvatureBounds bounds = regular ? curvature_bounds() : CurvatureBounds{};
    for (std::size_t k = 0; k < 4; ++k) {
      // Elsewhere they are nan; of curves limits, whose bounds nobody states.
      const double limit = std::isfinite(expected[k]) ? 1e-3 * std::abs(expected[k]) : 0;
      const double allowed = what_.relation == Relation::scaled ? 0
                             : regular                          ? bounds.of[k]
                                                                : limit;
      judge(Output::curvature, expected[k], b[k], allowed);
    }
    fill(Output::curvature);
  }

  // --- the table ---------------------------------------------------------------------------------

  static constexpr double kUseless = 0.3; ///< bounds on directions beyond this say nothing

  [[nodiscard]] Cell cell(Output output) const {
    return {what_.relation, what_.call,  what_.shape,  output,
            entry_.side,    entry_.kind, what_.origin, what_.is_double};
  }
  void fill(Output output) {
    if (on_own_side()) {
      table_.fill(cell(output));
    }
  }
  void judge(Output output, double expected, double found, double allowed) {
    if (expected == found || std::abs(expected - found) <= allowed ||
        (std::isnan(expected) && std::isnan(found))) {
      return;
    }
    std::ostringstream text;
    text << std::hexfloat << "sample " << at_.iu << ", " << at_.iv << ": " << expected
         << " expected, " << found << " found, " << std::defaultfloat << allowed << " allowed, "
         << std::abs(expected - found) << " apart";
    table_.fail(cell(output), text.str());
  }

  const Comparison& what_;
  const MetaEntry& entry_;
  Sample at_;
  const AllowedErrors& bounds_;
  const Sheet& from_;
  const Sheet& to_;
  Table& table_;
  std::size_t index_ = 0;
  std::size_t related_index_ = 0;
};

} // namespace

void compare(const Comparison& what, const std::vector<MetaEntry>& entries, const MetaBatch& batch,
             const Sheet& sheet, const MetaBatch& other, const Sheet& related_sheet, Table& table) {
  for (std::size_t net = 0; net < entries.size(); ++net) {
    const AllowedErrors bounds = allowed_errors(what, net, batch, other);
    for (std::size_t iv = 0; iv < sheet.nv; ++iv) {
      for (std::size_t iu = 0; iu < sheet.nu; ++iu) {
        SampleComparison(what, entries[net], {net, iu, iv}, bounds, sheet, related_sheet, table)
            .run();
      }
    }
  }
}

} // namespace simdbezier::tests
